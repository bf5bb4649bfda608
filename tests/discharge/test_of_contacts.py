"""The discharge of solved contacts: one solve for every voltage, zones, places, files."""

import dataclasses
import json
import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric import Case, load, save, solve
from ehlectric.contact.problems import field_problem
from ehlectric.discharge.assessment import Assessment
from ehlectric.discharge.film_capacitance import OUTLETS, capacitance_beyond, oil_fraction
from ehlectric.field.line_field import solve_field
from ehlectric.field.zones import part_widths
from ehlectric.paper.paper_contacts import PAPER
from ehlectric.tables.contact_tables import result_rows
from tests.cases.test_point_case import point
from tests.conftest import PAPER_CONTACT
from tests.discharge.gap_films import line_gap, point_gap
from tests.field.exact_fields import near
from tests.helpers.places import EXAMPLES

LAWS = {
    "constant": {"dielectric_strength": "15 V/um"},
    "table over pressure": {
        "strength_table": {
            "pressure": ["0 GPa", "1 GPa", "4 GPa"],
            "strength": ["15 V/um", "20 V/um", "50 V/um"],
        }
    },
    "table over temperature": {
        "strength_table": {"temperature": ["20 degC", "120 degC"], "strength": ["20 V/um", "10 V/um"]},
        "temperature": "70 degC",
    },
    "weibull": {"weibull": {"scale": "30 V/um", "shape": 10.0, "reference_area": "1 mm^2"}},
}  # fmt: skip
WAVES = {"surface": 2, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "40 um"}


def line(discharge, **tables):
    table = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 801}}
    return Case.from_dict(table | {"discharge": discharge} | tables)


def case_of(kind, discharge):
    if kind == "point":
        return point({"entrainment_speed": "4 m/s"}, grid={"nodes": 65}, discharge=discharge)
    rough = [WAVES] if kind == "rough line" else []
    return line(discharge | {"length": "10 mm"}, roughness=rough)


@pytest.fixture(scope="module")
def solved():
    """Solutions by kind, each computed once; another discharge changes nothing of it."""
    results = {}

    def solution(kind, discharge):
        if kind not in results:
            results[kind] = solve(case_of(kind, {}), beside_smooth=False)
        return dataclasses.replace(results[kind], case=case_of(kind, discharge))

    return solution


def at_voltage(case, voltage, *, common=0.0):
    changed = {"electric.potential_1": common, "electric.potential_2": common + voltage}
    return solve(case.replace(changed), beside_smooth=False).discharge


KINDS = [("line", law) for law in LAWS]
KINDS += [("rough line", "table over pressure"), ("rough line", "weibull")]
KINDS += [("point", "weibull")]
KINDS += [
    pytest.param(kind, law, marks=pytest.mark.slow)
    for kind in ("rough line", "point")
    for law in LAWS
    if (kind, law) not in KINDS
]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "law"), KINDS)
def test_breakdown_of_one_solve_is_that_of_a_solve_at_it(solved, kind, law):
    """The field is linear in the voltage: 1e-9, the rounding of the solutions."""
    result = solved(kind, LAWS[law])
    found = result.discharge
    assert result.converged
    assert found.strength_law == law
    again = at_voltage(result.case, found.breakdown_voltage)
    assert again.breakdown_voltage == near(found.breakdown_voltage, 1e-9)
    assert again.margin == near(1.0, 1e-9)
    if law == "weibull":
        assert again.probability == near(1.0 - math.exp(-1.0), 1e-8)
    elif kind == "line":
        breaks = found.breakdown_voltage
        below, above = (at_voltage(result.case, part * breaks) for part in (1 - 1e-8, 1 + 1e-8))
        assert (found.probability, below.probability, above.probability) == (0.0, 0.0, 1.0)


def test_band_of_one_solve_is_that_of_solves_at_it(solved):
    found = solved("line", LAWS["weibull"]).discharge
    low, high = found.breakdown_voltage_low, found.breakdown_voltage_high
    for voltage, probability in ((low, 0.05), (high, 0.95)):
        again = at_voltage(case_of("line", LAWS["weibull"]), voltage)
        assert again.probability == near(probability, 1e-7)


@pytest.mark.parametrize(
    ("kind", "voltage", "common"),
    [
        ("line", -2.0, 1.0),
        ("line", 2.0, 500.0),
        ("line", -2.0, -70.0),
        pytest.param("point", -2.0, 500.0, marks=pytest.mark.slow),
    ],
)
def test_sign_and_common_potential_do_not_matter(solved, kind, voltage, common):
    given = LAWS["constant"] | {"external_capacitance": 1e-9}
    found = solved(kind, given).discharge
    other = at_voltage(case_of(kind, given), voltage, common=common)
    for name, value in vars(found).items():
        if isinstance(value, float):
            assert getattr(other, name) == near(value, 1e-8), name
        elif name != "zone_position":  # of two lobes alike one is first
            assert getattr(other, name) == value, name


def test_strength_that_falls_with_pressure_moves_the_zone(solved):
    """From the exit constriction, where the film is least and the pressure has gone, to where h times the
    strength at the pressure is least.
    """
    table = {"pressure": ["0 GPa", "1 GPa", "4 GPa"], "strength": ["40 V/um", "10 V/um", "10 V/um"]}
    constant, result = (solved("line", given) for given in (LAWS["constant"], {"strength_table": table}))
    film, found = result.film, result.discharge
    b, dx = result.conditions.half_width, film.x[1] - film.x[0]
    strength = np.where(film.pressure < 1e9, 40e6 - 30e-3 * film.pressure, 10e6)
    expected = film.x[np.argmin(film.thickness * strength)]
    assert constant.discharge.zone_position == near(film.minimum_position, 1e-12)
    assert film.minimum_position > 0.95 * b
    assert found.zone_position == pytest.approx(expected, abs=dx)
    assert abs(found.zone_position - film.minimum_position) > 0.1 * b
    assert found.dielectric_strength == near(10e6, 1e-12)
    assert found.breakdown_voltage == near(np.min(film.thickness * strength), 1e-3)
    assert found.zone_size > constant.discharge.zone_size


def test_zone_of_a_line_is_that_of_high_field(solved):
    """Of a constant strength; the largest field of a column is at the walls or mid-film, 1e-3 apart."""
    result = solved("line", LAWS["constant"])
    found = result.discharge
    start, stop = result.field.high_field_zone
    assert start < found.zone_position < stop
    assert found.zone_size == near(result.field.high_field_width, 1e-3)
    assert found.zone_area == near(0.01 * found.zone_size, 1e-12)
    assert found.breakdown_voltage == near(15e6 * 2.0 / result.field.max_strength, 1e-12)


def test_one_of_two_lobes_breaks_first(solved):
    """A smooth point contact has two that are alike, beside its middle."""
    result = solved("point", LAWS["constant"])
    _, y = result.discharge.zone_position
    assert abs(y) > 0.3 * result.conditions.semi_axis_y
    assert result.discharge.zone_area == near(0.5 * result.field.high_field_area, 1e-3)


def test_zones_add_up(solved):
    for kind in ("line", "rough line", "point"):
        found = solved(kind, {"outlet": "layers"}).discharge
        zones = (found.capacitance_hertz, found.capacitance_inlet, found.capacitance_outlet)
        assert found.capacitance == near(sum(zones) + (found.capacitance_sides or 0.0), 1e-14)
        assert found.capacitance_outlet == found.capacitance_outlet_layers


WHOLE = {"grid.field_range": [-4.0, 2.0]}


@pytest.mark.parametrize("kind", ["line", "rough line", "point"])
def test_solved_over_the_whole_domain(solved, kind):
    """The capacitance by zone then adds up to that of the field, and was not far from it before: 1e-5 of the
    thin gap outside the range for a line; a point contact's of 65 nodes are 2e-3 apart.
    """
    range_of = {"grid.field_range": [-4.5, 1.5], "grid.field_side": 3.0} if kind == "point" else WHOLE
    whole = solve(case_of(kind, {}).replace(range_of), beside_smooth=False)
    assert whole.discharge.capacitance == near(whole.field.capacitance, 1e-10)
    before = solved(kind, {}).discharge.capacitance
    assert before == near(whole.field.capacitance, 2e-3 if kind == "point" else 2e-5)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("reach", [0.5, 1.25, 1.9])
def test_zones_of_a_line_by_quadrature(reach):
    """eps0 eps/h of the film, linear between nodes. The solved field is a thin gap's to about a twelfth of
    the square of the angle between the walls, 0.07 at 1.9 half-widths.
    """
    result = solve(line({}).replace({"grid.field_range": [-reach, reach], "grid.nodes": 1601}))
    film, b = result.film, result.conditions.half_width
    permittivity = result.case.oil.permittivity(film.pressure, film.density)

    def dense(x):
        return epsilon_0 * np.interp(x, film.x, permittivity) / np.interp(x, film.x, film.thickness)

    for zone, start, stop in (("inlet", -4.0, -1.0), ("hertz", -1.0, 1.0), ("outlet", 1.0, 2.0)):
        # In parts of a tenth of b: the interpolant has a kink at every node.
        edges = np.linspace(start, stop, 1 + round(10 * (stop - start))) * b
        exact = sum(quad(dense, *part, epsabs=0.0, epsrel=1e-7, limit=400)[0] for part in pairwise(edges))
        assert getattr(result.discharge, f"capacitance_{zone}") == near(exact, 2e-4), zone


@pytest.mark.parametrize("outlet", ["fingers", "layers"])
def test_outlet_is_that_of_a_field_solved_anew(outlet):
    """With the permittivity of oil and gas in the Poisson problem, in place of a field that is scaled."""
    case = line({"outlet": outlet}).replace(WHOLE)
    result = solve(case)
    film, b = result.film, result.conditions.half_width
    fraction = oil_fraction(film.thickness, film.density, film.cavitated)
    oil = case.oil.permittivity(film.pressure, film.density)
    problem = field_problem(case, result.conditions, film, result.roughness)
    anew = solve_field(dataclasses.replace(problem, permittivity=OUTLETS[outlet](oil, fraction)))
    behind = part_widths(film.x, b, np.inf) @ anew.capacitance_density
    found = result.discharge
    assert found.capacitance_outlet == near(behind, 3e-5)
    assert found.capacitance == near(anew.capacitance, 3e-6)
    assert found.capacitance_outlet_layers < found.capacitance_outlet_fingers
    # Gas takes away a good part of it: no comparison of what is the same anyway.
    assert found.capacitance_outlet < 0.8 * found.capacitance_outlet_full


def test_the_papers_solvers_agree():
    """Film by FAS and field by SOR, at 401 nodes to what they differ in."""
    case = line(LAWS["constant"], grid={"nodes": 401, "wedge": "second-order"})
    ours, theirs = solve(case).discharge, solve(case, solvers=PAPER).discharge
    for name in ("capacitance", "capacitance_hertz", "capacitance_inlet", "capacitance_outlet"):
        assert getattr(theirs, name) == near(getattr(ours, name), 2e-3), name
    assert theirs.breakdown_voltage == near(ours.breakdown_voltage, 1e-3)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("kind", ["line", "point"])
def test_nothing_new_is_said_of_an_ordinary_case(solved, kind):
    with_discharge = solve(case_of(kind, LAWS["constant"]))
    assert with_discharge.warnings == solved(kind, {}).warnings
    plain = solve(case_of(kind, {}).replace(discharge=None))
    assert plain.warnings == with_discharge.warnings
    assert plain.discharge is None
    assert "discharge" not in plain.summary()


def test_pressures_beyond_the_table_are_said():
    """2 GPa in the contact, 1 GPa in the table, whose last value holds."""
    table = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "15 V/um"]}
    result = solve(line({"strength_table": table}))
    texts = [text for text in map(str, result.warnings) if "discharge.strength_table" in text]
    assert len(texts) == 1
    assert result.discharge.breakdown_voltage == near(15e6 * 2.0 / result.field.max_strength, 1e-12)


ALL = LAWS["weibull"] | {
    "conductivity": "1 pS/m", "external_capacitance": "1 nF", "peak_current": "1 A", "outlet": "layers",
    "pit": {"efficiency": 0.1, "melting_energy": "10 GJ/m^3"},
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["line", "point"])
@pytest.mark.parametrize("discharge", [{}, LAWS["constant"], ALL], ids=["nothing", "constant", "all"])
def test_summary_and_files(solved, kind, discharge, tmp_path):
    result = solved(kind, discharge)
    summary = json.loads(json.dumps(result.summary(), allow_nan=False))["discharge"]
    parts = [vars(getattr(result.discharge, part.name)) for part in dataclasses.fields(Assessment)]
    values = {name: value for part in parts for name, value in part.items()}
    assert set(summary) == set(values) | {"sources"}
    assert {name: getattr(result.discharge, name) for name in values} == values
    # No number that neither case nor solution gives stands without its source or the word.
    assert all(
        "assumption" in text or "doi" in text or "domain" in text for text in summary["sources"].values()
    )
    assert set(summary["sources"]) <= set(summary)
    missing = {name for name, value in summary.items() if value is None}
    if discharge is ALL:
        assert missing == {"dielectric_strength"} | ({"capacitance_sides"} if kind == "line" else set())
    summary_file, result_file, _ = save(result, tmp_path)
    assert json.loads(summary_file.read_text(encoding="utf-8"))["discharge"] == summary
    back = load(result_file)
    assert back.discharge == result.discharge
    assert back.summary()["discharge"] == summary


def test_rows_of_the_table(solved):
    line_rows = rows(result_rows(solved("line", ALL)))
    found = solved("line", ALL).discharge
    breakdown, unit = line_rows["discharge.breakdown_voltage"]
    assert (breakdown, unit[:2]) == (f"{found.breakdown_voltage:.4g}", "V,")
    assert "63.2 %" in unit
    whole, unit = line_rows["discharge.capacitance"]
    assert (whole, unit[:5]) == (f"{found.capacitance * 1e9:.4g}", "nF/m,")
    assert line_rows["discharge.discharge_energy"] == (f"{found.discharge_energy * 1e9:.4g}", "nJ")
    diameter, unit = line_rows["discharge.pit_diameter"]
    assert (diameter, unit[:2]) == (f"{found.pit_diameter * 1e6:.4g}", "µm")
    assert "assumption" in unit
    limits = line_rows["discharge.current_density"][1]
    assert (limits[:5], limits[-13:]) == ("A/mm²", "0.1, 0.3, 0.8")
    assert float(line_rows["discharge.relaxation_time"][0]) == pytest.approx(
        21.25, abs=0.06
    )  # 8.854 pF/m 2.4
    constant = rows(result_rows(solved("point", LAWS["constant"])))
    assert ", at 15 V/µm" in constant["discharge.breakdown_voltage"][1]
    assert constant["discharge.capacitance"][1].startswith(
        "pF, over x = −4.5 to 1.5 and y = ±3 semi-axes; a domain"
    )
    assert constant["discharge.capacitance_sides"][1] == "pF"
    assert "discharge.relaxation_time" not in constant
    assert "discharge.discharge_energy" not in constant
    bare = rows(result_rows(solved("line", {})))
    assert "discharge.breakdown_voltage" not in bare
    assert bare["discharge.dielectric_strength"][0] == "not given"


def rows(table):
    """Value, and unit with note, of each row of a table as a terminal shows them, by its key."""
    return {row.key: (row.shown, row.unit + row.note) for row in table}


@pytest.mark.slow
def test_valleys_behind_a_rough_exit_are_filled_by_the_oil_that_leaves_it():
    """The rough example's film ends at x/b = 1.065, and does not form again behind.

    By the oil fraction of that exit, layers leave 3.28 of 4.67 nF/m.
    """
    case = Case.from_toml(EXAMPLES / "rough_contact.toml").replace(discharge={"outlet": "layers"})
    result = solve(case, beside_smooth=False)
    film, found = result.film, result.discharge
    behind = film.x > 1.1 * result.conditions.half_width
    assert np.all(film.cavitated[behind])
    mass = film.thickness * film.density
    first = np.flatnonzero(film.cavitated & (film.x > 0.9 * result.conditions.half_width))[0]
    least = np.where(film.x > film.x[first], np.minimum(1.0, mass[first] / mass), 1.0)
    oil = case.oil.permittivity(film.pressure, film.density)
    eps = np.where(film.x > film.x[first], 1.0 / (least / oil + 1.0 - least), oil)
    outside = film.x >= result.conditions.half_width
    expected = np.trapezoid(epsilon_0 * (eps / film.thickness)[outside], film.x[outside])
    assert found.capacitance_outlet == pytest.approx(expected, rel=0.03, abs=0.0)
    assert found.capacitance_outlet < 0.8 * found.capacitance_outlet_full


def test_beyond_a_parabola():
    """Between the domain and one twice as large, dx/h of x^2/(2 R) makes R/4 + R/2 = R (1/L1 + 1/L2)."""
    x, radius = np.linspace(-4.0, 2.0, 7), 3.0
    film = line_gap(x, np.maximum(x**2 / (2.0 * radius), 0.1))
    expected = 2.4 * epsilon_0 * radius * (1.0 / 4.0 + 1.0 / 2.0)
    assert capacitance_beyond(film, 2.4) == near(expected, 1e-12)


def test_beyond_a_paraboloid():
    """There dA/h makes 4 pi ln(2) sqrt(Rx Ry), whatever the sides of the domain are."""
    x, y = np.linspace(-4.0, 2.0, 1201), np.linspace(-3.0, 3.0, 1201)
    gap = x[:, np.newaxis] ** 2 / (2.0 * 2.0) + y**2 / (2.0 * 5.0)
    found = capacitance_beyond(point_gap(x, y, np.maximum(gap, 1e-3)), 2.4)
    expected = 2.4 * epsilon_0 * 4.0 * math.pi * math.log(2.0) * math.sqrt(2.0 * 5.0)
    assert found == pytest.approx(expected, rel=1e-5, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("geometry", ["line", "point"])
def test_a_domain_twice_as_large_has_what_is_told_of_it(geometry):
    """The elastic gap grows faster than the square: by a factor 6 and not 4 from two half-widths to four."""
    if geometry == "line":
        inner, outer = {"nodes": 601}, {"inlet": -8.0, "outlet": 4.0, "nodes": 1201}
        cases = [line({}, grid=grid) for grid in (inner, outer)]
    else:
        inner = {"nodes": 65, "inlet": -4.5, "outlet": 1.5, "side": 3.0}
        outer = {"nodes": 129, "inlet": -9.0, "outlet": 3.0, "side": 6.0}
        cases = [point({"entrainment_speed": "4 m/s"}, grid=grid, discharge={}) for grid in (inner, outer)]
    small, large = (solve(case).discharge for case in cases)
    added = large.capacitance_full - small.capacitance_full
    assert 0.7 * small.capacitance_beyond < added < small.capacitance_beyond
