"""Pages that list parts of the program: each list is complete."""

import inspect
import re
import tomllib
from pathlib import Path

import pytest

import ehlectric
from ehlectric.app.pages import PAGES
from ehlectric.figures.figure_names import BEARING_FIGURE_FILES, SPEED_FIGURE_FILES
from tests.helpers.places import ROOT

PACKAGE = ROOT / "src" / "ehlectric"
PACKAGES = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
EXTRAS = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["optional-dependencies"]
WORDS = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"]


def page(name):
    return (ROOT / name).read_text("utf-8")


def quoted(text):
    """Words in code of a text."""
    return set(re.findall(r"`([\w./]+)`", text))


def test_the_table_of_extras_is_that_of_the_package():
    rows = re.findall(r"^\| `(\w+)` \|", page("docs/howto/install.md"), re.MULTILINE)
    assert sorted(rows) == sorted(set(EXTRAS) - {"test", "docs", "dev"})


@pytest.mark.parametrize("name", ["SECURITY.md", "docs/project/support.md"])
def test_extras_of_the_hashed_packages_are_named(name):
    (line,) = (line for line in page("Makefile").splitlines() if "--output-file requirements.hashes" in line)
    locked = set(re.findall(r"--extra (\w+)", line))
    (stated,) = re.findall(r"\(with the extras ([^)]*)\)", page(name))
    assert set(re.findall(r"\w+", stated)) - {"and"} == locked


def test_the_number_of_pages_is_stated():
    assert f"The {WORDS[len(PAGES)]} pages of the app" in page("docs/project/app_parts.md")


def test_the_table_of_packages_has_each_package():
    """Each package has one row, as in the contract of imports."""
    table = page("CONTRIBUTING.md").partition("| package | what it holds |")[2].partition("\n\n")[0]
    rows = [line.split("|")[1] for line in table.splitlines()[2:]]
    assert {name for row in rows for name in quoted(row)} == PACKAGES


def test_packages_with_listed_names_and_with_runs_are_named():
    text = page("docs/project/architecture.md")
    (sentence,) = re.findall(r"^(.*) list in their `__init__.pyi`", text, re.MULTILINE)
    assert quoted(sentence) == {path.parent.name for path in PACKAGE.glob("*/__init__.pyi")}
    runs = {f"{path.parent.name}/run.py" for path in PACKAGE.glob("*/run.py")}
    assert runs <= quoted(text)


def test_figures_of_a_bearing_are_named():
    text = "".join(file.read_text("utf-8") for file in (ROOT / "docs").glob("*/*.md"))
    stems = [Path(name).stem for name in (*BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES)]
    assert [stem for stem in stems if stem not in text] == []


@pytest.mark.parametrize("name", [name for name in ehlectric.__all__ if callable(getattr(ehlectric, name))])
def test_a_public_name_has_an_example_that_the_tests_run(name):
    assert "\n>>> " in inspect.getdoc(getattr(ehlectric, name))


def test_former_names_work_with_a_warning():
    """Public names are kept for one minor version."""
    with pytest.deprecated_call(match="use with_text"):
        error = ehlectric.InputError("a", got=1, takes="2").retold("b", "wrong")
    assert (str(error), error.takes) == ("b: wrong", "2")
    with pytest.deprecated_call(match="is deprecated; use"):
        verdict = ehlectric.Verdict("green", "No breakdown expected: 5 V.")
    assert verdict.text == "No breakdown expected: 5 V."
    assert [*verdict.lines()] == [("", "No breakdown expected: 5 V")]
