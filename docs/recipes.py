"""Run the blocks of a page from its top to its end in one folder, as a reader does.

Commands and Python run as they are. A block of text is compared with the output above it. Comments directly
above a block state what the block itself does not:

- ``<!-- file: NAME -->``: the block is this file.
- ``<!-- in: NAME -->``: the keys of the block are added to this file, or replace those of the file; lists
  are replaced as a whole. With ``NAME, from OTHER`` the file is a copy of another, such as
  ``examples/drive.toml``. With ``NAME, without KEY`` a key or a table is removed before. If no later command
  of the page reads the file, ``check`` does.
- ``<!-- part of: NAME -->``: the file contains the tables or the lines of the block.
- ``<!--COMMAND-->``: the text is from the last run of this command of ehlectric, such as ``check``.
- ``<!-- quick: NAME: KEY = VALUE -->``: while the block runs, the file computes less, due to these changes.
  ``NAME, without KEY`` removes a key, and ``NAME: first 99 lines`` shortens a table of measurements.
- ``<!-- not run: REASON -->``: nothing runs.

In a sentence, ``<!--COMMAND: LABEL-->7430 rpm<!--/-->`` is what a run of the command prints after LABEL: the
last run above it that prints LABEL, or the first run below it.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, chdir, closing, contextmanager, redirect_stdout
from dataclasses import dataclass, field
from difflib import ndiff
from functools import reduce
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

from docs.printed import renewed_block, renewed_numbers

ROOT = Path(__file__).parents[1]
_MARK = re.compile(r"<!-- ?(.*?) ?-->")
_FENCE = re.compile(r" *(`{3,}|~{3,})(.*)")
SHELLS = ("sh", "bash")
KEYWORDS = ("file", "in", "part of", "quick", "not run")

# Runs ehlectric with arguments in the current folder.
Command = Callable[[list[str]], "subprocess.CompletedProcess[str]"]


class RecipeError(Exception):
    """A block that does not do what the page shows."""


class Block(NamedTuple):
    """A block of code or output of a page: line of its fence, language, text, and marks by their keywords."""

    line: int
    language: str
    text: str
    marks: Mapping[str, list[str]]

    def mark(self, keyword: str) -> str:
        """Return the text of a mark, empty if the block lacks the mark."""
        return next(iter(self.marks.get(keyword, ())), "")


class Printed(NamedTuple):
    """Output of a command of ehlectric by its name, of another program, or of Python; line of its block."""

    line: int
    name: str
    text: str


def recipes(text: str) -> list[Block]:
    """Return the blocks of a page, without directives such as figures."""
    blocks, fence, start, language = [], "", 0, ""
    marks: dict[str, list[str]] = {}
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        mark, opened = _MARK.fullmatch(line), _FENCE.match(line)
        if fence:
            if line.strip() == fence:
                body = "".join(f"{each}\n" for each in lines[start : number - 1])
                if not language.startswith("{"):
                    blocks.append(Block(start, language, body, marks))
                fence, marks = "", {}
        elif opened:
            fence, start, language = opened[1], number, opened[2].strip()
        elif mark:
            keyword, colon, value = mark[1].partition(": ")
            marks.setdefault(keyword if colon else "from", []).append(value or keyword)
        elif line.strip():
            marks = {}
    return blocks


def _difference(page: str, run: str) -> str:
    """Lines of a page that differ from a run."""
    lines = [line for line in ndiff(page.splitlines(), run.splitlines()) if line[0] in "-+"]
    return "\n".join(["the run differs; take its output by: python -m docs.renew", *lines])


def _merged(table: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Table with changes; tables within it are merged, and everything else is replaced."""
    for key, value in changes.items():
        deep = isinstance(value, dict) and isinstance(table.get(key), dict)
        table[key] = _merged(table[key], value) if deep else value
    return table


def _is_part(block: Block, text: str) -> bool:
    """Whether a text contains the tables of a block, or its lines in their order."""
    if block.language == "toml":
        table = tomllib.loads(text)
        return _merged(tomllib.loads(text), tomllib.loads(block.text)) == table
    lines = iter(text.splitlines())
    return all(line in lines for line in block.text.splitlines())


def _changed(mark: str, changes: str) -> str:
    """Merge tables into a TOML file. Return its name."""
    import tomli_w

    name, *options = mark.split(", ")
    source = next((option.removeprefix("from ") for option in options if option.startswith("from ")), name)
    table = tomllib.loads(Path(source).read_text("utf-8"))
    for option in options:
        if option.startswith("without "):
            *outer, last = option.removeprefix("without ").split(".")
            reduce(lambda within, key: within[key], outer, table).pop(last)
    Path(name).write_text(tomli_w.dumps(_merged(table, tomllib.loads(changes))), "utf-8")
    return name


class Quick:
    """A file that computes less while a block runs, as a mark states."""

    def __init__(self, mark: str) -> None:
        self.mark, _, self.changes = mark.partition(": ")
        self.file = Path(self.mark.split(", ")[0])
        self.before: str | None = None

    def begin(self) -> None:
        """Change the file, once it exists."""
        if self.before is None and self.mark and self.file.exists():
            self.before = self.file.read_text("utf-8")
            if rows := re.fullmatch(r"first (\d+) lines", self.changes):
                lines = self.before.splitlines(keepends=True)
                self.file.write_text("".join(lines[: int(rows[1])]), "utf-8")
            else:
                _changed(self.mark, self.changes.replace("; ", "\n"))

    def close(self) -> None:
        """Write the file as it was."""
        if self.before is not None:
            self.file.write_text(self.before, "utf-8")


@contextmanager
def _environment(values: Mapping[str, str]) -> Iterator[None]:
    before = dict(os.environ)
    os.environ.update(values)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def _commands(text: str) -> Iterator[tuple[dict[str, str], list[str]]]:
    """Yield environment and words of each command of a shell block."""
    for line in text.replace("\\\n", " ").splitlines():
        words: list[str] = []
        for word in [*shlex.split(line, comments=True), "&&"]:
            if word != "&&":
                words.append(word)
            elif words:
                count = next(k for k, each in enumerate(words) if not re.match(r"[A-Z_]+=", each))
                yield dict(each.split("=", 1) for each in words[:count]), words[count:]
                words = []


@dataclass
class Walk:
    """A walk through a page.

    ``faults`` names the lines of the blocks that fail, and ``differences`` the outputs that are not those of
    the page.

    Parameters
    ----------
    file : Path
        File of the page.
    command : Command
        Runs ehlectric.
    """

    file: Path
    command: Command
    faults: list[str] = field(default_factory=list)
    differences: list[str] = field(default_factory=list)
    printed: list[Printed] = field(default_factory=list)
    missing: set[str] = field(default_factory=set)
    names: dict[str, Any] = field(default_factory=lambda: {"__name__": "__main__"})
    line: int = 0

    def walk(self, folder: Path) -> str:
        """Run all blocks in a folder, and return the page with the outputs of the runs."""
        shutil.copytree(ROOT / "examples", folder / "examples", dirs_exist_ok=True)
        text = self.file.read_text("utf-8")
        lines, blocks = text.splitlines(keepends=True), recipes(text)
        with chdir(folder):
            for number, block in enumerate(blocks):
                later = " ".join(
                    each.text for each in blocks[number + 1 :] if each.language in (*SHELLS, "text")
                )
                try:
                    new = self._block(block, later)
                except Exception as error:
                    self.faults.append(f"{block.line}: {type(error).__name__}: {error}")
                    continue
                if new != block.text:
                    self.differences.append(f"{block.line}: {_difference(block.text, new)}")
                end = block.line + block.text.count("\n")
                lines[block.line : end] = [new, *[""] * (end - block.line - 1)]
        return self._numbers("".join(lines))

    def _numbers(self, text: str) -> str:
        """Page with the numbers of its sentences."""

        def printed(name: str, line: int) -> list[str]:
            runs = [each for each in self.printed if each.name == name]
            above = [each.text for each in reversed(runs) if each.line < line]
            return [*above, *(each.text for each in runs if each.line >= line)]

        try:
            new = renewed_numbers(text, printed)
        except LookupError as error:
            self.faults.append(f"no output contains {error}")
            return text
        if new != text:
            self.differences.append(_difference(text, new))
        return new

    def _block(self, block: Block, later: str) -> str:
        """Text of a block after its run."""
        if {*block.marks} - {*KEYWORDS, "from"}:
            raise RecipeError(f"unknown marks {[*block.marks]}")
        if block.mark("not run"):
            return block.text
        self.line = block.line
        with ExitStack() as stack:
            quick = [stack.enter_context(closing(Quick(mark))) for mark in block.marks.get("quick", ())]
            return self._done(block, later, quick)

    def _done(self, block: Block, later: str, quick: Sequence[Quick]) -> str:
        """Text of a block after its run."""
        if name := block.mark("part of"):
            if not _is_part(block, Path(name).read_text("utf-8")):
                raise RecipeError(f"no part of {name}")
        elif name := block.mark("file"):
            Path(name).write_text(block.text, "utf-8")
            self._check(name, later)
        elif mark := block.mark("in"):
            self._check(_changed(mark, block.text), later)
        elif block.language in SHELLS:
            self._shell(block.text, quick)
        elif block.language == "python":
            self._python(block, quick)
        elif block.language == "text":
            return self._output(block.text, block.mark("from"))
        else:
            raise RecipeError(f"a block of {block.language or 'no language'} needs a mark")
        return block.text

    def _check(self, name: str, later: str) -> None:
        """Check a file that no later command reads."""
        if name.endswith(".toml") and name not in later.split():
            self._ehlectric(["check", name])

    def _ehlectric(self, words: list[str], *, fails: bool = False) -> str:
        """Output of a command."""
        done = self.command(words)
        text = f"{done.stdout}\n{done.stderr}".replace("\xa0", " ")
        self.printed.append(Printed(self.line, words[0], text))
        if bool(done.returncode) != fails:
            raise RecipeError(f"{shlex.join(words)}: exit status {done.returncode}: {done.stderr.strip()}")
        return text

    def _shell(self, text: str, quick: Sequence[Quick]) -> None:
        for values, words in _commands(text):
            if words[1] not in ("init", "examples"):
                for each in quick:
                    each.begin()
            with _environment(values):
                if words[0] == "ehlectric":
                    self._ehlectric(words[1:])
                elif words[0] == "cd":
                    os.chdir(words[1])
                else:
                    self._program(words)

    def _program(self, words: list[str], text: str | None = None) -> str:
        """Output of another program, none if this machine lacks it."""
        if words[0] not in ("ngspice", "octave-cli"):
            raise RecipeError(f"no program of this page: {words[0]}")
        if shutil.which(words[0]) is None:
            self.missing.add(words[0])
            return ""
        done = subprocess.run(words, input=text, capture_output=True, text=True, timeout=600, check=False)
        # ngspice reports some errors only in its output.
        if done.returncode or re.search(r"(?i)error|warning|singular|no such", done.stdout):
            raise RecipeError(f"{shlex.join(words)}: {done.stdout}{done.stderr}")
        self.printed.append(Printed(self.line, words[0], f"{done.stdout}\n{done.stderr}"))
        return done.stdout

    def _python(self, block: Block, quick: Sequence[Quick]) -> None:
        for each in quick:
            each.begin()
        code = "\n" * block.line + block.text
        with redirect_stdout(StringIO()) as output:
            exec(compile(code, str(self.file), "exec"), self.names)
        self.printed.append(Printed(self.line, "python", output.getvalue().replace("\xa0", " ")))

    def _output(self, text: str, name: str) -> str:
        """Block of output, from the last run that contains all of its labels."""
        first, _, rest = text.partition("\n")
        if first.startswith("$ ehlectric "):
            printed = self._ehlectric(shlex.split(first)[2:], fails="error: " in rest)
            return f"{first}\n{renewed_block(rest, printed)}"
        if text.startswith(">> "):
            return self._octave(text)
        lacking = ""
        for each in reversed(self.printed):
            if name in ("", each.name):
                try:
                    return renewed_block(text, each.text)
                except LookupError as error:
                    lacking = lacking or str(error)
        raise RecipeError(f"no output of {name or 'a run'} contains {lacking}")

    def _octave(self, text: str) -> str:
        """Session of Octave with the answers to its commands. Figures are not drawn."""
        typed = [line.removeprefix(">> ") for line in text.splitlines() if line.startswith(">> ")]
        silent = Path("silent")
        silent.mkdir()
        for name in ("plot", "xlabel", "ylabel"):
            (silent / f"{name}.m").write_text(f"function {name}(varargin)\nend\n", "utf-8")
        script = "".join(f"{command}\ndisp('>>')\n" for command in typed)
        answers = self._program(["octave-cli", "--norc", "--quiet", "--path", "silent"], script).split(">>\n")
        if answers == [""]:
            return text
        return "".join(f">> {command}\n{answer}" for command, answer in zip(typed, answers, strict=False))
