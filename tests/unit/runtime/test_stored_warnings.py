"""Warnings in files: what is written comes back, and files of versions without codes keep their meaning."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import load, read_sweep
from ehlectric.errors import CODES, ResultWarning
from ehlectric.runtime.stored_warnings import (
    as_attributes,
    code_of_text,
    of_attributes,
    texts_and_codes,
    warnings_of,
)
from ehlectric.sweep.results import Point
from tests.helpers.each import each

EARLIER = Path(__file__).parents[2] / "data" / "earlier"
words = st.one_of(st.text(), st.sampled_from(["do not use this film", "the film may be 32 % off"]))
lists = st.lists(st.builds(ResultWarning, st.sampled_from(list(CODES)), words))

# Warnings as versions without codes wrote them, by the code that each has.
TEXTS = json.loads((EARLIER / "warnings.json").read_text(encoding="utf-8"))


@pytest.mark.slow
@given(lists)
def test_what_is_stored_comes_back(warnings):
    table = json.loads(json.dumps(texts_and_codes(warnings)))
    assert table == {"warnings": [w.text for w in warnings], "warning_codes": [w.code for w in warnings]}
    assert warnings_of(table) == of_attributes(as_attributes(warnings)) == tuple(warnings)


@given(lists)
def test_doubtful_points_are_those_with_a_severe_warning(warnings):
    """Whatever the texts say."""
    point = Point(0, {}, "solved", summary=texts_and_codes(warnings))
    assert point.warnings == tuple(warnings)
    assert point.doubtful == any(CODES[warning.code].severity == "severe" for warning in warnings)


@each(
    "code, text, doubtful",
    [
        ("grid-far-too-coarse", "the film may be 32 % off", True),
        ("grid-too-coarse", "do not use it", False),
        ("tunnelling", "do not use this film, it is no solution: stalled", False),
    ],
)
def test_prose_decides_nothing(code, text, doubtful):
    summary = {"warnings": [text], "warning_codes": [code]}
    assert Point(0, {}, "solved", summary=summary).doubtful == doubtful
    assert not Point(0, {}, "not converged", summary=summary).doubtful


@each("code, text", TEXTS.items())
def test_codes_of_texts_without_one(code, text):
    assert code_of_text(text) == code
    assert warnings_of({"warnings": [text]}) == (ResultWarning(code, text),)


def test_codes_of_later_versions_are_read_by_their_text():
    known, unknown = warnings_of({"warnings": ["do not use it", "warm"], "warning_codes": ["cold", "heat"]})
    assert (known.code, unknown.code) == ("not-usable", "unclassified")


def test_a_summary_without_warnings_has_none():
    assert warnings_of({}) == warnings_of({"warnings": []}) == ()


def test_codes_that_are_not_one_a_text_are_damage():
    with pytest.raises(ValueError, match="shorter"):
        warnings_of({"warnings": ["a", "b"], "warning_codes": ["regime"]})


def test_a_sweep_of_an_earlier_version_knows_its_doubtful_points(tmp_path):
    (tmp_path / "sweep.sqlite").write_bytes((EARLIER / "sweep.sqlite").read_bytes())
    results = read_sweep(tmp_path)
    assert all("warning_codes" not in point.summary for point in results.points)
    assert [point.status for point in results.points] == ["not converged", *["solved"] * 4]
    assert results.doubtful.tolist() == [False, True, True, False, False]
    assert [[warning.code for warning in point.warnings] for point in results.points] == [
        ["not-converged"],
        ["coarser-grid-unsolved"],
        ["grid-far-too-coarse"],
        ["grid-too-coarse"],
        [],
    ]


def test_a_result_of_an_earlier_version_is_read():
    result = load(EARLIER / "result.nc")
    (warning,) = result.warnings
    assert (warning.code, warning.severity) == ("coarser-grid-unsolved", "severe")
    assert warning.text == TEXTS["coarser-grid-unsolved"]
    assert result.summary()["warning_codes"] == ["coarser-grid-unsolved"]
