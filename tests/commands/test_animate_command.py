"""The command animate: where its file goes."""

import pytest
from click.testing import CliRunner
from typer.main import get_command

from ehlectric.commands.command_line import app


@pytest.mark.parametrize(("words", "name"), [((), "run/motion.gif"), (("-o", "own.gif"), "own.gif")])
def test_the_animation_is_written_beside_its_run(words, name, tmp_path, monkeypatch):
    """Drawing is replaced: the test is of the place of the file."""
    written = []
    monkeypatch.setattr("ehlectric.motion.stored_run.read_motion", lambda folder: folder)
    monkeypatch.setattr(
        "ehlectric.figures.animation.save_animation", lambda _, path, **__: written.append(path)
    )
    (tmp_path / "run").mkdir()
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(get_command(app), ["animate", "run", *words])
    assert done.exit_code == 0, done.output
    assert [path.as_posix() for path in written] == [name]
