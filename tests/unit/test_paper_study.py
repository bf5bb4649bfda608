"""What the report says: which films agree, the readings of mid-film, the slips' checks."""

from pathlib import Path

import numpy as np
import pytest

from ehlectric import solve
from ehlectric.paper import errata, fas
from ehlectric.paper.contacts import CONTACTS, LOADS, measured_profile
from ehlectric.paper.figures import FIGURES
from ehlectric.paper.study import Solved, Study, straight_line
from ehlectric.paper.tables import TABLES, printed_table


@pytest.fixture(scope="module")
def smooth():
    """The eight smooth contacts on a coarse grid, which is enough to look at the tables' logic."""
    solved = {}
    for contact in CONTACTS:
        result = solve(contact.case(nodes=801))
        solved[contact] = Solved(result, straight_line(result))
    return solved


def test_names_are_the_printed_ones_but_one(smooth):
    odd = []
    for contact, solved in smooth.items():
        groups = solved.result.conditions.formulas
        moes_m, moes_l = (float(part) for part in contact.printed[1:].split("L"))
        assert np.floor(groups.moes_l) == moes_l
        if np.floor(groups.moes_m) != moes_m:
            odd.append(contact.printed)
    assert odd == ["M68L13"]


def test_load_of_1_gpa_is_a_quarter(smooth):
    assert LOADS[2] == 4.0 * LOADS[1]
    for contact, solved in smooth.items():
        assert solved.result.conditions.max_pressure == pytest.approx(contact.gigapascal * 1e9, rel=2e-3)


def test_a_film_that_does_not_agree_is_said(smooth):
    """A film solved at half the speed is not that of the table."""
    first = {contact: solved.result for contact, solved in smooth.items()}
    table = printed_table(Study(smooth=smooth, first_order=first))
    assert [row[-1] for row in table.rows[:3]] == ["yes"] * 3
    wrong = dict(smooth)
    wrong[CONTACTS[4]] = smooth[CONTACTS[5]]
    table = printed_table(Study(smooth=wrong, first_order=first))
    assert [row[-1] for row in table.rows[:3]] == ["no", "yes", "yes"]


def test_readings_of_mid_film_differ_as_thin_gaps_do(smooth):
    """E = V12/h across the whole film up to terms of (dh/dx)^2: 1e-3 at the steepest wall."""
    for solved in smooth.values():
        of = solved.result.field
        inside = of.inner & np.isfinite(solved.straight)
        assert inside.sum() > 0.9 * of.x.size
        np.testing.assert_allclose(solved.straight[inside], of.middle_strength[inside], rtol=1e-3)


def test_packaged_profile_is_that_of_the_examples():
    example = Path(__file__).parents[2] / "examples" / "surfaces"
    with measured_profile() as path:
        assert path.read_bytes() == (example / "dektak-1.csv").read_bytes()
        assert (path.parent / "README.md").read_text() == (example / "README.md").read_text()


def test_every_figure_and_table_takes_parts_of_a_study():
    parts = set(Study.__dataclass_fields__)
    for figure in FIGURES.values():
        assert set(figure.parts) <= parts
    for _, needed in TABLES.values():
        assert set(needed) <= parts


def test_tension_without_cavitation():
    """The condition that eq. (6) lacks: without it the oil would carry tens of MPa of tension."""
    _, equations, at = errata._solved(401)
    film = errata._unconstrained(equations, at)
    assert -0.06 < np.min(film.pressure) < -0.01
    assert equations.carried(film.pressure) == pytest.approx(np.pi / 2, rel=1e-9)
    constrained = fas.residual_norm(equations, at)
    assert constrained < 1e-8


def test_slips_are_those_of_the_documentation():
    text = (Path(__file__).parents[2] / "docs" / "errata.md").read_text(encoding="utf-8")
    rows = [line for line in text.splitlines() if line.startswith("| ")][2:]
    assert len(rows) == len(errata.SLIPS)
