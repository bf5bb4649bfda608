"""Scripts in tools/ find what breaks a rule of the repository, with file and line."""

import pytest
from tools import check_tag, lint_house

from ehlectric.version import __version__
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


def test_an_action_is_pinned_by_the_hash_of_its_commit_and_names_its_version(tmp_path):
    (tmp_path / ".github/workflows").mkdir(parents=True)
    commit = "3d3c42e5aac5ba805825da76410c181273ba90b1"
    lines = [f"- uses: actions/checkout@{commit} # v7.0.1", f"- uses: actions/checkout@{commit}"]
    lines += ["- uses: actions/checkout@v7", "- run: make check"]
    (tmp_path / ".github/workflows/check.yml").write_text("\n".join(lines), encoding="utf-8")
    faults = [str(fault) for fault in lint_house.actions_of_the_workflows(tmp_path)]
    assert [fault.rsplit(": pin", 1)[0] for fault in faults] == [
        ".github/workflows/check.yml:2",
        ".github/workflows/check.yml:3",
    ]


def test_a_tag_is_the_version_of_package_citation_recipe_and_changelog(tmp_path):
    for name in check_tag.VERSIONS:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    (tmp_path / "changes").mkdir()
    tag = f"v{__version__}"
    assert check_tag.disagreements(tag, tmp_path) == []
    others = check_tag.disagreements("v99.0.0", tmp_path)
    assert [line.split(":")[0] for line in others] == list(check_tag.VERSIONS)
    assert all("99.0.0" in line and __version__ in line for line in others)
    (tmp_path / "changes/+a.added.md").write_text("An entry.\n", encoding="utf-8")
    assert ["1 entries" in line for line in check_tag.disagreements(tag, tmp_path)] == [True]
