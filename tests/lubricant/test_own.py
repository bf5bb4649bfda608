"""Laws of a user's own, against the laws of the package with the same formula, and their mistakes."""

import json
from functools import partial

import numpy as np
import pytest

from ehlectric import BearingCase, Case, InputError, Laws, evaluate, example, load, save, solve
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.electrical_laws import clausius_mossotti
from ehlectric.lubricant.python_laws import SampledLaws
from ehlectric.lubricant.viscosity import roelands
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each

OIL = {"pressure_viscosity_coefficient": 22e-9, "roelands_z": 0.67, "roelands_pressure": 0.198e9}


def viscosity(pressure, temperature):
    """Roelands' law of the paper's oil; the temperature moves it by a factor."""
    return 0.04 * np.exp(-0.03 * (temperature - 313.15)) * np.exp(roelands(pressure, **OIL)[0])


def density(pressure, _temperature):
    return 870.0 * dowson_higginson(pressure, density_c1=0.59e9, density_c2=1.34)[0]


def permittivity(pressure, temperature):
    return clausius_mossotti(density(pressure, temperature) / 870.0, relative_permittivity=2.4)


def strength(pressure, _temperature):
    return 15e6 * (1.0 + pressure / 2e9)


ALL = Laws(viscosity=viscosity, density=density, permittivity=permittivity, strength=strength)


def case(**contact):
    table = {"contact": dict(PAPER_CONTACT) | contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 801}}
    return Case.from_dict(table)


@pytest.fixture(scope="module")
def results():
    table = {"pressure": ["0 GPa", "20 GPa"], "strength": ["15 V/um", "165 V/um"]}
    of_package = case(temperature="40 degC").replace({"discharge.strength_table": table})
    return solve(of_package), solve(case(temperature="40 degC"), laws=ALL)


def test_the_same_formulas_give_the_same_film_and_field(results):
    expected, found = results
    assert found.converged
    np.testing.assert_allclose(found.film.thickness, expected.film.thickness, rtol=1e-5)
    np.testing.assert_allclose(found.film.density, expected.film.density, rtol=1e-6)
    assert found.field.capacitance == pytest.approx(expected.field.capacitance, rel=1e-5)
    assert found.discharge.breakdown_voltage == pytest.approx(expected.discharge.breakdown_voltage, rel=1e-4)
    assert found.summary()["groups"]["moes_l"] == pytest.approx(
        expected.summary()["groups"]["moes_l"], rel=1e-6
    )


def test_laws_are_named_in_the_result(results):
    laws = results[1].summary()["lubricant"]["laws"]
    for name in ("viscosity", "density", "permittivity", "strength"):
        assert laws[name].startswith(f"{name} ")


def test_a_stored_result_has_its_laws(results, tmp_path):
    save(results[1], tmp_path)
    loaded = load(tmp_path / "result.nc")
    assert json.dumps(loaded.summary()) == json.dumps(results[1].summary())


def test_the_temperature_reaches_the_laws():
    """0.04 Pa s e^(-0.03 * 20) at 60 degC."""
    warm = solve(case(temperature="60 degC"), laws=Laws(viscosity=viscosity))
    assert warm.conditions.viscosity == pytest.approx(0.04 * np.exp(-0.6), rel=1e-12)


@each(
    "law, text",
    [
        (lambda p, _: np.full_like(p, np.nan), "nan Pa s .*<lambda> .* 0 GPa"),
        (lambda p, _: -p - 1.0, "-1 Pa s"),
        (lambda p, _: np.where(p < 1e9, 0.04 + p * 1e-9, np.inf), "inf Pa s"),
        (lambda p, _: p[:3], "shape"),
    ],
)
def test_laws_that_are_none_are_one_line(law, text):
    with pytest.raises(InputError, match=rf"^laws\.viscosity: .*{text}") as error:
        solve(case(temperature="40 degC"), laws=Laws(viscosity=law))
    assert "\n" not in str(error.value)


def test_a_law_needs_a_temperature():
    with pytest.raises(InputError, match=r"^contact\.temperature: missing"):
        solve(case(), laws=ALL)


def test_only_contacts_take_laws():
    with pytest.raises(InputError, match=r"^laws: .*'dict'"):
        solve(case(temperature="40 degC"), laws={"viscosity": viscosity})
    bearing = BearingCase.from_toml(example("bearing_6208"))
    for refused in (partial(solve, bearing), partial(evaluate, bearing, {"bearing.radial_load": [1e3]})):
        with pytest.raises(InputError, match=r"^laws: .*one contact, not for a BearingCase"):
            refused(laws=ALL)


def test_a_film_beyond_the_samples_is_a_warning():
    """A law that ends at 1.6 times the Hertz pressure, under a film that is said to go beyond."""
    sampled = Laws(viscosity=lambda p, _: np.where(p < 1.6e9, 0.04 * np.exp(2e-8 * p), np.nan)).at(313.0, 1e9)
    assert [one.code for one in sampled.exceeded(2e9)] == ["law-range"]
    assert not list(sampled.exceeded(1.2e9))


def test_slopes_are_those_of_the_function():
    """Barus' law, whose logarithm is linear: the spline is exact."""
    sampled = Laws(viscosity=lambda p, _: 0.04 * np.exp(2e-8 * p)).at(313.0, 0.2e9)
    value, slope = sampled.samples["viscosity"].log_ratio(np.array([0.0, 1e7, 0.3e9]))
    np.testing.assert_allclose(value, [0.0, 0.2, 6.0], atol=1e-9)
    np.testing.assert_allclose(slope, 2e-8, rtol=1e-7)
    assert SampledLaws.restored(sampled.stored(), 313.0, 0.2e9).same_values(sampled)
