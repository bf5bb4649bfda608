"""Film factor from a capacitance: the inverse of the model, and what is out of reach."""

import math
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric.bearing.impedance import meter_capacitance
from ehlectric.bearing.measured_capacitance import (
    LEAST,
    MOST,
    NoFactorError,
    OperatingPoint,
    film_factor_of,
    slope_at,
)
from ehlectric.bearing.solution import capacitance
from ehlectric.bearing.solving import solution_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS

# Axial load alone: all contacts of a ring are equal, so that one contact is computed for each. The surfaces
# are so smooth that they touch at no film factor.
SMOOTH = BALLS["bearing"] | {"composite_rq": 1e-12}
RADIAL = BALLS | {"contacts": "formula", "bearing": SMOOTH}
AXIAL = RADIAL | {"bearing": SMOOTH | {"radial_load": 0.0}}


@cache
def point(rpm, case="axial"):
    made = BearingCase.from_dict(AXIAL if case == "axial" else RADIAL)
    return OperatingPoint.of(made, {"bearing.inner_speed": rpm * math.pi / 30.0})


@pytest.mark.slow
@settings(deadline=None, max_examples=12)
@given(st.floats(0.05, 2.9), st.sampled_from([600, 3000, 9000]), st.floats(0.2, 2.0))
def test_inverse_of_the_model(factor, rpm, guess):
    at = point(rpm)
    found = film_factor_of(lambda f: at.at(f).capacitance, at.at(factor).capacitance, guess)
    assert found == pytest.approx(factor, rel=1e-6)


@given(st.floats(0.02, 2.5), st.floats(0.05, 1.5))
def test_inverse_of_a_power(factor, power):
    assert film_factor_of(lambda f: 3e-10 * f**-power, 3e-10 * factor**-power) == pytest.approx(
        factor, rel=1e-6
    )


def test_capacitance_at_a_film_factor_is_that_of_a_meter_at_the_case_with_it():
    """With rough films and a coating, and without what is in parallel."""
    keys = {"parallel_capacitance": "20 pF", "composite_rq": "50 nm", "radial_load": 0.0}
    coating = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "50 cm^2"}
    case = BearingCase.from_dict(RADIAL | {"bearing": SMOOTH | keys | {"coating": coating}})
    found = OperatingPoint.of(case, {}).at(0.6).capacitance
    solved = solution_of(case.replace({"bearing.film_factor": 0.6}))
    assert found == pytest.approx(meter_capacitance(solved) - 20e-12, rel=1e-9)
    assert found < 0.99 * capacitance(solved)


@pytest.mark.parametrize("case", ["axial", "radial"])
def test_capacitance_falls_with_the_film(case):
    values = [point(3000, case).at(f).capacitance for f in (0.1, 0.5, 1.0, 1.01, 3.0)]
    assert values == sorted(values, reverse=True)
    assert len(set(values)) == len(values)


def test_slope_is_that_of_differences():
    def value(factor):
        return point(3000).at(factor).capacitance

    exact = math.log(value(0.7 * 1.001) / value(0.7 / 1.001)) / (2.0 * math.log(1.001))
    assert slope_at(value, 0.7) == pytest.approx(exact, rel=0.01)


@pytest.mark.parametrize(
    ("target", "words"),
    [
        (1e-10 * LEAST**-0.5 * 1.1, r"above 1(000 pF| nF).* 0\.01"),
        (1e-10 * MOST**-0.5 * 0.9, "below 57.74 pF"),
    ],
)
def test_what_no_film_explains_is_told(target, words):
    with pytest.raises(NoFactorError, match=words):
        film_factor_of(lambda f: 1e-10 * f**-0.5, target)


@pytest.mark.parametrize(("lowest", "highest"), [(0.55, 0.8), (0.6, 0.62), (1.3, 2.9)])
def test_films_that_cannot_be_computed_do_not_end_the_search(lowest, highest):
    """The film factor lies close to the end of those that the model takes."""

    def value(factor):
        if not lowest < factor < highest:
            raise InputError("bearing", "leaves no room")
        return 1e-10 * factor**-0.5

    for factor in (lowest * 1.01, highest * 0.995):
        assert film_factor_of(value, value(factor)) == pytest.approx(factor, rel=1e-6)
    with pytest.raises(NoFactorError, match="leaves no room"):
        film_factor_of(value, 1e-10 * (0.8 * lowest) ** -0.5)
