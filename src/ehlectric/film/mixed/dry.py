"""Dry contact of rough surfaces that touch at the thickness of a boundary film: a film at rest."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.mixed.touching import own_compliance
from ehlectric.film.state import State

# Change of the pressure from step to step, relative to its mean, at which the iteration ends: it is a first
# guess.
_TOLERANCE = 1e-5
_MOST_STEPS = 400

# Curvature along a direction, over that of a single node, that is only rounding.
_ROUNDING = 1e-9


def dry_contact(level: Level, pressure: Array, boundary_film: float, ambient_pressure: float) -> State:
    """Contact without oil: Q >= P_amb, H >= H_s, (Q - P_amb)(H - H_s) = 0, and the balance of load.

    Parameters
    ----------
    level : Level
        Grid.
    pressure : ndarray, shape (nx, ny)
        First guess of the pressure, as that of Hertz.
    boundary_film : float
        Thickness H_s of the boundary film, dimensionless.
    ambient_pressure : float
        Ambient pressure P_amb over p_h.

    Returns
    -------
    State
        Pressure, H00 and gap; all of the pressure above ambient is contact pressure.

    Notes
    -----
    Conjugate gradients on the nodes in contact, after I. A. Polonsky and L. M. Keer, Wear 231 (1999) 206,
    doi:10.1016/S0043-1648(99)00113-1.
    """
    weights, inner = level.weights, level.mesh.inner
    base = level.dry_gap + level.deflection(np.full(level.mesh.shape, ambient_pressure))
    load = level.load - float(np.sum(weights)) * ambient_pressure
    q = np.where(inner, np.maximum(pressure - ambient_pressure, 0.0), 0.0)
    q *= load / float(np.vdot(weights, q))
    direction, last, h00 = np.zeros_like(q), 1.0, 0.0
    opened, compliance = level.deflection(q), own_compliance(level)
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
