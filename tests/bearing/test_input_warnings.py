"""Warnings of inputs that a machine hardly has, and of inputs that stand for a range."""

import math
from types import SimpleNamespace

import pytest

from ehlectric import evaluate
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.warnings import _most_speed, input_warning_conditions, library_viscosity
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.result_warnings import active
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

GRADE = {
    "lubricant__temperature__kinematic_viscosity_40": None,
    "lubricant__temperature__iso_vg": 32,
}
CLASS = {"bearing__radial_clearance": "C2", "bearing__bore": "40 mm"}


def told(viscosity=0.01, **changes):
    return {
        w.code: str(w) for w in active(input_warning_conditions(bearing_case(BALLS, **changes), viscosity))
    }


def test_an_ordinary_bearing_has_none():
    assert told() == {}


@each(
    "code, just, above, parts",
    [
        # 60 mm and 16 667 rpm are 1e6 mm/min.
        (
            "speed-high",
            {"bearing__inner_speed": "16660 rpm"},
            {"bearing__inner_speed": "16680 rpm"},
            ["16\xa0680 rpm", "60 mm", "1\xa0million mm/min", "deep-groove"],
        ),
        (
            "temperature-extreme",
            {"bearing__temperature": "150 degC"},
            {"bearing__temperature": "158 degC"},
            ["bearing.temperature", "158 °C", "-40 to 150 °C", "°F"],
        ),
        (
            "temperature-extreme",
            {"bearing__temperature": "-40 degC"},
            {"bearing__temperature": "-41 degC"},
            ["bearing.temperature", "-41 °C"],
        ),
        ("viscosity-high", {"viscosity": 10.0}, {"viscosity": 11.0}, ["11 Pa s", "70 °C"]),
        ("viscosity-grade", {}, GRADE, ["ISO VG 32", "28.8 to 35.2 mm²/s", "40 °C"]),
        (
            "clearance-class",
            {},
            CLASS,
            ["C2", "1 to 11 µm", " 6 µm"],
        ),
    ],
)
def test_limits(code, just, above, parts):
    assert told(**just) == {}
    found = told(**above)
    assert list(found) == [code]
    assert [part for part in parts if part not in found[code]] == []


def test_the_viscosity_of_a_base_is_not_at_the_temperature_of_the_bearing():
    """The paper's oil has 40 mPa s; a viscosity of the file, or one over temperature, is the user's own."""
    base = {"lubricant__temperature": None, "lubricant__base": "paper"}
    assert library_viscosity(bearing_case(BALLS, **base).lubricant) == 0.04
    assert library_viscosity(bearing_case(BALLS, **base, lubricant__viscosity="12 mPa s").lubricant) is None
    assert library_viscosity(bearing_case(BALLS).lubricant) is None


def test_a_load_in_kilonewtons_without_its_unit_is_doubted():
    """13 Z D^2 = 13 * 9 * 11.906^2 = 16.6 kN, near the 17.9 kN that NSK prints for a 6208."""
    alone = {"bearing__axial_load": None}
    assert "load-low" not in told(bearing__radial_load="17 N", **alone)
    text = told(bearing__radial_load=1.8, **alone)["load-low"]
    assert "1.8 N" in text
    assert "17\xa0000 N" in text


def test_a_grade_beside_the_viscosity_of_another_oil_says_the_index():
    """ISO VG 32 with the 6.8 mm²/s at 100 °C of a VG 46. By hand, ASTM D2270 with H = 46.41 mm²/s gives
    N = lg(46.41/32)/lg(6.8) = 0.1940 and (10^N - 1)/0.00715 + 100 = 178.8."""
    assert " 179" in told(**GRADE)["viscosity-grade"]
    with_index = GRADE | {
        "lubricant__temperature__kinematic_viscosity_100": None,
        "lubricant__temperature__viscosity_index": 100,
    }
    assert "index" not in told(**with_index)["viscosity-grade"]


def test_a_coating_of_assumed_values_says_so():
    """The name alone assumes 100 um and a permittivity of 9; both given, nothing is assumed."""
    formula = bearing_case(BALLS).replace({"contacts": "formula", "bearing.outer_diameter": "80 mm"})
    formula = formula.replace({"bearing.width": "18 mm"})
    table = {"base": "alumina", "thickness": "150 um", "relative_permittivity": 8.0}
    for coating, expected in (("alumina", ["100", "9"]), (table, [])):
        told = solve_bearing(formula.replace({"bearing.coating": coating}), workers=1).warnings
        texts = [one.text for one in told if one.code == "coating-assumed"]
        assert len(texts) == bool(expected)
        assert all(number in text for text in texts for number in expected)


@each(
    "kind, angle, limit",
    [
        ("deep-groove ball", None, 1e6),
        ("angular-contact ball", 15.0, 1e6),
        ("angular-contact ball", 40.0, 6.5e5),
        ("cylindrical roller", None, 8e5),
        ("tapered roller", 14.0, 4e5),
        ("thrust ball", None, 3e5),
    ],
)
def test_speeds_above_the_range_of_catalogues(kind, angle, limit):
    """Maximum speed factors n d_m of the Tribology Handbook (Neale), tables 20.2 and 20.3, in mm/min."""
    angle = None if angle is None else math.radians(angle)
    assert _most_speed(SimpleNamespace(kind=kind, contact_angle=angle)) == pytest.approx(limit, rel=1e-12)


def test_loads_below_the_minimum_load():
    """SKF: 0.01 C of ball bearings. NSK prints 29.1 kN for the 6208: 291 N."""
    alone = {"bearing__base": "6208", "bearing__axial_load": None}
    for load, told_of in ((292.0, False), (290.0, True), (60.0, True), (5.0, False)):
        found = told(bearing__radial_load=load, **alone)
        assert ("load-below-minimum" in found) == told_of, load
    text = told(bearing__radial_load=290.0, **alone)["load-below-minimum"]
    assert "290 N" in text
    assert "291 N" in text


def test_the_minimum_load_of_rollers_is_larger_and_a_preload_is_a_load():
    """SKF: 0.02 C of roller bearings; the rating of the file is C."""
    tables = {"contamination_factor": 0.5, "dynamic_rating": "50 kN"}
    rollers = BearingCase.from_toml(EXAMPLES / "bearing_tapered_pair.toml").replace({"bearing.life": tables})
    # Both bearings of a pair together have 2^(7/9) C.
    least = 0.02 * 50e3 * 2.0 ** (7.0 / 9.0)
    free = {"bearing.pair.axial_clearance": 0.0, "bearing.axial_load": 0.0}
    for changes, part, told_of in (
        (free, 0.99, True),
        (free, 1.01, False),
        ({"bearing.axial_load": 0.0}, 0.5, False),
    ):
        case = rollers.replace(changes | {"bearing.radial_load": part * least})
        codes = [warning.code for warning in active(input_warning_conditions(case, 0.01))]
        assert ("load-below-minimum" in codes) == told_of, (changes, part)


def test_preloads_of_many_points_are_loads_each():
    """Both points at once, as in sweeps and ``evaluate``: without a preload, a load of 500 N is too small."""
    pair = BearingCase.from_toml(EXAMPLES / "bearing_tapered_pair.toml")
    light = pair.replace({"bearing.radial_load": 500.0, "bearing.axial_load": 0.0})
    found = evaluate(light, {"bearing.pair.preload": [0.0, 200.0]})
    codes = found["warning_codes"].values.tolist()
    assert ["load-below-minimum" in one for one in codes] == [True, False]
