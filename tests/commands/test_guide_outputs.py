"""Outputs printed in the guide are those of the commands: every line and every sentence of a block."""

import re
import shlex

import pytest
from docs import pages
from docs.renew import RUNS, outputs, renewed, runs_of

from tests.helpers.commands import run_command
from tests.helpers.places import ROOT


def blocks(name, language):
    """Blocks of a page in a language, in their order."""
    return pages.blocks(pages.page(name), language)


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


def test_the_page_of_oils_has_the_output_of_its_command(tmp_path):
    (block,) = (block for block in blocks("oils.md", "text") if block.startswith("$"))
    command, *lines = block.splitlines()
    printed = printed_by(*shlex.split(command.removeprefix("$ ehlectric ")), cwd=tmp_path)
    assert len(lines) > 10
    for line in lines:
        assert words(line) in printed


@pytest.mark.slow
def test_the_bearing_page_has_the_output_of_its_command(bearing_output):
    verdict, totals, contacts, *_ = blocks("bearing_output.md", "text")
    (probability,) = blocks("howto/probability.md", "text")
    assert words(verdict) in bearing_output
    for line in (*totals.splitlines(), *contacts.splitlines(), *probability.splitlines()):
        assert words(line) in bearing_output


def kind_commands():
    """Commands of the bearings of several kinds, and the lines that the page has of their output."""
    shown = [block.splitlines() for block in blocks("bearing_kinds.md", "text") if block.startswith("$")]
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


def agrees(run):
    """Check that the pages that name a run contain the blocks and the numbers that it prints."""
    texts = [text for text in (file.read_text("utf-8") for file in pages.pages()) if run in runs_of(text)]
    assert texts
    printed = outputs({run}, lambda words, folder: run_command(*words, cwd=folder).stdout)
    for text in texts:
        assert renewed(text, printed) == text, "python -m docs.renew"


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("run", ["check", "readme"])
def test_blocks_and_numbers_of_the_first_pages_are_those_of_their_runs(run):
    agrees(run)


@pytest.mark.slow
@pytest.mark.parametrize("run", sorted(set(RUNS) - {"check", "readme"}))
def test_blocks_and_numbers_of_pages_are_those_of_their_runs(run):
    agrees(run)


def test_no_line_of_a_page_begins_with_the_comment_of_a_number():
    """Markdown ends a paragraph before a line that begins with a comment."""
    lines = [line for file in pages.pages() for line in file.read_text("utf-8").splitlines()]
    assert [line for line in lines if re.match(r"\s*<!--\w+: ", line)] == []


def test_the_readme_names_the_command_of_its_output():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert "ehlectric bearing examples/bearing_6208.toml --contacts atlas -o" in text


def test_every_speed_in_the_sentences_of_the_tutorial_is_of_the_file_or_of_a_run():
    """Four values of one critical speed stood in blocks and sentences."""
    text = pages.page("first_bearing.md")
    sentences = re.sub(r"^```.*?^```|<!--\w+: .*?<!--/-->|`[^`]*`", "", text, flags=re.S | re.M)
    assert set(re.findall(r"\d+ rpm", sentences)) <= {"4000 rpm"}


PRINTED = """
 voltages
   shaft voltage        4.1 V, by the
                        divider
   critical speed       7470 rpm
 other voltages
   shaft voltage        5 V
Breakdown likely
  voltages     shaft 4.1 V, margin 0.57
  speed        below about 7470 rpm
"""


PAGE = """It is <!--one: critical speed-->{speed}<!--/-->, margin <!--one: V, margin-->{margin}<!--/-->.

<!--one-->

```text
   shaft voltage     {volts}
 other voltages
   shaft voltage     {others}
Breakdown likely
  voltages     {shaft}margin {margin}
  speed        below about {speed}
```

<!--two-->

```text
   left     as it is
```
"""


def test_blocks_and_numbers_of_a_page_are_those_of_the_output():
    page = PAGE.format(speed="7430 rpm", margin="0.5", volts="4 V, by", others="4 V", shaft="")
    assert runs_of(page) == {"one", "two"}
    expected = PAGE.format(
        speed="7470 rpm", margin="0.57", volts="4.1 V, by the divider", others="5 V", shaft="shaft 4.1 V, "
    )
    assert renewed(page, {"one": PRINTED}) == expected
    with pytest.raises(LookupError, match="unknown"):
        renewed("<!--one: unknown-->4 V<!--/-->", {"one": PRINTED})


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
    table, verdict = blocks("howto/discharge.md", "text")
    for line in table.splitlines():
        assert words(line) in printed
    assert words(verdict) in printed


@pytest.mark.slow
def test_the_sweep_of_the_first_contact_is_solved_at_all_points(tmp_path):
    (case,) = (block for block in blocks("first_contact.md", "toml") if "[contact]" in block)
    (sweep,) = (block for block in blocks("first_contact.md", "toml") if "[vary]" in block)
    (tmp_path / "contact.toml").write_text(case, encoding="utf-8")
    (tmp_path / "speeds.toml").write_text(sweep, encoding="utf-8")
    assert "points solved 6 of 6" in printed_by("sweep", "speeds.toml", "-o", "o", cwd=tmp_path)


def test_the_file_of_the_first_drive_is_the_example_whose_numbers_the_page_contains(tmp_path):
    printed_by("init", "drive.toml", "--kind", "drive", "--no-schema", cwd=tmp_path)
    example = (ROOT / "examples" / "drive.toml").read_text("utf-8")
    assert (tmp_path / "drive.toml").read_text("utf-8") == example
