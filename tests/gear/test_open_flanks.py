"""Capacitance of the lines of contact at which relief and crowning keep the flanks apart."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import ehlectric
from ehlectric.constants import EPSILON_0
from ehlectric.gear.solution import OperatingPair
from tests.gear.pairs import case_of
from tests.helpers.gears import helical_case

RELIEF = {"gear.tip_relief": "12 um", "gear.tip_relief_length": "1.5 mm"}


@pytest.mark.parametrize(
    "case",
    [
        helical_case().replace(RELIEF),
        helical_case().replace({**RELIEF, "gear.lead_crowning": "8 um"}),
        case_of(tip_relief="60 um", tip_relief_length="2 mm"),
    ],
)
def test_the_capacitance_of_open_flanks_is_the_integral_over_their_gap(case):
    """Cylinders at the gap f - delta, which is integrated numerically along all lines at each phase."""
    solution = ehlectric.solve_gear(case, probable=False).solution
    sharing = OperatingPair.of(case).sharing(case.gear)
    plane, film = solution.plane, float(np.nanmax(solution.films.central))
    path, tangent = plane.path, math.tan(plane.path.base_helix_angle)

    def density(across, begin, delta):
        """Integrand of the capacitance over y: 0 outside of the plane of action and where flanks touch."""
        x = begin + across * tangent
        if not 0.0 <= x <= path.length:
            return 0.0
        place = np.array([path.start + x])
        gap = float(sharing.modification.opening(plane, place, np.array([across]))[0]) - delta
        radius = float(path.reduced_radius(place)[0])
        return math.sqrt(2.0 * radius / (gap + film)) if gap > 0.0 else 0.0

    expected = []
    for phase, delta in zip(solution.loads.phases.tolist(), sharing.state.tolist(), strict=True):
        total = 0.0
        for line in range(-math.ceil(plane.overlap_ratio) - 1, math.ceil(path.contact_ratio) + 1):
            begin = (phase + line) * path.base_pitch
            across = (np.arange(4000) + 0.5) / 4000 * plane.face_width
            total += float(np.mean([density(y, begin, delta) for y in across.tolist()])) * plane.face_width
        expected.append(total)
        if len(expected) == 4:
            break
    factor = math.pi * EPSILON_0 * solution.flanks.oil.relative_permittivity
    factor /= math.cos(path.base_helix_angle)
    found = solution.open_capacitance[: len(expected)]
    assert found == pytest.approx(factor * np.array(expected), rel=0.03, abs=1e-14)


def test_the_mean_over_a_linear_gap_is_exact():
    first, last = 2e-6, 9e-6
    mean = quad(lambda x: 1.0 / math.sqrt(first + (last - first) * x), 0.0, 1.0)[0]
    assert mean == pytest.approx(2.0 / (math.sqrt(first) + math.sqrt(last)), rel=1e-10)


def test_flanks_without_relief_touch_everywhere():
    solution = ehlectric.solve_gear(helical_case(), probable=False).solution
    assert np.all(solution.open_capacitance == 0.0)


def test_an_unloaded_end_continues_the_capacitance_of_its_loaded_part():
    """A relief that grows from zero changes the capacitance of the mesh continuously: by less than 2 % where
    it starts to take the flanks apart.
    """
    reliefs = np.linspace(2.0, 14.0, 13)
    found = ehlectric.evaluate(
        helical_case().replace(RELIEF), {"gear.tip_relief": [f"{relief} um" for relief in reliefs]}
    )
    capacitance = np.asarray(found["mesh.capacitance"])
    assert np.all(np.abs(np.diff(capacitance)) < 0.02 * capacitance[0])
