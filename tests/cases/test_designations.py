"""Designations of makers, read as bearings of the library with their class of clearance."""

import csv
import math
import re
import tomllib
from collections import Counter
from pathlib import Path

import pytest

from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.library.designation_suffixes import parted, suffixes
from ehlectric.cases.library.designation_types import no_such_bearing, type_of
from ehlectric.cases.library.designations import known_bearings, read_designation
from ehlectric.cases.library.estimated_bearings import estimated_geometry, series
from ehlectric.errors import InputError
from ehlectric.formulas.load_ratings import ball_static_rating
from tests.helpers.each import each

NAMES = library.bearing_names()
REST = {"radial_load": "1 kN", "inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.03 um"}
OIL = {"base": "paper"}


@each(
    ("text", "name", "clearance"),
    [
        ("6208-C3", "6208", "C3"),
        ("6208-2RS1/C3", "6208", "C3"),
        ("6208 2Z", "6208", None),
        ("6310 ZZ C4", "6310", "C4"),
        ("NU 208 ECP", "nu-208", None),
        ("nu208ecp/c3", "nu-208", "C3"),
        ("NU-215-EM", "nu-215", None),
        ("7208 BEP", "7208-b", None),
        ("7208-B", "7208-b", None),
        ("7208 C TVP P5", "7208-c", None),
        ("NJ 208 ECP", "nu-208", None),
        ("N 208 ECP", "nu-208", None),
    ],
)
def test_designations(text, name, clearance):
    found = read_designation(text, NAMES)
    assert (found.name, found.clearance_class) == (name, clearance)


@each(
    ("text", "name", "clearance"),
    [
        ("6314-C3", "6314", "C3"),
        ("NU 210 ECP/C3", "nu-210", "C3"),
        ("7210 BEP", "7210-b", None),
        ("7908 A5", "7908-a5", None),
        ("61808-2RZ", "6808", None),
        ("60/22 ZZ", "60/22", None),
        ("32208 J2/Q", "32208", None),
        ("HR 32208 J", "32208", None),
        ("HK2020", "hk-2020", None),
        ("NA 49/22", "na-49/22", None),
        ("RNA4904", "rna-4904", None),
        ("NK 20/20", "nk-20/20", None),
        ("51208", "51208", None),
        ("AXK 75100", None, None),
        ("AXK 2542", "axk-2542", None),
        ("QJ 208 N2MA/C3", "qj-208", "C3"),
    ],
)
def test_designations_of_the_usual_series(text, name, clearance):
    found = read_designation(text, known_bearings())
    assert (found and (found.name, found.clearance_class)) == (name and (name, clearance))


@each("text", ["6999", "HK 2020", "32208", "bearing", "", "7208 X"])
def test_bearings_that_the_library_lacks(text):
    assert read_designation(text, NAMES) is None


@each(
    ("text", "message"),
    [
        ("6208 XYZ", "'XYZ'"),
        ("6208/VL0241", "coating"),
        ("6208 HC5", "element_material"),
        ("6208 C3 C4", "one class"),
    ],
)
def test_suffixes_that_may_change_the_bearing_are_refused(text, message):
    with pytest.raises(InputError, match=message):
        read_designation(text, NAMES)


@each(
    ("text", "words"),
    [
        *((f"6308 {suffix}", "reinforced set") for suffix in ("E", "EC", "ECP", "EM", "ETN9", "ECJ", "EW")),
        ("6308-2RS1 E", "reinforced set"),
        ("QJ 208 E", "reinforced set"),
        ("NU 208 2RS", "two rubbing seals"),
        ("NA 4904 2RS", "two rubbing seals"),
        ("6208 X", "other boundary dimensions"),
        ("6208 Q", "surfaces for sliding on bearings of kind tapered roller"),
        ("32208 TN9", "polymer cage"),
        ("HK 2020 ECP", "reinforced design"),
        ("NU 1010 ECP", "NU-10"),
    ],
)
def test_suffixes_are_harmless_for_some_kinds_only(text, words):
    """SKF's general catalogue: E is a reinforced ball set of deep-groove bearings and the reinforced roller
    set of cylindrical ones; needle roller bearings with seals have shorter needles.
    """
    with pytest.raises(InputError) as error:
        read_designation(text, known_bearings())
    assert words in str(error.value)


def test_the_same_suffixes_are_taken_where_they_are_harmless():
    for text in (
        "NU 208 ECP",
        "NU 208 E",
        "NU 310 EW",
        "7210 BEP",
        "32008 X",
        "32208 J2/Q",
        "6308 TN9",
        "6308 M",
    ):
        assert read_designation(text, known_bearings()) is not None, text


def test_every_suffix_names_kinds_of_bearings():
    kinds = {"any", *(one.kind for one in series().values())}
    for one in suffixes().values():
        assert set(one.kinds) <= kinds, one.text
        assert one.kinds or one.elsewhere or one.instead, one.text
        assert set(one.not_series) <= {bearing.series for bearing in series().values()}, one.text


def test_long_and_strange_texts_are_refused_at_once():
    for text in (
        "6208" * 10_000,
        "6208" + "Z" * 100_000,
        "6208" + "C3" * 10_000,
        "🙂",
        "-",
        "NU",
        "209-HAMROCK",
    ):
        reading = _reading(text)
        assert reading[0] == "209-hamrock" or len(reading) < 600


def test_every_suffix_has_a_meaning():
    assert all(one.meaning for one in suffixes().values())
    assert {"2RS", "ECP", "TN9"} <= set(suffixes())


def test_a_file_with_a_designation():
    """C3 of a bore of 40 mm is 15 to 33 um before mounting, 24 in the middle."""
    case = BearingCase.of(base="6208-2Z/C3", lubricant=OIL, **REST)
    assert case.bearing.base == "6208"
    assert case.bearing.clearance_class == "C3"
    assert case.bearing.radial_clearance == pytest.approx(24e-6)
    assert BearingCase.from_dict(case.to_dict()) == case
    own = BearingCase.of(base="6208-2Z/C3", radial_clearance="10 um", lubricant=OIL, **REST)
    assert own.bearing.radial_clearance == pytest.approx(10e-6)
    own = BearingCase.of(base="6208-2Z/C3", clearance_class="C3", lubricant=OIL, **REST)
    assert own.bearing.clearance_class == "C3"
    with pytest.raises(InputError, match="a bearing of the library or a designation"):
        BearingCase.of(base="32298", lubricant=OIL, **REST)


@each(
    ("base", "clearance"),
    [
        # Middle of CN of ISO 5753-1: 6 to 20 um on 40 mm, 10 to 30 um on 70 mm; rollers on 50 mm 30 to 60 um.
        ("6208", 13e-6),
        ("6208-2RS1", 13e-6),
        ("6314", 20e-6),
        ("NU 210 ECP", 45e-6),
        ("nu-210", 45e-6),
        ("NA 4908", 37.5e-6),
    ],
)
def test_a_designation_without_a_class_stands_for_the_normal_class(base, clearance):
    case = BearingCase.of(base=base, lubricant=OIL, **REST)
    assert (case.bearing.clearance_class, case.bearing.radial_clearance) == ("CN", pytest.approx(clearance))
    assert BearingCase.from_dict(case.to_dict()) == case
    given = BearingCase.of(base=base, radial_clearance="10 um", lubricant=OIL, **REST)
    assert (given.bearing.clearance_class, given.bearing.radial_clearance) == (None, pytest.approx(10e-6))
    tight = BearingCase.of(base=base, clearance_class="C2", lubricant=OIL, **REST)
    assert tight.bearing.clearance_class == "C2"


@each("base", ["6208-C3", "6314 C3", "NU 210 ECP/C3", "6208/CN"])
@each("given", [{"clearance_class": "C2"}, {"radial_clearance": "C2"}])
def test_a_class_that_contradicts_the_designation_is_refused(base, given):
    with pytest.raises(InputError, match="'C2' with base") as caught:
        BearingCase.of(base=base, lubricant=OIL, **given, **REST)
    assert caught.value.key == "bearing.clearance_class"


def test_classes_before_mounting_follow_the_designation():
    fits = {"shaft_interference": "10 um", "housing_interference": "-10 um", "housing_material": "steel"}
    of = {base: BearingCase.of(base=base, fits=fits, lubricant=OIL, **REST) for base in ("6208", "6208-C3")}
    assert [one.bearing.clearance_class for one in of.values()] == ["CN", "C3"]
    own = fits | {"unmounted_clearance": "20 um"}
    for base in of:
        case = BearingCase.of(base=base, fits=own, lubricant=OIL, **REST)
        assert (case.bearing.clearance_class, case.bearing.fits.unmounted_clearance) == (None, 20e-6)


@each("base", ["6316/C3VL0241", "22210 E", "7208 B/C3", "6208 XYZ"])
def test_another_designation_that_is_refused_names_the_key(base):
    case = BearingCase.of(base="6208", lubricant=OIL, **REST)
    with pytest.raises(InputError) as caught:
        case.replace({"bearing.base": base})
    assert caught.value.key == "bearing.base"


def test_another_designation_brings_its_class():
    """Its own class replaces every clearance; without a class, only an implied one is replaced."""
    given = BearingCase.of(base="6208", radial_clearance="10 um", lubricant=OIL, **REST)
    classed = given.replace({"bearing.base": "6314-C3"})
    assert (classed.bearing.clearance_class, classed.bearing.radial_clearance) == ("C3", pytest.approx(38e-6))
    again = classed.replace({"bearing.base": "6208-C4"})
    assert (again.bearing.clearance_class, again.bearing.radial_clearance) == ("C4", pytest.approx(37e-6))
    assert given.replace({"bearing.base": "6314"}).bearing.radial_clearance == pytest.approx(10e-6)
    implied = BearingCase.of(base="6208", lubricant=OIL, **REST)
    assert implied.replace({"bearing.base": "6314"}).bearing.radial_clearance == pytest.approx(20e-6)
    rollers = implied.replace({"bearing.base": "32208", "bearing.axial_load": "500 N"})
    assert rollers.bearing.clearance_class is None
    assert classed.replace({"bearing.base": "6208"}).bearing.clearance_class == "C3"


@each(("base", "key"), [("QJ 208", "radial_clearance"), ("HK 2020", "radial_clearance")])
def test_bearings_without_classes_still_need_a_clearance(base, key):
    with pytest.raises(InputError) as caught:
        BearingCase.of(base=base, lubricant=OIL, **REST)
    assert caught.value.key == f"bearing.{key}"


LIST = Path(__file__).parent / "designations.csv"


def _listed():
    lines = (line for line in LIST.read_text(encoding="utf-8").splitlines() if not line.startswith("#"))
    return list(csv.DictReader(lines))


def _reading(text):
    """Name and class of a designation, or the text of its refusal."""
    try:
        found = read_designation(text, known_bearings())
    except InputError as error:
        return str(error)
    return str(no_such_bearing(text)) if found is None else (found.name, found.clearance_class or "")


def test_designations_as_people_type_them():
    """Each is read as the right bearing with its class, or refused with what is unknown about it."""
    rows = _listed()
    wrong = {}
    for row in rows:
        reading, expected = _reading(row["text"]), (row["name"], row["clearance"])
        right = reading == expected if row["name"] else isinstance(reading, str) and row["refused"] in reading
        if not right:
            wrong[row["text"]] = reading
    assert wrong == {}
    assert len({row["text"] for row in rows}) == len(rows) >= 300
    assert Counter(bool(row["name"]) for row in rows)[True] >= 150


@each("shape", ["{0}", "skf {0}", "{0}/C3", "{0} c3", "{1}", "{2}", "FAG {1}"])
def test_every_bearing_is_read_by_its_own_name(shape):
    """In capital and small letters, with spaces, and without a sign behind the letters of the type."""
    for name in series():
        text = shape.format(name.upper(), name.replace("-", " "), name.upper().replace("-", "", 1))
        assert _reading(text)[0] == name, text


@each("base", ["22210 E", "1208", "3208 A", "5308", "81208", "29412", "C 2210", "UC 208", "4208", "NN 3010"])
def test_a_kind_that_is_not_modelled_is_refused_by_its_name_without_examples_of_other_kinds(base):
    with pytest.raises(InputError) as caught:
        BearingCase.of(base=base, lubricant=OIL, **REST)
    assert caught.value.key == "bearing.base"
    assert "a kind that is not modelled" in str(caught.value)
    assert "such as" not in str(caught.value)


@each(
    ("base", "kind"),
    [
        ("6298", "deep-groove ball"),
        ("NU 299 ECP", "cylindrical roller"),
        ("QJ 299", "four-point contact ball"),
        ("7299 B", "angular-contact ball"),
        ("32298", "tapered roller"),
        ("LM11749/LM11710", "tapered roller"),
        ("51298", "thrust ball"),
        ("NK 99/20", "needle roller"),
        ("HK 9920", "needle roller"),
        ("AXK 9920", "thrust needle roller"),
        ("R8ZZ", "deep-groove ball"),
    ],
)
def test_examples_of_a_refusal_are_of_the_kind_that_was_typed(base, kind):
    with pytest.raises(InputError, match="such as") as caught:
        BearingCase.of(base=base, lubricant=OIL, **REST)
    text = str(caught.value).partition("such as ")[2].partition(" (list")[0]
    names = [name.strip("'") for name in text.split(", ")]
    assert [series()[name].kind for name in names] == [kind] * 3


def test_types_of_designations_agree_with_the_series():
    """Each bearing of the series has the type of its kind, so that no example is of another kind."""
    for name, bearing in series().items():
        found = type_of(name.upper().replace("-", "", 1) if name[0].isalpha() else name.upper())
        assert found is not None, name
        assert found.kind == bearing.kind, name


@each(
    ("text", "bore", "pieces"),
    [
        ("2RS1C3WT", 40.0, ["2RS1", "C3", "WT"]),
        ("C3LHT23", 40.0, ["C3", "LHT23"]),
        ("C3HT", 40.0, ["C3", "HT"]),
        ("MC3", 80.0, ["M", "C3"]),
        ("MC3", 8.0, ["MC3"]),
        ("C3VL0241", 80.0, ["C3", "VL0241"]),
        ("P6C4", 40.0, ["P6", "C4"]),
    ],
)
def test_suffixes_that_are_written_together(text, bore, pieces):
    known, unknown = parted(text, bore)
    assert ([one.text for one in known], unknown) == (pieces, "")


@each("text", ["MN", "ZM", "C3C4", "2RSZZ", "TNP"])
def test_letters_are_not_divided_into_single_ones_or_into_two_suffixes_of_a_group(text):
    assert parted(text, 40.0)[1]


@each(
    ("base", "clearance"),
    [
        # Middle of CM of NSK's table 9.13: balls on 10 mm 4 to 11 um, on 40 mm 9 to 17 um and on 150 mm 24 to
        # 38 um; rollers on 50 mm 20 to 35 um.
        ("6200ZZCM", 7.5e-6),
        ("6208DDUCM", 13e-6),
        ("6330CM", 31e-6),
        ("NU210EMCM", 27.5e-6),
        # C3 on 150 mm is 46 to 91 um, CN on 8 mm 2 to 13 um.
        ("6330/C3", 68.5e-6),
        ("608ZZ", 7.5e-6),
    ],
)
def test_clearances_of_electric_motors_and_of_small_and_large_bearings(base, clearance):
    more = {"profile": "logarithmic"} if base.startswith("N") else {}
    case = BearingCase.of(base=base, lubricant=OIL, **REST, **more)
    assert case.bearing.radial_clearance == pytest.approx(clearance)


@each(("base", "key"), [("625", "radial_clearance"), ("6244", "radial_clearance")])
def test_bores_outside_the_table_of_clearances_need_a_clearance(base, key):
    with pytest.raises(InputError) as caught:
        BearingCase.of(base=base, lubricant=OIL, **REST)
    assert (caught.value.key, caught.value.is_missing) == (f"bearing.{key}", True)


@each("base", ["625 C3", "6234 CM", "NA 4908 CM"])
def test_classes_that_are_not_printed_for_a_bore_are_refused(base):
    with pytest.raises(InputError, match=r"radial_clearance"):
        BearingCase.of(base=base, lubricant=OIL, **REST)


@each(
    ("name", "factor"),
    [("6226", 14.5), ("6240", 15.2), ("6248", 15.2), ("6330", 13.9), ("6348", 14.2), ("6030", 15.9)],
)
def test_large_balls_have_the_printed_factor_of_the_static_rating(name, factor):
    """NSK prints f0 of ISO 76, which depends on ball over pitch circle, next to the ratings."""
    bearing = series()[name]
    found = estimated_geometry(bearing)
    own = ball_static_rating(found.elements, found.element_diameter, found.pitch_diameter, 0.0)
    f0 = own / (1e6 * found.elements * found.element_diameter**2)
    assert f0 == pytest.approx(factor, abs=0.15)


def test_small_bearings_contain_their_balls():
    """608: seven balls of 5/32 in; 626: six of 3.5 mm, as makers sell them (unverified source)."""
    found = {name: estimated_geometry(series()[name]) for name in ("608", "626", "627")}
    assert [one.elements for one in found.values()] == [7, 6, 7]
    assert found["608"].element_diameter == pytest.approx(25.4e-3 * 5 / 32, rel=1e-6)
    assert found["626"].element_diameter == pytest.approx(3.5e-3)
    assert (found["627"].pitch_diameter, found["608"].pitch_diameter) == (0.015, 0.015)


def test_contact_angles_of_super_precision_designations():
    angles = {base: series()[_reading(base)[0]].contact_angle for base in ("7014 CD/P4A", "7014 ACD/P4A")}
    assert [math.degrees(angle) for angle in angles.values()] == pytest.approx([15.0, 25.0])


@each("base", ["7208 B/C3", "32208 J2/C3", "51208 C3"])
def test_a_class_of_a_kind_without_radial_clearance_is_refused_in_the_designation(base):
    with pytest.raises(InputError, match="'C3'") as caught:
        BearingCase.of(base=base, lubricant=OIL, **REST)
    assert caught.value.key == "bearing.base"


@each(
    "text, parts, coating",
    [
        ("FAG 6312-C-VL0241", ["'C'", "'VL0241'", "of SKF"], "skf-insocoat-vl0241"),
        ("6312 XYZ-J20AA", ["'XYZ'", "'J20AA'", "of Schaeffler"], "schaeffler-j20aa"),
        ("6312-VL2071", ["'VL2071'"], "skf-insocoat-vl2071"),
        ("SKF 6312/C3VL0241", ["'VL0241'"], "skf-insocoat-vl0241"),
        ("FAG 6312-C-J20AA-C4", ["'J20AA'"], "schaeffler-j20aa"),
    ],
)
def test_one_refusal_names_all_suffixes_with_lines_to_paste(text, parts, coating):
    """The lines of the message, pasted into a file, are a base of the library and its coating."""
    with pytest.raises(InputError) as error:
        read_designation(text, known_bearings())
    line = str(error.value)
    assert [part for part in parts if part not in line] == []
    base, coated = re.search("(base = '[^']+')$", line), re.search(r"bearing\.(coating = \{.*?\})", line)
    pasted = tomllib.loads(f"{base[1]}\n{coated[1]}\n")
    classes = re.search("C[34]", text)
    base = "6312" if classes is None else f"6312/{classes[0]}"
    assert pasted == {"base": base, "coating": {"base": coating, "relative_permittivity": 9}}
    assert coating in library.coating_names()


@each(
    "text, bore",
    [("NCF 3010", 50.0), ("SL18 3010", 50.0), ("NU 2110", 50.0), ("6410", 50.0), ("7416 B", 80.0)],
)
def test_suggestions_have_the_bore_of_the_designation(text, bore):
    """ISO 15: the last two digits are the bore divided by 5 mm."""
    takes = no_such_bearing(text).takes
    suggested = re.findall("such as ('.*?') \\(", takes)[0].replace("'", "").split(", ")
    assert [1e3 * series()[name].bore for name in suggested] == pytest.approx([bore] * 3)


@each("designation", ["QJ 208", "NK 25/20", "RNA 4905"])
def test_no_class_of_clearance_is_advised_that_no_table_has(designation):
    """A class is advised for all others, of which the geometry is given here."""
    with pytest.raises(InputError) as caught:
        BearingCase.of(designation=designation, **REST, lubricant="fva-3")
    assert "radial_clearance: missing" in str(caught.value)
    assert "clearance_class" not in str(caught.value)
    table = BearingCase.of(base="6208", radial_clearance="10 um", **REST, lubricant="fva-3").to_dict()
    for key in ("base", "designation", "radial_clearance"):
        table["bearing"].pop(key, None)
    with pytest.raises(InputError, match=r"radial_clearance: missing.*clearance_class with bore"):
        BearingCase.from_dict(table)
