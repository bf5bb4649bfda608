"""Leakage of charge through the oil: relaxation time and corner frequency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.laws import (
    relaxation_time,
)


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


def leakage(discharge: Discharge, permittivity: float) -> Leakage:
    """Leakage of charge through an oil with this relative permittivity and the conductivity of the case."""
    if discharge.conductivity is None:
        return Leakage()
    time = relaxation_time(permittivity, discharge.conductivity)
    return Leakage(relaxation_time=time, corner_frequency=1.0 / (2.0 * np.pi * time))
