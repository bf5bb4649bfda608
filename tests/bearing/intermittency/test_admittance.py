"""Impedance of a bearing whose contacts close at times, against sums written out by hand."""

import itertools

import numpy as np
import pytest

from ehlectric.bearing.bearing_touching import duty_of
from ehlectric.bearing.impedance import impedance_of
from tests.bearing.intermittency.test_duty import solved

COATING = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "45 cm^2"}


def expected(solution, resistance, frequency, tau):
    """Mean admittance over all four states of each element, at all positions."""
    duty, total = duty_of(solution), 0.0
    omega = 2j * np.pi * frequency
    for position, rings in zip(solution.positions, duty.rings, strict=True):
        films = [
            omega[:, None] * ring.capacitance("oil") + ring.capacitance("oil") / tau
            for ring in position.rings
        ]
        for closed in itertools.product((False, True), repeat=2):
            chance, contacts = 1.0, []
            for film, ring, shut in zip(films, rings, closed, strict=True):
                share = ring.contact_time_share
                chance = chance * (share if shut else 1.0 - share)
                contacts.append(film + (1.0 / resistance if shut else 0.0))
            total = total + np.sum(chance * contacts[0] * contacts[1] / (contacts[0] + contacts[1]), axis=1)
    return total / len(solution.positions)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("rq", ["0.02 um", "0.06 um", "0.5 um"])
@pytest.mark.parametrize("resistance", [0.3, 1e3])
def test_mean_over_the_states_of_all_elements(rq, resistance):
    solution = solved(bearing__composite_rq=rq, bearing__contact_resistance=resistance)
    found = impedance_of(solution)
    tau = 1.0 / (2.0 * np.pi * found.corner)
    hand = 1.0 / expected(solution, resistance, found.frequency, tau)
    np.testing.assert_allclose(found.mean.values, hand, rtol=1e-9)


def test_without_contacts_it_is_that_of_the_films():
    found = impedance_of(solved(bearing__composite_rq="0.1 nm", bearing__contact_resistance=0.3))
    np.testing.assert_allclose(found.mean.values, found.values, rtol=1e-12)


@pytest.mark.slow
def test_only_with_a_resistance_where_surfaces_touch():
    rough = {"bearing__composite_rq": "0.3 um"}
    assert impedance_of(solved(**rough)) is None
    assert impedance_of(solved()).mean is None
    found = impedance_of(solved(**rough, bearing__contact_resistance=0.3))
    assert np.all(found.mean.magnitude < 1.0)


def test_a_coating_stays_in_series():
    """At a low frequency its capacitance alone is left of a bearing that is nearly always shorted."""
    keys = {"bearing__composite_rq": "10 um", "bearing__contact_resistance": 0.3}
    bare, coated = (impedance_of(solved(bearing__coating=one, **keys)) for one in (None, COATING))
    own = 8.854e-12 * 9.0 * 45e-4 / 200e-6
    assert np.all(bare.mean.magnitude < 1.0)
    at = np.searchsorted(coated.frequency, 1e5)
    found = coated.mean.magnitude[at] * 2.0 * np.pi * coated.frequency[at] * own
    assert found == pytest.approx(1.0, rel=1e-2, abs=0.0)
