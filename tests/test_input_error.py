"""Errors of a wrong input: their line, and what they know of the key, the value and what is allowed."""

import copy
import pickle
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.ring_contacts import error_of_contact
from ehlectric.cases import library
from ehlectric.cases.case import Case
from ehlectric.errors import InputError, MemoryLimitError, WriteError
from ehlectric.surfaces.surface_files import read_surface
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

CASE = {
    "contact": {
        "reduced_radius": "10 mm",
        "reduced_modulus": "220 GPa",
        "load_per_length": "100 kN/m",
        "entrainment_speed": "1 m/s",
    },
    "lubricant": {"base": "paper"},
}
# A contact of the inner ring, as an error names it.
INNER = SimpleNamespace(ring=SimpleNamespace(name="inner"), load=800.0)
# Any text, and what a line or a key may not hold.
TEXTS = st.text(max_size=20) | st.sampled_from(["a\nb", "x;", "got", "takes", "a: b", "\x85", "\r\n"])


@each(
    "error, line, known",
    [
        (
            InputError("contact.radius_x", got="-1 m", takes="above 0 m"),
            "contact.radius_x: got -1 m; expected above 0 m",
            ("contact.radius_x", "-1 m", "above 0 m"),
        ),
        (
            InputError("motion", got="it where a film is at rest;", takes="a case without it"),
            "motion: got it where a film is at rest; expected a case without it",
            ("motion", "it where a film is at rest", "a case without it"),
        ),
        (
            InputError(Path("rough.csv"), "has 3 points", takes="at least 16"),
            "rough.csv: has 3 points; expected at least 16",
            ("rough.csv", "has 3 points", "at least 16"),
        ),
        (
            InputError("line", got=0, takes="a row from 1"),
            "line: got 0; expected a row from 1",
            ("line", 0, "a row from 1"),
        ),
        (
            InputError("bearing.temperature", got="9 K, at which the oil is solid"),
            "bearing.temperature: got 9 K, at which the oil is solid",
            ("bearing.temperature", "9 K, at which the oil is solid", None),
        ),
        (
            InputError.missing("contact.load", "a value"),
            "contact.load: missing; expected a value",
            ("contact.load", None, "a value"),
        ),
        (
            InputError.unknown("contact.lod", "contact.load"),
            "contact.lod: unknown key; the nearest known one is contact.load",
            ("contact.lod", None, "contact.load"),
        ),
        (
            InputError.worded("grid.nodes", "got 8, the solver takes odd ones", got=8, takes="odd ones"),
            "grid.nodes: got 8, the solver takes odd ones",
            ("grid.nodes", 8, "odd ones"),
        ),
        (InputError(got="2 kg", takes="a length"), "got 2 kg; expected a length", (None, "2 kg", "a length")),
        (InputError("no point is solved"), "no point is solved", (None, None, None)),
        (InputError(), "", (None, None, None)),
    ],
)
def test_line_is_made_of_key_value_and_what_is_allowed(
    error: InputError, line: str, known: tuple[object, ...]
) -> None:
    assert str(error) == line
    assert (error.key, error.got, error.takes) == known


@each("kind", [InputError, MemoryLimitError, WriteError])
def test_error_of_a_worker_arrives_whole(kind: type[InputError]) -> None:
    error = kind("grid.nodes", got=10**6, takes="a grid that fits").under("case")
    for arrived in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert type(arrived) is kind
        assert str(arrived) == str(error) == "case.grid.nodes: got 1000000; expected a grid that fits"
        assert vars(arrived) == vars(error)


@each(
    "error, table, key, line",
    [
        (InputError("width", got=2, takes="less"), "roughness", "roughness.width", "got 2; expected less"),
        (InputError(got=2, takes="less"), "contact.load", "contact.load", "got 2; expected less"),
        (InputError("width", got=2, takes="less"), "", "width", "got 2; expected less"),
    ],
)
def test_key_is_put_under_a_table(error: InputError, table: str, key: str, line: str) -> None:
    under = error.under(table)
    assert str(under) == f"{key}: {line}"
    assert (under.key, under.got, under.takes) == (key, 2, "less")
    assert error.key in (None, "width")
    assert str(InputError(got=2).under("")) == "got 2"


@given(key=TEXTS, says=TEXTS | st.none(), got=TEXTS | st.none(), takes=TEXTS, table=TEXTS)
def test_every_error_is_one_line_that_starts_with_its_key(
    key: str, says: str | None, got: str | None, takes: str, table: str
) -> None:
    error = InputError(key, says, got=got, takes=takes)
    for one in (
        error,
        error.under(table),
        error.with_text(key, str(error)),
        InputError.worded(key, takes, got=got),
        pickle.loads(pickle.dumps(error)),
    ):
        assert len(str(one).splitlines()) <= 1
        assert one.key is None or str(one) == f"{one.key}: {one.text}"


@each(
    "table, value, known",
    [
        ("title", 3, ("title", "3", ["string"])),
        ("solver", 3, ("solver", "3", ["table"])),
        ("contact", {"geometry": "ring"}, ("contact.geometry", "'ring'", ["'line'", "'point'"])),
        ("potential_2", 4, ("potential_2", None, ["electric.potential_2"])),
        (
            "grid",
            {"wedge": "third"},
            ("grid.wedge", "'third'", ["third-order", "second-order", "first-order"]),
        ),
        ("grid", {"node": 4}, ("grid.node", None, ["grid.nodes"])),
        ("lubricant", {}, ("lubricant.viscosity_law", None, ["roelands", "barus"])),
        (
            "lubricant",
            {"base": "tar"},
            ("lubricant.base", "'tar'", library.lubricant_names()),
        ),
        (
            "motion",
            {"passes": 1, "duration": 1},
            ("motion.passes", "passes and duration together", ["passes", "duration"]),
        ),
        ("motion", {}, ("motion.passes", None, ["passes", "duration"])),
        (
            "roughness",
            [{"surface": 1, "file": "a.txt", "generator": "pit"}],
            ("roughness.file", "file and generator together", ["file", "generator"]),
        ),
    ],
)
def test_refused_case_knows_key_value_and_what_is_allowed(
    table: str, value: object, known: tuple[str, str | None, Sequence[str]]
) -> None:
    with pytest.raises(InputError) as refused:
        Case.from_dict(CASE | {table: value})
    error = refused.value
    key, got, named = known
    assert (error.key, error.got) == (key, got)
    assert [name for name in named if name not in str(error.takes)] == []
    assert str(error).startswith(f"{error.key}: ")


def test_refused_key_of_a_case_is_known_within_a_sweep(tmp_path: Path) -> None:
    wrong = CASE | {"grid": {"nodes": 4}}
    with pytest.raises(InputError, match=r"^case\.grid\.nodes: got 4; expected") as refused:
        Sweep.from_dict({"case": wrong, "design": "grid", "vary": {}})
    assert (refused.value.key, refused.value.got) == ("case.grid.nodes", "4")
    file = tmp_path / "case.toml"
    with pytest.raises(InputError, match=r"case\.toml: cannot be read, no such file") as refused:
        Sweep.from_dict({"case": file, "design": "grid", "vary": {}})
    assert refused.value.key == str(file)
    with pytest.raises(InputError) as refused:
        Sweep.from_dict({"case": CASE, "design": "grid", "vary": {"contact.entrainment_speed": [1, -1]}})
    assert (refused.value.key, refused.value.got) == ("vary.contact.entrainment_speed", "-1")


def test_refused_file_is_the_key(tmp_path: Path) -> None:
    short = tmp_path / "short.csv"
    short.write_text("x [um];z [um]\n0;1\n1;2\n2;1\n")
    with pytest.raises(InputError) as refused:
        read_surface(short)
    assert (refused.value.key, refused.value.got, refused.value.takes) == (
        str(short),
        "has 3 points",
        "at least 16",
    )


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (InputError("contact", "too wide;", takes="less load"), "too wide; expected less load"),
        (MemoryLimitError("grid.nodes", got=8, takes="4"), "grid.nodes: got 8; expected 4"),
    ],
)
def test_contact_of_a_bearing_is_to_blame_by_key(error: InputError, line: str) -> None:
    refused = error_of_contact(INNER, error)
    assert type(refused) is type(error)
    assert str(refused) == f"bearing: inner contact at 800 N: {line}"
    assert (refused.key, refused.takes) == ("bearing", error.takes)


@each(
    "error",
    [InputError("contacts.width", got=1), InputError("contact a file"), InputError("lubricant", got=1)],
)
def test_others_than_the_contact_are_not_rewritten(error: InputError) -> None:
    assert error_of_contact(INNER, error) is error
