"""Breakdown voltage of a contact by formula, before its film is solved."""

import pytest

from ehlectric import Case
from ehlectric.app.compute.contact_answers import by_formula
from ehlectric.runs.preview import preview_of

VOLTAGES = {"potential_1": "0 V", "potential_2": "5 V"}
SHARED = {"reduced_modulus": "226 GPa", "entrainment_speed": "2 m/s", "electric": VOLTAGES}
LINE = {"reduced_radius": "14.1 mm", "load_per_length": "300 kN/m", **SHARED}
POINT = {"radius_x": "10 mm", "radius_y": "10 mm", "load": "20 N", **SHARED}
STRENGTH = {"dielectric_strength": "15 V/um"}


@pytest.mark.parametrize(
    ("make", "keys", "formula"),
    [(Case.line, LINE, "pan_hamrock"), (Case.point, POINT, "chittenden")],
    ids=["line", "point"],
)
def test_the_voltage_is_the_strength_of_the_film(make, keys, formula):
    summary = preview_of(make(**keys, lubricant="paper", discharge=STRENGTH)).summary
    film = summary["film_formulas"][formula]["minimum_thickness"]
    estimate = summary["breakdown_by_formula"]
    assert estimate["breakdown_voltage"] == pytest.approx(15e6 * film, rel=1e-12)
    assert estimate["margin"] == pytest.approx(15e6 * film / 5.0, rel=1e-12)


@pytest.mark.parametrize(("make", "keys"), [(Case.line, LINE), (Case.point, POINT)], ids=["line", "point"])
def test_an_oil_that_pressure_does_not_thicken_has_none(make, keys):
    """The formulas of the minimum film are for piezoviscous oils."""
    oil = {"base": "paper", "viscosity_law": "constant"}
    case = make(**keys, lubricant=oil, discharge=STRENGTH)
    assert "breakdown_by_formula" not in preview_of(case).summary
    assert by_formula(case).verdict.level == "grey"
