"""Warnings about a contact with moving roughness: known before its first time step, and of its spots."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact import (
    PointResult,
    Result,
    about_share,
    case_warnings,
    changed_share,
    domain_of,
    spacings_of,
    starvation_warnings,
    unknown_share,
)
from ehlectric.field import ATOM
from ehlectric.motion.motion_touching import TouchHistory
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unused_keys import unused_note
from ehlectric.surfaces.surface_warnings import LEAST_IN_SHAPE, shortest_wave, surface_warnings

# Part of its height by which moving roughness may differ from the stationary one without a warning.
_ALIKE = 1e-3

# Distance of the end of the domain behind which the front of moving roughness leaves the Hertzian zone
# undisturbed [half-widths]: the half-width of the zone, and the length of the front.
_CLEAR = 2.0
_FRONT_IN_ZONE = "its front, one half-width long, is still in the Hertzian zone"

# Processing steps of a surface whose effect depends on its length.
_LONGER = ("form", "cutoff_long", "cutoff_short", "rescale_rq", "truncate")

# Number of time steps in which a wave moves past the oil. Below the first number the amplitude of the ripples
# in the film is wrong by 2 % and more, and there is a warning; from the second on by less than 1 %.
LEAST_STEPS, SUFFICIENT_STEPS = 8.0, 20.0


def motion_warnings(contact: TransientContact, still: Result | PointResult) -> Iterator[ResultWarning]:
    """Warnings that are known before the first time step.

    They concern the case, its surfaces, its time steps and the film with stationary roughness.
    """
    conditions, travelled = contact.conditions, contact.travelled
    domain, spacings = domain_of(travelled, conditions), spacings_of(contact.case, conditions)
    yield from case_warnings(contact.case, conditions)
    yield from surface_warnings(travelled.roughness, contact.roughness.surfaces, domain, *spacings)
    yield from step_warnings(contact)
    if unused := _stationary_keys(contact.case):
        yield unused_note("motion", unused)
    yield from starvation_warnings(contact.case, still.film)
    yield from _unlike(contact, still)
    if not still.converged:
        yield ResultWarning.of("stationary-not-converged", status=still.film.status)
    elif (error := still.film_error) is not None and error > 0.01:
        yield ResultWarning.of("stationary-error", percent=100.0 * error)


def _stationary_keys(case: Case) -> list[str]:
    """Given keys that only a stationary contact uses: discharges, and resistances of spots."""
    electric = ("resistivity", "mean_free_path", "tribofilm_resistance")
    keys = [] if case.discharge is None else ["discharge"]
    keys += [f"electric.{key}" for key in electric if getattr(case.electric, key) is not None]
    heated = case.film is not None and case.film.thermal
    if case.contact.boundary_friction is not None and not heated:
        keys.append("contact.boundary_friction")
    return keys


def step_warnings(contact: TransientContact) -> Iterator[ResultWarning]:
    """Warning about time steps that do not resolve the roughness that oil passes.

    Roughness that moves with the oil is carried along exactly. What the steps must resolve is the passage of
    waves relative to the oil, at the difference between the speeds of their surface and of entrainment.

    Yields the warning, with the number of steps that is sufficient.
    """
    steps, motion, case = contact.schedule.steps, contact.case.motion, contact.case
    assert motion is not None
    spacing = spacings_of(case, contact.conditions)[0]
    passages = []
    for number, table in enumerate(case.roughness):
        wave = shortest_wave(table, contact.roughness.surfaces[number])
        # A wave that the grid does not resolve has a warning of its own, and needs nodes rather than steps.
        if motion.steps is not None or wave >= LEAST_IN_SHAPE * spacing:
            passages.append((wave / _passed(contact, table.surface), table.surface))
    fewest, surface = min(passages, default=(math.inf, 0))
    if fewest < LEAST_STEPS:
        enough = math.ceil(steps * SUFFICIENT_STEPS / fewest)
        yield ResultWarning.of("steps-too-long", steps=steps, surface=surface, fewest=fewest, enough=enough)


def touch_warnings(touching: TouchHistory) -> Iterator[ResultWarning]:
    """Warnings about a run whose surfaces touch.

    The first says what touching means. The second is given where the load share depends on the grid, or is
    not known on a coarser one.
    """
    share, coarser = touching.mean_share, touching.coarser
    yield ResultWarning.of(
        "asperities-touch",
        "moving" if touching.filled else "short_run",
        percent=100.0 * touching.time_share,
        steps=touching.steps,
        share=about_share(share, coarser),
    )
    what, grid = "the mean load share", "every second node with twice the time step"
    if coarser is None:
        yield unknown_share(what, grid)
    else:
        yield from changed_share(what, share, coarser, grid, change=touching.share_change)


def _passed(contact: TransientContact, surface: int) -> float:
    """Distance by which a surface moves past the oil in a time step [m]; tiny for one that moves with it."""
    schedule = contact.schedule
    return max(abs(schedule.speed_of(surface) - 1.0), 1e-12) * schedule.step * contact.half_width


def _unlike(contact: TransientContact, still: Result | PointResult) -> Iterator[ResultWarning]:
    """Warning that the moving roughness differs from the stationary one, with the causes that apply."""
    coincident = contact.schedule.coincident
    if not np.isfinite(coincident):
        return
    axes = [position / contact.half_width for position in still.film.axes]
    inside = np.abs(axes[0]) <= 1.0
    away = (contact.roughness.heights(coincident, *axes) - still.roughness)[:, inside]
    part = np.max(np.abs(away)) / max(np.max(np.abs(still.roughness[:, inside])), ATOM)
    if part > _ALIKE:
        yield ResultWarning.of("stationary-differs", percent=100.0 * part, causes="; ".join(_causes(contact)))


def _causes(contact: TransientContact) -> Iterator[str]:
    """Causes of a difference between moving and stationary roughness, with the keys that decide them."""
    schedule = contact.schedule
    inlet, outlet = schedule.domain
    forwards = any(speed > 0.0 for speed in schedule.moving_speeds)
    if forwards and outlet < _CLEAR:
        yield f"{_FRONT_IN_ZONE} (raise grid.outlet to {_CLEAR:g})"
    if inlet > -_CLEAR and any(speed < 0.0 for speed in schedule.moving_speeds):
        yield f"{_FRONT_IN_ZONE} (lower grid.inlet to {-_CLEAR:g})"
    moving = [table for table in contact.case.roughness if schedule.speed_of(table.surface)]
    keys = [key for key in _LONGER if any(getattr(table, key) not in (None, "none") for table in moving)]
    if keys:
        are = "is" if len(keys) == 1 else "are"
        yield f"{' and '.join(keys)} {are} applied to the longer surface that moves through the contact"
    elif any(table.seed is not None for table in moving):
        yield "a longer surface is generated for the motion"
