"""Warnings of fields and strengths that no film of a liquid carries."""

import math

import pytest

from ehlectric import Case, solve
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.film_breakdown import (
    MOST_OF_LIQUIDS,
    field_warning_conditions,
    strength_warning_conditions,
)
from ehlectric.quantities.result_warnings import active
from tests.helpers.each import each

LINE = {
    "contact": {
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "1 GPa",
        "entrainment_speed": "4 m/s",
    },
    "lubricant": {"base": "paper"},
    "grid": {"nodes": 801},
}


def emitted(field, *, work=4.5, fermi=7.0):
    """Current density of field emission [A/m^2] by Fowler and Nordheim, in eV and V/cm as they print it."""
    at = field / 100.0
    part = 6.2e-6 * math.sqrt(fermi) / ((work + fermi) * math.sqrt(work))
    return 1e4 * part * at**2 * math.exp(-6.8e7 * work**1.5 / at)


def test_the_limit_is_where_rough_metals_begin_to_emit():
    """A third of the field at which a smooth metal emits; 1000 V/um on a smooth one emit nothing."""
    assert emitted(3.0 * MOST_OF_LIQUIDS) == pytest.approx(2.4e3, rel=0.02)
    assert emitted(5.0 * MOST_OF_LIQUIDS) == pytest.approx(3.9e7, rel=0.02)
    assert emitted(MOST_OF_LIQUIDS) < 1e-9


@pytest.mark.parametrize(("field", "count"), [(None, 0), (0.99e9, 0), (3.3e9, 1)])
def test_fields(field, count):
    found = list(active(field_warning_conditions(field, "the potentials")))
    assert [one.code for one in found] == count * ["field-above-insulators"]


@each(
    "strength, count",
    [
        ({"dielectric_strength": "999 V/um"}, 0),
        ({"dielectric_strength": "1001 V/um"}, 1),
        ({"weibull": {"scale": "3300 V/um", "shape": 5, "reference_area": "1 mm^2"}}, 1),
        ({"strength_table": {"pressure": [0.0, 1e9], "strength": ["15 V/um", "2000 V/um"]}}, 1),
        ({"conductivity": "1 pS/m"}, 0),
    ],
)
def test_strengths(strength, count):
    found = list(active(strength_warning_conditions(Discharge.from_dict(strength))))
    assert [one.code for one in found] == count * ["strength-above-liquids"]


def test_a_contact_above_its_strength_says_its_field():
    """20 V on a film of about 0.7 um at 15 V/um; and a strength that no liquid has."""
    volts = {"electric": {"potential_1": 0.0, "potential_2": 20.0}}
    result = solve(Case.from_dict(LINE | volts | {"discharge": {"dielectric_strength": "15 V/um"}}))
    (warning,) = (one for one in result.warnings if one.code == "breakdown-expected")
    field = f"{result.field.max_strength / 1e6:.3g} V/µm"
    assert field in warning.text
    strong = solve(Case.from_dict(LINE | volts | {"discharge": {"dielectric_strength": "3300 V/um"}}))
    assert "strength-above-liquids" in {one.code for one in strong.warnings}
    assert strong.verdict.level == "yellow"
