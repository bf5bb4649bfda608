"""Laws of a user's own as a part of their case: compared, shown, kept, stored, and used with heat."""

import copy
import json
import pickle

import numpy as np
import pytest

from ehlectric import (
    Case,
    InputError,
    Laws,
    Sweep,
    load,
    read_sweep,
    run_sweep,
    save,
    solve,
    solve_many,
    write_report,
)
from ehlectric.contact.conditions import resolve
from ehlectric.contact.contact_heat import physics_of
from ehlectric.contact.preparation import portable, prepare
from ehlectric.lubricant.viscosity import roelands
from ehlectric.tables.html_tables import html_of
from tests.helpers.each import each

CONTACT = {"reduced_radius": "12.7 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "0.8 GPa"}
CONTACT |= {"entrainment_speed": "2 m/s", "temperature": "40 degC"}
BODY = {"thermal_conductivity": "46 W/m/K", "heat_capacity": "450 J/kg/K", "density": "7800 kg/m^3"}


def hybrid(pressure, _temperature):
    """McEwen's law with a faster part [Pa s]; it has a pole at 1.6 GPa."""
    return 0.035 * (1 + 17.5e-9 * pressure / 3.5) ** 3.5 * np.exp(4.0 * pressure / (1.6e9 - pressure))


def strength(pressure, _temperature):
    return 15e6 * (1.0 + pressure / 2e9)


LAWS = Laws(viscosity=hybrid)


def case(**tables):
    return Case.line(**CONTACT, lubricant="paper", grid={"nodes": 401}, **tables)


@pytest.fixture(scope="module")
def result():
    return solve(case(), laws=LAWS)


def film(solved):
    return solved.film.minimum_thickness


def test_a_case_has_its_laws(result):
    assert result.case != case()
    assert result.case == case().with_laws(LAWS) == case(laws=LAWS) == case().replace(laws=LAWS)
    assert result.case != case(laws=Laws(viscosity=hybrid, strength=strength))
    assert "viscosity" in repr(result.case)
    assert repr(result.case) != repr(case())
    assert "hybrid" in html_of(result.case)


def test_laws_stay_when_a_case_is_changed(result):
    """The film at a new speed is the film of a case that gets the speed first and the laws then."""
    assert film(solve(result.case)) == film(result)
    assert result.case.replace({"contact.entrainment_speed": "2 m/s"}) == result.case
    faster = {"contact.entrainment_speed": "4 m/s"}
    assert film(solve(result.case.replace(faster))) == film(solve(case().replace(faster), laws=LAWS))
    assert result.case.replace(laws=None) == result.case.with_laws(None) == case()


def test_a_strength_goes_with_its_laws():
    both = case(laws=Laws(viscosity=hybrid, strength=strength))
    assert both.discharge.strength_table.strength[0] == 15e6
    assert both.with_laws(LAWS) == case(laws=LAWS)
    lower = both.replace({"contact.max_hertz_pressure": "0.4 GPa"})
    assert lower.discharge.strength_table.pressure[-1] == pytest.approx(1.6e9)


def test_the_oil_has_the_values_of_its_laws_at_ambient_pressure():
    """At p = 0 each factor on the parameter of the law is 1."""
    laws = Laws(
        viscosity=hybrid,
        density=lambda pressure, _temperature: 850.0 * (1.0 + pressure / 1e10),
        permittivity=lambda pressure, _temperature: 2.3 * (1.0 + pressure / 2e10),
    )
    oil = case(laws=laws).oil
    assert (oil.viscosity, oil.density, oil.relative_permittivity) == pytest.approx((0.035, 850.0, 2.3))


def test_files_and_tables_that_cannot_contain_laws_are_refused(result):
    for refused in (result.case.to_dict, result.case.to_toml):
        with pytest.raises(InputError, match=r"^laws: .*hybrid.*replace\(laws=None\)"):
            refused()
    with pytest.raises(InputError, match=r"^laws: a file cannot contain.*hybrid"):
        Case.from_dict({"contact": CONTACT, "lubricant": {"base": "paper"}, "laws": {"viscosity": "hybrid"}})
    with pytest.raises(InputError, match=r"^laws: "):
        Case.from_dict({"contact": CONTACT, "lubricant": {"base": "paper"}, "laws": hybrid})


def test_laws_are_named_in_summary_and_warnings(result):
    summary = result.summary()
    assert summary["lubricant"]["laws"]["viscosity"].startswith("hybrid")
    assert "own-laws" in summary["warning_codes"]


def test_a_loaded_result_keeps_the_values_of_its_laws(result, tmp_path):
    save(result, tmp_path)
    loaded = load(tmp_path)
    assert loaded == result
    assert loaded.case == result.case != case()
    assert json.dumps(loaded.summary()) == json.dumps(result.summary())
    assert film(solve(loaded.case)) == pytest.approx(film(result), rel=1e-12)
    for key, value in (("contact.temperature", "60 degC"), ("contact.max_hertz_pressure", "0.7 GPa")):
        with pytest.raises(InputError, match=r"^laws: .*hybrid.*313\.15 K.*give the functions again"):
            loaded.case.replace({key: value})
    assert film(solve(loaded.case.replace({"contact.temperature": "60 degC"}, laws=LAWS))) > 0.0


@pytest.mark.slow
@pytest.mark.gate
def test_a_report_names_the_laws(result, tmp_path):
    save(result, tmp_path)
    (page,) = write_report(tmp_path, tmp_path / "report.html")
    text = page.read_text(encoding="utf-8")
    assert "[laws]" in text
    assert "hybrid (Python function)" in text


def test_a_pole_ends_the_values():
    """Beyond its pole at 1.6 GPa the formula has finite viscosities again, which are not those of an oil."""
    values = case(laws=LAWS).law_values.samples["viscosity"]
    assert 1.2e9 <= values.pressure[-1] < 1.6e9
    with pytest.raises(InputError, match=r"^laws\.viscosity: .*does not decrease"):
        case(laws=Laws(viscosity=lambda p, _: 0.04 * np.exp(-1e-9 * p)))


def test_an_error_of_a_function_is_one_line():
    with pytest.raises(InputError, match=r"^laws\.viscosity: got ZeroDivisionError .*<lambda>"):
        case(laws=Laws(viscosity=lambda p, _: p * (1 / 0)))


def test_copies_have_the_laws():
    own = case(laws=Laws(viscosity=lambda p, _: 0.04 * np.exp(2e-8 * p)))
    assert copy.copy(own) == copy.deepcopy(own) == own
    assert copy.deepcopy(own) != case()


def test_pickled_laws_are_equal_or_refused(result):
    assert pickle.loads(pickle.dumps(result.case)) == result.case
    with pytest.raises(InputError, match=r"^laws\.viscosity: .*cannot be pickled.*top level of a module"):
        pickle.dumps(case(laws=Laws(viscosity=lambda p, _: 0.04 * np.exp(2e-8 * p))))


HOT = {"body_1": BODY, "body_2": BODY, "slide_to_roll_ratio": 0.3}
OIL = {"base": "paper", "heat_capacity_law": "constant", "heat_capacity": "2000 J/kg/K", "density": 850.0}
OIL |= {
    "thermal_conductivity_law": "constant",
    "thermal_conductivity": "0.14 W/m/K",
    "eyring_stress": "5 MPa",
}
VOGEL = {"atmospheric_law": "vogel", "vogel_viscosity": 6.2e-5, "vogel_b": 1000.0, "vogel_c": 155.0}


def vogel_and_roelands(pressure, temperature):
    """Laws of ``VOGEL`` and of Roelands, whose exponents do not depend on temperature."""
    constants = {"pressure_viscosity_coefficient": 18e-9, "roelands_z": 0.6}
    at_zero = 6.2e-5 * np.exp(1000.0 / (temperature - 155.0))
    return at_zero * np.exp(roelands(pressure, **constants, roelands_pressure=0.196e9)[0])


def hot_case(oil, **tables):
    film = {"thermal": True, "rheology": "eyring"}
    return Case.line(**CONTACT, **HOT, lubricant=oil, film=film, grid={"nodes": 201}, **tables)


def test_a_hot_film_has_the_laws_at_its_temperatures():
    """The viscosity of the hot oil is that of the function at temperatures between 20 and 200 degC."""
    hot = hot_case(OIL, laws=Laws(viscosity=vogel_and_roelands))
    oil = physics_of(hot, resolve(hot)).thermal.oil
    for temperature in (300.0, 360.0, 470.0):
        pressure = np.array([0.0, 0.3e9, 0.8e9])
        found = oil.log_viscosity(pressure, np.full(3, temperature)).value
        np.testing.assert_allclose(found, np.log(vogel_and_roelands(pressure, temperature)), atol=2e-5)


def test_a_law_without_temperature_is_noted_in_a_hot_film():
    codes = [
        [one.code for one in prepare(hot_case(OIL, laws=Laws(viscosity=law))).warnings()]
        for law in (hybrid, vogel_and_roelands)
    ]
    assert ["temperature-unused" in each for each in codes] == [True, False]


def test_another_process_gets_values_at_all_temperatures():
    """A function that cannot be pickled is handed over as its values, also of a hot film."""
    hot = hot_case(OIL, laws=Laws(viscosity=lambda p, t: vogel_and_roelands(p, t)))
    there = pickle.loads(pickle.dumps(portable(hot)))
    pressure, temperature = np.array([0.0, 0.4e9]), np.array([320.0, 400.0])
    oils = [physics_of(one, resolve(one)).thermal.oil for one in (hot, there)]
    here, found = (oil.log_viscosity(pressure, temperature).value for oil in oils)
    np.testing.assert_array_equal(found, here)


def test_heat_needs_a_viscosity_over_temperature_from_oil_or_laws():
    with pytest.raises(InputError, match=r"^lubricant\.atmospheric_law: .*laws=Laws"):
        hot_case(OIL)


@pytest.mark.slow
def test_a_hot_film_depends_on_the_function_only(tmp_path):
    """The function decides, whether or not the oil has a viscosity over temperature of its own."""
    of_function = solve(hot_case(OIL | VOGEL, laws=Laws(viscosity=vogel_and_roelands)))
    without = solve(hot_case({"base": "paper"} | OIL, laws=Laws(viscosity=vogel_and_roelands)))
    assert of_function.converged
    assert without.converged
    assert film(of_function) == pytest.approx(film(without), rel=1e-12)
    assert without.film.heated.max_temperature_rise > 1.0
    isothermal = Case.line(**CONTACT, lubricant=OIL, grid={"nodes": 201})
    cold = solve(isothermal, laws=Laws(viscosity=vogel_and_roelands))
    assert film(without) < film(cold)
    save(without, tmp_path)
    with pytest.raises(InputError, match=r"^laws: .*at 313\.15 K .*give the functions again"):
        solve(load(tmp_path).case)


def doubling(pressure, temperature):
    return 0.03 * np.exp(-0.03 * (temperature - 313.15) + 1.8e-8 * pressure)


@pytest.mark.slow
def test_many_cases_and_sweeps_take_laws(tmp_path):
    """Films in processes are those of ``solve``, also of functions that processes cannot import."""
    local = Laws(viscosity=lambda p, t: doubling(p, t))
    cases = [case().replace({"contact.entrainment_speed": speed}) for speed in (1.0, 2.0)]
    expected = [film(solve(one, laws=local)) for one in cases]
    assert expected[0] != film(solve(cases[0]))
    for workers in (1, 2):
        found = {one.number: one.result for one in solve_many(cases, workers, laws=local)}
        assert [film(found[k]) for k in (0, 1)] == pytest.approx(expected, rel=1e-12)
        assert found[0].case == cases[0].with_laws(local)
    sweep = Sweep.from_dict({"case": case(), "vary": {"contact.entrainment_speed": [1.0, 2.0]}})
    results = run_sweep(sweep, tmp_path / "own", workers=1, laws=local)
    films = [point.summary["film"]["minimum_thickness"] for point in results.points]
    assert films == pytest.approx(expected, rel=1e-12)
    again = read_sweep(tmp_path / "own")
    assert again.case == sweep.case.with_laws(local)
    with pytest.raises(InputError, match=r"^laws: "):
        again.to_toml()
    # Another law is another sweep: none of its points is taken from the folder.
    other = run_sweep(sweep, tmp_path / "own", workers=1)
    assert other.points[0].summary["film"]["minimum_thickness"] == pytest.approx(
        film(solve(cases[0])), rel=1e-12
    )


@pytest.mark.slow
@pytest.mark.gate
@each("other", ["heat", "laws"])
def test_the_smooth_contact_of_a_rough_one_has_its_laws_and_heat(other):
    """Also if the contact before it differed in nothing else: the smooth contact is not shared then."""
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "80 um"}
    plain = hot_case(OIL | VOGEL, roughness=[wave]).replace(
        {"film.thermal": False, "film.rheology": "newtonian"}
    )
    changed = plain.replace({"film.thermal": True}) if other == "heat" else plain
    laws = LAWS if other == "laws" else None
    apart = solve(plain).smooth
    rough = solve(changed, laws=laws)
    smooth = solve(changed.replace(roughness=()), laws=laws)
    np.testing.assert_array_equal(rough.smooth.thickness, smooth.film.thickness)
    assert np.any(rough.smooth.thickness != apart.thickness)
