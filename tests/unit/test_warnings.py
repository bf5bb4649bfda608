"""Codes of warnings: each known, each used, each with a sentence."""

import ast
from pathlib import Path

import pytest

import ehlectric
from ehlectric.quantities.result_warnings import CODES, ResultWarning
from tests.helpers.places import ROOT

SOURCE = Path(ehlectric.__file__).parent
# The codes themselves.
OF_ALL = {SOURCE / "quantities" / "result_warnings.py"}
# Codes that only files of later versions give.
FOREIGN = {"not-usable", "unclassified"}


def syntax_trees():
    for path in sorted(set(SOURCE.rglob("*.py")) - OF_ALL):
        yield ast.parse(path.read_text(encoding="utf-8"))


def literals(tree):
    return {
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }


@pytest.mark.slow
@pytest.mark.gate
def test_every_code_is_used():
    """A code that no generator gives any more is taken out of the table."""
    used = set().union(*map(literals, syntax_trees()))
    assert set(CODES) - used <= FOREIGN


def test_every_code_is_explained():
    """The page of troubleshooting says in its own words what each means and what to do."""
    page = (ROOT / "docs" / "guide" / "troubleshooting.md").read_text(encoding="utf-8")
    assert [code for code in CODES if f"`{code}`" not in page] == []


@pytest.mark.slow
@pytest.mark.gate
def test_every_generator_gives_a_known_code():
    """Branches that no other test reaches too: the code is a literal, or a name for literals."""
    calls = [
        node
        for tree in syntax_trees()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("ResultWarning", "ResultWarning.of")
    ]
    assert len(calls) > 40
    given = [call.args[0] for call in calls]
    assert {node.value for node in given if isinstance(node, ast.Constant)} <= set(CODES)
    # A warning and its severe form, and those that are handed on.
    others = {ast.unparse(node) for node in given if not isinstance(node, ast.Constant)}
    assert others <= {"code", "warning.code"}


def test_every_code_has_a_sentence():
    for code, cause in CODES.items():
        assert code == code.lower().replace("_", "-").replace(" ", "-")
        assert cause.meaning[0].isupper()
        assert cause.meaning.endswith(".")
    meanings = [cause.meaning for cause in CODES.values()]
    assert len(set(meanings)) == len(meanings)


def test_a_warning_reads_as_its_text():
    warning = ResultWarning("inlet-too-short", "lower grid.inlet")
    assert (str(warning), f"warning: {warning}") == ("lower grid.inlet", "warning: lower grid.inlet")
    for code, cause in CODES.items():
        assert ResultWarning(code, "text").severity == cause.severity


def test_unknown_codes_are_refused():
    with pytest.raises(ValueError, match=r"^'inlet' .*inlet-too-short"):
        ResultWarning("inlet", "lower grid.inlet")
