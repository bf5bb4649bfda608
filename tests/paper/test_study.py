"""What the report says: which films agree, the readings of mid-film, the slips' checks."""

import dataclasses
import os
import re

import numpy as np
import pytest
from docs import pages

from ehlectric import solve
from ehlectric.field.line_field import solve_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.formulas.polynomials import lobatto_nodes
from ehlectric.paper import errata, fas, paper_report
from ehlectric.paper.paper_contacts import CONTACTS, LOADS, measured_profile, of_paper
from ehlectric.paper.paper_figures import FIGURES
from ehlectric.paper.paper_tables import TABLES, agrees, amplitude, printed_table
from ehlectric.paper.study import Placed, Study, readings_differ_by, straight_line
from ehlectric.runtime.worker_processes import cores
from tests.field.exact_fields import cylinder_potential
from tests.helpers.places import EXAMPLES


@pytest.fixture(scope="module")
def study():
    """The eight contacts on coarse grids, which is enough to look at the logic of tables and verdicts."""
    smooth, rough, constant = {}, {}, {}
    with measured_profile() as profile:
        for contact in CONTACTS:
            smooth[contact] = solve(contact.case(nodes=801))
            rough[contact] = solve(contact.rough_case(profile, nodes=1601))
            constant[contact] = solve(contact.constant_case().replace({"grid.nodes": 801}))
    placed = {contact: (Placed(2e-7, 1.01, converged=True),) * 4 for contact in CONTACTS}
    return Study(
        smooth=smooth, first_order=smooth, fine=smooth, rough=rough, constant=constant, placed=placed
    )


@pytest.fixture(scope="module")
def smooth(study):
    return study.smooth


def tables_of(study):
    return {name: build(study) for name, (build, _) in TABLES.items()}


def verdicts(study):
    return paper_report.verdicts(tables_of(study))


@pytest.mark.slow
def test_names_are_the_printed_ones_but_one(smooth):
    odd = []
    for contact, result in smooth.items():
        groups = of_paper(result)
        moes_m, moes_l = (float(part) for part in contact.printed[1:].split("L"))
        assert np.floor(groups.moes_l) == moes_l
        if np.floor(groups.moes_m) != moes_m:
            odd.append(contact.printed)
    assert odd == ["M68L13"]


@pytest.mark.slow
def test_load_of_1_gpa_is_a_quarter(smooth):
    assert LOADS[2] == 4.0 * LOADS[1]
    for contact, result in smooth.items():
        assert result.conditions.max_pressure == pytest.approx(contact.gigapascal * 1e9, rel=2e-3, abs=0.0)


@pytest.mark.slow
def test_a_film_that_does_not_agree_is_said(smooth):
    """A film of half the speed in a row is not that of the table; 4 % and half of the last digit are."""
    table = printed_table(Study(smooth=smooth, first_order=smooth))
    assert [row[1] for row in table.rows[:3]] == ["yes"] * 3
    wrong = smooth | {CONTACTS[4]: smooth[CONTACTS[5]]}
    table = printed_table(Study(smooth=wrong, first_order=smooth))
    assert [row[1] for row in table.rows[:3]] == ["no", "yes", "yes"]
    assert agrees(0.104e-6 + 0.0049e-6, 0.1e-6)
    assert not agrees(0.104e-6 + 0.0051e-6, 0.1e-6)


@pytest.mark.slow
def test_conclusions_hold_and_would_not_hold(study):
    said = verdicts(study)
    assert [said[f"conclusion_{k}"] for k in (1, 2, 3)] == ["holds"] * 3
    contact = CONTACTS[2]
    # One placement with a field 6 % above V12/h_min.
    placed = (*study.placed[contact][:3], Placed(2e-7, 1.06, converged=True))
    bad = dataclasses.replace(study, placed=study.placed | {contact: placed})
    assert verdicts(bad)["conclusion_1"] == "does not hold"
    # A contact with the zone of another speed does not narrow.
    bad = dataclasses.replace(study, smooth=study.smooth | {contact: study.smooth[CONTACTS[0]]})
    assert verdicts(bad)["conclusion_2"] == "does not hold"
    # A field that is 2 % higher with a constant permittivity.
    constant = study.constant[contact]
    field = dataclasses.replace(constant.field, strength=1.02 * constant.field.strength)
    changed = dataclasses.replace(constant, field=field)
    bad = dataclasses.replace(study, constant=study.constant | {contact: changed})
    assert verdicts(bad)["conclusion_3"] == "does not hold"
    # A film that is 10 % thicker.
    wrong = CONTACTS[4]
    film = dataclasses.replace(study.smooth[wrong].film, thickness=1.1 * study.smooth[wrong].film.thickness)
    thick = dataclasses.replace(study.smooth[wrong], film=film)
    bad = dataclasses.replace(study, smooth=study.smooth | {wrong: thick})
    good_rows, bad_rows = (int(verdicts(each)["table_3"].split()[0]) for each in (study, bad))
    assert bad_rows == good_rows - 1


@pytest.mark.slow
def test_a_film_that_was_not_found_is_said(study):
    assert study.converged
    places = (Placed(2e-7, 1.0, converged=False),)
    assert not dataclasses.replace(study, placed={CONTACTS[0]: places}).converged


@pytest.mark.slow
def test_straight_line_between_smooth_equal_bodies_is_the_middle(smooth):
    for result in smooth.values():
        assert readings_differ_by(result) < 1e-9


@pytest.mark.slow
def test_strength_along_a_straight_line(study):
    """Against the exact field between a plane and a cylinder, and none beyond the walls."""
    radius, gap, height = 5e-3, 1e-6, 0.4e-6
    x = np.linspace(-1e-4, 1e-4, 801)
    upper = gap + radius - np.sqrt(radius**2 - x**2)
    end = cylinder_potential(x[0], upper[0] * lobatto_nodes(8), radius, gap)
    problem = FieldProblem(x, 0 * x, upper, 1 + 0 * x, 0.0, 1.0, degree=8, end_potentials=(end, end))
    field = solve_field(problem)
    focus, scale = np.sqrt(gap**2 + 2 * gap * radius), np.arccosh(1 + gap / radius)
    above, below = x**2 + (height + focus) ** 2, x**2 + (height - focus) ** 2
    exact = np.hypot(x / above - x / below, (height + focus) / above - (height - focus) / below) / scale
    np.testing.assert_allclose(field.strength_at(height)[2:-2], exact[2:-2], rtol=1e-6)
    outside = field.strength_at(1.05e-6)
    np.testing.assert_array_equal(np.isnan(outside), upper < 1.05e-6)
    rough = study.rough[CONTACTS[7]]
    assert 1e-4 < readings_differ_by(rough) < 0.02
    assert straight_line(rough).shape == rough.field.x.shape


@pytest.mark.slow
def test_heavier_contacts_flatten_their_roughness_more(study):
    """Amplitude reduction: less of it is left at the higher of two pressures, all else the same."""
    for light, heavy in zip(CONTACTS[:4], CONTACTS[4:], strict=True):
        assert amplitude(study.rough[heavy]) < amplitude(study.rough[light]) < 1.0


def test_packaged_profile_is_that_of_the_examples():
    example = EXAMPLES / "surfaces"
    with measured_profile() as path:
        assert path.read_bytes() == (example / "dektak-1.csv").read_bytes()
        assert (path.parent / "README.md").read_text() == (example / "README.md").read_text()


def test_every_figure_and_table_takes_parts_of_a_study():
    parts = set(Study.__dataclass_fields__)
    for figure in FIGURES.values():
        assert set(figure.parts) <= parts
    for _, needed in TABLES.values():
        assert set(needed) <= parts


@pytest.mark.slow
def test_checks_of_the_slips(study):
    """Each number by hand, or by a bound that the slip would break."""
    said = {slip.printed.split(":")[0]: slip.check(study) for slip in errata.SLIPS}
    # M goes with eta0^(-1/2), L with eta0^(1/4).
    assert "4e-4 gives 491.7 and 4.98, 0.04 gives 49.2 and 15.7" in said["Table 1"]
    assert "2.001 GPa, a quarter of it 1.001 GPa" in said["Table 2"]
    tension = float(re.search(r"goes to (-[\d.]+) %", said["Eq. (6) and its boundary conditions only"])[1])
    assert -6.0 < tension < -1.0
    carried = [float(each) for each in re.findall(r"\d\.\d{4}", said["Eq. (19)"])]
    # The load of a Hertz contact falls by 4.5 when its H00 is raised by one.
    assert carried[1] == pytest.approx(np.pi / 2, abs=1e-4)
    assert (carried[0] - carried[1]) / 0.01 == pytest.approx(-4.5, abs=0.5)
    assert "1.10 V" in said["Section 2.4"]  # 1 + 1/(4 2.4)
    squeezed, ours = map(float, re.findall(r"(\d\.\d\d)", said["Eqs. (A1) to (A5) for any grid"])[-2:])
    assert squeezed > ours + 0.05
    assert "M = 69.5" in said["Figure 6"]
    # 2 b 10 mm = 9.99 mm^2 at b = 499.4 µm.
    assert "8 µA and 0.8 A/mm^2 is 8 A" in said["Section 3.1"] or "10 mm^2" in said["Section 3.1"]


@pytest.mark.slow
def test_tension_solution_carries_the_load():
    _, equations, at = errata._solved(401)
    film = errata._unconstrained(equations, at)
    assert equations.carried(film.pressure) == pytest.approx(np.pi / 2, rel=1e-9, abs=0.0)
    assert fas.residual_norm(equations, at) < 1e-8


def test_slips_are_those_of_the_documentation():
    text = pages.page("errata.md")
    rows = [line for line in text.splitlines() if line.startswith("| ")][2:]
    assert len(rows) == len(errata.SLIPS)


def test_cores_without_affinity(monkeypatch):
    """Systems other than Linux do not tell which cores a process may use."""
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    assert cores() >= 1


@pytest.mark.slow
@pytest.mark.parametrize("number", [4, 5, 6, 9, 10])
def test_sections_that_are_compared_share_their_heights_and_one_colour_bar(study, number):
    """Heights are in one unit, the thickest film fits, and every panel says its speed."""
    axes = FIGURES[number].draw(study).axes
    panels, bars = [ax for ax in axes if ax.get_title(loc="left")], [ax for ax in axes if ax.get_ylabel()]
    assert len(panels) == len(axes) - 1 == (2 if number == 4 else 4)
    limits = {ax.get_ylim() for ax in panels}
    assert len(limits) == 1
    gigapascal, solved = 1 if number in (4, 5, 9) else 2, study.rough if number > 8 else study.smooth
    thickest = 1e6 * max(r.film.central_thickness for c, r in solved.items() if c.gigapascal == gigapascal)
    low, high = limits.pop()
    assert low < -0.5 * thickest < 0.5 * thickest < high < thickest
    assert {ax.get_ylabel() for ax in bars if ax in panels} == {"height $y$ [µm]"}
    assert all("m/s" in ax.get_title(loc="left") for ax in panels)


@pytest.mark.slow
@pytest.mark.parametrize(("number", "text"), [(7, "coincide"), (11, "differ by up to ")])
def test_the_definitions_of_mid_film_are_one_line_where_they_coincide(study, number, text):
    """A dotted line over each curve, and in its inset, where they differ."""
    panels = FIGURES[number].draw(study).axes[:2]
    solved = study.smooth if number == 7 else study.rough
    for ax, gigapascal in zip(panels, (1, 2), strict=True):
        apart = max(readings_differ_by(solved[c]) for c in CONTACTS if c.gigapascal == gigapascal)
        title = ax.get_title(loc="right")
        assert title.startswith(f"both definitions of mid-film {text}")
        assert number == 7 or title.endswith(f"{100.0 * apart:.2g} %")
        dotted = [line for line in ax.get_lines() if line.get_color() == "black"]
        assert len(dotted) == (0 if number == 7 else 5)
        assert "M12L15, $u_1+u_2$ = 8 m/s" in [t.get_text() for t in panels[0].get_legend().get_texts()]
    assert panels[0].get_ylim() == panels[1].get_ylim()
