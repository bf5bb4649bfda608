"""Limits of the layout that keep it readable, and the table of docs/architecture.md."""

import ast
import re
import sys
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

import ehlectric
from ehlectric import Case, solve
from ehlectric.contact.solver import OWN
from ehlectric.film.line import solve_film
from tests.helpers.places import EXAMPLES, ROOT

PACKAGE = Path(ehlectric.__file__).parent
FOLDERS = sorted({path.parent for path in PACKAGE.rglob("*.py")})


def name(path):
    return str(path.relative_to(PACKAGE))


def bodies(path):
    """Lines of every function of a module, without signature and docstring."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body[1:] if ast.get_docstring(node) else node.body
            yield node.name, body[-1].end_lineno - body[0].lineno + 1 if body else 0


def test_packages_and_files_at_the_top():
    entries = [path for path in PACKAGE.iterdir() if path.name != "__pycache__"]
    assert sum(path.is_dir() for path in entries) <= 20
    assert sum(path.is_file() for path in entries) <= 6


def test_layers_of_the_import_contract():
    contract = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"][0]
    assert contract["exhaustive"]
    assert len(contract["layers"]) <= 16


@pytest.mark.slow
@pytest.mark.parametrize("folder", FOLDERS, ids=name)
def test_modules_of_a_package(folder):
    modules = [path for path in folder.glob("*.py") if path.name != "__init__.py"]
    assert len(modules) <= 20
    doc = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8")))
    assert doc is not None, "a package says in a sentence what is in it"
    for path in modules:
        # A module does not repeat the name of its package.
        assert not path.stem.startswith(f"{folder.name}_"), path
        assert path.read_text(encoding="utf-8").count("\n") <= 400, path
        for function, lines in bodies(path):
            assert lines <= 60, f"{path}: {function}"


def test_packages_a_case_passes_from_file_to_film():
    """Packages whose functions are called between the file of a line contact and its film."""
    passed = set()

    def profile(frame, event, _argument):
        path = Path(frame.f_code.co_filename)
        if event == "call" and path.is_relative_to(PACKAGE):
            passed.add(path.relative_to(PACKAGE).parts[0])

    def film_alone(*arguments, **keywords):
        film = solve_film(*arguments, **keywords)
        sys.setprofile(None)
        return film

    solvers = replace(OWN, film=dict(OWN.film) | {"line": film_alone})
    sys.setprofile(profile)
    try:
        solve(Case.from_toml(EXAMPLES / "line_contact.toml"), solvers=solvers)
    finally:
        sys.setprofile(None)
    assert {"cases", "contact", "film"} <= passed
    assert len(passed) <= 10


def rows():
    """Rows of the table of what to touch: what is added, files, tests."""
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    table = page.partition("## I want to add")[2]
    for text in table.splitlines():
        cells = [cell.strip() for cell in text.strip().strip("|").split("|")]
        if text.startswith("|") and len(cells) == 3 and "`" in cells[1]:
            yield pytest.param(cells[1], cells[2], id=cells[0])


@pytest.mark.parametrize(("files", "tests"), list(rows()))
def test_files_and_tests_of_the_table_are_there(files, tests):
    for path in re.findall(r"`([\w/.]+\.(?:py|toml))`", files):
        assert (PACKAGE / path).is_file(), path
    sources = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("test_*.py"))
    named = re.findall(r"`(test_\w+)`", tests)
    assert named, "a test shows that these files are enough"
    for test in named:
        assert f"def {test}(" in sources, test
