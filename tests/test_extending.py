"""A law of the oil and a film-thickness formula added as an extender would: one function, one entry."""

import math
import re
import shutil

import numpy as np
import pytest
from docs import pages

from ehlectric import Case, InputError, load, save, solve
from ehlectric.bearing.result import solve_bearing
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.table_edits import flattened
from ehlectric.contact import solver
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import film_problem
from ehlectric.formulas import film_line, film_point
from ehlectric.formulas.film_line import CentralThickness, Formula
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.electrical_laws import PERMITTIVITY_LAWS
from ehlectric.lubricant.law import Law, Parameter
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS
from ehlectric.quantities import result_warnings
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runs.preview import preview_of
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.sweep_inputs import Sweep
from tests.conftest import PAPER_CONTACT
from tests.helpers.places import ROOT

# A viscosity that doubles every so much pressure: Barus' law with alpha = ln 2/p_2, so that Barus' film is
# the expected one.
DOUBLING = Parameter(
    "doubling_pressure",
    "Pa",
    title="doubling pressure",
    symbol="$p_2$",
    meaning="pressure that doubles the viscosity",
    least=1e6,
    most=1e9,
    reason="an oil has some 30 MPa",
)
BULK = Parameter("bulk_modulus", "Pa", meaning="of the oil", above=1e7, most=1e12)
P_2 = math.log(2.0) / 22e-9


def doubling(pressure, _temperature=None, *, doubling_pressure):
    alpha = math.log(2.0) / doubling_pressure
    return alpha * np.asarray(pressure), np.full_like(pressure, alpha, dtype=float)


def law_warnings(max_pressure, _viscosity, _temperature, *, doubling_pressure):
    if max_pressure > 10 * doubling_pressure:
        yield ResultWarning(
            "law-range", f"the viscosity doubles {max_pressure / doubling_pressure:.0f} times"
        )


def linear(pressure, _temperature=None, *, bulk_modulus):
    return 1.0 + np.asarray(pressure) / bulk_modulus, np.full_like(pressure, 1.0 / bulk_modulus, dtype=float)


def squared(density_ratio, _temperature=None, *, relative_permittivity, excess):
    return relative_permittivity + excess * (np.asarray(density_ratio) ** 2 - 1.0)


def central(contact):
    return CentralThickness(central_thickness=1e-3 * contact.viscosity)


@pytest.fixture
def laws(monkeypatch):
    monkeypatch.setitem(VISCOSITY_LAWS, "doubling", Law(doubling, (DOUBLING,), warnings=law_warnings))
    monkeypatch.setitem(DENSITY_LAWS, "linear", Law(linear, (BULK,)))


def table(geometry="line", **changes):
    oil = {"viscosity": "0.04 Pa s", "relative_permittivity": 2.4, "density_law": "linear"}
    oil |= {"viscosity_law": "doubling", "doubling_pressure": P_2, "bulk_modulus": "2.5 GPa"}
    oil = {key: value for key, value in (oil | changes).items() if value is not None}
    if geometry == "line":
        return {"contact": dict(PAPER_CONTACT), "lubricant": oil, "grid": {"nodes": 801}}
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    return {"contact": contact, "lubricant": oil, "grid": {"nodes": 65}}


def rows(meaning):
    return {row.name: row.shown for row in meaning.rows}


def films_of(summary):
    return {key: film for key, film in flattened(summary["film_formulas"]).items() if film is not None}


@pytest.mark.usefixtures("laws")
def test_film_of_a_new_viscosity_law_is_that_of_the_same_curve():
    """Of light loads, where Barus' law is not absurd."""
    light = {"contact.load_per_length": "50 kN/m"}
    found = solve(Case.from_dict(table()).replace(light), require_convergence=True)
    barus = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 22e-9, "doubling_pressure": None}
    expected = solve(Case.from_dict(table(**barus)).replace(light), require_convergence=True)
    np.testing.assert_allclose(found.film.thickness, expected.film.thickness, rtol=1e-7)
    assert found.film.density.max() == pytest.approx(1.0 + found.film.max_pressure / 2.5e9, rel=1e-12)
    assert vars(found.formulas()["pan_hamrock"]) == pytest.approx(vars(expected.formulas()["pan_hamrock"]))


@pytest.mark.usefixtures("laws")
def test_a_new_law_is_saved_and_loaded(tmp_path):
    result = solve(Case.from_dict(table()).replace({"contact.load_per_length": "50 kN/m"}))
    save(result, tmp_path)
    assert load(tmp_path / "result.nc").case == result.case
    assert result.summary()["inputs"]["lubricant"]["doubling_pressure"] == P_2


@pytest.mark.parametrize("geometry", ["line", "point"])
@pytest.mark.usefixtures("laws")
def test_check_shows_formulas_and_warnings_of_a_new_law(geometry):
    case = Case.from_dict(table(geometry))
    assert case.oil.alpha == pytest.approx(22e-9, rel=1e-15)
    meaning = preview_of(case)
    summary, texts = meaning.summary, meaning.warnings
    of_paper = Case.from_dict(table(geometry) | {"lubricant": {"base": "paper", "viscosity_law": "barus"}})
    expected = preview_of(of_paper).summary
    # Formulas know alpha alone, and the Moes groups too.
    assert summary["groups"] == pytest.approx(expected["groups"], rel=1e-14)
    assert films_of(summary) == pytest.approx(films_of(expected), rel=1e-13)
    times = summary["hertz"]["max_pressure"] / P_2
    assert f"the viscosity doubles {times:.0f} times" in list(map(str, texts))
    assert rows(meaning)["material parameter (Moes)"] == f"{expected['groups']['moes_l']:.4g}"


@pytest.mark.usefixtures("laws")
def test_toml_round_trip_keeps_the_parameters_in_order(tmp_path):
    case = Case.from_dict(table())
    (tmp_path / "case.toml").write_text(case.to_toml(), encoding="utf-8")
    again = Case.from_toml(tmp_path / "case.toml")
    assert again == case
    assert again.lubricant.parameter("doubling_pressure") == P_2
    keys = list(case.to_dict()["lubricant"])
    assert keys[:5] == ["viscosity", "viscosity_law", "doubling_pressure", "density_law", "bulk_modulus"]
    assert case.replace({"lubricant.doubling_pressure": "40 MPa"}).lubricant.doubling_pressure == 4e7


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"doubling_pressure": None}, "doubling_pressure: missing; viscosity_law 'doubling' needs it"),
        (
            {"doubling_pressure": "1 kPa"},
            "doubling_pressure: got '1 kPa'; expected a number in Pa",
        ),
        (
            {"doubling_presure": 1e7},
            "doubling_presure: unknown key; the nearest known one is",
        ),
        (
            {"bulk_modulus": 1e7},
            "bulk_modulus: got 10000000.0; expected a number in Pa",
        ),
    ],
)
@pytest.mark.usefixtures("laws")
def test_messages_of_a_new_law(changes, message):
    with pytest.raises(InputError) as caught:
        Case.from_dict(table(**changes))
    assert str(caught.value).startswith(f"lubricant.{message}")


def test_a_law_that_is_not_there_has_no_keys():
    with pytest.raises(InputError, match="doubling_pressure: unknown key"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper", "doubling_pressure": 1e7}})


@pytest.mark.usefixtures("laws")
def test_sweep_over_a_parameter_of_a_new_law():
    case = Case.from_dict(table())
    vary = {"lubricant.doubling_pressure": ["20 MPa", "40 MPa"]}
    assert [*Sweep.from_dict({"case": case, "vary": vary}).points()] == [
        {"lubricant.doubling_pressure": 2e7},
        {"lubricant.doubling_pressure": 4e7},
    ]
    label = label_of("inputs.lubricant.doubling_pressure", case)
    assert label.axis(label.scaled(np.array([2e7, 4e7]))) == "doubling pressure $p_2$ [MPa]"
    # Without a title the key stands there in words.
    assert label_of("inputs.lubricant.bulk_modulus", case).name == "bulk modulus"


def test_a_new_permittivity_law(monkeypatch):
    excess = Parameter("excess", "", meaning="share of the square", least=0.0, most=10.0)
    (eps_r,) = PERMITTIVITY_LAWS["constant"].parameters
    monkeypatch.setitem(PERMITTIVITY_LAWS, "squared", Law(squared, (eps_r, excess)))
    oil = {"base": "paper", "permittivity_law": "squared", "excess": 0.5}
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": oil, "grid": {"nodes": 401}})
    result = solve(case)
    rho = np.interp(0.0, result.film.x, result.film.density)
    across = result.field.permittivity[np.argmin(np.abs(result.field.x))]
    assert across == pytest.approx(2.4 + 0.5 * (rho**2 - 1.0), rel=1e-3)
    with pytest.raises(InputError, match=r"lubricant\.excess: missing; permittivity_law 'squared' needs it"):
        case.replace({"lubricant": {"base": "paper", "permittivity_law": "squared"}})


def test_a_law_may_depend_on_the_temperature(monkeypatch):
    """Without a temperature it is that of the case, which is what the film takes."""

    def thinning(pressure, temperature=None):
        alpha = 20e-9 if temperature is None else 20e-9 * 300.0 / np.asarray(temperature)
        return alpha * np.asarray(pressure), alpha * np.ones_like(pressure)

    monkeypatch.setitem(VISCOSITY_LAWS, "thinning", Law(thinning))
    case = Case.from_dict(
        {"contact": PAPER_CONTACT, "lubricant": {"base": "paper", "viscosity_law": "thinning"}}
    )
    assert case.oil.alpha == 20e-9
    pressure = np.array([[1e8], [2e8]])
    value, slope = case.oil.log_viscosity(pressure, np.array([300.0, 600.0]))
    np.testing.assert_allclose(value, [[2.0, 1.0], [4.0, 2.0]])
    np.testing.assert_allclose(slope, [[20e-9, 10e-9]] * 2)
    assert film_problem(case, resolve(case)).fluid.log_viscosity(np.ones(1))[1] == pytest.approx(
        20e-9 * resolve(case).max_pressure
    )


def bearing(**oil):
    geometry = {"base": "6208", "radial_clearance": 1e-5, "axial_load": 500.0, "inner_speed": 500.0}
    geometry |= {"temperature": 343.15, "composite_rq": 1e-8}
    temperature = {"kinematic_viscosity_40": 46e-6, "kinematic_viscosity_100": 6.8e-6, "density_15": 870.0}
    oil = table(**oil)["lubricant"] | {"temperature": temperature}
    del oil["viscosity"]
    return BearingCase.from_dict({"contacts": "formula", "bearing": geometry, "lubricant": oil})


@pytest.mark.usefixtures("laws")
def test_contacts_of_a_bearing_by_formula_take_a_new_law():
    barus = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 22e-9, "doubling_pressure": None}
    found, expected = (solve_bearing(case) for case in (bearing(), bearing(**barus)))
    assert found.summary()["bearing"]["capacitance"] == pytest.approx(
        expected.summary()["bearing"]["capacitance"], rel=1e-9
    )
    assert any(str(text).endswith("times") for text in found.warnings)


@pytest.mark.parametrize(("module", "geometry"), [(film_line, "line"), (film_point, "point")])
@pytest.mark.usefixtures("laws")
def test_a_new_formula_is_in_results_and_tables(monkeypatch, module, geometry):
    """Its film is a thousandth of the viscosity, 0.04 Pa s."""
    monkeypatch.setitem(module.FORMULAS, "mine", Formula("My formula", central))
    case = Case.from_dict(table(geometry) | {"lubricant": {"base": "paper"}})
    meaning = preview_of(case)
    summary = meaning.summary
    films = {"minimum_thickness": None, "central_thickness": 4e-5}
    assert summary["film_formulas"]["mine"] == films
    assert rows(meaning)["central film (My formula)"] == "40"
    assert "minimum film (My formula)" not in rows(meaning)
    result = solve(case)
    assert result.formulas()["mine"] == CentralThickness(central_thickness=4e-5)
    assert result.summary()["film_formulas"]["mine"] == films


def test_a_piezoviscous_formula_gives_nothing_for_an_isoviscous_oil(monkeypatch):
    monkeypatch.setitem(film_line.FORMULAS, "mine", Formula("My formula", central, piezoviscous=True))
    oil = {"base": "paper", "viscosity_law": "constant"}
    meaning = preview_of(Case.from_dict({"contact": PAPER_CONTACT, "lubricant": oil}))
    summary = meaning.summary
    assert set(summary["film_formulas"]["mine"].values()) == {None}
    assert not any("My formula" in name for name in rows(meaning))


def test_a_lubricant_of_the_library_is_one_file(tmp_path, monkeypatch):
    """A copy of the library gains a file, whose name a case takes and a message lists."""
    folder = tmp_path / "library"
    shutil.copytree(library._FOLDER, folder)
    oil = (folder / "lubricants" / "paper.toml").read_text(encoding="utf-8")
    (folder / "lubricants" / "thick.toml").write_text(
        re.sub(r"^viscosity = .*$", 'viscosity = "0.4 Pa s"', oil, flags=re.MULTILINE), encoding="utf-8"
    )
    monkeypatch.setattr(library, "_FOLDER", folder)
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "thick"}})
    assert case.lubricant.viscosity == 0.4
    with pytest.raises(InputError, match=r", thick; for another grade"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "tar"}})


def test_the_map_names_files_and_tests_that_are_there():
    """The table "I want to add ..." of architecture.md: paths, and tests that show the addition."""
    page = pages.page("architecture.md")
    lines = [line for line in page.partition("## I want to add")[2].splitlines() if "`" in line]
    tests = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("test_*.py"))
    package = ROOT / "src" / "ehlectric"
    paths = [name for line in lines for name in re.findall(r"`([\w/.]+\.(?:py|toml))`", line)]
    assert len(paths) > 10
    assert [name for name in paths if not any((base / name).is_file() for base in (package, ROOT))] == []
    shown = [name for line in lines for name in re.findall(r"`(test_\w+)`", line)]
    assert [name for name in shown if f"def {name}(" not in tests] == []


def test_a_warning_is_a_code_and_a_condition(monkeypatch):
    """A code and its text in the lists, and a generator that gives it: the summary carries it."""
    texts = {**result_warnings._texts(), "fast": {"text": "the surfaces move at {speed:g} m/s"}}
    monkeypatch.setattr(
        result_warnings,
        "CODES",
        {**result_warnings.CODES, "fast": result_warnings.WarningCode("The contact is fast.", "Contact")},
    )
    monkeypatch.setattr(result_warnings, "_texts", lambda: texts)
    before = solver.case_warnings

    def case_warnings(setup, conditions):
        yield from before(setup, conditions)
        if conditions.entrainment_speed > 3.0:
            yield ResultWarning.of("fast", speed=conditions.entrainment_speed)

    monkeypatch.setattr(solver, "case_warnings", case_warnings)
    fast = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 801}})
    summary = solve(fast).summary()
    told = dict(zip(summary["warning_codes"], summary["warnings"], strict=True))
    assert told["fast"] == "the surfaces move at 4 m/s"
    slow = solve(fast.replace({"contact.entrainment_speed": 2.0}))
    assert "fast" not in slow.summary()["warning_codes"]
