"""Journal of a run: tables and values by hand, as its description says, and films that come back exactly."""

import json
import sqlite3
import zlib
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.newton import State
from ehlectric.film.unsteady import History, Instant
from ehlectric.motion.coarse_run import CoarseRun
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.solver import TransientSolver
from ehlectric.motion.storage import MotionJournal, Record, described, time_step
from ehlectric.runtime.result_names import MOTION_JOURNAL
from ehlectric.version import __version__
from tests.helpers.moving_cases import moving

CASE = moving(motion={"passes": 0.375, "steps": 12, "record": 4})
SHAPE = (65, 1)


def instant(seed, *, touching=False):
    """An instant of random values."""
    random = np.random.default_rng(seed)
    over = random.random(SHAPE) if touching else 0.0
    state = State(random.random(SHAPE), float(random.random()), random.random(SHAPE), over)
    full = random.random(SHAPE) > 0.5
    return Instant(float(seed), state, random.random(SHAPE), random.random(SHAPE), full)


def history(frame, *, touching=False):
    """History of the recorded instant of a number; only its last film touches."""
    return History(now=instant(2 * frame + 1, touching=touching), before=instant(2 * frame))


@pytest.fixture(scope="module")
def first():
    """Contact, and the film before the motion as the first recorded instant."""
    contact = TransientContact.of(CASE)
    solver, coarse_run = TransientSolver(contact), CoarseRun(contact)
    start, coarse = solver.start(), coarse_run.start()
    row = time_step(solver, start, coarse_run.films(0, coarse))
    return contact, Record(0, [row], solver.snapshot(start.now), start, coarse, 0.25)


def attributes(contact):
    return {"case": contact.case.to_toml(), "version": __version__, "rough": described(contact)}


def kept(folder, contact, *records):
    """Films that a journal is resumed from after it was begun and records were added."""
    with MotionJournal(folder, contact) as journal:
        journal.begin(records[0], attributes(contact), None)
        for record in records[1:]:
            journal.append(record)
    with MotionJournal(folder, contact) as journal:
        return journal.resumed()


def same(one, other):
    for name in ("mass", "density", "full_film"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    for name in ("pressure", "thickness", "h00"):
        np.testing.assert_array_equal(getattr(one.state, name), getattr(other.state, name))
    touching = (np.broadcast_to(each.state.contact_pressure, SHAPE) for each in (one, other))
    np.testing.assert_array_equal(*touching)
    assert one.time == other.time
    assert one.full_film.dtype == bool


@pytest.mark.parametrize("touching", [False, True])
def test_films_come_back_to_the_last_bit(tmp_path, first, touching):
    contact, record = first
    later = [
        replace(record, step=step, history=history(step, touching=touching), coarse=history(step + 9))
        for step in (4, 8)
    ]
    done, fine, coarse = kept(tmp_path, contact, record, *later)
    assert done == 8
    for found, expected in ((fine, history(8, touching=touching)), (coarse, history(17))):
        same(found.now, expected.now)
        same(found.before, expected.before)


def test_a_coarse_run_that_did_not_converge_is_not_kept(tmp_path, first):
    contact, record = first
    assert kept(tmp_path, contact, record, replace(record, step=4, coarse=None))[2] is None


def test_the_journal_is_as_described(tmp_path, first):
    """Any program that reads SQLite reads it: numbers are JSON, and arrays are raw bytes."""
    contact, record = first
    unknown = replace(record.rows[0], coarse_lowest_thickness=float("nan"))
    kept(tmp_path, contact, record, replace(record, step=2, rows=[unknown, record.rows[0]], seconds=0.5))
    with closing(sqlite3.connect(tmp_path / MOTION_JOURNAL)) as file:
        run = {name: json.loads(text) for name, text in file.execute("SELECT name, value FROM run")}
        assert run == {**attributes(contact), "steps": 12}
        rows = file.execute("SELECT step, time, seconds, numbers FROM instants ORDER BY step").fetchall()
        assert [row[:3] for row in rows] == [(0, 0.0, 0.25), (2, 0.0, 0.5)]
        numbers = json.loads(rows[1][3])
        film, field = record.snapshot.film, record.snapshot.field
        assert numbers["minimum_thickness"] == [float(np.min(film.thickness))] * 2
        assert numbers["coarse_lowest_thickness"] == [None, record.rows[0].coarse_lowest_thickness]
        assert (numbers["max_strength"], numbers["frame_step"]) == (field.max_strength, 2)
        assert "minimum_y" not in numbers  # of a line contact
        kind, shape, content = file.execute(
            "SELECT type, shape, content FROM arrays WHERE part = 'maps' AND step = 2 AND name = 'pressure'"
        ).fetchone()
        assert (kind, shape, len(content)) == ("<f4", "[65]", 260)
        np.testing.assert_array_equal(np.frombuffer(content, "<f4"), film.pressure.astype("<f4"))
        parts = dict(file.execute("SELECT part, count(*) FROM arrays GROUP BY part"))
        assert parts == {"still": 1, "maps": 12, "films": 7, "coarse films": 7}
        # Films are those of the last instant only.
        assert file.execute("SELECT DISTINCT step FROM arrays WHERE part LIKE '%films'").fetchall() == [(2,)]
        *row, seal = file.execute("SELECT * FROM instants WHERE step = 2").fetchone()
        assert seal == zlib.crc32(json.dumps(row).encode())
        *row, content, seal = file.execute("SELECT * FROM arrays WHERE name = 'x'").fetchone()
        assert seal == zlib.crc32(content, zlib.crc32(json.dumps(row).encode()))
        np.testing.assert_array_equal(np.frombuffer(content, "<f8"), film.x)
