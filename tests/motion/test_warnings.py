"""Warnings about moving roughness before its first time step."""

import tempfile

import numpy as np
import pytest

from ehlectric.contact.solver import solve
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import read_motion
from ehlectric.motion.warnings import LEAST_STEPS, motion_warnings, step_warnings
from tests.helpers.each import each
from tests.helpers.moving_cases import LINE, POINT, moving

WAVE = {"surface": 1, "generator": "sinusoid", "amplitude": "50 nm", "wavelength": "25 um"}
SLIDING = {"contact.slide_to_roll_ratio": 2.0}


def steps_text(case):
    found = list(step_warnings(TransientContact.of(case)))
    assert len(found) <= 1
    return found[0].text if found else ""


def test_steps_over_which_waves_move_past_the_oil_are_named_with_a_number_that_is_enough():
    """At the mean speed oil travels 6 half-widths in 150 steps; a wave of 25 um passes it in 5 of them."""
    motion = {"passes": 1.0, "steps": 150}
    case = moving(LINE, {**SLIDING, "grid.nodes": 801}, roughness=[WAVE], motion=motion)
    text = steps_text(case)
    assert "the 150 time steps are too long: the shortest waves of surface 1" in text
    passage = 25e-6 / (6.0 * TransientContact.of(case).half_width / 150)
    assert f"pass the oil in {passage:.2g} steps" in text
    enough = int(np.ceil(150 * 20.0 / passage))
    assert f"Use at least {enough} motion.steps" in text
    assert steps_text(case.replace({"motion.steps": enough})) == ""


@each("surface, ratio, beside_oil", [(1, 0.0, 0.0), (1, 1.0, 0.5), (1, -1.0, 0.5), (2, 3.0, 1.5)])
def test_the_speed_that_counts_is_that_of_the_surface_against_the_oil(surface, ratio, beside_oil):
    case = moving(
        LINE,
        {"contact.slide_to_roll_ratio": ratio, "grid.nodes": 801},
        roughness=[WAVE | {"surface": surface}],
        motion={"passes": 1.0, "steps": 100},
    )
    contact = TransientContact.of(case)
    travelled = beside_oil * contact.schedule.step * contact.half_width
    too_long = travelled > 25e-6 / LEAST_STEPS
    assert bool(steps_text(case)) == too_long


def test_steps_that_follow_from_the_grid_resolve_each_wave_that_it_resolves():
    """Surface 1 at 0.5 to 3 times the speed of the oil, surface 2 backwards at the same speed and faster."""
    for ratio, surface in ((-1.0, 1), (0.0, 1), (1.0, 1), (2.0, 1), (4.0, 1), (4.0, 2), (6.0, 2)):
        changes = {"contact.slide_to_roll_ratio": ratio, "grid.nodes": 401}
        wave = WAVE | {"wavelength": "15 um", "surface": surface}  # eight nodes
        case = moving(LINE, changes, roughness=[wave], motion={"passes": 1.0})
        assert steps_text(case) == ""
        schedule = TransientContact.of(case).schedule
        given = case.replace({"motion.steps": schedule.steps})
        assert steps_text(given) == ""


@each(
    "table, rough, length",
    [
        (LINE, {"generator": "asperity", "height": "50 nm", "width": "60 um"}, 60e-6),
        (LINE, {"generator": "pit", "depth": "50 nm", "width": "60 um", "rim": "10 nm"}, 30e-6),
        (
            POINT,
            {"generator": "sinusoid", "amplitude": "50 nm", "wavelength": "25 um", "orientation": "60 deg"},
            50e-6,
        ),
        (
            POINT,
            {"generator": "sinusoid", "amplitude": "50 nm", "wavelength": "25 um", "orientation": "90 deg"},
            np.inf,
        ),
    ],
)
def test_the_length_of_a_shape_along_entrainment_counts(table, rough, length):
    case = moving(table, SLIDING, roughness=[{"surface": 1} | rough], motion={"passes": 1.0, "steps": 30})
    contact = TransientContact.of(case)
    passage = length / (contact.schedule.step * contact.half_width)
    text = steps_text(case)
    assert (f"pass the oil in {passage:.2g} steps" in text) == (passage < LEAST_STEPS)


@pytest.mark.parametrize("table", [LINE, POINT])
def test_four_correlation_lengths_count_as_a_wave(table):
    rough = {"surface": 1, "generator": "gaussian", "rq": "20 nm", "correlation_length": "20 um", "seed": 1}
    case = moving(table, SLIDING, roughness=[rough], motion={"passes": 1.0, "steps": 20})
    contact = TransientContact.of(case)
    passage = 80e-6 / (contact.schedule.step * contact.half_width)
    said = float(steps_text(case).split("pass the oil in ")[1].split(" ")[0])
    assert said == pytest.approx(passage, rel=0.3)


def unlike_text(**changes):
    case = moving(LINE, **changes)
    still = solve(case.replace(motion=None), beside_smooth=False)
    found = motion_warnings(TransientContact.of(case), still)
    return " ".join(warning.text for warning in found if warning.code == "stationary-differs")


def test_the_front_of_a_plain_wave_is_named_and_no_key_that_the_wave_does_not_have():
    wave = WAVE | {"wavelength": "100 um"}
    text = unlike_text(roughness=[wave], grid={"nodes": 129, "outlet": 1.5}, motion={"passes": 1.0})
    assert "its front, one half-width long, is still in the Hertzian zone (raise grid.outlet to 2)." in text
    assert "form" not in text
    assert "rescale_rq" not in text
    assert unlike_text(roughness=[wave], grid={"nodes": 129, "outlet": 2.0}, motion={"passes": 1.0}) == ""


def test_a_wave_that_moves_backwards_needs_a_longer_inlet():
    wave = WAVE | {"wavelength": "100 um", "surface": 2}
    contact = LINE["contact"] | {"slide_to_roll_ratio": 4.0}
    grid = {"nodes": 129, "inlet": -1.6, "field_range": [-1.25, 1.25]}
    text = unlike_text(contact=contact, roughness=[wave], grid=grid, motion={"passes": 1.0})
    assert "is still in the Hertzian zone (lower grid.inlet to -2)." in text


def test_the_steps_that_depend_on_the_length_are_named_and_only_those_of_the_case():
    rough = {"surface": 1, "generator": "gaussian", "rq": "20 nm", "correlation_length": "40 um", "seed": 1}
    given = {"grid": {"nodes": 129}, "motion": {"passes": 2.5}}
    text = unlike_text(roughness=[rough | {"rescale_rq": "30 nm"}], **given)
    assert "height: rescale_rq is applied to the longer surface that moves through the contact." in text
    text = unlike_text(roughness=[rough | {"form": "line", "rescale_rq": "30 nm"}], **given)
    assert "form and rescale_rq are applied" in text


def ripple(steps, ratio):
    """Amplitude of the ripples of the film over that of the waves, and whether there is a warning."""
    case = moving(
        LINE,
        {"contact.slide_to_roll_ratio": ratio, "contact.entrainment_speed": 1.0, "grid.nodes": 201},
        roughness=[WAVE | {"wavelength": "50 um"}],
        motion={"duration": "0.4 ms", "steps": steps, "record": 60},
    )
    with tempfile.TemporaryDirectory() as folder:
        run_motion(case, folder)
        run = read_motion(folder).load()
    x, time = run["x"].values, run["frame_time"].values
    film = run["thickness"].values[time > 0.8 * time[-1]][:, np.abs(x) < 75e-6]
    return float(np.sqrt(2.0) * np.std(film - film.mean(axis=0)) / 50e-9), bool(steps_text(case))


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "steps"), [(2.0, (24, 48, 64, 160, 320)), (1.0, (24, 32, 80, 160))])
def test_the_warning_comes_where_the_ripples_are_wrong(ratio, steps):
    """A wave passes the oil in as many steps as 50 um / (relative speed times the step)."""
    found = [ripple(number, ratio) for number in steps]
    exact, warned = found[-1]
    assert not warned
    errors = [(abs(amplitude / exact - 1.0), warned) for amplitude, warned in found[:-1]]
    assert all(warned or error < 0.01 for error, warned in errors)
    assert all(error > 0.01 or not warned for error, warned in errors)
    assert max(errors)[0] > 0.03
