"""Leakage of charge through the oil: relaxation time and corner frequency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.laws import relaxation_time
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class Leakage:
    """Leakage of charge through the oil at ambient pressure; None if the conductivity is unknown.

    Attributes
    ----------
    relaxation_time : float or None
        Charge relaxation time eps0 eps_r/sigma [s].
    corner_frequency : float or None
        Frequency above which the film is a capacitor, 1/(2 pi ``relaxation_time``) [Hz].
    """

    relaxation_time: float | None = None
    corner_frequency: float | None = None


def conductivity_of(discharge: Discharge | None, oil: Oil) -> float | None:
    """Electrical conductivity [S/m] of the table ``discharge``, or else of the oil; None without one."""
    given = None if discharge is None else discharge.conductivity
    return oil.conductivity if given is None else given


def leakage(discharge: Discharge, oil: Oil) -> Leakage:
    """Leakage of charge through an oil at ambient pressure."""
    conductivity = conductivity_of(discharge, oil)
    if conductivity is None:
        return Leakage()
    time = relaxation_time(oil.relative_permittivity, conductivity)
    return Leakage(relaxation_time=time, corner_frequency=1.0 / (2.0 * np.pi * time))
