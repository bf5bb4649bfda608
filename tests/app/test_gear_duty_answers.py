"""Duty cycles on the page of a gear pair: numbers of the command, table over time, and wrong files."""

import pytest

from ehlectric.app.charts.duty_charts import MESH_DUTY_HEADS
from ehlectric.app.compute.answer_parts import lines_of
from ehlectric.app.compute.duty_answers import look
from ehlectric.app.compute.gear_answers import duty_answer, quick_answer
from ehlectric.app.pages.frame import GEAR
from ehlectric.app.session import SURFACES
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.gear import solve_gear
from ehlectric.tables.gear_tables import gear_rows

HEADS = "time [s],speed [rpm],torque [N m],radial load [N]"
ROWS = "0,0,0,1\n10,50,120,1\n20,9000,20,1\n60,12000,-30,1\n"
FILE = f"{SURFACES}/surface-1.csv"


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """Folder of a session with a duty cycle."""
    folder = tmp_path_factory.mktemp("session")
    (folder / SURFACES).mkdir()
    (folder / FILE).write_text(f"{HEADS}\n{ROWS}", encoding="utf-8")
    return folder


def test_the_page_has_the_numbers_of_the_command(session):
    table = {**GEAR.table, "duty": {"file": FILE}}
    shown = duty_answer(table, session)
    case = GearCase.from_written({**GEAR.table, "duty": {"file": str(session / FILE)}})
    rows = [row for row in gear_rows(solve_gear(case).summary()) if row.key.startswith("duty.")]
    assert shown.lines == lines_of(row for row in rows if not row.key.startswith("duty.stretches"))
    assert shown.figure.title == "Speed, torque, lambda ratio and breakdown voltage over the duty cycle"
    assert shown.figure.table.heads == MESH_DUTY_HEADS
    first, *_, last = shown.figure.table.rows
    assert (first[0], first[-1]) == ("0", "standstill")
    assert last[:3] == ("60", "-30", "12\N{NO-BREAK SPACE}000")
    titles = [warning.code for warning in shown.warnings]
    assert "columns-ignored" in titles
    # Without the file of the cycle, the page answers at the operating point.
    assert quick_answer(table, None).duty is None


def test_a_file_without_columns_of_gears_is_refused(session):
    text = look(FILE, session, "gear").text
    assert text.startswith("4 rows over 60 s: speed, torque.")
    assert "Ignored: radial load [N]." in text
    (session / SURFACES / "other.csv").write_text("time [s],radial load [N]\n0,1\n1,2\n", encoding="utf-8")
    with pytest.raises(InputError, match="torque"):
        look(f"{SURFACES}/other.csv", session, "gear")
