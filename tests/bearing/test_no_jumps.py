"""Numbers of every kind of bearing at 400 points along each of its numeric inputs: none jumps."""

from collections import defaultdict
from functools import cache

import numpy as np
import pytest

from tests.helpers.jumps import _suspects, jumps_along, search
from tests.helpers.kinds_of_bearings import KINDS, bearing_of, numbers_of
from tests.helpers.share import THOROUGH


@cache
def keys_by_kind():
    """Inputs to search along by kind of bearing; each input with some kind."""
    kinds_with = defaultdict(list)
    for kind in KINDS:
        for key in numbers_of(bearing_of(kind)):
            kinds_with[key].append(kind)
    chosen = defaultdict(list)
    for number, (key, kinds) in enumerate(kinds_with.items()):
        # Keys that follow each other take other kinds.
        for kind in kinds if THOROUGH else kinds[number % min(3, len(kinds)) :: 3]:
            chosen[kind].append(key)
    return chosen


def test_a_step_is_suspicious_and_a_slope_is_not():
    changes = np.diff(np.linspace(0.0, 1.0, 50))
    assert _suspects(changes, 1e-3) == []
    changes[20] += 1e-3
    assert _suspects(changes, 1e-3) == [20]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("kind", "key", "points"),
    [
        ("pair with play", "bearing.radial_load", 100),
        ("pair with play", "bearing.pair.axial_clearance", 100),
        ("four-point contact", "bearing.radial_load", 400),
    ],
)
def test_no_number_of_rows_and_tracks_jumps(kind, key, points):
    """Rows of a pair with play, and the other diagonal of balls, lift off element by element."""
    case = bearing_of(kind)
    assert search(case, key, numbers_of(case)[key], points) == (1.0, [])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_no_number_jumps_along_any_input(kind):
    """Along each input of every third kind that has it; a thorough run takes all kinds."""
    case = bearing_of(kind)
    found = {key: search(case, key, numbers_of(case)[key]) for key in keys_by_kind()[kind]}
    assert {key: jumps for key, (_, jumps) in found.items() if jumps} == {}
    assert [key for key, (width, _) in found.items() if width == 0.0] == []


def test_a_jump_is_found(monkeypatch):
    """A made-up step of 0.3 % in a capacitance."""
    case = bearing_of("thrust needle", contacts="formula")

    def stepped(_case, _key, values):
        return {"bearing.capacitance": np.where(np.asarray(values) < 4321.0, 1.0, 1.003) * values**0.1}

    monkeypatch.setattr("tests.helpers.jumps.numbers_at", stepped)
    (jump,) = jumps_along(case, "bearing.axial_load", np.linspace(4000.0, 5000.0, 40))
    assert jump.number == "bearing.capacitance"
    assert jump.place == pytest.approx(4321.0, rel=1e-6)
    assert jump.change == pytest.approx(np.log(1.003), rel=1e-3)
