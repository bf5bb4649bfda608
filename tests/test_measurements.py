"""Every data file says where its values come from, under which licence, and how certain they are."""

import numpy as np
import pytest

from tests.helpers.each import each
from tests.helpers.measurements import NEEDED, exponent, film_log, load, zero_checks
from tests.helpers.places import MEASURED

pytestmark = pytest.mark.measured

FILES = sorted(path.stem for path in MEASURED.glob("*.csv"))


def test_there_are_data_files():
    assert len(FILES) == 6


@each("name", FILES)
def test_header_and_values(name):
    reference = load(name)
    assert [line for line in NEEDED if not reference.header.get(line)] == []
    numbers = reference.table.select_dtypes("number")
    assert len(reference.table) >= 4
    assert np.all(np.isfinite(numbers))
    assert np.all(numbers.drop(columns="position", errors="ignore") > 0.0)


def test_log_of_the_rig():
    """32 speeds from 1 m/s down to 9.9 mm/s, and the rig's own zero at rest, as the log prints them."""
    speed, film = film_log("40C")
    assert (speed.size, speed[0], film[0], speed[-1], film[-1]) == (32, 1.0, 46.0, 0.0099, 1.3)
    assert zero_checks("40C") == [-1.8, -2.0]
    assert (MEASURED / "ploss_LICENSE.txt").read_text("utf-8").startswith("Copyright (c) 2017 Moritz Ploss")


def test_exponent():
    speed = np.array([0.1, 0.4, 2.0])
    assert exponent(speed, 7.0 * speed**0.67) == pytest.approx(0.67)
