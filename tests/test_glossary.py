"""Glossary: entries of the terms of the project, and keys that exist."""

import re

import pytest

from ehlectric.cases.input_keys import input_of
from ehlectric.quantities.lubrication_states import STATES
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import BEARING_KEYS, CONTACT_KEYS, DRIVE_KEYS, GEAR_KEYS
from tests.helpers.places import ROOT

TEXT = (ROOT / "docs" / "reference" / "glossary.md").read_text("utf-8")

# Terms that pages use and that a reader cannot look up elsewhere, and terms that have a private synonym.
TERMS = (
    "asperity contact", "atlas", "boundary film", "breakdown safety factor", "contact spot", "discharge",
    "electrical behaviour", "EHL regime", "film content", "film factor", "film-thickness formula", "filling",
    "first breakdown", "Hertzian contact", "inlet oil layer", "lambda ratio", "lubrication state", "meter",
    "mitigation measure", "numerical solution", "operating clearance", "operating point", "replenishment",
    "ring-to-ring breakdown", "starvation reduction factor", "summit height", "tabulated film",
    "thermal film", "thermal reduction factor", "tribofilm", "upper bound", "verdict", "wedge",
)  # fmt: skip


def entries():
    """Texts of the entries by term."""
    block = TEXT.split("```{glossary}", 1)[1].split("\n```", 1)[0]
    parts = re.split(r"\n(?=\S)", block)
    return {part.split("\n", 1)[0]: part.split("\n", 1)[1] for part in parts if "\n  " in part}


@pytest.mark.parametrize("term", [*TERMS, *(state.name for state in STATES)])
def test_a_term_has_an_entry_of_one_to_four_sentences(term):
    text = " ".join(entries()[term].split())
    assert 1 <= len(re.findall(r"[.:](?= [A-Z*(`]|$)", text)) <= 6
    assert len(text.split()) <= 80


def test_terms_that_entries_name_have_entries():
    known = {term.lower() for term in entries()}
    names = re.findall(r"\{term\}`(?:[^`<]*<)?([^`<>]+)>?`", TEXT)
    assert names
    assert {name.lower() for name in names} <= known


def test_keys_that_entries_name_exist():
    """Dotted keys are inputs or results; a list has brackets."""
    named = {key.replace("[]", "") for key in re.findall(r"`([a-z_]+(?:\[\])?\.[a-z_.]+)`", TEXT)}
    assert len(named) > 40
    books = (BEARING_KEYS, DRIVE_KEYS, GEAR_KEYS, *CONTACT_KEYS.values())
    unknown = {key for key in named if input_of(key) is None and not any(key_of(book, key) for book in books)}
    assert not unknown - {"summary.json"}
