"""Codes of warnings: each known, each with a text, a sentence and an explanation."""

import pytest
from docs import pages

from ehlectric.quantities.result_warnings import CODES, ResultWarning
from tests.helpers.places import ROOT
from tools.lint_house import FOREIGN_CODES, data


def test_every_code_is_explained():
    """The page of troubleshooting says in its own words what each means and what to do."""
    page = pages.page("warnings.md")
    assert [code for code in CODES if f"`{code}`" not in page] == []


def test_every_code_has_its_text():
    """All but the codes that only files of later versions give."""
    assert data(ROOT, "quantities/warning_texts.toml").keys() == set(CODES) - FOREIGN_CODES


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
