"""Dry contacts of smooth and rough surfaces, which films that touch start from."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.newton import State
from ehlectric.film.touching_film import node_compliance

# Change of the pressure from step to step, relative to its mean, at which the iteration ends: it is a first
# guess.
_TOLERANCE = 1e-5
_MOST_STEPS = 400

# Root mean square of the gap of nodes in contact over H_s at which asperities count as relieved, and the
# largest number of steps.
_RELIEVED = 1e-4
_RELIEVING_STEPS = 200

# Curvature along a direction, divided by the curvature of a single node, that is only rounding.
_ROUNDING = 1e-9


def dry_contact(level: Level, pressure: Array, boundary_film: float, ambient_pressure: float) -> State:
    """Contact without oil: Q >= P_amb, H >= H_s, (Q - P_amb)(H - H_s) = 0, and the balance of load.

    ``pressure`` (nx, ny) is an initial guess, such as the Hertz pressure. All of the resulting pressure above
    ambient is contact pressure.

    Conjugate gradients on the nodes in contact, after I. A. Polonsky and L. M. Keer, Wear 231 (1999) 206,
    doi:10.1016/S0043-1648(99)00113-1.
    """
    weights, inner = level.weights, level.mesh.inner
    base = level.dry_gap + level.deflection(np.full(level.mesh.shape, ambient_pressure))
    load = level.load - float(np.sum(weights)) * ambient_pressure
    q = np.where(inner, np.maximum(pressure - ambient_pressure, 0.0), 0.0)
    q *= load / float(np.vdot(weights, q))
    direction, last, h00 = np.zeros_like(q), 1.0, 0.0
    opened, compliance = level.deflection(q), node_compliance(level)
    for _ in range(_MOST_STEPS):
        touching = q > 0.0
        gap = base + opened
        h00 = -float(np.average(gap, weights=weights * touching))
        slack = np.where(touching, gap + h00, 0.0)
        square = float(np.vdot(weights, slack**2))
        direction = np.where(touching, slack + square / last * direction, 0.0)
        image = level.deflection(direction)
        image -= float(np.average(image, weights=weights * touching))
        curvature = float(np.vdot(weights * direction, image))
        # With a single node in contact the rest of the gap and the direction are rounding errors.
        if not curvature > _ROUNDING * compliance * float(np.vdot(weights, direction**2)):
            break
        step = float(np.vdot(weights * slack, direction)) / curvature
        after = np.maximum(q - step * direction, 0.0)
        pressed = inner & (after == 0.0) & (gap + h00 < 0.0)
        last = square
        if pressed.any():
            after[pressed] -= step * (gap + h00)[pressed]
            direction, last = np.zeros_like(q), 1.0
        after *= load / float(np.vdot(weights, after))
        change = float(np.max(np.abs(after - q)))
        q, opened = after, level.deflection(after)
        if change < _TOLERANCE:
            break
    touching = q > 0.0
    h00 = boundary_film - float(np.average(base + opened, weights=weights * touching))
    total = q + ambient_pressure
    return State(total, h00, Gap.of(level, total, h00).thickness, q)


def relieved(level: Level, state: State, boundary_film: float) -> State:
    """Film with the pressure of its oil and its H00, and the contact pressure that leaves no node pierced.

    On a finer grid a rough surface has waves that the film of the coarser grid does not know. Asperities that
    they push through the other surface are flattened here before the oil answers.

    The result fulfils H >= H_s and P_c >= 0 within the domain, P_c about zero where H > H_s; it carries more
    load.

    Conjugate gradients on the nodes in contact, as in ``dry_contact``, without the balance of load.
    """
    weights, inner, oil = level.weights, level.mesh.inner, state.oil_pressure
    base = Gap.of(level, oil, state.h00).thickness - boundary_film
    contact = np.where(inner, state.contact_pressure, 0.0)
    gap, direction, last = base + level.deflection(contact), np.zeros_like(oil), 1.0
    for _ in range(_RELIEVING_STEPS):
        free = inner & ((contact > 0.0) | (gap < 0.0))
        slack = np.where(free, gap, 0.0)
        square = float(np.vdot(weights, slack**2))
        if square <= (_RELIEVED * boundary_film) ** 2 * float(np.sum(weights * free)):
            break
        direction = np.where(free, slack + square / last * direction, 0.0)
        image = level.deflection(direction)
        step = float(np.vdot(weights * slack, direction)) / float(np.vdot(weights * direction, image))
        after, last = contact - step * direction, square
        if np.any(after < 0.0):
            direction, last = np.zeros_like(oil), 1.0
        contact = np.maximum(after, 0.0)
        gap = base + level.deflection(contact)
    return State.of(level, oil + contact, state.h00, contact)
