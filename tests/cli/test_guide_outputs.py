"""Outputs printed in the guide are those of the commands: every line and every sentence of a block."""

import re
import shlex

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
    done = run_command(*arguments, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return words(done.stdout)


@pytest.fixture(scope="module")
def bearing_output(tmp_path_factory):
    example = str(ROOT / "examples" / "bearing_6208.toml")
    arguments = ("bearing", example, "--contacts", "atlas", "--no-plots", "-o", "out")
    return printed_by(*arguments, cwd=tmp_path_factory.mktemp("bearing"))


@pytest.fixture
def tutorial(tmp_path):
    """Folder with the bearing file of the tutorial."""
    (file,) = (block for block in blocks("first_bearing.md", "toml") if "[bearing]" in block)
    (tmp_path / "bearing.toml").write_text(file, encoding="utf-8")
    return tmp_path


def test_the_page_of_oils_has_the_output_of_its_command(tmp_path):
    (block,) = (block for block in blocks("oils.md", "text") if block.startswith("$"))
    command, *lines = block.splitlines()
    printed = printed_by(*shlex.split(command.removeprefix("$ ehlectric ")), cwd=tmp_path)
    assert len(lines) > 10
    for line in lines:
        assert words(line) in printed


@pytest.mark.slow
def test_the_bearing_page_has_the_output_of_its_command(bearing_output):
    verdict, totals, contacts, *others = blocks("bearing.md", "text")
    (probability,) = (block for block in others if "within what is uncertain" in block)
    assert words(verdict) in bearing_output
    for line in (*totals.splitlines(), *contacts.splitlines(), *probability.splitlines()):
        assert words(line) in bearing_output


def kind_commands():
    """Commands of the bearings of several kinds, and the lines that the page has of their output."""
    shown = [block.splitlines() for block in blocks("bearing.md", "text") if block.startswith("$")]
    return {command.removeprefix("$ ehlectric "): lines for command, *lines in shown}


@pytest.mark.slow
@pytest.mark.parametrize("command", kind_commands())
def test_the_bearing_page_has_the_output_of_each_kind(command, tmp_path):
    word, file, *others = shlex.split(command)
    printed = printed_by(word, str(ROOT / file), *others, "--no-plots", cwd=tmp_path)
    lines = kind_commands()[command]
    assert len(lines) == 3
    for line in lines:
        assert words(line) in printed


@pytest.mark.slow
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


@pytest.mark.slow
def test_the_meter_page_has_the_output_of_its_example(tmp_path):
    example = str(ROOT / "examples" / "oil_contact.toml")
    printed = printed_by("run", example, "--no-plots", "-o", "o", cwd=tmp_path)
    for line in blocks("meter.md", "text")[0].splitlines():
        assert words(line) in printed


@pytest.mark.slow
def test_the_oils_and_temperatures_of_the_guide_can_be_swept(tmp_path):
    (sweep,) = (block for block in blocks("oils.md", "toml") if "[vary]" in block)
    example = (ROOT / "examples" / "oil_contact.toml").read_text(encoding="utf-8")
    # A grid for the sweep to be quick; the numbers of the page are those of the grid of the example.
    example = example.replace('error = "2 %"', "nodes = 65")
    (tmp_path / "oil_contact.toml").write_text(example, encoding="utf-8")
    (tmp_path / "oils.toml").write_text(sweep, encoding="utf-8")
    assert "points solved 6 of 6" in printed_by("sweep", "oils.toml", "-o", "oils", cwd=tmp_path)
    value = ("--value", "film.central_thickness")
    along = ("--x", "contact.temperature", "--y", "lubricant.base")
    assert "lines_film.central_thickness.png" in printed_by("map", "oils", *along, *value, cwd=tmp_path)


@pytest.mark.slow
def test_the_discharge_page_has_the_output_of_its_case(tmp_path):
    printed = printed_by(
        "run", str(ROOT / "examples" / "discharge.toml"), "--no-plots", "-o", "o", cwd=tmp_path
    )
    table, verdict = blocks("discharge.md", "text")
    for line in table.splitlines():
        assert words(line) in printed
    assert words(verdict) in printed
