"""Every block of the pages for users runs as a reader runs it, and prints what the page shows."""

import re
from pathlib import Path
from subprocess import CompletedProcess

import matplotlib.pyplot as plt
import pytest
from docs.pages import DOCS, page, pages
from docs.printed import renewed_block, renewed_numbers
from docs.recipes import Walk, recipes

from ehlectric.runtime import worker_processes
from tests.helpers.gate import gated
from tests.helpers.programs import program

SCOPE = (
    *("README.md", "docs/index.md", "docs/tutorials/", "docs/howto/"),
    *("docs/reference/bearing_", "docs/reference/case.md"),
)
TEXTS = {file.relative_to(DOCS.parent).as_posix(): file.read_text("utf-8") for file in pages()}
RECIPES = {name: blocks for name in TEXTS if name.startswith(SCOPE) and (blocks := recipes(TEXTS[name]))}
QUICK = [
    *("docs/howto/cluster.md", "docs/howto/install.md", "docs/howto/own_laws.md"),
    *("docs/reference/case.md", "docs/tutorials/app.md"),
]
SLOW = gated(
    [name for name in RECIPES if name not in QUICK],
    *("README.md", "docs/tutorials/first_bearing.md", "docs/howto/bring_measurement.md"),
)
MOST_NOT_RUN = 10


@pytest.fixture
def faults(typed, tmp_path, monkeypatch):
    """Walk a page in an empty folder, and return the blocks that fail, with their lines."""
    # Everything is computed in this process, as in a service that may not start others.
    monkeypatch.setattr(worker_processes, "_is_daemonic", lambda: True)

    def faults(name):
        walk = Walk(DOCS.parent / name, lambda words: typed(*words))
        walk.walk(tmp_path)
        plt.close("all")
        found = [*walk.faults, *walk.differences]
        if not found:
            for missing in walk.missing:
                program(missing)
        return "\n".join(f"{name}:{fault}" for fault in found)

    return faults


@pytest.mark.parametrize("name", QUICK)
def test_the_blocks_of_a_quick_page(name, faults):
    if found := faults(name):
        pytest.fail(found, pytrace=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", SLOW)
def test_the_blocks_of_a_page(name, faults):
    if found := faults(name):
        pytest.fail(found, pytrace=False)


def test_few_blocks_are_not_run_and_each_states_a_reason():
    reasons = [
        block.mark("not run") for blocks in RECIPES.values() for block in blocks if "not run" in block.marks
    ]
    assert len(reasons) <= MOST_NOT_RUN
    assert all(len(reason.split()) > 1 for reason in reasons)


def test_no_line_of_a_page_begins_with_the_comment_of_a_number():
    """Markdown ends a paragraph before a line that begins with a comment."""
    lines = [line for text in TEXTS.values() for line in text.splitlines()]
    assert [line for line in lines if re.match(r"\s*<!--\w+: ", line)] == []


def test_every_speed_in_the_sentences_of_the_tutorial_is_of_the_file_or_of_a_run():
    """Four values of one critical speed stood in blocks and sentences."""
    sentences = re.sub(
        r"^```.*?^```|<!--\w+: .*?<!--/-->|`[^`]*`", "", page("first_bearing.md"), flags=re.S | re.M
    )
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
written to out:
  film.png
note: 40 rows
"""

BLOCK = """\
   shaft voltage     {volts}
 other voltages
   shaft voltage     {others}
Breakdown likely
  voltages     {shaft}margin {margin}
  speed        below about {speed}
"""


def test_rows_verdicts_lines_and_numbers_are_those_of_the_output():
    block = BLOCK.format(speed="7430 rpm", margin="0.5", volts="4 V, by", others="4 V", shaft="")
    new = {"speed": "7470 rpm", "margin": "0.57", "volts": "4.1 V, by the divider", "others": "5 V"}
    assert renewed_block(block, PRINTED) == BLOCK.format(**new, shaft="shaft 4.1 V, ")
    assert renewed_block("note: 39 rows\n", PRINTED) == "note: 40 rows\n"
    text = "It is <!--check: critical speed-->1 rpm<!--/-->, margin <!--check: V, margin-->1<!--/-->."
    new = renewed_numbers(text, lambda *_: ["another", PRINTED])
    assert re.sub("<.*?>", "", new) == "It is 7470 rpm, margin 0.57."
    swapped = "   critical speed    7470 rpm\n   shaft voltage     4.1 V\n   critical speed    7470 rpm\n"
    for wrong in ("   unknown voltage    5 V\n", "note: 40 columns\n", swapped):
        with pytest.raises(LookupError):
            renewed_block(wrong, PRINTED)


PAGE = """\
<!-- file: case.toml -->

```toml
[grid]
nodes = 801
```

<!-- in: fine.toml, from case.toml, without grid.nodes -->

```toml
[grid]
error = "1 %"
```

```sh
ehlectric solve case.toml  # a comment
ehlectric solve fine.toml
```

```text
   film     1.25 um
```

<!-- part of: fine.toml -->

```toml
[grid]
{part}
```

<!-- quick: case.toml: grid.nodes = 9 -->

```python
from pathlib import Path
print(Path("{name}").read_text())
```

```text
nodes = {nodes}
```

```toml
[grid]
```

A film of <!--solve: film-->{film} um<!--/-->.
"""


RIGHT = {"part": 'error = "1 %"', "name": "case.toml", "nodes": 9, "film": 1.25}


@pytest.mark.parametrize(
    ("wrong", "failing"),
    [
        ({}, []),
        ({"part": "nodes = 801"}, ["```toml\n[grid]\nnodes = 801\n```\n\n<!-- quick"]),
        ({"name": "none.toml"}, ["```python", "```text\nnodes"]),
        ({"nodes": 8}, ["```text\nnodes"]),
    ],
)
def test_each_block_that_fails_is_named(tmp_path, wrong, failing):
    """The last block names no file, so that it fails always."""
    text = PAGE.format(**(RIGHT | wrong))
    walk = walked(text, tmp_path)
    starts = [*failing, "```toml\n[grid]\n```"]
    lines = [text[: text.index(start)].count("\n") + 1 for start in starts]
    found = [*walk.faults, *walk.differences]
    assert sorted(fault.partition(": ")[0] for fault in found) == [str(line) for line in lines]


def test_a_number_of_a_sentence_that_differs_is_named(tmp_path):
    (difference,) = walked(PAGE.format(**(RIGHT | {"film": 1.26})), tmp_path).differences
    assert "+ A film of <!--solve: film-->1.25 um<!--/-->." in difference


def walked(text, folder):
    """Walk through a page whose command checks that files are as the page wrote them."""

    def command(words):
        assert Path(words[1]).read_text("utf-8") in ("[grid]\nnodes = 801\n", '[grid]\nerror = "1 %"\n')
        return CompletedProcess(words, 0, "   film   1.25 um\n", "")

    (folder / "page.md").write_text(text, "utf-8")
    walk = Walk(folder / "page.md", command)
    walk.walk(folder / "folder")
    return walk
