"""Databases that were damaged or edited are refused in one line, before anything is solved or drawn."""

import json
import random
import sqlite3
from contextlib import closing

import pytest

from ehlectric import InputError, read_sweep
from ehlectric.errors import DamagedError
from ehlectric.sweep.engine import Outcome, plan
from ehlectric.sweep.result import write_tables
from ehlectric.sweep.sensitivity_indices import sensitivity
from ehlectric.sweep.slices import select_slice
from ehlectric.sweep.store import NAME, Store, saved_points
from ehlectric.sweep.sweep_inputs import breakdown_of
from tests.helpers.damage import edited_json, scrambled, with_damaged_bytes
from tests.helpers.each import each
from tests.helpers.share import share
from tests.helpers.sweeps import LOAD, SPEED, sweep_over

SUMMARY = {
    "title": "",
    "warnings": ["the inlet is too short"],
    "warning_codes": ["inlet-too-short"],
    "inputs": {"contact": {"entrainment_speed": 1.0}},
    "film": {"minimum_thickness": 1e-7, "minimum_position": [1e-4, 0.0], "status": "converged"},
    "field": {"voltage": 2.0, "max_strength": 1e7},
    "discharge": {"breakdown_voltage": 3.0, "margin": 1.5},
}
GRID = sweep_over({SPEED: [1.0, 2.0, 3.0], LOAD: [1e6, 2e6]})
SOBOL = sweep_over(
    {SPEED: {"from": 1, "to": 4}, LOAD: {"from": 1e5, "to": 1e6, "spacing": "log"}},
    design="sobol",
    samples=32,
)
COLUMNS = {
    "sweep": ("value", "name"),
    "points": ("inputs", "inputs", "number", "key", "refused"),
    "results": ("summary", "summary", "summary", "status", "reason", "again", "seconds", "version", "date"),
}
BAD_VALUES = (
    None,
    "",
    "x",
    "{",
    "[]",
    "null",
    "NaN",
    "[" * 5000,
    b"\xff\x00",
    -1,
    7,
    1e300,
    "1],[2",
    "{},{}",
)


def filled(folder, sweep, count=None):
    """A folder with the database of a sweep; its points are solved, the fourth failed, all with numbers."""
    planned = list(plan(sweep))
    with Store(folder) as store:
        store.begin(sweep, planned)
        for k, point in enumerate(planned[:count]):
            numbers = {"breakdown_voltage": 3.0 + 0.1 * (k % 7), "margin": 1.5}
            outcome = Outcome("solved", summary=SUMMARY | {"discharge": numbers}, date="2026-01-01")
            store.write([(point.key, Outcome("failed", "no") if k == 3 else outcome)])
    return folder / NAME


@pytest.fixture(scope="module")
def databases(tmp_path_factory):
    made = {"grid": (GRID, 5), "sobol": (SOBOL, None)}
    return {
        kind: filled(tmp_path_factory.mktemp(kind), sweep, count).read_bytes()
        for kind, (sweep, count) in made.items()
    }


def use(folder):
    """What the commands plot, map and sensitivity do with a sweep before they draw."""
    results = read_sweep(folder)
    value = breakdown_of(results.case).value
    assert results.summary()["points"] == len(results.points)
    repr(results)
    write_tables(results, folder)
    if results.ranges:
        sensitivity(results, value)
    else:
        select_slice(results, SPEED, LOAD, value)


def changed(path, statement, *values):
    with closing(sqlite3.connect(path)) as file, file:
        file.execute("PRAGMA ignore_check_constraints = 1")
        file.execute(statement, values)


def edit(path, seed):
    """Edit one value of one row; whether the database took it."""
    draw = random.Random(seed)
    table = draw.choice(["sweep", "points", "results", "results"])
    column = draw.choice(COLUMNS[table])
    with closing(sqlite3.connect(path)) as file:
        rows = file.execute(f"SELECT rowid, {column} FROM {table}" if table != "sweep" else
                            f"SELECT name, {column} FROM sweep").fetchall()  # fmt: skip
        row, value = draw.choice(rows)
        match draw.choice(["bad", "json", "json", "letters"]):
            case "json" if isinstance(value, str) and value[:1] in ("{", "["):
                new = edited_json(value, draw)
            case "letters" if isinstance(value, str) and value:
                new = scrambled(value, draw)
            case _:
                new = draw.choice(BAD_VALUES)
        identity = "name" if table == "sweep" else "rowid"
        try:
            with file:
                file.execute(f"UPDATE {table} SET {column} = ? WHERE {identity} = ?", (new, row))
        except sqlite3.IntegrityError:
            return False
        return True


def used_or_refused(path, seeds, damage):
    """Damage a database, use it, and count the refusals; each is one line."""
    content, told = path.read_bytes(), []
    for seed in seeds:
        path.write_bytes(content)
        damage(path, seed)
        try:
            use(path.parent)
        except InputError as error:
            told.append(str(error))
    path.write_bytes(content)
    assert not [text for text in told if "\n" in text]
    return len(told)


def damage_bytes(path, seed):
    path.write_bytes(with_damaged_bytes(path.read_bytes(), seed))


@pytest.mark.slow
@pytest.mark.parametrize("damage", [edit, damage_bytes])
@pytest.mark.parametrize("kind", ["grid", "sobol"])
def test_damaged_sweeps(kind, damage, databases, tmp_path):
    path = tmp_path / NAME
    path.write_bytes(databases[kind])
    use(tmp_path)
    assert used_or_refused(path, range(20), damage) > 3
    assert used_or_refused(path, share(range(1000, 1300), 5), damage) > 12


@each(
    "statement, names",
    [
        ("UPDATE results SET summary = '[]'", ["summary", "point 0"]),
        ("UPDATE results SET summary = '{\"warnings\": 3}'", ["summary", "point 0"]),
        ("UPDATE results SET summary = '{\"film\": NaN}'", ["point 0", "JSON"]),
        ("UPDATE results SET summary = NULL", ["summary", "point 0", "missing"]),
        ("UPDATE results SET summary = x'ff'", ["point 0", "text"]),
        ("UPDATE results SET status = 'done'", ["status", "point 0"]),
        ("UPDATE results SET seconds = 'long'", ["point 0"]),
        ("UPDATE points SET inputs = '[]'", ["point 0"]),
        ("UPDATE points SET inputs = '{}'", ["points", "design"]),
        ("DELETE FROM points WHERE number = 2", ["numbers", "gaps"]),
        ("DELETE FROM points WHERE number = 5", ["points", "design"]),
        ("UPDATE sweep SET value = '[]' WHERE name = 'axes'", ["axes"]),
        ("UPDATE sweep SET value = '{}' WHERE name = 'axes'", ["axes", "ranges", "design"]),
        ("UPDATE sweep SET value = '{\"a.b\": [1]}' WHERE name = 'axes'", ["axes"]),
        ("UPDATE sweep SET value = '\"some\"' WHERE name = 'design'", ["design"]),
        ("UPDATE sweep SET value = '\"[\"' WHERE name = 'case'", ["case", "TOML"]),
        ("UPDATE sweep SET value = '\"a = 1\"' WHERE name = 'case'", ["case", "valid"]),
        ("DELETE FROM sweep WHERE name = 'seed'", ["seed", "missing"]),
        ("ALTER TABLE results RENAME COLUMN reason TO why", ["reason", "results", "missing"]),
        ("CREATE VIEW other AS SELECT 1", ["view", "trigger"]),
    ],
)
def test_what_is_wrong_is_named(statement, names, databases, tmp_path):
    path = tmp_path / NAME
    path.write_bytes(databases["grid"])
    changed(path, statement)
    before = path.read_bytes()
    with pytest.raises(DamagedError) as caught:
        read_sweep(tmp_path)
    head, _, told = str(caught.value).partition(": is damaged: ")
    assert head == str(path)
    assert [name for name in names if name not in told] == []
    assert path.read_bytes() == before


@each(
    "statement",
    [
        "UPDATE results SET summary = '[]' WHERE rowid = 2",
        "UPDATE results SET status = 'open'",
        "UPDATE results SET again = 'no'",
        "DROP TABLE points",
    ],
)
def test_a_damaged_sweep_is_not_resumed(statement, databases, tmp_path):
    """It is refused before hours are spent on its other points."""
    path = tmp_path / NAME
    path.write_bytes(databases["grid"])
    changed(path, statement)
    with pytest.raises(DamagedError):
        Store(tmp_path)
    path.write_bytes(databases["grid"])
    with Store(tmp_path) as store:  # the refusal has left no lock
        assert store.counts() == {"solved": 4, "failed": 1, "open": 1}
    assert saved_points(tmp_path) == (5, 6)


def test_a_plausible_number_in_an_outcome_is_noticed(databases, tmp_path):
    """The checksum of the row tells it, when it is drawn and when the sweep goes on."""
    path = tmp_path / NAME
    path.write_bytes(databases["grid"])
    with closing(sqlite3.connect(path)) as file:
        key, summary = file.execute("SELECT key, summary FROM results WHERE summary IS NOT NULL").fetchone()
    table = json.loads(summary)
    table["film"]["minimum_thickness"] *= 1.1
    changed(path, "UPDATE results SET summary = ? WHERE key = ?", json.dumps(table), key)
    for use_it in (read_sweep, Store):
        with pytest.raises(DamagedError, match=rf"the outcome {key[:12]} is not as it was written"):
            use_it(path.parent)


def test_errors_of_sqlite_that_are_no_text(databases, tmp_path):
    """SQLite quotes damaged bytes of the statement that made a table."""
    path = tmp_path / NAME
    content = databases["grid"].replace(b"tablepointspoints", b"table\xac\xe6\xffntspoints")
    path.write_bytes(content.replace(b"CREATE TABLE points", b"CREATE TABLX points"))
    with pytest.raises(InputError, match=r"is damaged: SQLite cannot read its tables; compute it again$"):
        read_sweep(tmp_path)


def test_a_locked_database_is_said(databases, tmp_path, monkeypatch):
    monkeypatch.setattr("ehlectric.runtime.journal._PATIENCE", 0.0)
    path = tmp_path / NAME
    path.write_bytes(databases["grid"])
    with closing(sqlite3.connect(path, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(InputError, match=r"sweep\.sqlite: cannot be used, database is locked$"):
            read_sweep(tmp_path)
    assert len(read_sweep(tmp_path).points) == 6


def test_summaries_whose_warnings_have_no_codes_are_refused(databases, tmp_path):
    path = tmp_path / NAME
    path.write_bytes(databases["grid"])
    edited = {name: value for name, value in SUMMARY.items() if name != "warning_codes"}
    changed(path, "DROP TABLE seals")
    changed(path, "UPDATE results SET summary = ? WHERE summary IS NOT NULL", json.dumps(edited))
    with pytest.raises(DamagedError):
        read_sweep(tmp_path)
