"""Slowest and hottest point of a sweep of drives, tried before the sweep begins."""

import pytest
from click.testing import CliRunner
from typer.main import get_command

from ehlectric.commands.command_line import app
from ehlectric.errors import InputError
from ehlectric.runs.preview import preview_of
from ehlectric.sweep.engine import lacking_point, plan
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import BALLS
from tests.helpers.drives import small_drive

SPEEDS = {"drive.speed": ["6000 rpm", "200 rpm", "3000 rpm"]}


def swept(**changes):
    drive = small_drive(**{"drive.temperature": "90 degC"} | changes)
    return Sweep.from_dict({"case": drive, "vary": SPEEDS})


def test_the_slowest_point_names_what_it_lacks():
    """At 200 rpm asperities close the films, at the first point of the sweep they do not."""
    sweep = swept()
    found = lacking_point(sweep, list(plan(sweep)))
    assert found.point.number == 1
    assert "contact_resistance" in found.reason
    meaning = preview_of(sweep)
    assert "contact_resistance" in meaning.summary["sweep"]["lacking"]


def test_a_refused_first_point_is_no_refused_sweep():
    """The sweep solves the second point and keeps the reason of the first one; the check shows the second."""
    case = {"contacts": "formula", "bearing": BALLS["bearing"], "lubricant": {"base": "iso-vg-46"}}
    hot, warm = "200 degC", "70 degC"
    checked = preview_of(Sweep.from_dict({"case": case, "vary": {"bearing.temperature": [hot, warm]}}))
    found = checked.summary["sweep"]
    assert found["first_point"]["number"] == 1
    assert found["points_refused"] == 1
    assert "bearing.temperature" in found["reason"]
    with pytest.raises(InputError, match="temperature"):
        preview_of(Sweep.from_dict({"case": case, "vary": {"bearing.temperature": [hot, "210 degC"]}}))


@pytest.mark.slow
@pytest.mark.gate
def test_a_given_resistance_lacks_nothing():
    sweep = swept(**{"bearings.bearing.contact_resistance": "1 ohm"})
    assert lacking_point(sweep, list(plan(sweep))) is None
    assert preview_of(sweep).summary["sweep"]["lacking"] is None


@pytest.mark.slow
def test_the_command_says_it_before_it_solves(tmp_path):
    (tmp_path / "drive.toml").write_text(small_drive(**{"drive.temperature": "90 degC"}).to_toml())
    vary = '[vary]\n"drive.speed" = ["200 rpm", "6000 rpm"]\n'
    (tmp_path / "sweep.toml").write_text(f'case = "drive.toml"\n{vary}')
    words = ["sweep", str(tmp_path / "sweep.toml"), "-o", str(tmp_path / "out")]
    done = CliRunner().invoke(get_command(app), words)
    assert "contact_resistance" in done.stderr.splitlines()[0]
