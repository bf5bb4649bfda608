"""Table ``inlet``: its alternatives, what it is refused with, and changes that replace one by another."""

import pytest

from ehlectric import Case

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
