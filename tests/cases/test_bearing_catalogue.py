"""The bearings of the library: their dimensions fit together, and their load ratings are the printed ones."""

import math
from dataclasses import replace

import pytest

from ehlectric.bearing.result import solve_bearing
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.library.bearing_catalogue import bearing_catalogue, catalogue_bearing
from ehlectric.cases.library.library_oils import KINDS, sources_of, weakest
from ehlectric.errors import InputError
from ehlectric.formulas import load_ratings as ratings
from tests.helpers.each import each

ALL = bearing_catalogue()
RATED = [bearing for bearing in ALL if bearing.rating is not None]
QUICK = ("6208", "7208-b", "nu-205")
DUTY = {"inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.05 um"}
OIL = {"base": "paper", "temperature": {"iso_vg": 46, "viscosity_index": 100, "density_15": "870 kg/m^3"}}
GIVEN = {
    "deep-groove ball": {"clearance_class": "CN", "radial_load": "500 N"},
    "angular-contact ball": {"radial_load": "500 N", "axial_load": "500 N"},
    "cylindrical roller": {"clearance_class": "CN", "profile": "logarithmic", "radial_load": "500 N"},
}


def over(bearings):
    return each("bearing", bearings, ids=lambda bearing: bearing.name)


def computed(bearing):
    """Dynamic and static rating by ISO 281 and ISO 76 [N]."""
    sizes = (bearing.elements, bearing.element_diameter, bearing.pitch_diameter)
    if bearing.roller_length is not None:
        dynamic = ratings.roller_dynamic_rating(*sizes, bearing.roller_length)
        return dynamic, ratings.roller_static_rating(*sizes, bearing.roller_length)
    rates = (ratings.ball_dynamic_rating, ratings.ball_static_rating)
    return tuple(rate(*sizes, bearing.contact_angle) for rate in rates)


@over(RATED)
def test_ratings_follow_from_the_internal_geometry(bearing):
    """Both printed ratings to 1.1 %, and the static one of the 6310 to 1.6 %.

    One ball more or less changes C_0r by 7 to 13 %; the next ball of the inch series changes it by 3 to 12 %.
    """
    dynamic, static = computed(bearing)
    assert dynamic == pytest.approx(bearing.rating.dynamic, rel=0.011, abs=0.0)
    margin = 0.016 if bearing.name == "6310" else 0.011
    assert static == pytest.approx(bearing.rating.static, rel=margin, abs=0.0)


@pytest.mark.slow
@over([bearing for bearing in RATED if bearing.roller_length is None])
def test_number_and_ball_are_the_only_ones_of_the_inch_series_with_both_ratings(bearing):
    """The rule of the catalogue finds the published balls, too, and the next best are clearly worse.

    All numbers from 6 to 17 are tried, with balls in steps of 1/64 in on a pitch circle of (d + D)/2.
    """
    printed = (bearing.rating.dynamic, bearing.rating.static)
    pitch, misses = 0.5 * (bearing.bore + bearing.outer_diameter), {}
    for elements in range(6, 18):
        for step in range(12, 65):
            ball = step * 25.4e-3 / 64.0
            if ball < 0.36 * (bearing.outer_diameter - bearing.bore):
                tried = replace(bearing, elements=elements, element_diameter=ball, pitch_diameter=pitch)
                errors = [rate / own - 1.0 for rate, own in zip(computed(tried), printed, strict=True)]
                misses[elements, ball] = math.hypot(*errors)
    best, second = sorted(misses, key=misses.__getitem__)[:2]
    assert best == (bearing.elements, pytest.approx(bearing.element_diameter, rel=4e-4, abs=0.0))
    # Both misses are hypotenuses of the two relative errors.
    assert misses[best] < min(0.017, 0.51 * misses[second])


@over([bearing for bearing in RATED if bearing.roller_length is not None])
def test_rollers_are_as_many_as_leave_a_fifth_of_a_diameter(bearing):
    """The rule of the catalogue, and the 18 rollers that are published of the NU 215."""
    gap = math.pi * bearing.pitch_diameter / bearing.element_diameter
    assert math.floor(gap / 1.2) == bearing.elements
    static = computed(replace(bearing, roller_length=1e-3))[1]
    length = bearing.rating.static / static
    assert 1e3 * bearing.roller_length == pytest.approx(length, rel=0.005, abs=0.0)


@over([bearing for bearing in RATED if bearing.rating.static_factor])
def test_printed_static_factor_tells_the_pitch_diameter(bearing):
    """The f_0 that NSK prints; 0.17 of it are 0.007 of D/d_m, as f_0 falls by 23 from 0.1 to 0.4."""
    ratio = bearing.element_diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    factor = ratings.static_factor(ratio)
    assert factor == pytest.approx(bearing.rating.static_factor, rel=0.0, abs=0.17)


@over(ALL)
def test_elements_and_rings_fit_together(bearing):
    """Pitch circle amid bore and outside diameter, room for a cage between elements, and for both rings."""
    ball, pitch = bearing.element_diameter, bearing.pitch_diameter
    assert pitch == pytest.approx(0.5 * (bearing.bore + bearing.outer_diameter), rel=0.016, abs=0.0)
    # Either ring has a seventh to a quarter of the section behind its raceway.
    section = 0.5 * (bearing.outer_diameter - bearing.bore)
    for thickness in (pitch - ball - bearing.bore, bearing.outer_diameter - pitch - ball):
        assert 0.14 * section < 0.5 * thickness < 0.25 * section
    # Bars of the cage: chord between neighbours less the element itself.
    bar = pitch * math.sin(math.pi / bearing.elements) - ball
    assert 0.12 * ball < bar < 0.85 * ball
    across = ball if bearing.roller_length is None else bearing.roller_length
    assert across < 0.9 * bearing.width


@over([bearing for bearing in ALL if bearing.kind == "deep-groove ball"])
def test_balls_of_a_deep_groove_bearing_can_be_filled_in(bearing):
    """Eccentric rings take balls over little more than half of the circle, from first to last ball centre."""
    chord = 2.0 * math.degrees(math.asin(bearing.element_diameter / bearing.pitch_diameter))
    assert 170.0 < (bearing.elements - 1) * chord < 197.0


@over(ALL)
def test_bore_is_that_of_the_designation(bearing):
    """Bore code by ISO 15: five times the last two digits, and 17 mm of the code 03."""
    if bearing.name == "209-hamrock":
        assert bearing.bore == pytest.approx(0.045, rel=1e-12, abs=0.0)
        return
    code = int("".join(filter(str.isdigit, bearing.name))[-2:])
    assert bearing.bore == pytest.approx(0.017 if code == 3 else 5e-3 * code, rel=1e-12, abs=0.0)


@over(ALL)
def test_every_value_has_a_source(bearing):
    """Each key of [bearing] but the kind has a source, and none has two; assumed values are the grooves."""
    keys = [key for source in bearing.sources for key in source.keys]
    given = set(library.bearing(bearing.name)) - {"kind"}
    rated = {"rating"} if bearing.rating else set()
    assert sorted(keys) == sorted(given | rated)
    assert set(keys) - rated <= set(Bearing.model_fields)
    assumed = {key for source in bearing.sources if source.kind == "assumed" for key in source.keys}
    assert assumed <= {"inner_groove", "outer_groove", "shoulder_height"}
    assert bearing.internal_kind in ("published", "by rule")


# One bearing of each kind by default, the others with the slow tests.
@pytest.mark.parametrize(
    "bearing",
    [
        pytest.param(bearing, id=bearing.name, marks=[] if bearing.name in QUICK else pytest.mark.slow)
        for bearing in ALL
    ],
)
def test_every_bearing_solves_by_formula(bearing):
    given = GIVEN[bearing.kind]
    if bearing.name == "209-hamrock":
        given = {"radial_load": "500 N"}
    tables = {"bearing": {"base": bearing.name} | DUTY | given, "lubricant": OIL, "contacts": "formula"}
    result = solve_bearing(BearingCase.from_dict(tables))
    assert result.converged
    # Bearings of this size have some tens to some hundreds of picofarads.
    assert 2e-11 < result.capacitance() < 2e-9


def test_a_deep_groove_bearing_replaces_an_angular_one():
    """The contact angle of the library belongs to its bearing; it goes with it."""
    bearing = {"base": "7208-b"} | DUTY | GIVEN["angular-contact ball"]
    case = BearingCase.from_dict({"bearing": bearing, "lubricant": OIL})
    changed = case.replace({"bearing.base": "6208", "bearing.radial_clearance": "10 um"}).bearing
    assert changed.contact_angle is None
    assert (changed.elements, changed.outer_diameter) == (9, pytest.approx(0.080))


def test_the_weakest_source_counts():
    sources = sources_of(
        {
            "source": [
                {"keys": ["elements"], "kind": "published", "citation": "a table"},
                {"keys": ["pitch_diameter", "bore"], "kind": "by rule", "citation": "a rule"},
            ]
        }
    )
    assert weakest(sources, ["elements"]) == "published"
    assert weakest(sources, ["elements", "bore"]) == "by rule"
    assert weakest(sources, ["width"]) is None
    assert (KINDS[0], KINDS[-1]) == ("measured", "assumed")


@each(
    "entry, text",
    [
        ({"kind": "guessed", "citation": "nobody"}, r"source\.kind: got 'guessed'; expected one of measured"),
        ({"kind": "published", "note": "well known"}, r"source: missing; expected a citation for bore"),
        ({"kind": "assumed"}, r"source: missing; expected a citation for bore, or a note if assumed"),
    ],
)
def test_a_source_without_what_it_needs_is_refused(entry, text):
    with pytest.raises(InputError, match=text):
        sources_of({"source": [{"keys": ["bore"], **entry}]})


def test_an_unknown_bearing_is_no_file():
    with pytest.raises(FileNotFoundError):
        catalogue_bearing("6000")
