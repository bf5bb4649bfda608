"""tools/lint_prose.py counts constructions that make texts hard to read, and rejects a count that rises."""

import re
import subprocess

import pytest

from tools import lint_prose


def texts(root, files):
    """Write files by their names, and return the texts of the repository."""
    for name, text in files.items():
        file = root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    return lint_prose.Texts(root)


def lines(places):
    return [place.line for place in places]


@pytest.mark.parametrize(
    ("rule", "wrong", "right"),
    [
        ("C1", "That of the bearing is lower.", "The voltage of the bearing is lower."),
        ("C2", "It exceeds that at 3000 rpm.", "The speed rises, so that at 3000 rpm it whirls."),
        ("C3", "The factor is used in place of the table.", "The factor is used instead of the table."),
        ("C4", "A value beside the film.", "A value next to the film."),
        ("C5", "A warning tells of it.", "The program prints a warning."),
        ("C6", "The shoulders are left out.", "Turn left, then walk out."),
        ("C7", "The film over the flooded film.", "The film divided by the flooded film."),
        ("C8", "The film is thin. Where it ends, air enters.", "The region where the film ends."),
        ("C9", "It takes some 10 minutes.", "It takes about 10 minutes; some films take more."),
        ("C10", "The film hardly changes.", "The film changes by less than 1 %."),
        ("C11", "It needs the speed alone.", "The program can stand alone."),
        ("C12", "All but one film converge.", "All films converge, but slowly."),
        ("C13", "null as either is", "Null if no strength is given."),
        ("C14", "The oil leads heat to the ring.", "The oil conducts heat to the ring."),
        ("C15", "Neglected are the shoulders.", "The shoulders are neglected."),
        ("C16", "The ring is heated, too.", "The ring is also heated. It is too hot to touch."),
        ("C17", "The film is the same.", "Both cases use the same film."),
        (
            "C18",
            "The table has a row for each speed.",
            "The table contains a row. The file has not been read.",
        ),
        ("C19", "Films by formula are isothermal.", "The film-thickness formula is isothermal."),
    ],
)
def test_a_pattern_counts_its_construction_and_no_correct_sentence(tmp_path, rule, wrong, right):
    pages = texts(tmp_path, {"README.md": f"{right}\n\n{wrong}\n", "docs/a.md": f"{right}\n"})
    (place,) = lint_prose.RULES[rule].places(pages)
    assert place[:3] == ("README", "README.md", 3)
    assert place.words in wrong


def test_every_pattern_has_an_example():
    marks = test_a_pattern_counts_its_construction_and_no_correct_sentence.pytestmark
    examples = [case[0] for mark in marks for case in mark.args[1]]
    assert examples == [name for name in lint_prose.RULES if name.startswith("C")]


def test_code_formulas_and_outputs_are_no_prose(tmp_path):
    page = """\
`that of` $that of$
```text
that of
```
```{note}
that of
```
$$
that of
$$
::::{grid}
that of
"""
    assert lines(lint_prose.RULES["C1"].places(texts(tmp_path, {"docs/a.md": page}))) == [6, 12]


def test_docstrings_comments_and_data_are_groups_of_their_own(tmp_path):
    module = '''\
def film():
    """Return the film.

    >>> "that of"
    The film is that of the ring.
    """
    if True:
        class Inner:
            "A film: that of ``that of``."
    return "that of"  # that of the ring
'''
    data = 'meaning = "the film is that of the ring"\n'
    pages = texts(tmp_path, {"src/a.py": module, "src/quantities/inputs.toml": data, "src/other.toml": data})
    places = [place[:3] for place in lint_prose.RULES["C1"].places(pages)]
    assert places == [
        ("docstrings", "src/a.py", 5),
        ("docstrings", "src/a.py", 9),
        ("comments", "src/a.py", 10),
        ("data", "src/quantities/inputs.toml", 1),
    ]


@pytest.mark.parametrize(
    ("text", "without_action"),
    [
        ("the film is thin; use more grid.nodes", False),
        ("The film is thin. If it matters, check the load.", False),
        ("The oil is assumed to be new. No action is needed.", False),
        ("the film did not converge; {advice}", False),
        ("the film is thin, which may be used to find errors", True),
    ],
)
def test_a_warning_contains_an_action(tmp_path, text, without_action):
    file = tmp_path / lint_prose.QUANTITIES / "warning_texts.toml"
    file.parent.mkdir(parents=True)
    file.write_text(f'\n[thin]\nexplanation = ""\nfirst = "{text}"\n', encoding="utf-8")
    places = lint_prose.warnings_without_an_action(lint_prose.Texts(tmp_path))
    assert lines(places) == [2] * without_action


def test_lengths_and_first_words_of_texts_of_data(tmp_path):
    folder = tmp_path / lint_prose.QUANTITIES
    folder.mkdir(parents=True)
    (folder / "warning_texts.toml").write_text(
        f'short.text = "{"word " * 40}"\nlong.first = "{"word " * 41}"\n', encoding="utf-8"
    )
    (folder / "inputs.toml").write_text(
        '[a.speed]\nmeaning = "of the shaft"\n[a.load]\nmeaning = "load of the shaft"\n', encoding="utf-8"
    )
    (folder / "bearing_results.toml").write_text(
        f'[film]\nshort = {{ meaning = "{"a " * 30}" }}\nlong = {{ meaning = "{"b " * 31}" }}\n', "utf-8"
    )
    pages = lint_prose.Texts(tmp_path)
    assert [place.words for place in lint_prose.long_warnings(pages)] == ["long: 41 words"]
    assert [place.words for place in lint_prose.meanings_without_the_quantity(pages)] == [
        "a.speed: of the shaft"
    ]
    assert [place.words for place in lint_prose.long_meanings(pages)] == ["film.long: 31 words"]


def test_sentences_end_with_items_cells_and_paragraphs(tmp_path):
    words = "word " * 20
    page = f"{words}\n\n{words}\n- {words}\n- {words}\n| {words}| {words}|\n\n{words}\n{words}\n"
    assert lines(lint_prose.long_sentences(texts(tmp_path, {"docs/a.md": page}))) == [8]


def test_a_sentence_contains_the_word_of_three_times_at_most(tmp_path):
    row = "The error of the film of the ring of the"
    module = f'"""{row} bearing.\n\n{row} bearing of the drive."""\n'
    pages = texts(
        tmp_path, {"docs/a.md": f"{row} bearing.\n{row} bearing of the drive.\n", "src/a.py": module}
    )
    assert lines(lint_prose.rows_of_of(pages)) == [2]


def test_the_parts_of_a_long_page_count_no_more_than_the_page(tmp_path):
    pages = texts(
        tmp_path,
        {"docs/a.md": "word " * 6000, "docs/b.md": "word " * 2500, "docs/_build/c.md": "word " * 9000},
    )
    places = [*lint_prose.long_pages(pages)]
    assert [place.file for place in places] == ["docs/a.md", "docs/a.md"]
    parts = texts(tmp_path, {"docs/a.md": "word " * 3000, "docs/d.md": "word " * 3000})
    assert len([*lint_prose.long_pages(parts)]) == 2


def test_rows_of_pages_that_describe_a_warning(tmp_path):
    folder = tmp_path / lint_prose.QUANTITIES
    folder.mkdir(parents=True)
    (folder / "warning_codes.toml").write_text(
        '[codes.Film]\nfilm-thin = { meaning = "x" }\n', encoding="utf-8"
    )
    page = "| thin (`film-thin`) | x |\n| x | `film-thin` |\n| `other` | x |\nSee `film-thin`.\n"
    assert lines(lint_prose.warnings_described_by_hand(texts(tmp_path, {"docs/a.md": page}))) == [1]


def test_numbers_of_a_tutorial_are_in_its_outputs(tmp_path):
    page = "Below 3130 rpm, 4.04 V and 53 %.\n```text\n3130 rpm, 53 %\n```\n"
    pages = texts(tmp_path, {"docs/tutorials/a.md": page, "docs/howto/a.md": page})
    assert [place.words for place in lint_prose.numbers_without_an_output(pages)] == ["4.04 V"]


GLOSSARY = """```{glossary}
margin
breakdown safety factor
  Voltage divided by voltage ([page](../theory/margin.md)).

breakdown
  Loss of insulation.

breakdown voltage
  Voltage of a {term}`breakdown`.
```
"""


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("The margin is low. The margin is high.", ["margin"]),
        ("Two\nmargins after a breakdown\nvoltage.", ["margins", "breakdown voltage"]),
        ("The margin is a {term}`breakdown safety factor`. A breakdown.", ["breakdown"]),
        ("The margin ([margin of a bearing](a.md)).\n\nThe margin.", []),
        ('# Margin\n\n`margin`, **margin**, "margin", $margin$, <!--a: margin-->1<!--/-->', []),
        ("```text\nmargin\n```\n\n$$\nmargin\n$$ (margin)\n\n- a margin", ["margin"]),
        ("| margin | margin |\n| --- | --- |\n| margin | a |\n", []),
        ("| a | b |\n| --- | --- |\n| margin | breakdown |\n", ["breakdown"]),
        (":::{note}\nThe margin-like breakdowns.\n:::\n", ["breakdowns"]),
        ("```{figure} a.png\n:alt: margin\n\nThe margin.\n```\n", []),
    ],
)
def test_the_first_use_of_a_term_is_linked(tmp_path, page, words):
    files = {"docs/howto/a.md": page, "docs/howto/index.md": page, "docs/validation/a.md": page}
    pages = texts(tmp_path, files | {"docs/reference/glossary.md": GLOSSARY})
    assert [place.words for place in lint_prose.terms_without_a_link(pages)] == words


def test_a_page_that_a_term_names_needs_no_link_to_it(tmp_path):
    files = {"docs/theory/margin.md": "\nA margin and a breakdown.", "docs/reference/glossary.md": GLOSSARY}
    (place,) = lint_prose.terms_without_a_link(texts(tmp_path, files))
    assert place == ("docs", "docs/theory/margin.md", 2, "breakdown")


def test_a_count_falls_and_does_not_rise(tmp_path):
    def git(*arguments):
        command = ["git", "-C", tmp_path, "-c", "user.name=a", "-c", "user.email=a", *arguments]
        subprocess.run(command, check=True, capture_output=True)

    (tmp_path / "tools").mkdir()
    pages = texts(tmp_path, {"README.md": "that of the ring\nthat of the ring\n", "docs/a.md": "beside\n"})
    lint_prose.renew(tmp_path, lint_prose.places_by_rule(pages))
    git("init", "--quiet", "--initial-branch=main")
    git("add", ".")
    git("commit", "--quiet", "--message=a")
    git("checkout", "--quiet", "-b", "change")

    (tmp_path / "docs/b.md").write_bytes((tmp_path / "docs/a.md").read_bytes())
    (tmp_path / "docs/a.md").unlink()
    pages = texts(tmp_path, {"README.md": "that of the ring\nthat of the oil\nthat of the ring\n"})
    (message,) = lint_prose.faults(tmp_path, lint_prose.places_by_rule(pages))
    assert re.match(r"C1 in README: 3 places, and at most 2 .* Write instead: repeat the noun", message)
    assert message.splitlines()[1:] == ["  README.md:2: that of the oil"]
    before = (tmp_path / lint_prose.COUNTS).read_text(encoding="utf-8")
    lint_prose.renew(tmp_path, lint_prose.places_by_rule(pages))
    assert (tmp_path / lint_prose.COUNTS).read_text(encoding="utf-8") == before

    pages = texts(tmp_path, {"README.md": "the oil of the ring\nthat of the ring\n"})
    places = lint_prose.places_by_rule(pages)
    assert lint_prose.faults(tmp_path, places) == []
    lint_prose.renew(tmp_path, places)
    assert lint_prose.allowed(tmp_path)["C1"] == {"README": 1}
    assert lint_prose.allowed(tmp_path)["C4"] == {"docs": 1}


def test_texts_in_the_code_and_texts_outside_of_the_pages_are_read(tmp_path):
    code = '"""Module."""\n\nTEXT = "the voltage, that of the ring"\n'
    code += "CLASS = '<div class=\"that of x\">'\nKEY = 'that of'\n"
    pages = texts(
        tmp_path, {"src/a.py": code, "changes/+a.fixed.md": "that of x\n", "SECURITY.md": "that of x\n"}
    )
    found = {(place.texts, place.line) for place in lint_prose.RULES["C1"].places(pages)}
    assert found == {("strings", 3), ("changes", 1), ("SECURITY", 1)}
