"""Scripts in tools/ find what breaks a rule of the repository, with file and line."""

import json

import pytest

from ehlectric.version import __version__
from tests.helpers.places import ROOT
from tools import check_tag, frozen, lint_house, mutants


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


def package(root, name, line):
    """Make a package of one module with data files of ours; its second line is the given one."""
    for file in ("warning_codes", "warning_texts", "verdict_texts"):
        data = root / lint_house.PACKAGE / f"quantities/{file}.toml"
        data.parent.mkdir(parents=True, exist_ok=True)
        data.write_bytes((ROOT / lint_house.PACKAGE / f"quantities/{file}.toml").read_bytes())
    (root / lint_house.PACKAGE / name).parent.mkdir(parents=True, exist_ok=True)
    (root / lint_house.PACKAGE / name).write_text(f"\n{line}\n", encoding="utf-8")


@pytest.mark.parametrize(
    ("rule", "name", "line", "message"),
    [
        ("codes_of_warnings", "a.py", 'ResultWarning.of("no-such-code")', "no-such-code"),
        ("codes_of_warnings", "a.py", "ResultWarning.of(name)", "literal"),
        ("codes_of_warnings", "a.py", 'ResultWarning.of("not-converged")', None),
        ("texts_of_warnings", "a.py", 'ResultWarning.of("regime", "line")', "no text"),
        ("texts_of_warnings", "a.py", 'ResultWarning.of("regime", "line", regime=1, h=2)', "values h"),
        ("texts_of_warnings", "a.py", 'ResultWarning.of("regime", "line", **values)', "name the values"),
        ("texts_of_warnings", "a.py", 'WarningCondition.of(low, "regime", "line", regime=1)', None),
        ("warnings_with_written_texts", "a.py", 'ResultWarning("regime", "a text")', "warning_texts.toml"),
        ("warnings_with_written_texts", "a.py", 'ResultWarning(warning.code, "a text")', None),
        ("keys_in_texts_of_errors", "a.py", 'raise InputError(f"{key}: got {x}")', "give the key"),
        ("keys_in_texts_of_errors", "a.py", 'raise InputError(key, got=x, takes="more")', None),
        ("keys_in_texts_of_errors", "a.py", 'raise InputError("no point is solved")', None),
        ("signs_of_bounds", "app/a.py", 'row(bound="≤")', "result_bounds.py"),
        ("signs_of_bounds", "tables/a.py", 'row(bound="≤")', None),
        ("properties_of_the_app", "app/pages/a.py", 'ui.label().props(f"title={title}")', "set title"),
        ("properties_of_the_app", "app/pages/a.py", "ui.label().props(title)", "set title"),
        ("properties_of_the_app", "app/pages/a.py", 'ui.label().props(f"data-testid={test_id}")', None),
        ("texts_of_verdicts", "a.py", 'Statement.of("no-such-statement")', "no-such-statement"),
        ("texts_of_verdicts", "a.py", 'Statement.of("speeds-below-1")', None),
        ("names_that_windows_lacks", "a.py", "os.fork()", "os.fork"),
        ("names_that_windows_lacks", "a.py", "from fcntl import flock", "fcntl"),
        ("names_that_windows_lacks", "a.py", 'getattr(os, "fork", None)', None),
    ],
)
def test_a_line_of_the_source_breaks_a_rule(tmp_path, rule, name, line, message):
    package(tmp_path, name, line)
    place = lint_house.PACKAGE / name
    faults = [fault for fault in getattr(lint_house, rule)(tmp_path) if fault.file == place]
    assert [fault.line for fault in faults] == ([] if message is None else [2])
    assert all(message in fault.message for fault in faults)


@pytest.mark.parametrize(
    ("rule", "name", "entry"),
    [
        ("codes_of_warnings", "warning_codes.toml", "not-converged"),
        ("texts_of_warnings", "warning_texts.toml", "regime"),
        ("texts_of_verdicts", "verdict_texts.toml", "speeds-below-1"),
    ],
)
def test_an_entry_that_no_module_uses_is_found_with_its_line(tmp_path, rule, name, entry):
    package(tmp_path, "a.py", "x = 0")
    file = lint_house.PACKAGE / "quantities" / name
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines()
    places = [fault.line for fault in getattr(lint_house, rule)(tmp_path) if fault.file == file]
    assert any(lines[place - 1].lstrip("[").startswith(entry) for place in places)


def test_a_name_of_a_face_that_no_other_package_imports_is_found(tmp_path):
    package(tmp_path, "film/__init__.py", "")
    (tmp_path / lint_house.PACKAGE / "film/__init__.pyi").write_text(
        "from .mesh import Mesh as Mesh, Width as Width\nfrom .newton import newton, step\n",
        "utf-8",
    )
    public = tmp_path / lint_house.PACKAGE / "__init__.pyi"
    public.write_text("from .film import Width as Width\n", "utf-8")
    (tmp_path / lint_house.PACKAGE / "a.py").write_text(
        "from ehlectric import film\nfrom ehlectric.film import Mesh\n\nfilm.step\n", "utf-8"
    )
    faults = [str(fault) for fault in lint_house.names_of_faces(tmp_path)]
    assert faults == ["src/ehlectric/film/__init__.pyi:2: no other package imports newton"]


def test_a_publication_without_a_docstring_is_found(tmp_path):
    package(tmp_path, "a.py", '"""Film after doi:10.1/film."""')
    texts = 'references = [{citation = "A 1", doi = "10.1/film"}, {citation = "B 2", doi = "10.1/none"}]'
    (tmp_path / lint_house.PACKAGE / "report").mkdir()
    file = tmp_path / lint_house.PACKAGE / "report/report_texts.toml"
    file.write_text(f"{texts}\ndrive_references = []\n", encoding="utf-8")
    (fault,) = lint_house.publications_of_reports(tmp_path)
    assert "10.1/none" in fault.message


def words_allowed(root, **numbers):
    """Write the file of numbers of words in names."""
    entries = [f'[{word}]\nnumber = {number}\nnouns = "row"\n' for word, number in numbers.items()]
    (root / "tools").mkdir(exist_ok=True)
    (root / lint_house.WORDS_IN_NAMES).write_text("# Words.\n\n" + "\n".join(entries), encoding="utf-8")


# Five names: of a function, an argument, a variable (twice) and an attribute, some within a formatted text.
NAMES_WITH_FOUND = (
    """def found_row(found): return f"{FOUND_AT} {x.not_found}", FOUND_AT, 'found', foundation  # found"""
)


@pytest.mark.parametrize(("allowed", "broken"), [(4, True), (5, False), (6, False)])
def test_a_word_is_in_no_more_names_than_are_allowed(tmp_path, allowed, broken):
    package(tmp_path, "a.py", NAMES_WITH_FOUND)
    words_allowed(tmp_path, own=0, found=allowed)
    faults = list(lint_house.words_in_names(tmp_path))
    assert len(faults) == broken
    for fault in faults:
        assert fault.line == 7
        assert "5 names" in fault.message
        assert "such as row" in fault.message
        places = [line.split() for line in fault.message.splitlines()[1:]]
        assert {place for place, _ in places} == {f"{lint_house.PACKAGE.as_posix()}/a.py:2"}
        assert sorted(name for _, name in places) == ["FOUND_AT"] * 2 + ["found", "found_row", "not_found"]


def test_a_word_in_names_of_modules_and_keywords_counts(tmp_path):
    package(tmp_path, "a.py", "from x.own_y import z as own; f(own=1)")
    words_allowed(tmp_path, own=2)
    (fault,) = lint_house.words_in_names(tmp_path)
    assert "3 names" in fault.message


def test_renewal_lowers_the_numbers_of_words_and_raises_none(tmp_path):
    package(tmp_path, "a.py", NAMES_WITH_FOUND)
    words_allowed(tmp_path, own=2, found=7)
    assert lint_house.renew(tmp_path) == []
    text = (tmp_path / lint_house.WORDS_IN_NAMES).read_text(encoding="utf-8")
    assert text.startswith("# Words.\n\n[own]\nnumber = 0\n")
    assert "[found]\nnumber = 5\n" in text
    words_allowed(tmp_path, own=2, found=3)
    assert len(lint_house.renew(tmp_path)) == 1
    assert "number = 2" in (tmp_path / lint_house.WORDS_IN_NAMES).read_text(encoding="utf-8")


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


def test_a_mutant_changes_one_operator_or_number_that_is_no_text():
    """By hand: all mutants of five lines, and the source of the last one, whose column counts bytes."""
    source = """
def area(side: Literal[2], µ=0.0):
    if side < 0:
        raise ValueError(f"{side + 1}")
    side *= 3  # < 4
    return "a" + name, µ - (side) / µ
""".encode()
    found = list(mutants.mutants_of("a.py", source))
    changes = sorted(f"{one.line}: {one.old} -> {one.new}" for one in found)
    first = ["2: 0.0 -> 1.0", "3: 0 -> 1", "3: < -> <="]
    assert changes == [*first, "5: * -> /", "5: 3 -> 4", "6: - -> +", "6: / -> *"]
    (last,) = (one for one in found if one.old == "/")
    assert last.applied(source).decode().splitlines()[5] == '    return "a" + name, µ - (side) * µ'


def test_frozen_numbers_find_what_changed(tmp_path, monkeypatch):
    """Equal numbers are found equal, and a changed key, text, event and number are found."""

    def status(action):
        monkeypatch.setattr("sys.argv", ["frozen", action, str(tmp_path), "release"])
        with pytest.raises(SystemExit) as ended:
            frozen.main()
        return ended.value.code

    assert status("make") == status("compare") == 0
    file = tmp_path / "release.json"
    stored = json.loads(file.read_text(encoding="utf-8"))
    stored["drive"]["summary"]["drive_end"]["peak_voltage"] *= 1.0 + 2e-10
    file.write_text(json.dumps(stored), encoding="utf-8")
    assert status("compare") == 1
    before = {"a": [1.0, "x"], "events": [[2.0]], "b": None}
    after = {"a": [1.0 + 1e-12, "y"], "events": [[2.0 + 1e-12]], "c": None}
    places = [each.partition(":")[0] for each in frozen.differences(before, after)]
    assert places == [".a[1]", ".b", ".c", ".events[0][0]"]
