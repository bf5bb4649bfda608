"""Outputs printed in the guide are those of the commands: every line and every sentence of a block."""

import re

import pytest

from tests.helpers.commands import run_command
from tests.helpers.places import ROOT

GUIDE = ROOT / "docs" / "guide"


def blocks(page, language):
    """Blocks of a page in a language, in their order."""
    text = (GUIDE / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.S | re.M)


def words(text):
    return " ".join(text.split())


def printed_by(*arguments, cwd):
    done = run_command(*arguments, cwd=cwd, timeout=400)
    assert done.returncode == 0, done.stderr
    return words(done.stdout)


@pytest.fixture(scope="module")
def bearing_output(tmp_path_factory):
    example = str(ROOT / "examples" / "bearing_6208.toml")
    arguments = ("bearing", example, "--contacts", "formula", "--no-plots", "-o", "out")
    return printed_by(*arguments, cwd=tmp_path_factory.mktemp("bearing"))


@pytest.fixture
def tutorial(tmp_path):
    """Folder with the bearing file of the tutorial."""
    (file,) = (block for block in blocks("first_bearing.md", "toml") if "[bearing]" in block)
    (tmp_path / "bearing.toml").write_text(file, encoding="utf-8")
    return tmp_path


@pytest.mark.slow
def test_the_bearing_page_has_the_output_of_its_command(bearing_output):
    verdict, totals, contacts = blocks("bearing.md", "text")
    assert words(verdict) in bearing_output
    for line in (*totals.splitlines(), *contacts.splitlines()):
        assert words(line) in bearing_output


def test_the_tutorial_has_the_output_of_check(tutorial):
    printed = printed_by("check", "bearing.toml", cwd=tutorial)
    table, verdict, _solved, _other_oil, effects = blocks("first_bearing.md", "text")
    for line in (*table.splitlines(), *effects.splitlines()):
        assert words(line) in printed
    assert words(verdict) in printed


@pytest.mark.slow
def test_the_tutorial_has_the_output_of_check_with_the_thicker_oil(tutorial):
    file = tutorial / "bearing.toml"
    text = file.read_text(encoding="utf-8")
    assert "iso_vg = 46" in text
    file.write_text(text.replace("iso_vg = 46", "iso_vg = 68"), encoding="utf-8")
    assert words(blocks("first_bearing.md", "text")[3]) in printed_by("check", "bearing.toml", cwd=tutorial)


@pytest.mark.slow
def test_the_tutorial_has_the_verdict_of_the_solved_bearing(tutorial):
    printed = printed_by("bearing", "bearing.toml", "--no-plots", "-o", "out", cwd=tutorial)
    assert words(blocks("first_bearing.md", "text")[2]) in printed


def test_the_discharge_page_has_the_output_of_its_case(tmp_path):
    printed = printed_by(
        "run", str(ROOT / "examples" / "discharge.toml"), "--no-plots", "-o", "o", cwd=tmp_path
    )
    table, verdict = blocks("discharge.md", "text")
    for line in table.splitlines():
        assert words(line) in printed
    assert words(verdict) in printed
