"""Gear files: round trips, changed copies, keys of results, and refused drawings."""

import math
import tomllib

import pytest
from hypothesis import given, settings

import ehlectric
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.gear.solving import solve_gear_pair
from ehlectric.quantities.results import GEAR_KEYS
from tests.gear.drawings import ANY, LAWS, USUAL, tables_of_drawing
from tests.gear.pairs import case_of
from tests.helpers.places import EXAMPLES

FILES = sorted(EXAMPLES.glob("gear_[ps]*.toml"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_case_is_written_and_read_again(path, tmp_path):
    case = GearCase.from_toml(path)
    again = GearCase.from_dict(case.to_dict())
    assert again == case
    (tmp_path / "again.toml").write_text(case.to_toml(), "utf-8")
    assert GearCase.from_toml(tmp_path / "again.toml").to_dict() == case.to_dict()
    assert GearCase.from_dict(tomllib.loads(path.read_text("utf-8"))) == case


def test_replace_returns_a_changed_copy():
    case = case_of()
    changed = case.replace({"gear.operation.pinion_torque": "100 N m"}, gear={"helix_angle": 0.1})
    assert (changed.gear.operation.pinion_torque, changed.gear.helix_angle) == (100.0, 0.1)
    assert (case.gear.operation.pinion_torque, case.gear.helix_angle) == (215.6, 0.0)
    assert changed.gear.teeth == (16, 24)


def test_a_composite_rq_replaces_the_ra_of_the_flanks():
    changed = case_of(composite_rq="0.1 um")
    assert changed.gear.rq == pytest.approx(0.1e-6)
    assert changed.gear.flank_ra is None


@pytest.mark.parametrize("ra", ["0.3 um", ["0.3 um"], ["0.3 um", "0.3 um"]])
def test_one_value_holds_for_both_gears(ra):
    """Rq of two flanks is sqrt(2) sqrt(pi/2) Ra for Gaussian heights."""
    assert case_of(flank_ra=ra).gear.rq == pytest.approx(math.sqrt(math.pi) * 0.3e-6, rel=1e-3)


def keys_of(table, before=""):
    """Dotted keys of nested tables, with the inputs as a single key."""
    for name, value in table.items():
        key = f"{before}{name}"
        if isinstance(value, dict) and key != "inputs":
            yield from keys_of(value, f"{key}.")
        else:
            yield key


def test_the_summary_has_the_keys_of_the_book(tmp_path):
    (tmp_path / "cycle.csv").write_text("time [s],speed [rpm]\n0,3000\n10,2000\n")
    case = case_of(contact__voltage="5 V", flank_ra="0.05 um").replace(
        {"duty.file": str(tmp_path / "cycle.csv")}
    )
    summary = ehlectric.solve_gear(case).summary()
    keys = {key for key in keys_of(summary) if not key.startswith("inputs.")}
    described = {key for key in GEAR_KEYS if not key.startswith(("lubricant.", "summary."))}
    assert keys - {"inputs"} <= described | {key.removeprefix("summary.") for key in GEAR_KEYS}
    listed = {key for key in described if key.startswith("uncertainty.indices.")}
    of_stretches = {key for key in described if key.startswith("duty.stretches.")}
    assert {key for key in described if "." in key} - listed - of_stretches <= keys
    (first, *_) = summary["uncertainty"]["indices"]
    assert {f"uncertainty.indices.{name}" for name in first} == listed


REFUSED = {
    "torque": ({"gear.operation.pinion_torque": 0.0}, "gear.operation.pinion_torque"),
    "no temperature": ({"gear.operation.bulk_temperature": "iso"}, "gear.operation.bulk_temperature"),
    "three values": ({"gear.flank_ra": ["0.3 um"] * 3}, "gear.flank_ra"),
    "one tip": ({"gear.tip_diameter": ["82.46 mm"]}, "gear.tip_diameter"),
    "no length": ({"gear.tip_relief": "5 um"}, "gear.tip_relief_length"),
    "no relief": ({"gear.tip_relief_length": "1 mm"}, "gear.tip_relief"),
    "relief of shares": (
        {"gear.lead_crowning": "5 um", "gear.operation.load_sharing": "iso"},
        "gear.operation.load_sharing",
    ),
    "one gear": ({"gear.teeth": [16]}, "gear.teeth"),
    "no teeth": ({"gear.teeth": [3, 24]}, "gear.teeth"),
    "ring first": ({"gear.teeth": [-24, 16]}, "gear.teeth"),
    "parts of teeth": ({"gear.teeth": [16, 24.5]}, "gear.teeth"),
    "material": ({"gear.material": "cheese"}, "gear.material"),
    "law": ({"gear.operation.load_sharing": "equal"}, "gear.operation.load_sharing"),
    "unknown": ({"gear.modul": "2 mm"}, "gear.modul"),
    "weibull": (
        {
            "discharge.weibull": {"scale": "15 V/um", "shape": 5, "reference_area": "1 mm^2"},
            "discharge.dielectric_strength": None,
        },
        "discharge.weibull",
    ),
    "connected": ({"discharge.external_capacitance": "1 nF"}, "discharge.external_capacitance"),
    "outlet": ({"discharge.outlet": "fingers"}, "discharge.outlet"),
    "over pressure": (
        {
            "discharge.dielectric_strength": None,
            "discharge.strength_table": {"pressure": ["0 GPa", "2 GPa"], "strength": ["15 V/um", "60 V/um"]},
        },
        "discharge.strength_table",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_wrong_keys_are_refused_by_name(name):
    changes, key = REFUSED[name]
    with pytest.raises(InputError) as refused:
        solve_gear_pair(case_of().replace(changes))
    assert str(refused.value).startswith(key)
    assert "\n" not in str(refused.value)


def solved_or_refused(drawing, law):
    """Summary of a drawing, or the text with which it is refused."""
    try:
        return ehlectric.solve_gear(GearCase.from_dict(tables_of_drawing(drawing, law))).summary()
    except InputError as error:
        return str(error)


@settings(max_examples=200, deadline=None)
@given(ANY, LAWS)
def test_any_drawing_runs_or_is_refused_in_one_line(drawing, law):
    """What is refused names its key; what runs has finite numbers."""
    answer = solved_or_refused(drawing, law)
    if isinstance(answer, str):
        assert "\n" not in answer
        assert answer.startswith("gear.")
        return
    for key in ("minimum_thickness", "max_pressure", "capacitance"):
        assert 0.0 < answer["mesh"][key] < math.inf
    assert answer["gear"]["transverse_contact_ratio"] >= 1.0


@settings(max_examples=100, deadline=None)
@given(USUAL, LAWS)
def test_usual_drawings_run(drawing, law):
    """Standard gears without undercut are not refused, except helical ones by the shares of spur gears."""
    answer = solved_or_refused(drawing, law)
    if law == "tip-relief" and drawing["helix_angle"] > 0.0:
        assert answer.startswith("gear.operation.load_sharing")
        return
    ratio = answer["gear"]["transverse_contact_ratio"]
    assert 1.0 < ratio < 2.0
    low, mean, high = (answer["gear"][f"contact_length{end}"] for end in ("_low", "", "_high"))
    assert low <= mean * (1.0 + 1e-12)
    assert mean <= high * (1.0 + 1e-12)
    assert answer["mesh"]["capacitance_low"] <= answer["mesh"]["capacitance"]
    assert answer["points"]["C"]["slide_to_roll_ratio"] == pytest.approx(0.0, abs=1e-9)


LISTS = {
    "gear.flank_ra": (("0.05 um +- 30 %", "0.06 um to 0.08 um"), ((3.5e-8, 6.5e-8), (6e-8, 8e-8))),
    "gear.tip_relief": (("8 um +- 2 um", "8 um +- 25 %"), ((6e-6, 10e-6), (6e-6, 10e-6))),
    "gear.tip_diameter": (("82.46 mm +- 10 um", "118.36 mm"), ((82.45e-3, 82.47e-3), None)),
    "gear.profile_shift": (("0.1817 +- 0.01", "0.1715"), ((0.1717, 0.1917), None)),
    "gear.summit_height": ("2 +- 0.5", (1.5, 2.5)),
}


@pytest.mark.parametrize("key", LISTS)
def test_numbers_of_each_gear_have_their_uncertainty_where_the_file_has_them(key):
    text, expected = LISTS[key]
    texts, ends = (text, expected) if isinstance(text, tuple) else ((text,), (expected,))
    tables, leaf = case_of(tip_relief_length="1.5 mm", tip_relief="8 um").to_dict(), key.rpartition(".")[2]
    bare = [float(each) if key == "gear.profile_shift" and "+-" not in each else each for each in texts]
    tables["gear"][leaf] = bare if isinstance(text, tuple) else text
    case = GearCase.from_dict(tables)
    names = [f"{key}.{place}" for place in range(1, len(texts) + 1)] if isinstance(text, tuple) else [key]
    found = {entry.key: (entry.low, entry.high) for entry in case.ranges}
    wanted = {name: span for name, span in zip(names, ends, strict=True) if span is not None}
    assert found.keys() == wanted.keys()
    for name, span in wanted.items():
        assert found[name] == pytest.approx(span, rel=1e-9)
    assert GearCase.from_dict(case.to_dict()) == case
    # The table of ranges has the same keys, and a new list removes the ranges of its numbers.
    spans = {name: [*span] for name, span in found.items()}
    assert case.replace({key: case.to_dict()["gear"][leaf]}, ranges=spans).ranges == case.ranges
    assert case.replace({key: case.to_dict()["gear"][leaf]}).ranges is None


@pytest.mark.parametrize("place", ["0", "3", "first"])
def test_a_place_that_a_list_does_not_have_is_refused(place):
    with pytest.raises(InputError, match=r"place from 1 to 2|unknown key"):
        case_of().replace({f"gear.flank_ra.{place}": 1e-7})


@pytest.mark.parametrize("flank_ra", ["0.1 um", 1e-7, ["0.1 um", "0.3 um"]])
def test_keys_of_both_gears_change_a_list_in_any_form(flank_ra):
    case = case_of().replace({"gear.flank_ra": flank_ra, "gear.flank_ra.2": "0.2 um"})
    assert case.gear.flank_ra == (1e-7, 2e-7)
    both = case_of().replace({"gear.flank_ra.1": "0.1 um", "gear.flank_ra.2": "0.2 um"})
    assert both.gear.flank_ra == (1e-7, 2e-7)


def test_only_numbers_of_gears_have_keys_of_their_own():
    bearing = ehlectric.BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    contact = ehlectric.Case.from_toml(EXAMPLES / "rough_contact.toml")
    table = {"temperature": ["20 degC", "80 degC"], "strength": ["15 V/um", "12 V/um"]}
    aged = bearing.replace({"discharge.strength_table": table})
    for case, changes in (
        (contact, {"roughness.1.1": 3}),
        (bearing, {"bearing.radial_load.1": "1 kN"}),
        (case_of().replace({"gear.composite_rq": 1e-7}), {"gear.flank_ra.1": 1e-7}),
        (aged, {"ranges": {"discharge.strength_table.strength.2": ["10 V/um", "14 V/um"]}}),
    ):
        with pytest.raises(InputError):
            case.replace(changes)


def test_a_roughness_with_a_range_is_not_asked_for():
    case = GearCase.from_toml(EXAMPLES / "gear_pair.toml")
    asked = "composite roughness"
    assert asked in str(ehlectric.solve_gear(case).verdict)
    given = case.replace(ranges={"gear.flank_ra.1": ["0.04 um", "0.06 um"]})
    result = ehlectric.solve_gear(given)
    assert asked not in str(result.verdict)
    assert "gear.flank_ra.1" in [each.key for each in result.uncertainty.inputs]
