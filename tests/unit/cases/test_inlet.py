"""Table ``inlet``: its alternatives, what it is refused with, and changes that replace one by another."""

import pytest

from ehlectric import Case, InputError

LINE = {
    "contact": {
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "1 GPa",
        "entrainment_speed": "4 m/s",
    },
    "lubricant": {"base": "paper"},
}
POINT = {
    "contact": {
        "geometry": "point",
        "radius_x": "10 mm",
        "radius_y": "10 mm",
        "reduced_modulus": "226 GPa",
        "load": "20 N",
        "entrainment_speed": "2 m/s",
    },
    "lubricant": {"base": "paper"},
}
TABLE = {"y": ["-1 mm", "1 mm"], "thickness": ["0.1 um", "0.3 um"]}


def test_supplies_of_oil_in_si_units():
    assert Case.from_dict(LINE).inlet is None
    assert Case.from_dict(LINE | {"inlet": {"oil_layer": "0.2 um"}}).inlet.oil_layer == 2e-7
    assert Case.from_dict(POINT | {"inlet": {"film_ratio": "40 %"}}).inlet.film_ratio == 0.4
    table = Case.from_dict(POINT | {"inlet": {"layer_table": TABLE}}).inlet.layer_table
    assert table.y == (-1e-3, 1e-3)
    assert table.thickness == pytest.approx((1e-7, 3e-7), rel=1e-15)


def test_a_case_with_an_inlet_is_written_and_read_back(tmp_path):
    case = Case.from_dict(POINT | {"inlet": {"layer_table": TABLE}})
    path = tmp_path / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert Case.from_toml(path) == case


def test_one_supply_replaces_another():
    case = Case.from_dict(POINT | {"inlet": {"layer_table": TABLE}})
    changed = case.replace({"inlet.oil_layer": "50 nm"})
    assert changed.inlet.oil_layer == 5e-8
    assert changed.inlet.layer_table is None
    assert changed.replace({"inlet.film_ratio": 0.5}).inlet.oil_layer is None


@pytest.mark.parametrize(
    ("base", "changes", "message"),
    [
        (LINE, {"inlet": {}}, "inlet.oil_layer: missing; expected one of oil_layer, layer_table, film_ratio"),
        (
            LINE,
            {"inlet": {"oil_layer": "1 um", "film_ratio": 0.5}},
            "inlet.oil_layer: got oil_layer and film_ratio together; expected one of",
        ),
        (LINE, {"inlet": {"oil_layer": "0 um"}}, "inlet.oil_layer: got '0 um'; expected .* 1e-09"),
        (LINE, {"inlet": {"film_ratio": 1.5}}, "inlet.film_ratio: got 1.5"),
        (LINE, {"inlet": {"layer_table": TABLE}}, "inlet.layer_table: got that of a line contact"),
        (
            POINT,
            {"inlet": {"layer_table": TABLE | {"y": [1.0, -1.0]}}},
            "inlet.layer_table.y: .* expected increasing values",
        ),
        (
            POINT,
            {"inlet": {"layer_table": TABLE | {"thickness": ["1 um", "1 um", "1 um"]}}},
            "inlet.layer_table.thickness: got 3 values over 2 of y; expected as many",
        ),
        (
            POINT,
            {"inlet": {"oil_layer": "1 um"}, "meter": {"fill": "oil"}},
            r"inlet: got \[inlet\] beside \[meter\]",
        ),
        (
            {**LINE, "contact": {**LINE["contact"], "slide_to_roll_ratio": -2.1}},
            {"inlet": {"oil_layer": "1 um"}},
            r"inlet: got \[inlet\] with surfaces that move in opposite directions; expected a slide-to-roll",
        ),
        (
            {
                **POINT,
                "contact": {**POINT["contact"], "entrainment_speed": None, "speed_1": 3.0, "speed_2": -1.0},
            },
            {"inlet": {"film_ratio": 0.5}},
            r"inlet: got \[inlet\] with surfaces that move in opposite directions",
        ),
        (
            LINE,
            {
                "inlet": {"film_ratio": 0.5},
                "motion": {"passes": 1.0},
                "roughness": [
                    {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "60 um"}
                ],
            },
            r"inlet\.film_ratio: got 0\.5 beside \[motion\]",
        ),
    ],
)
def test_supplies_that_are_refused(base, changes, message):
    with pytest.raises(InputError, match=message):
        Case.from_dict(base | changes)
