"""Capacitance of the rows of a measurement, as a meter gives it or from magnitude and phase."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.measurements.reading import Measurement
from ehlectric.errors import InputError

# Quantities of an impedance, all three of which give a capacitance.
_OF_IMPEDANCE = ("impedance", "phase", "frequency")


@dataclass(frozen=True, eq=False)
class MeasuredCapacitance:
    """Parallel capacitance of measured rows, with the background in it.

    Attributes
    ----------
    value : ndarray, shape (n,)
        Capacitance [F]; NaN where the phase is not that of a capacitor.
    uncertainty : ndarray, shape (n,), or None
        Standard uncertainty [F]; None where the measurement states none.
    resistance : ndarray, shape (n,), or None
        Parallel resistance [Ohm], infinite at a phase of -90 deg; None where a capacitance was measured.
    """

    value: Array
    uncertainty: Array | None
    resistance: Array | None = None


def parallel_circuit(magnitude: Array, phase: Array, frequency: Array) -> tuple[Array, Array]:
    """Capacitance and resistance in parallel that have an impedance, C = -sin(phase)/(2 pi f magnitude).

    Parameters
    ----------
    magnitude, phase, frequency : ndarray, shape (n,)
        Magnitude of the impedance [Ohm], its phase [rad], negative for a capacitor, and the frequency f [Hz].

    Returns
    -------
    capacitance, resistance : ndarray, shape (n,)
        C [F], and R = magnitude/cos(phase) [Ohm]. C is negative for an inductive phase.

    Examples
    --------
    >>> c, r = parallel_circuit(np.array([1e4]), np.array([-np.pi / 3]), np.array([1e5]))
    >>> round(float(c[0]) * 1e12, 3), round(float(r[0]))
    (137.832, 20000)
    """
    capacitance = -np.sin(phase) / (2.0 * math.pi * frequency * magnitude)
    with np.errstate(divide="ignore"):
        resistance = magnitude / np.cos(phase)
    return capacitance, resistance


def capacitance_of(measured: Measurement, uncertainty: float | None = None) -> MeasuredCapacitance:
    """Parallel capacitance of all rows of a measurement.

    Parameters
    ----------
    measured : Measurement
        Rows with a capacitance, or with magnitude, phase and frequency of an impedance.
    uncertainty : float, optional
        Relative standard uncertainty of the capacitance, for a measurement that states none.

    Returns
    -------
    MeasuredCapacitance
        Capacitance with its uncertainty; columns of the measurement win over ``uncertainty``.

    Raises
    ------
    InputError
        If the measurement has neither, or has both.
    """
    if measured.has("capacitance") and measured.has("impedance"):
        raise InputError(measured.source, "has a capacitance and an impedance", takes="one of the two")
    if measured.has("capacitance"):
        value = measured.values["capacitance"]
        stated = measured.uncertainties.get("capacitance")
        return MeasuredCapacitance(value, _stated(value, stated, uncertainty))
    missing = [name for name in _OF_IMPEDANCE if not measured.has(name)]
    if len(missing) == len(_OF_IMPEDANCE) or "impedance" in missing:
        raise InputError.missing(
            f"{measured.source}: capacitance",
            "a column 'capacitance [pF]', or columns 'impedance [ohm]', 'phase [deg]' and 'frequency [Hz]'",
        )
    if missing:
        raise InputError.missing(f"{measured.source}: {missing[0]}", "a column of it beside the impedance")
    value, resistance = parallel_circuit(*(measured.values[name] for name in _OF_IMPEDANCE))
    stated = _of_impedance(measured)
    value = np.where(value > 0.0, value, np.nan)
    return MeasuredCapacitance(value, _stated(value, stated, uncertainty), resistance)


def _of_impedance(measured: Measurement) -> Array | None:
    """Uncertainty of the capacitance [F] from those of magnitude, phase and frequency, in quadrature."""
    magnitude, phase, frequency = (measured.values[name] for name in _OF_IMPEDANCE)
    given = measured.uncertainties
    if not any(name in given for name in _OF_IMPEDANCE):
        return None
    slope = 1.0 / (2.0 * math.pi * frequency * magnitude)
    capacitance = -np.sin(phase) * slope
    none = np.zeros_like(magnitude)
    parts = (
        capacitance * given.get("impedance", none) / magnitude,
        np.cos(phase) * slope * given.get("phase", none),
        capacitance * given.get("frequency", none) / frequency,
    )
    total: Array = np.sqrt(sum(part**2 for part in parts))
    return total


def _stated(value: Array, stated: Array | None, relative: float | None) -> Array | None:
    if stated is not None:
        return stated
    return None if relative is None else relative * value
