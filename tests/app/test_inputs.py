"""Inputs of a page: an address and a TOML text hold them exactly, and a wrong address is refused in words."""

import json
import subprocess
import sys
import tomllib
from urllib.parse import parse_qsl

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric.app.page_inputs import LONGEST_QUERY, History, Inputs
from ehlectric.errors import InputError
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES


def read_back(inputs):
    """Inputs of an address, as the server reads its query."""
    return Inputs.of_query(parse_qsl(inputs.address(), keep_blank_values=True))


def exact(inputs):
    """Text of the tables that tells 1 from 1.0 and from true."""
    return json.dumps(inputs.table, sort_keys=True)


@each("path", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_an_address_and_a_text_hold_every_example(path):
    inputs = Inputs(tomllib.loads(path.read_text(encoding="utf-8")))
    assert inputs.linkable
    assert exact(read_back(inputs)) == exact(inputs)
    assert exact(Inputs(tomllib.loads(inputs.toml()))) == exact(inputs)


# Surrogates have no place in UTF-8, and so neither in TOML nor in an address.
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=12) | st.sampled_from(
    [
        "1800 N",
        "6208",
        "true",
        "'6208'",
        '"',
        "a&b=c",
        "[1, 2]",
        "{}",
        "5 # five",
        "inf",
        "1e400",
        "\r\n",
        " x ",
    ]
)
SCALARS = st.booleans() | st.integers(-(10**20), 10**20) | st.floats(allow_nan=False) | TEXTS
KEYS = st.text(st.characters(exclude_categories=["Cs"]), max_size=6) | st.sampled_from(
    ["a.b", "base", "a b", '"']
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3),
    max_leaves=8,
)


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(st.dictionaries(KEYS.filter(lambda key: key != "token"), VALUES, max_size=4))
def test_an_address_and_a_text_hold_any_tables(table):
    inputs = Inputs(table)
    assert exact(read_back(inputs)) == exact(inputs)
    assert exact(Inputs(tomllib.loads(inputs.toml()))) == exact(inputs)


def test_short_texts_are_readable_in_an_address():
    inputs = Inputs({"bearing": {"radial_load": "1800 N", "base": "6208", "film_factor": 0.7}})
    assert inputs.address() == "bearing.radial_load=1800+N&bearing.base=%276208%27&bearing.film_factor=0.7"


@each(
    "pairs, says",
    [
        ([("a", "1"), ("a.b", "2")], "'a.b'"),
        ([("a.b", "1"), ("a", "2")], "'a'"),
        ([("a", "1"), ("a", "1")], "'a'"),
        ([("a", "[1]"), ("a.1", "2")], "'a.1'"),
        ([("a", "x" * (LONGEST_QUERY + 1))], str(LONGEST_QUERY)),
        ([("a..b", "1")], "'a..b'"),
        ([("", "1")], "''"),
        ([("a\nb", "1")], repr("a\nb")),
        ([("a=1#", "1")], "'a=1#'"),
        ([(".".join("a" * 40), "1")], "40"),
        ([("a", "[" * 30 + "]" * 30)], "16"),
    ],
)
def test_a_wrong_address_is_refused_in_words(pairs, says):
    with pytest.raises(InputError) as refused:
        Inputs.of_query(pairs)
    assert says in str(refused.value)
    inputs, error = Inputs.of_link(pairs, Inputs({"a": 1}))
    assert inputs == Inputs({"a": 1})
    assert str(error) == str(refused.value)


@each("text", ["[" * 5000, "{a=" * 3000, "1" * 5000, "a." * 5000, '"""' + "x" * 100, "\x00"])
def test_a_hostile_value_is_a_text_or_an_error(text):
    try:
        found = Inputs.of_query([("a", text)]).value("a")
    except InputError:
        return
    assert found == text


def test_the_token_of_the_server_is_no_input():
    assert Inputs.of_query([("token", "abc"), ("title", "A")]) == Inputs({"title": "A"})


def test_values_are_found_and_changed_by_dotted_key():
    inputs = Inputs(
        {"ranges": {"bearing.temperature": [1, 2]}, "roughness": [{"surface": 1, "file": "a.csv"}]}
    )
    assert inputs.value('ranges."bearing.temperature"') == [1, 2]
    assert inputs.value("roughness.1.file") == "a.csv"
    assert inputs.value("roughness.2.file") is None
    changed = inputs.changed({"roughness.1.file": "b.csv", 'ranges."bearing.temperature"': None})
    assert changed.table == {"roughness": [{"surface": 1, "file": "b.csv"}]}
    assert changed.changed({"roughness.1": None}).table == {}
    assert inputs.value("roughness.1.file") == "a.csv", "a change makes a copy"


def test_undo_and_redo_tell_of_every_change():
    told = []
    history = History(Inputs({"a": 1}))
    history.listeners.append(lambda: told.append(history.now.value("a")))
    history.push(Inputs({"a": 2}))
    history.push(Inputs({"a": 2}))
    history.push(Inputs({"a": 3}))
    history.undo()
    history.undo()
    history.undo()
    history.redo()
    assert told == [2, 3, 2, 1, 2]
    history.push(Inputs({"a": 4}))
    assert history.redo().value("a") == 4, "new inputs replace those that were undone"


def test_changes_within_a_step_are_undone_together():
    history = History(Inputs({"a": 1}))
    with history.step():
        for value in (2, 3):
            history.push(Inputs({"a": value}))
    with history.step():
        history.push(Inputs({"a": 4}))
    history.push(Inputs({"a": 5}))
    assert [history.undo().value("a") for _ in range(4)] == [4, 3, 1, 1]


def test_a_drag_is_one_step_until_it_pauses(monkeypatch):
    now = 100.0
    monkeypatch.setattr("ehlectric.app.page_inputs.time.monotonic", lambda: now)
    history = History(Inputs({"a": 0}))

    def drag(key, value):
        with history.step(key):
            history.push(history.now.changed({key: value}))

    for value in range(1, 6):
        now += 0.5
        drag("a", value)
    now += 2.0
    drag("a", 6)
    drag("b", 7)
    assert history.undo().table == {"a": 6}
    drag("b", 8)
    assert [dict(history.undo().table) for _ in range(3)] == [{"a": 6}, {"a": 5}, {"a": 0}]
    assert history.redo().table == {"a": 5}
    drag("a", 9)
    assert history.undo().table == {"a": 5}, "a drag does not go on with a step before an undo"


def test_the_process_of_the_server_loads_no_physics_for_the_inputs():
    code = "import sys; import ehlectric.app.page_inputs; assert 'numpy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
