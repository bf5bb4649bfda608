"""Renew the output blocks and the numbers of pages from the runs of their commands: python -m docs.renew

A page marks what it takes from a run. The line ``<!--RUN-->`` is above a block of the output of a run. In a
sentence, ``<!--RUN: LABEL-->7430 rpm<!--/-->`` is what the run prints after LABEL, with as many words as
before.
"""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
import textwrap
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from docs.pages import block_with, blocks, page, pages

ROOT = Path(__file__).parents[1]
_BLOCK = re.compile(r"(<!--(\w+)-->\n+```text\n)(.*?)(```)", re.DOTALL)
_NUMBER = re.compile(r"(<!--(\w+): ([^>]+)-->)(.*?)(<!--/-->)")
_ROW = re.compile(r"(\s*)(\S.*?\S)(\s{2,})\S.*")

# Runs a command, given by its words without "ehlectric", in a folder, and returns its output.
Run = Callable[[list[str], Path], str]


def by_command(words: list[str], folder: Path) -> str:
    """Output of the command in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "ehlectric", *words], cwd=folder, capture_output=True, check=True
    )
    return done.stdout.decode("utf-8")


def _tutorial(command: str, run: Run, folder: Path, *, grade: int = 46) -> str:
    """Output of a command for the file of the tutorial, with an ISO viscosity grade."""
    (file,) = (block for block in blocks(page("first_bearing.md"), "toml") if "[bearing]" in block)
    (folder / "bearing.toml").write_text(file.replace("iso_vg = 46", f"iso_vg = {grade}"), "utf-8")
    return run(shlex.split(command), folder)


def _speeds(run: Run, folder: Path) -> str:
    """Output of the sweep of the tutorial."""
    (sweep,) = (block for block in blocks(page("first_bearing.md"), "toml") if "[vary]" in block)
    (folder / "speeds.toml").write_text(sweep, "utf-8")
    return _tutorial("sweep speeds.toml -o out", run, folder)


def _contact(command: str, run: Run, folder: Path) -> str:
    """Output of a command for the contact of its tutorial."""
    case = block_with('title = "Ball on disc, 20 N, 60 °C"', "toml")
    (folder / "contact.toml").write_text(case, "utf-8")
    return run(shlex.split(command), folder)


def _fits(command: str, run: Run, folder: Path, *, inner: int = 85) -> str:
    """Output of a command for the bearing with fits, at a temperature of its inner ring [degC]."""
    example = (ROOT / "examples" / "bearing_6208.toml").read_text("utf-8")
    file = block_with("[bearing.fits]", "toml").replace('"85 degC"', f'"{inner} degC"')
    (folder / "bearing.toml").write_text(f"{file}\n{example[example.index('[lubricant]') :]}", "utf-8")
    return run(shlex.split(command), folder)


def _coated(command: str, run: Run, folder: Path) -> str:
    """Output of a command for the example with the coating of the page."""
    example = (ROOT / "examples" / "bearing_6208.toml").read_text("utf-8")
    coating = block_with('base = "schaeffler-j20aa"', "toml")
    (folder / "bearing.toml").write_text(f"{example}\n{coating}", "utf-8")
    return run(shlex.split(command), folder)


def _example(command: str, run: Run, folder: Path) -> str:
    """Output of a command whose file is an example."""
    words = [str(ROOT / word) if word.startswith("examples/") else word for word in shlex.split(command)]
    return run(words, folder)


_SOLVED = "--no-plots -o out"
RUNS: Mapping[str, Callable[[Run, Path], str]] = {
    "check": partial(_tutorial, "check bearing.toml"),
    "solved": partial(_tutorial, f"bearing bearing.toml {_SOLVED}"),
    "thicker": partial(_tutorial, "check bearing.toml", grade=68),
    "speeds": _speeds,
    "readme": partial(_example, f"bearing examples/bearing_6208.toml --contacts atlas {_SOLVED}"),
    "fits": partial(_fits, f"bearing bearing.toml --contacts formula {_SOLVED}"),
    "even": partial(_fits, f"bearing bearing.toml --contacts formula {_SOLVED}", inner=70),
    "coated": partial(_coated, f"bearing bearing.toml --contacts atlas {_SOLVED}"),
    "contact_check": partial(_contact, "check contact.toml"),
    "contact": partial(_contact, "run contact.toml --no-plots -o out"),
    "drive": partial(_example, "drive examples/drive.toml --no-plots -o out"),
    "gear": partial(_example, "gear examples/gear_pair.toml --no-plots -o out"),
    "axle": partial(_example, "check examples/e_axle.toml"),
    "index": partial(_example, f"bearing examples/bearing_6208.toml {_SOLVED}"),
}


def outputs(names: set[str], run: Run = by_command) -> dict[str, str]:
    """Outputs of runs by their names."""
    found = {}
    for name in sorted(names):
        with TemporaryDirectory() as folder:
            found[name] = RUNS[name](run, Path(folder)).replace("\xa0", " ")
    return found


def runs_of(page: str) -> set[str]:
    """Names of the runs that a page names."""
    return {found[2] for pattern in (_BLOCK, _NUMBER) for found in pattern.finditer(page)}


def renewed(page: str, printed: Mapping[str, str]) -> str:
    """Page with the blocks and the numbers of the outputs that are given, by the names of their runs.

    Raises LookupError if an output lacks a label of the page.
    """

    def block(found: re.Match[str]) -> str:
        run = found[2]
        return found[1] + _block(found[3], printed[run]) + found[4] if run in printed else found[0]

    def number(found: re.Match[str]) -> str:
        run = found[2]
        return found[1] + _after(found[3], found[4], printed[run]) + found[5] if run in printed else found[0]

    return _NUMBER.sub(number, _BLOCK.sub(block, page))


def _block(block: str, printed: str) -> str:
    """Block with the rows that it has, and its verdict, as the output has them."""
    lines, known, at = block.splitlines(), _rows(printed), 0
    rows, verdict = _split(lines)
    made = []
    for line in rows:
        row = _ROW.fullmatch(line)
        label = row[2] if row else line.strip()
        # A label that stands in several tables is that of the table whose heading came last.
        place = next((k for k, (name, _) in enumerate(known[at:], at) if name == label), None)
        if place is None:
            raise LookupError(label)
        if row is None:
            at = place
        made.append(line[: row.end(3)] + known[place][1] if row else line)
    if verdict:
        _, new = _split(printed.rstrip().splitlines())
        width = max(_WIDTH, *map(len, rows), 0)
        made += [part for line in new for part in textwrap.wrap(line, width, subsequent_indent=_INDENT)]
    return "".join(f"{line}\n" for line in made)


# Width of the lines of a verdict, and the indent of what follows their first lines, below the texts.
_WIDTH, _INDENT = 100, " " * 15


def _split(lines: list[str]) -> tuple[list[str], list[str]]:
    """Lines of a table, and of the verdict at its end: a heading, and labels with two spaces before them."""
    for place in reversed(range(len(lines) - 1)):
        if lines[place][:1].strip() and re.match(r"  \w", lines[place + 1]):
            return lines[:place], lines[place:]
    return lines, []


def _rows(printed: str) -> list[tuple[str, str]]:
    """Labels and texts of the rows of an output, with texts that are broken into lines as one; headings
    without a text.
    """
    rows: list[tuple[str, str]] = []
    column = 0
    for line in printed.splitlines():
        found = _ROW.fullmatch(line.rstrip())
        if found:
            column = found.end(3)
            rows.append((found[2], line[column:].rstrip()))
        elif rows and column and not line[:column].strip() and line.strip():
            rows[-1] = rows[-1][0], f"{rows[-1][1]} {line.strip()}"
        elif line.strip():
            rows.append((line.strip(), ""))
    return rows


def _after(label: str, shown: str, printed: str) -> str:
    """Words of an output after a label, as many as are shown, without punctuation at their end."""
    words = " ".join(printed.split())
    found = re.search(re.escape(label) + " " + " ".join([r"(\S+)"] * len(shown.split())), words)
    if found is None:
        raise LookupError(label)
    return " ".join(found.groups()).rstrip(".,;:)")


def main() -> None:
    """Renew all pages."""
    texts = {path: path.read_text("utf-8") for path in pages()}
    printed = outputs(set().union(*map(runs_of, texts.values())))
    for path, text in texts.items():
        if runs_of(text):
            path.write_text(renewed(text, printed), "utf-8")


if __name__ == "__main__":
    main()
