"""A moving film on a patch is that on the whole domain, and its instants cover the whole domain."""

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.film.gap import Gap
from ehlectric.film.mesh import at_centre
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.runtime.threads import quiet_solution
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

WAVE = {"generator": "sinusoid", "amplitude": "50 nm", "wavelength": "60 um", "orientation": "20 deg"}
PEAK = {"generator": "asperity", "height": "100 nm", "width": "50 um"}
NOISE = {"generator": "gaussian", "rq": "30 nm", "correlation_length": "30 um", "seed": 3}

# Roughness, load, speed, slide-to-roll ratio and nodes along x.
RUNS = {
    "peak": (PEAK, "20 N", "2 m/s", 1.0, 65),
    "wave": (WAVE, "20 N", "2 m/s", 0.0, 97),
    "thick": (NOISE, "20 N", "6 m/s", 0.5, 97),
    "thin": (NOISE, "100 N", "2 m/s", -0.5, 97),
    "peak on 97": (PEAK, "20 N", "2 m/s", 1.0, 97),
}


def contact_of(name):
    surface, load, speed, sliding, nodes = RUNS[name]
    return TransientContact.of(
        Case.from_dict(
            {
                "contact": {
                    "geometry": "point",
                    "radius_x": 0.01,
                    "radius_y": 0.01,
                    "reduced_modulus": 226e9,
                    "load": load,
                    "entrainment_speed": speed,
                    "slide_to_roll_ratio": sliding,
                },
                "lubricant": {"base": "paper"},
                "grid": {"nodes": nodes},
                "roughness": [{"surface": 1, **surface}],
                "motion": {"passes": 1.0},
            }
        )
    )


def films_over_time(film, history, schedule):
    """Smallest and central film thickness after every step, shape (steps, 2)."""
    found = []
    for _ in range(schedule.steps):
        with quiet_solution():
            history = film.advance(history, schedule.step)
        thickness = history.now.state.thickness
        found.append((np.min(thickness), at_centre(film.level.mesh, thickness)))
    return np.array(found), history


def check_run(name):
    contact = contact_of(name)
    moving, step = MovingFilm(contact.problem, contact.moving_gap), contact.schedule.step
    patched, last = films_over_time(moving.film, moving.start(step), contact.schedule)
    film = UnsteadyFilm(contact.problem, contact.moving_gap)
    whole, expected = films_over_time(film, film.start(moving.steady, step), contact.schedule)
    assert moving.film.level.mesh.weights.size < 0.6 * film.level.mesh.weights.size
    np.testing.assert_allclose(patched, whole, rtol=1.5e-3)
    assert np.sqrt(np.mean((patched / whole - 1.0) ** 2)) < 5e-4
    return moving, film, last.now, expected.now


@pytest.mark.slow
def test_moving_film_on_a_patch_is_that_of_the_whole_domain():
    moving, film, last, expected = check_run("peak")
    instant = moving.whole(last)
    scale = np.max(expected.state.pressure)
    np.testing.assert_allclose(instant.state.pressure, expected.state.pressure, atol=5e-3 * scale)
    np.testing.assert_allclose(instant.state.thickness, expected.state.thickness, rtol=3e-3)
    np.testing.assert_allclose(instant.density, expected.density, rtol=1e-3)
    inside = moving.patch.nodes
    np.testing.assert_array_equal(instant.state.thickness[inside], last.state.thickness)
    # The whole load is carried: that of the pressure outside was taken off inside the patch.
    level = film.level
    assert Gap(level, instant.state.thickness).load(instant.state.pressure) == pytest.approx(
        level.load, rel=1e-5
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", share([name for name in RUNS if name != "peak"], 2))
def test_moving_films_on_patches_are_those_of_the_whole_domain(name):
    check_run(name)


def test_a_line_contact_moves_on_the_whole_domain():
    table = {
        "reduced_radius": 0.0141,
        "reduced_modulus": 226e9,
        "load_per_length": 5e5,
        "entrainment_speed": 4.0,
    }
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "50 nm", "wavelength": "60 um"}
    case = {"contact": table, "lubricant": {"base": "paper"}, "grid": {"nodes": 201}, "roughness": [wave]}
    contact = TransientContact.of(Case.from_dict({**case, "motion": {"passes": 1.0}}))
    moving = MovingFilm(contact.problem, contact.moving_gap)
    history = moving.start(contact.schedule.step)
    assert moving.patch is None
    assert moving.whole(history.now) is history.now
