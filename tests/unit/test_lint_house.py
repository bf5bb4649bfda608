"""The rules of tools/lint_house.py find what breaks them, with file and line."""

import pytest
from tools import lint_house

from tests.helpers.places import ROOT


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("+a.added.md", "An entry.\n", None),
        ("+a-2.removed.md", "word " * 29 + "last.\n", None),
        ("+a.added.md", "word " * 30 + "last.\n", "31 words"),
        ("+a.news.md", "An entry.\n", "name"),
        ("a.added.md", "An entry.\n", "name"),
        ("+a.added.md", "An entry\n", "full stop"),
        ("+a.added.md", "An entry.\nAnother.\n", "one line"),
        ("+a.added.md", "- An entry.\n", "bullet"),
    ],
)
def test_fragments_of_the_changelog_have_a_kind_and_at_most_30_words(tmp_path, name, text, message):
    (tmp_path / "pyproject.toml").write_bytes((ROOT / "pyproject.toml").read_bytes())
    (tmp_path / "changes").mkdir()
    (tmp_path / "changes" / name).write_text(text, encoding="utf-8")
    faults = [str(fault) for fault in lint_house.fragments_of_the_changelog(tmp_path)]
    assert len(faults) == (message is not None)
    for fault in faults:
        assert fault.startswith(f"changes/{name}:1: ")
        assert message in fault
