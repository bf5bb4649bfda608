"""Films outside the atlas: they continue the films at its edge, with an error that grows."""

import dataclasses

import numpy as np
import pytest

from ehlectric.film.atlas.atlas_films import MOST_HERTZ, atlas_film
from ehlectric.film.atlas.atlas_groups import SKEW, Ellipse, Groups
from ehlectric.film.atlas.atlas_table import NAMES, table
from tests.helpers.each import each

NUMBERS = ("central", "minimum", "mean", "mass", "central_pressure", "zone", "inlet", "outlet")


def groups_at(load, lubricant, ratio=None):
    """Groups at coordinates N (M for lines), Y and k of the atlas."""
    load, moes_l = np.asarray(load), lubricant / np.asarray(load) ** SKEW
    if ratio is None:
        return Groups(load, moes_l)
    ellipse = Ellipse.of(np.asarray(ratio))
    return Groups(load * ellipse.ratio**0.75 / ellipse.q**0.25, moes_l, ellipse.ratio, ellipse)


def across(place, number, step=1e-7):
    """Groups just inside, on and just outside an edge at a coordinate of this number, and beyond it."""
    columns = [np.full(4, value) for value in place]
    columns[number] = columns[number] * np.array([1.0 - step, 1.0, 1.0 + step, 1.3])
    return groups_at(*columns)


@each(
    "place, number",
    [
        ((0.2, 10.0), 0),
        ((800.0, 10.0), 0),
        ((20.0, 0.35621784), 1),
        ((20.0, 112.0), 1),
        ((3.0, 10.0, 6.0), 0),
        ((12000.0, 10.0, 6.0), 0),
        ((100.0, 0.6, 6.0), 1),
        ((10.0, 175.0, 6.0), 1),
        ((100.0, 10.0, 0.25), 2),
        ((100.0, 10.0, 20.0), 2),
        # Cells with a node that has no film.
        ((20.0, 112.0, 12.0), 1),
        ((20.0, 112.0, 3.0), 1),
        ((3.5, 23.66, 0.3), 1),
    ],
)
def test_no_number_jumps_at_an_edge(place, number):
    film = atlas_film(across(place, number), beyond=True)
    assert not np.all(film.known)
    assert np.any(film.known)
    for name in NUMBERS:
        values = getattr(film, name)
        assert np.all(np.isfinite(values)), name
        assert values[:3] == pytest.approx(values[1], rel=1e-4), name
    for name, errors in film.errors.items():
        assert errors[:3] == pytest.approx(errors[1], rel=1e-3), name


def test_no_number_jumps_at_the_largest_hertz_pressure():
    at = groups_at(np.array([500.0]), np.array([100.0]), np.array([6.0]))
    most = 100.0 * MOST_HERTZ / at.hertz_number
    film = atlas_film(across((500.0, float(most[0]), 6.0), 1), beyond=True)
    assert [bool(known) for known in film.known[[0, 2]]] == [True, False]
    for name in NUMBERS:
        assert getattr(film, name)[:3] == pytest.approx(getattr(film, name)[1], rel=1e-5), name


def test_known_contacts_have_the_same_film_next_to_others():
    """To rounding, whether or not contacts outside are continued."""
    groups = groups_at(np.array([1.0, 50.0, 900.0]), np.array([12.0, 12.0, 12.0]), np.array([30.0, 4.0, 9.0]))
    alone, together = atlas_film(groups), atlas_film(groups, beyond=True)
    np.testing.assert_array_equal(alone.known, [False, True, True])
    for name in NUMBERS:
        assert getattr(together, name)[1:] == pytest.approx(getattr(alone, name)[1:], rel=1e-12), name


CUTS = [
    (kind, axis, end, cut)
    for kind, axes in (("points", 3), ("lines", 2))
    for axis in range(axes)
    for end in ("low", "high")
    for cut in (1, 2, 3)
]


@each("kind, axis, end, cut", CUTS)
def test_films_of_nodes_that_are_taken_away_are_within_the_error(kind, axis, end, cut):
    """The table without its outer nodes: central, minimum and mean films that were solved there."""
    whole = table(kind)
    kept = slice(cut, None) if end == "low" else slice(None, -cut)
    places = (slice(None),) * axis + (kept,)
    axes = (*whole.axes[:axis], whole.axes[axis][kept], *whole.axes[axis + 1 :])
    arrays = {name: getattr(whole, name)[places] for name in ("values", "errors", "solved")}
    part = dataclasses.replace(whole, axes=axes, **arrays)
    far = (slice(None),) * axis + ([0 if end == "low" else -1],)
    at = np.meshgrid(*whole.axes[:axis], whole.axes[axis][far[-1]], *whole.axes[axis + 1 :], indexing="ij")
    numbers, errors, growth = part.continued(*at)
    solved = whole.solved[far]
    for name in ("central", "minimum", "mean"):
        number = NAMES.index(name)
        off = np.abs(numbers[number] - whole.values[far][..., number])[solved]
        assert np.mean(off < (errors[number] + growth)[solved]) > 0.9, name
