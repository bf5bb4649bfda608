"""Contacts with heat and shear from their case to their files: what is solved, told, stored and drawn."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import Case, InputError, load, solve
from ehlectric.app.compute.contact_answers import answer_of
from ehlectric.contact.conditions import resolve
from ehlectric.contact.contact_heat import (
    _has_values,
    heat_warnings,
    hot_oil,
    oil_over_temperature,
    physics_of,
)
from ehlectric.contact.film_warnings import film_warnings
from ehlectric.contact.preparation import prepare
from ehlectric.contact.run import save
from ehlectric.discharge.film_breakdown import FieldUtilisation
from ehlectric.errors import DamagedError
from ehlectric.figures.contact_figure_files import figure
from ehlectric.figures.contact_findings import temperature_text
from ehlectric.film import heated_film, touching_newton
from ehlectric.film.across_film import Across
from ehlectric.paper.paper_contacts import PAPER
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.tables.contact_tables import result_rows
from tests.helpers.hot_cases import HOT_LINE, HOT_POINT


@pytest.fixture(scope="module")
def hot():
    """Solved film with heat and shear."""
    table = {"temperature": [273.15, 473.15], "strength": ["30 V/um", "10 V/um"]}
    discharge = {"strength_table": table, "temperature": "40 degC"}
    return solve(Case.from_dict(HOT_LINE | {"discharge": discharge}))


@pytest.fixture(scope="module")
def sheared():
    """Solved isothermal film with shear, with the faster surface on the other side."""
    contact = HOT_LINE["contact"] | {"slide_to_roll_ratio": -0.1}
    return solve(Case.from_dict(HOT_LINE | {"contact": contact, "film": {"rheology": "eyring"}}))


def case_with(table, **keys):
    return Case.from_dict(HOT_LINE | {table: HOT_LINE[table] | keys})


def test_heat_and_shear_make_the_film_thinner(hot):
    """The isothermal Newtonian film stands beside it, and is that of the case without the table film."""
    plain = solve(Case.from_dict({key: part for key, part in HOT_LINE.items() if key != "film"}))
    film = hot.summary()["film"]
    beside = film["isothermal"]
    assert plain.film.heated is None
    assert beside["minimum_thickness"] == pytest.approx(plain.film.minimum_thickness, rel=1e-9)
    assert beside["central_thickness"] == pytest.approx(plain.film.central_thickness, rel=1e-9)
    assert film["minimum_thickness"] < 0.99 * beside["minimum_thickness"]
    assert "rheology" not in plain.summary()["film"]


def test_traction_has_the_sign_of_the_sliding(hot, sheared):
    assert hot.film.heated.traction_coefficient > 0.0 > sheared.film.heated.traction_coefficient
    assert np.max(hot.film.heated.shear_stress) > 0.0 > np.min(sheared.film.heated.shear_stress)
    # Heat makes the oil thinner, and so the traction smaller.
    assert hot.film.heated.traction_coefficient < -sheared.film.heated.traction_coefficient


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("warmer", "drags"), [(0.0, False), (20.0, True)])
def test_equal_bodies_that_roll_have_no_traction(warmer, drags):
    """Between bodies at different temperatures the oil on both sides is not equally thick."""
    contact = {"slide_to_roll_ratio": 0.0, "temperature_2": 313.15 + warmer}
    result = solve(case_with("contact", **contact).replace({"grid.nodes": 101}))
    assert result.converged
    assert (result.film.heated.traction_coefficient != 0.0) == drags


def test_power_is_the_heat_of_shear_in_the_film(hot):
    """Integral of stress times shear rate over the full film, with the law of Ree and Eyring written out.

    The surfaces also compress the oil, which gives this work back as it expands.
    """
    film, heated, limit = hot.film, hot.film.heated, hot.case.lubricant.eyring_stress
    oil = physics_of(hot.case, resolve(hot.case)).thermal.oil
    from_middle = film.thickness * (heated.zeta[:, np.newaxis] - 0.5)
    stress = from_middle * np.gradient(film.pressure, film.x) - heated.shear_stress
    viscosity = np.exp(oil.log_viscosity(film.pressure, heated.temperature).value)
    rate = limit / viscosity * np.sinh(stress / limit)
    across = Across.of(heated.zeta.size - 1).weights * film.thickness[:, np.newaxis]
    centre = int(np.argmin(np.abs(film.x)))
    assert across[centre] @ rate[:, centre] == pytest.approx(-0.3, rel=1e-4)  # slip of the surfaces [m/s]
    power = np.sum(across.T * stress * rate, axis=0, where=~film.cavitated)
    assert heated.power_loss == pytest.approx(np.trapezoid(power, film.x), rel=3e-3)


def test_temperatures_of_the_film(hot):
    """Both surfaces are warmer than the oil in the inlet, and the middle of the film is hotter than they."""
    heated, inlet = hot.film.heated, hot.case.contact.temperature
    assert heated.temperature.shape == (heated.zeta.size, hot.film.x.size)
    assert np.array_equal(hot.film.temperature, heated.mid_temperature)
    assert np.max(heated.mid_temperature) - inlet == pytest.approx(heated.max_temperature_rise)
    centre = int(np.argmin(np.abs(hot.film.x)))
    for surface in heated.surface_temperatures[:, centre]:
        assert inlet < surface < heated.mid_temperature[centre]


@pytest.mark.slow
@pytest.mark.gate
def test_files_bring_heat_and_shear_back(hot, sheared, tmp_path):
    for result in (hot, sheared):
        folder = tmp_path / result.film.heated.rheology / str(result.film.heated.thermal)
        save(result, folder)
        loaded = load(folder / "result.nc")
        assert loaded.summary() == result.summary()
        for name, value in vars(result.film.heated).items():
            assert np.array_equal(getattr(loaded.film.heated, name), value), name


@pytest.mark.slow
def test_an_isothermal_film_that_did_not_converge_is_not_told(tmp_path):
    """With three Newton steps only the film with heat converges, which takes more of them in its turns."""
    result = solve(Case.from_dict(HOT_LINE | {"solver": {"max_iterations": 3}}))
    assert result.converged
    assert result.summary()["film"]["isothermal"] == {"minimum_thickness": None, "central_thickness": None}
    assert "isothermal-unsolved" in [each.code for each in result.warnings]
    rows = {row.key: row for row in result_rows(result)}
    assert rows["film.isothermal.minimum_thickness"].text == "not converged"
    texts = [text.get_text() for text in figure(result, "temperature.png").texts]
    texts += [number.note for number in answer_of(result).shown]
    assert not any("isothermal and Newtonian" in text for text in texts)
    save(result, tmp_path)
    assert load(tmp_path / "result.nc").summary() == result.summary()


def test_a_film_without_heat_has_none_in_its_file(tmp_path):
    plain = solve(Case.from_dict({key: part for key, part in HOT_LINE.items() if key != "film"}))
    save(plain, tmp_path)
    dataset = read_dataset(tmp_path / "result.nc")
    assert "heated" not in dataset.attrs
    assert not {"temperature", "zeta", "shear_stress"} & set(dataset.variables)


@pytest.mark.slow
def test_damaged_numbers_are_refused(hot, tmp_path):
    path = tmp_path / "result.nc"
    dataset = hot.to_xarray()
    dataset.attrs["heated"] = dataset.attrs["heated"].replace("traction_coefficient", "traction")
    dataset.to_netcdf(path, engine="h5netcdf")
    with pytest.raises(DamagedError, match="heated is not as it was written"):
        load(path)


def test_tables_tell_what_heat_and_shear_change(hot, sheared):
    rows = {row.key: row.text for row in result_rows(hot)}
    assert rows["film.rheology"] == "Ree-Eyring, eyring_stress 5 MPa"
    assert "% by heat and shear" in rows["film.isothermal.minimum_thickness"]
    assert rows["film.max_temperature_rise"].split()[1] in ("K", "K,")
    rows = {row.key: row.text for row in result_rows(sheared)}
    assert rows["film.isothermal.minimum_thickness"].endswith("% by shear")
    assert "film.max_temperature_rise" not in rows


def test_a_strength_over_temperature_is_that_of_the_local_film(hot):
    """30 V/um at 0 degC and 10 V/um at 200 degC: 0.1 V/um less per kelvin, at mid-film, not in the inlet."""
    found = FieldUtilisation.of(hot.case.discharge, hot.film, hot.field).dielectric_strength
    warm = np.interp(hot.field.x, hot.film.x, hot.film.temperature)
    assert found == pytest.approx(30e6 - 0.1e6 * (warm - 273.15), rel=1e-6)
    assert "Upper bound: fully flooded film" in hot.verdict.text


def test_permittivity_follows_the_density_of_the_hot_film(hot):
    """Clausius and Mossotti at the mean density across the film, which heat lowers."""
    cold = hot.case.oil.density_ratio(hot.film.pressure)[0]
    contact = np.abs(hot.film.x) < 0.5 * hot.conditions.half_width
    assert np.all(hot.film.density[contact] < cold[contact])
    centre = int(np.argmin(np.abs(hot.field.x)))
    node = int(np.argmin(np.abs(hot.film.x - hot.field.x[centre])))
    at = hot.film.pressure[[node]]
    expected = hot.case.oil.permittivity(at, hot.film.density[[node]])
    assert hot.field.permittivity[centre, 0] == pytest.approx(expected[0])
    assert expected < hot.case.oil.permittivity(at, cold[[node]])


def test_figures(hot, sheared):
    drawn = figure(hot, "temperature.png")
    assert "K hotter than the oil" in " ".join(text.get_text() for text in drawn.texts)
    assert len([ax for ax in drawn.axes if ax.get_ylabel().startswith(("height", "temp", "shear"))]) >= 3
    drawn = figure(sheared, "shear_stress.png")
    assert "Traction coefficient −0.0" in " ".join(text.get_text() for text in drawn.texts)
    with pytest.raises(InputError):
        figure(sheared, "temperature.png")


def test_bodies_and_speeds_of_the_solver():
    case = case_with("contact", temperature_2="60 degC", body_2={"material": "steel", "density": 3000.0})
    physics = physics_of(case, resolve(case))
    assert physics.speeds == pytest.approx((3.15, 2.85))
    assert [body.temperature for body in physics.thermal.bodies] == [313.15, 333.15]
    assert [body.density for body in physics.thermal.bodies] == [7830.0, 3000.0]
    assert physics.thermal.inlet_temperature == 313.15
    assert physics.thermal.oil.lowest < 313.15 < 333.15 + 200.0 < physics.thermal.oil.highest


def test_the_oil_of_the_solver_is_that_of_the_case_at_other_temperatures():
    case = case_with("contact")
    hot = physics_of(case, resolve(case)).thermal.oil
    pressure = np.array([0.0, 0.3e9, 0.6e9])
    for temperature in (300.0, 350.0, 420.0):
        oil = case.lubricant.at(temperature)
        expected = np.log(oil.viscosity) + oil.log_viscosity(pressure)[0]
        assert hot.log_viscosity(pressure, np.full(3, temperature)).value == pytest.approx(expected, abs=1e-5)


def test_laws_go_on_beyond_the_range_of_the_oil():
    """The range of an oil bounds the temperature of a case, but not those in its film."""
    case = case_with("lubricant", temperature_range=["20 degC", "60 degC"])
    with pytest.raises(InputError, match="temperature"):
        case.lubricant.at(400.0)
    beyond, known = oil_over_temperature(case.lubricant)(400.0), case_with("lubricant").lubricant.at(400.0)
    assert beyond.viscosity == known.viscosity


def test_the_range_ends_where_a_law_has_no_values():
    """A density that falls by 0.2 % per kelvin is zero 500 K above its reference."""
    case = case_with("lubricant", thermal_expansion=2e-3, reference_temperature=313.15)
    oil = hot_oil(case.lubricant, (400.0, 600.0), 1e9)
    assert 600.0 + 30.0 <= oil.highest < 813.15


@pytest.mark.parametrize("key", ["contact.temperature_1", "contact.temperature_2"])
def test_a_temperature_without_values_of_the_oil_is_refused_by_its_key(key):
    """A density that falls by 0.2 % per kelvin from -60 degC is zero at 440 degC, less than 30 K hotter."""
    case = case_with("lubricant", thermal_expansion=2e-3, reference_temperature=213.15)
    with pytest.raises(InputError, match="properties; expected at most") as refused:
        prepare(case.replace({key: "426 degC"}))
    assert refused.value.key == key
    allowed = float(refused.value.takes.split()[2])
    assert 400.0 <= allowed < 410.0
    prepare(case.replace({key: f"{allowed} degC"}))


@pytest.mark.parametrize("ratio", [2.5, -2.5])
def test_a_surface_against_entrainment_is_refused(ratio):
    case = case_with("contact", slide_to_roll_ratio=ratio)
    with pytest.raises(InputError, match=r"^contact\.slide_to_roll_ratio: .*2\.5"):
        prepare(case)


def test_the_solver_of_the_paper_has_no_heat():
    case = case_with("contact")
    with pytest.raises(InputError, match=r"^film: .*'paper'"):
        solve(case, solvers=PAPER)


@pytest.mark.slow
@pytest.mark.gate
def test_a_sheared_film_whose_surfaces_touch_is_solved():
    """The boundary film of 1 nm carries what the oil does not: together they carry the load."""
    contact = HOT_LINE["contact"] | {"entrainment_speed": 5e-4}
    table = HOT_LINE | {"contact": contact, "grid": {"nodes": 101}, "film": {"rheology": "eyring"}}
    result = solve(Case.from_dict(table))
    assert result.converged
    assert result.film.contact.any()
    assert result.film.minimum_thickness == pytest.approx(result.conditions.boundary_film, rel=1e-6)
    assert result.film.load_residual < 1e-9
    # The minimum is the boundary film with shear and without: a change of it in percent would be rounding.
    rows = {row.key: row.text for row in result_rows(result)}
    assert "%" not in rows["film.isothermal.minimum_thickness"]
    assert rows["film.isothermal.central_thickness"].endswith("% by shear")


def test_a_rough_film_that_does_not_touch_has_its_change_by_shear():
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "60 um"}
    table = HOT_LINE | {"grid": {"nodes": 101}, "film": {"rheology": "eyring"}, "roughness": [wave]}
    result = solve(Case.from_dict(table))
    assert result.converged
    assert not result.film.contact.any()
    rows = {row.key: row.text for row in result_rows(result)}
    assert rows["film.isothermal.minimum_thickness"].endswith("% by shear")


@pytest.mark.slow
def test_the_heat_of_sliding_spots_needs_their_friction():
    """Without the coefficient a warning says what is missing; with it the film is hotter."""
    rises = []
    for friction in (None, 0.1):
        contact = HOT_LINE["contact"] | {"entrainment_speed": 5e-4, "slide_to_roll_ratio": 1.0}
        contact |= {"boundary_friction": friction} if friction else {}
        result = solve(Case.from_dict(HOT_LINE | {"contact": contact, "grid": {"nodes": 101}}))
        assert result.converged
        assert result.film.contact.any()
        assert ("spot-heat-unknown" in [each.code for each in result.warnings]) == (friction is None)
        rises.append(result.film.heated.max_temperature_rise)
    assert rises[1] > rises[0]


@pytest.mark.slow
@pytest.mark.gate
def test_a_film_that_did_not_converge_has_no_friction(tmp_path, monkeypatch):
    """Neither in Python, summary.json and the table of command and report, nor in the app and in figures."""
    contact = HOT_LINE["contact"] | {"entrainment_speed": 0.003}
    table = HOT_LINE | {"contact": contact, "grid": {"nodes": 101}, "film": {"rheology": "eyring"}}
    with monkeypatch.context() as patch:
        patch.setattr(touching_newton, "_PATIENCE", 1)
        result = solve(Case.from_dict(table))
    assert not result.converged
    save(result, tmp_path)
    for each in (result, load(tmp_path / "result.nc")):
        film = each.summary()["film"]
        for key in ("traction_coefficient", "rolling_coefficient", "power_loss"):
            assert film[key] is None, key
            assert getattr(each.film.heated, key) is None, key
    rows = {row.key: row.text for row in result_rows(result)}
    assert rows["film.traction_coefficient"] == "not converged"
    assert "film.power_loss" not in rows
    assert answer_of(result).shown == ()
    drawn = figure(result, "shear_stress.png")
    texts = [*drawn.axes[0].get_legend().get_texts(), *drawn.texts]
    assert not any("raction coefficient" in text.get_text() for text in texts)


@pytest.mark.slow
def test_a_film_that_did_not_converge_shows_the_temperature_it_reached(tmp_path, monkeypatch):
    """Command and report mark the temperatures, and warning, summary.json and file have the same rise."""
    with monkeypatch.context() as patch:
        patch.setattr(heated_film, "MOST_LOOPS", 3)
        result = solve(Case.from_dict(HOT_LINE | {"grid": {"nodes": 101}}))
    assert result.film.status == "stalled"
    save(result, tmp_path)
    middle, inlet = result.film.heated.mid_temperature, result.case.contact.temperature
    rise = float(np.max(middle)) - inlet
    assert rise > 1.0
    for each in (result, load(tmp_path / "result.nc")):
        assert each.summary()["film"]["max_temperature_rise"] == pytest.approx(rise)
        rows = {row.key: row.text for row in result_rows(each)}
        assert f"{rise:.4g} K" in rows["film.max_temperature_rise"]
        for key in ("max_temperature_rise", "surface_temperature_1", "surface_temperature_2"):
            assert "not converged" in rows[f"film.{key}"], key
    (told,) = (each.text for each in result.warnings if each.code == "not-converged")
    assert f"{rise:.3g} K" in told
    assert "not converged" in temperature_text(result)


@pytest.mark.parametrize(
    ("rheology", "part", "named"),
    [
        ("newtonian", 0.2, "lubricant.eyring_stress"),
        ("newtonian", 0.0, "grid.nodes"),
        ("eyring", 0.2, "grid.nodes"),
    ],
)
def test_advice_for_heat_that_did_not_converge_is_true_of_all(hot, rheology, part, named):
    """More Newton steps do not help where film and temperature take turns, whose number is fixed."""
    stress = np.full_like(hot.film.x, part * hot.film.scales.pressure)
    heated = replace(hot.film.heated, rheology=rheology, shear_stress=stress)
    film = replace(hot.film, status="stalled", heated=heated)
    (text,) = (each.text for each in film_warnings(hot.case, film) if each.code == "not-converged")
    assert named in text
    assert "max_iterations" not in text


def test_oil_that_gets_thicker_with_temperature_is_told(hot):
    """As some oils of the library do far above their data sheets. Here the temperatures are reversed."""
    oil = physics_of(hot.case, resolve(hot.case)).thermal.oil
    turned = replace(oil, oils=oil.oils[::-1])
    physics = physics_of(hot.case, resolve(hot.case))
    physics = replace(physics, thermal=replace(physics.thermal, oil=turned))
    for film in (hot.film, replace(hot.film, status="stalled")):
        (told,) = (
            each.text
            for each in heat_warnings(hot.case, resolve(hot.case), film, physics)
            if each.code == "film-temperature-range"
        )
        assert "0.6 GPa" in told


@pytest.mark.slow
@pytest.mark.parametrize(
    ("speed", "ratio", "thinnest", "traction"), [(0.5, 0.5, 0.0726, 0.214), (2.0, 0.1, 0.248, 0.297)]
)
def test_newtonian_heat_at_two_gigapascals(speed, ratio, thinnest, traction):
    """Cold, the stress would be 1e9 times the pressure; the numbers are those of an independent program."""
    keys = {"entrainment_speed": speed, "slide_to_roll_ratio": ratio, "max_hertz_pressure": "2 GPa"}
    case = case_with("contact", **keys).replace({"film.rheology": "newtonian"})
    film = solve(Case.from_dict({key: part for key, part in case.to_dict().items() if key != "grid"})).film
    assert film.converged
    assert film.minimum_thickness * 1e6 == pytest.approx(thinnest, rel=0.04)
    assert film.heated.traction_coefficient == pytest.approx(traction, rel=0.01)


def test_heat_that_does_not_fit_into_memory_is_refused():
    """Of a line contact it grows with the square of the nodes: 300 000 of them need above a terabyte."""
    table = HOT_LINE | {"grid": {"nodes": 300_001}}
    with pytest.raises(InputError, match=r"^grid\.nodes: got 300001"):
        prepare(Case.from_dict(table))
    prepare(Case.from_dict(table | {"film": {"rheology": "eyring"}}))


@pytest.mark.slow
def test_a_point_contact_is_hot_on_both_sides_alike(tmp_path):
    """Half of the contact is solved; its temperature stands at all nodes, in the file and in a figure too."""
    result = solve(Case.from_dict(HOT_POINT))
    heated, shape = result.film.heated, result.film.thickness.shape
    assert heated.temperature.shape == (heated.zeta.size, *shape)
    assert np.array_equal(heated.temperature, heated.temperature[:, :, ::-1])
    assert np.array_equal(heated.shear_stress, heated.shear_stress[:, ::-1])
    # The largest rise lies within the contact, and most of the film beside it is as cold as the oil.
    i, j = np.unravel_index(np.argmax(heated.mid_temperature), shape)
    assert result.film.x[i] ** 2 + result.film.y[j] ** 2 < result.conditions.semi_axis_x**2
    assert np.median(heated.mid_temperature) < 313.15 + 0.2 * heated.max_temperature_rise
    save(result, tmp_path)
    assert load(tmp_path / "result.nc").summary() == result.summary()
    assert figure(result, "temperature.png").axes


def told(result, case=None, **changes):
    """Texts by code of the warnings about a film whose heat and shear differ in some values."""
    film = replace(result.film, heated=replace(result.film.heated, **changes))
    case = result.case if case is None else case
    conditions = resolve(case)
    return {
        each.code: each.text for each in heat_warnings(case, conditions, film, physics_of(case, conditions))
    }


def test_warnings(hot):
    resolved = {"temperature_rise_error": 0.0}
    assert told(hot, **resolved) == {}
    assert [*told(hot, **resolved, energy_imbalance=0.05)] == ["heat-unresolved"]
    assert [*told(hot, **resolved, max_temperature_rise=250.0)] == ["film-very-hot"]
    slow = case_with("contact", slide_to_roll_ratio=1.9999)
    assert [*told(hot, slow, **resolved)] == ["slow-body"]


@pytest.mark.parametrize(
    ("rheology", "told"), [("eyring", "carreau_stress and lubricant.carreau_exponent are"), ("newtonian", "")]
)
def test_constants_of_another_law_are_not_taken_without_a_word(rheology, told):
    """A Newtonian film stands for comparison in sweeps of the law, and needs no note."""
    case = case_with("lubricant", carreau_stress="5 MPa", carreau_exponent=0.5)
    case = case.replace({"film.rheology": rheology})
    notes = [each for each in prepare(case).warnings() if each.code == "shear-constant-unused"]
    assert len(notes) == bool(told)
    assert all(f"lubricant.{told} not used" in note.text and note.severity == "note" for note in notes)


def test_warning_about_stress_without_a_limit(hot, sheared):
    """Heat and Carreau's law bring the stress near to that of oils; a Newtonian one is too large by far."""
    newtonian = Case.from_dict(HOT_LINE | {"film": {"rheology": "newtonian"}})
    (text,) = told(sheared, newtonian, rheology="newtonian").values()
    assert text.startswith("do not use the traction coefficient of 0.0")
    assert "and the power loss" in text
    assert "temperature rise" not in text
    low = newtonian.replace({"contact.max_hertz_pressure": "0.4 GPa"})
    rolling = newtonian.replace({"contact.slide_to_roll_ratio": 0.0})
    for case in (low, rolling):
        assert told(sheared, case, rheology="newtonian") == {}
    warm = told(hot, rheology="newtonian", temperature_rise_error=0.0)["newtonian-traction"]
    assert warm.startswith("do not use")
    assert "the temperature rise and the power loss" in warm
    warm = told(hot, rheology="carreau", temperature_rise_error=0.0)["newtonian-traction"]
    assert "may be too large" in warm
    assert "do not use" not in warm


def test_warning_about_temperatures_at_which_the_oil_is_not_known(hot):
    """Beyond the range of its laws, and beyond that at which they are taken: 40 - 20 to 40 + 250 degC."""
    narrow = case_with("lubricant", temperature_range=["39 degC", "41 degC"])
    (text,) = told(hot, narrow, temperature_rise_error=0.0).values()
    assert "the laws of the oil hold for 39 to 41 °C" in text
    assert "linearly" not in text
    beyond = {"temperature": hot.film.heated.temperature + 250.0, "temperature_rise_error": 0.0}
    (text,) = told(hot, **beyond).values()
    assert "its properties were sampled from 20 to 290 °C, and are extrapolated linearly" in text


def test_warning_about_a_rise_that_the_grid_does_not_resolve(hot):
    """It blames the pressure spike only where the film is hottest there."""
    x, middle = hot.film.x / hot.film.scales.length, hot.film.heated.mid_temperature
    spike = x > 0.5
    at_spike = x[spike][np.argmax(hot.film.pressure[spike] * (np.gradient(hot.film.pressure)[spike] >= 0.0))]
    for place, blamed in ((at_spike, True), (0.0, False)):
        peak = middle + 100.0 * np.exp(-((10.0 * (x - place)) ** 2))
        rise = {"mid_temperature": peak, "max_temperature_rise": 10.0}
        text = told(hot, **rise, temperature_rise_error=1.0)["heat-unresolved"]
        assert ("spike" in text) == blamed
    assert told(hot, temperature_rise_error=0.1, max_temperature_rise=10.0) == {}


def test_laws_need_values_up_to_the_largest_pressure_only():
    """A law that ends at 1 GPa is enough for a film of 1 GPa, and not for one of 1.1 GPa."""

    def until_1_gpa(pressure):
        if np.max(pressure) > 1e9:
            raise ValueError
        return np.ones_like(pressure), None

    laws = dict.fromkeys(("log_viscosity", "density_ratio", "thermal_conductivity_law"), until_1_gpa)
    oil = SimpleNamespace(**laws, heat_capacity_law=None, viscosity=0.1)
    assert _has_values(lambda _: oil, 350.0, 1e9)
    assert not _has_values(lambda _: oil, 350.0, 1.1e9)
