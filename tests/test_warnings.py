"""Codes of warnings: each known, each with a text and a sentence."""

import pytest

from ehlectric.quantities.result_warnings import CODES, ResultWarning
from tests.helpers.places import ROOT
from tools.lint_house import FOREIGN_CODES, data


def test_severe_warnings_begin_with_do_not_use():
    """Programs that do not know the code of a later version find it by these words."""
    texts = data(ROOT, "quantities/warning_texts.toml")
    for code in (code for code in texts if CODES[code].severity == "severe"):
        assert {text[:10] for name, text in texts[code].items() if name != "explanation"} == {"do not use"}


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
