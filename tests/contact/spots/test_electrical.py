"""Electrical answer of spots: independent sums, and limits that are known exactly."""

import dataclasses

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric import Case
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import Electric
from ehlectric.contact.touching import (
    Spots,
    behaviour_of,
    constriction,
    electrical,
    spots_of,
    strip_resistance,
    time_share,
)
from ehlectric.formulas.asperities import greenwood_cluster, spot_resistance
from tests.contact.spots.cases import POINT, solved
from tests.helpers.each import each

RHO = 2.2e-7


def of_discs(nodes, centres, radius):
    axis = np.linspace(-20e-6, 20e-6, nodes)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    mask = np.any([(x - cx) ** 2 + (y - cy) ** 2 < radius**2 for cx, cy in centres], axis=0)
    return x, y, axis, mask


def test_spots_of_any_shape_against_sources_over_all_nodes():
    """Charges on all nodes of the spots at one potential, each spread over a square."""
    x, y, axis, mask = of_discs(161, [(-6e-6, 0.0), (5e-6, 2e-6), (2e-6, -8e-6)], 3e-6)
    spots = Spots.of((axis, axis), mask, 1.0 * mask)
    assert spots.number == 3
    side = axis[1] - axis[0]
    at = np.column_stack([x[mask], y[mask]])
    distance = np.hypot(*(at[:, None] - at[None]).transpose(2, 0, 1))
    np.fill_diagonal(distance, side / (4.0 * np.log(1.0 + np.sqrt(2.0))))  # the mean of 1/r over the square
    currents = np.linalg.solve(RHO / (2.0 * np.pi) / distance, np.ones(len(at)))
    expected = 2.0 / np.sum(currents)  # both half-spaces
    found = constriction(spots, Electric(resistivity=RHO), 1.0)
    assert found == pytest.approx(expected, rel=0.03)


def test_a_long_strip_has_the_logarithm_of_its_slenderness():
    """K(1 - k^2) tends to ln(4/k) for a small ratio k of the axes."""
    assert strip_resistance(width=1e-6, length=1e-2, resistivity=RHO) == pytest.approx(
        RHO * np.log(4e4) / (np.pi * 0.5e-2), rel=1e-6
    )
    assert strip_resistance(width=1e-2, length=1e-6, resistivity=RHO) == strip_resistance(
        width=1e-6, length=1e-2, resistivity=RHO
    )


@each("path", [0.0, 20e-9, 1e-6])
def test_electrons_with_a_mean_free_path(path):
    """A strip of equal axes, and a cluster of one spot, are a circle; a slit has Sharvin's 4 rho l/(3 A)."""
    circle = pytest.approx(float(spot_resistance(0.1e-6, RHO, path)), rel=1e-12)
    assert strip_resistance(width=2e-7, length=2e-7, resistivity=RHO, mean_free_path=path) == circle
    assert greenwood_cluster([[0.0, 0.0]], [0.1e-6], RHO, path) == circle
    slit = strip_resistance(width=2e-12, length=2e-6, resistivity=RHO, mean_free_path=path)
    ballistic = 4.0 * RHO * path / (3.0 * np.pi * 1e-12 * 1e-6)
    assert slit == pytest.approx(ballistic, rel=1e-3) or path == 0.0


def test_a_line_contact_needs_a_length_for_its_resistance():
    x = np.linspace(0.0, 1e-4, 101)
    mask = (x > 2e-5) & (x < 3e-5)
    spots = Spots.of((x,), mask, 1.0 * mask)
    assert constriction(spots, Electric(resistivity=RHO), None) is None
    assert constriction(spots, Electric(), 0.01) is None
    found = constriction(spots, Electric(resistivity=RHO), 0.01)
    assert found == strip_resistance(width=float(spots.areas[0]), length=0.01, resistivity=RHO)


def test_time_share_is_that_of_sites_that_touch_at_random():
    """A row of sites of the size of a spot, each touched with the same probability, by counting."""
    sites, share = 20, 0.15
    touched = np.random.default_rng(2).random((200_000, sites)) < share
    counted = np.mean(np.any(touched, axis=1))
    assert time_share(round(sites * share), share) == pytest.approx(counted, abs=0.003)
    assert time_share(2, 1e-9) == pytest.approx(1.0 - np.exp(-2.0))


@each(
    "spots, always, ratio, error, expected",
    [
        (0, 0.0, None, None, "capacitive"),
        (9, 1.0, 0.09, 0.1, "capacitive"),
        (9, 1.0, 9.0, 0.1, "intermittent"),
        (9, 1.0, 11.0, 0.1, "resistive"),
        (9, 1.0, 11.0, 1.0, "intermittent"),
        (9, 0.94, 11.0, 0.1, "intermittent"),
        (9, 1.0, None, 0.1, "resistive"),
    ],
)
def test_one_word(spots, always, ratio, error, expected):
    assert behaviour_of(spots, always, ratio, error) == expected


def answer(case=POINT, **changes):
    result = solved()
    film = result.film
    tables = {"electric": Electric(resistivity=RHO), "discharge": None} | changes
    return electrical(film, spots_of(film), case.oil, semi_axes=result.conditions.semi_axes, **tables)


@pytest.mark.slow
def test_impedances_of_spots_and_film():
    found = answer()
    assert found.resistance is not None
    assert found.corner_frequency == pytest.approx(
        1.0 / (2.0 * np.pi * found.resistance * found.capacitance_outside)
    )
    assert found.impedance_ratio == pytest.approx(found.corner_frequency / 1e4)
    film = solved().film
    inside = ~film.contact[1:-1, 1:-1]
    cell = (film.x[1] - film.x[0]) * (film.y[1] - film.y[0])
    permittivity = POINT.oil.permittivity(film.pressure, film.density)
    plates = epsilon_0 * permittivity / film.thickness
    # All nodes but those on the edges, where the film is thick.
    assert found.capacitance_outside == pytest.approx(cell * np.sum(plates[1:-1, 1:-1][inside]), rel=0.01)


@pytest.mark.slow
def test_a_tribofilm_that_insulates_makes_the_contact_capacitive():
    bare = answer()
    covered = answer(electric=Electric(resistivity=RHO, tribofilm_resistance=1e-1))
    area = solved().asperities.spots.area
    assert covered.tribofilm_resistance == pytest.approx(0.1 / area)
    assert covered.resistance == pytest.approx(bare.constriction_resistance + 0.1 / area)
    assert covered.impedance_ratio < 0.1
    assert covered.behaviour == "capacitive"


@pytest.mark.slow
def test_breakdown_around_the_spots():
    found = answer(discharge=Discharge(dielectric_strength=15e6))
    touching = solved().asperities.touching
    for voltage, film in ((found.breakdown_1, touching.film_1), (found.breakdown_50, touching.film_50)):
        assert voltage == pytest.approx(15e6 * film)
    assert found.breakdown_1 <= found.breakdown_5 <= found.breakdown_50
    assert (found.breakdown_voltage, found.breakdown_probability) == (None, None)


@pytest.mark.slow
def test_probability_of_breakdown_is_that_of_the_area_around_the_spots():
    law = {"scale": 3e7, "shape": 2.0, "reference_area": 1e-9}
    found = answer(discharge=Discharge.from_dict({"weibull": law}))
    film = solved().film
    x, y = (np.gradient(axis) for axis in (film.x, film.y))
    x[[0, -1]] *= 0.5
    y[[0, -1]] *= 0.5
    exponent = np.sum((np.outer(x, y) * (2.0 / film.thickness / 3e7) ** 2)[~film.contact]) / 1e-9
    assert found.breakdown_probability == pytest.approx(1.0 - np.exp(-exponent))
    assert found.breakdown_voltage == pytest.approx(2.0 / np.sqrt(exponent))


@pytest.mark.slow
def test_a_film_without_spots_has_no_resistance():
    result = solved()
    film = dataclasses.replace(result.film, contact_pressure=None)
    found = electrical(
        film,
        spots_of(film),
        POINT.oil,
        electric=Electric(resistivity=RHO),
        discharge=None,
        semi_axes=result.conditions.semi_axes,
    )
    assert (found.resistance, found.time_share, found.behaviour) == (None, 0.0, "capacitive")


def test_keys_of_the_case():
    table = POINT.to_dict() | {
        "electric": {
            "resistivity": "22 uohm cm",
            "tribofilm_resistance": "1e-9 ohm m^2",
            "mean_free_path": "2 nm",
        }
    }
    electric = Case.from_dict(table).electric
    assert electric.resistivity == pytest.approx(2.2e-7)
    assert electric.tribofilm_resistance == 1e-9
    assert electric.mean_free_path == 2e-9


def test_the_edge_of_spots_is_half_the_area_of_the_cells_that_it_cuts():
    """By hand: 3 x 4 touching nodes at spacings of 2 and 5 cut 2 x 4 + 2 x 3 cells of an area of 10; in a
    line of three touching nodes two of them.
    """
    x, y = 2.0 * np.arange(9), 5.0 * np.arange(10)
    touches = np.zeros((9, 10), dtype=bool)
    touches[3:6, 2:6] = True
    assert Spots.of((x, y), touches, 1.0 * touches).edge == pytest.approx(0.5 * 14 * 10.0)
    assert Spots.of((x,), touches[:, 3], 1.0 * touches[:, 3]).edge == pytest.approx(2.0)
