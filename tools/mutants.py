"""Change one operator or number of the source at a time, and run the tests that should notice.

``python -m tools.mutants --number 300`` draws mutants from the rooms of physics and of studies. Each one is
written into a copy of the source, never into the working tree. Tests that import the module and tests of the
room run until one fails, first the short ones. ``build/mutants.jsonl`` gets a line for each mutant, and a run
that was stopped continues after these lines. ``--again`` repeats the mutants that no test noticed.
"""

import argparse
import ast
import importlib
import json
import multiprocessing
import os
import random
import re
import shutil
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[1]
SOURCE, TABLE = ROOT / "src/ehlectric", ROOT / "build/mutants.jsonl"
ROOMS = ["film", "field", "lubricant", "formulas", "discharge", "surfaces", "contact", "motion", "bearing"]
ROOMS += ["gear", "drive", "axle", "calibration", "sweep"]
SIGNS = {"Add": "+", "Sub": "-", "Mult": "*", "Div": "/", "Lt": "<", "LtE": "<=", "Gt": ">", "GtE": ">="}
EXCHANGED = {"+": "-", "-": "+", "*": "/", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">"}
# Nodes that only form texts, fields that contain types, and operands whose sums are no arithmetic.
TEXTS, TYPES = (ast.JoinedStr, ast.Raise, ast.Assert), {"annotation", "returns", "decorator_list"}
SEQUENCES = (ast.List, ast.Tuple, ast.ListComp, ast.JoinedStr)
# Libraries that are imported once; the processes of the tests are forks.
LIBRARIES = ["scipy.optimize", "scipy.sparse.linalg", "scipy.stats", "pandas", "xarray", "pydantic", "numba"]
OPTIONS = ["-xq", "-n0", "-pno:cacheprovider", f"--rootdir={ROOT}", f"-c{ROOT / 'pyproject.toml'}"]
FAILED = re.compile(r"^(?:SUBFAILED\S*|FAILED|ERROR) (?:.*\] )?(\S*::\S+|\S+\.py)", re.MULTILINE)
NAME = re.compile(r"^(?:def |class )?([A-Za-z]\w+)(?=[(:]| =)", re.MULTILINE)


class Mutant(NamedTuple):
    """Change of a piece of a line, whose column counts bytes; ``text`` is the line before the change."""

    path: str
    line: int
    column: int
    old: str
    new: str
    text: str

    def applied(self, source: bytes) -> bytes:
        """Return the source with the change."""
        lines = source.splitlines(keepends=True)
        before, after = lines[self.line - 1][: self.column], lines[self.line - 1][self.column :]
        lines[self.line - 1] = before + after.replace(self.old.encode(), self.new.encode(), 1)
        return b"".join(lines)


def mutants_of(path: str, source: bytes) -> Iterator[Mutant]:
    """Return all mutants of a module."""
    lines = source.splitlines(keepends=True)
    for node in _nodes(ast.parse(source)):
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            new = node.value + 1 if isinstance(node.value, int) else 2.0 * node.value or 1.0
            line, text = node.lineno, lines[node.lineno - 1]
            old = text[node.col_offset : node.end_col_offset].decode()
            yield Mutant(path, line, node.col_offset, old, repr(new), text.decode().strip())
        for left, operator in _operators(node):
            if sign := SIGNS.get(type(operator).__name__):
                line, column = left.end_lineno, left.end_col_offset
                while (place := lines[line - 1].split(b"#")[0].find(sign.encode(), column)) < 0:
                    line, column = line + 1, 0
                yield Mutant(path, line, place, sign, EXCHANGED[sign], lines[line - 1].decode().strip())


def _nodes(node: ast.AST) -> Iterator[ast.AST]:
    yield node
    for name, value in ast.iter_fields(node):
        for one in value if isinstance(value, list) else [value]:
            if isinstance(one, ast.AST) and not isinstance(one, TEXTS) and name not in TYPES:
                yield from _nodes(one)


def _operators(node: ast.AST) -> list[tuple[ast.expr, ast.AST]]:
    """Operators of a node, each with its left side."""
    if isinstance(node, ast.Compare):
        return list(zip([node.left, *node.comparators], node.ops, strict=False))
    if isinstance(node, ast.AugAssign):
        return [(node.target, node.op)]
    sides = [node.left, node.right] if isinstance(node, ast.BinOp) else []
    texts = [isinstance(one, SEQUENCES) or isinstance(getattr(one, "value", 0), str) for one in sides]
    return [(node.left, node.op)] if sides and not any(texts) else []


def tests_of(path: str) -> tuple[list[Path], list[Path]]:
    """Return test files that import a module, and others of its room; first those with most of its names."""
    module, words = Path(path).with_suffix(""), set(NAME.findall((SOURCE / path).read_text("utf-8")))
    *parents, name = ["ehlectric", *module.parts]
    parent = r"\.".join(parents)
    imported = re.compile(rf"{parent}(\.| import .*){name}\b")
    texts = {file: file.read_text("utf-8") for file in sorted((ROOT / "tests").rglob("test_*.py"))}
    ranked = sorted(texts, key=lambda file: -len(words & set(re.findall(r"\w+", texts[file]))))
    near = [file for file in ranked if imported.search(texts[file])]
    room = ROOT / "tests" / module.parts[0]
    return near, [file for file in ranked if file not in near and file.is_relative_to(room)]


def noticed(mutant: Mutant, copy: Path, markers: list[str], limit: float) -> tuple[str, str]:
    """Return "caught", "survived", or "late" after the time limit [s], and the test that failed."""
    file, whole, (near, others) = copy / mutant.path, (copy / mutant.path).read_bytes(), tests_of(mutant.path)
    _write(file, mutant.applied(whole))
    try:
        for marker, files in [(marker, part) for marker in markers for part in ([file, *near], others)]:
            code, output = _run(["-m", marker, *map(str, files)], limit) if files else (0, "")
            if code not in (0, 5):
                outcome = "late" if code is None else "caught"
                return outcome, [*FAILED.findall(output), f"{code}: {output[-300:]}"][0]
    finally:
        _write(file, whole)
    return "survived", ""


def _write(file: Path, contents: bytes) -> None:
    """Write a module, without its compiled file, which an equal size and second would keep."""
    file.write_bytes(contents)
    for compiled in (file.parent / "__pycache__").glob(f"{file.stem}.*.pyc"):
        compiled.unlink()


def _run(arguments: list[str], limit: float) -> tuple[int | None, str]:
    """Exit status of tests in a process of their own, None after the time limit, and their output."""
    with tempfile.TemporaryFile("w+") as out:

        def run() -> None:
            os.setsid()
            os.dup2(out.fileno(), 1)
            os.dup2(out.fileno(), 2)
            sys.exit(int(pytest.main([*OPTIONS, *arguments])))

        process = multiprocessing.get_context("fork").Process(target=run)
        process.start()
        process.join(limit)
        if late := process.is_alive():
            os.killpg(process.pid, signal.SIGKILL)
            process.join()
        out.seek(0)
        return (None if late else process.exitcode), out.read()


def main() -> None:
    """Run the drawn mutants that the table lacks, and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--number", type=int, default=300, help="number of mutants that are drawn")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rooms", nargs="+", default=ROOMS)
    parser.add_argument("--markers", nargs="+", default=["not slow", "slow and gate"], help="tests, in turn")
    parser.add_argument("--limit", type=float, default=600.0, help="longest time of a part of the tests [s]")
    parser.add_argument("--again", action="store_true", help="repeat mutants that no test noticed")
    given = parser.parse_args()
    files = sorted(file for room in given.rooms for file in (SOURCE / room).rglob("*.py"))
    drawn = [one for file in files for one in mutants_of(str(file.relative_to(SOURCE)), file.read_bytes())]
    random.Random(given.seed).shuffle(drawn)
    drawn = drawn[: given.number]
    TABLE.parent.mkdir(exist_ok=True)
    TABLE.touch()
    known = {Mutant(*row["mutant"]): row["outcome"] for row in map(json.loads, TABLE.open(encoding="utf-8"))}
    with tempfile.TemporaryDirectory() as folder, TABLE.open("a", encoding="utf-8") as table:
        for entry in {*ROOT.iterdir()} - {ROOT / "src"}:
            Path(folder, entry.name).symlink_to(entry)
        copy = shutil.copytree(SOURCE, Path(folder, "src/ehlectric"))
        sys.path.insert(0, str(copy.parent))
        os.environ |= {"PYTHONPATH": str(copy.parent), "NUMBA_CACHE_DIR": f"{folder}/numba"}
        for library in LIBRARIES:
            importlib.import_module(library)
        for mutant in drawn:
            if mutant not in known or (given.again and known[mutant] != "caught"):
                known[mutant], test = noticed(mutant, copy, given.markers, given.limit)
                row = json.dumps({"outcome": known[mutant], "test": test, "mutant": mutant})
                print(row, file=table, flush=True)
                print(row, flush=True)
    print(Counter(known[one] for one in drawn))


if __name__ == "__main__":
    main()
