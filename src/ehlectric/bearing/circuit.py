"""Electrical circuit of a bearing: both contacts of an element in series, elements in parallel. SI units."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array, Mask


def series(first: Array, second: Array) -> Array:
    """Capacitance of two capacitors in series, C1 C2/(C1 + C2) [F].

    Examples
    --------
    >>> float(series(np.array(2e-10), np.array(2e-10)))
    1e-10
    """
    return first * second / (first + second)


@dataclass(frozen=True)
class Circuit:
    """Capacitances of a bearing's contacts and the voltages at which their films break down.

    Attributes
    ----------
    inner, outer : ndarray, shape (n,)
        Capacitance of the contact of each element with the inner and the outer ring [F].
    inner_breakdown, outer_breakdown : ndarray, shape (n,)
        Breakdown voltage of each contact by itself [V]; infinite without a dielectric strength.
    shape : float or None
        Shape parameter m of Weibull's law. The breakdown voltages are then those at a probability of 63.2 %.
        None for a strength without scatter.

    Examples
    --------
    Two equal contacts have half of the bearing voltage each. The inner one, which withstands 5 V, breaks down
    at a bearing voltage of 10 V. The outer one then carries the whole voltage, up to 20 V:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> circuit.capacitance, circuit.first_break, circuit.through_breakdown
    (5e-11, 10.0, 20.0)

    By Weibull's law the voltage of the first break falls with the number of equal contacts to the power -1/m,
    here from 10 V for a single contact to 5 V for four:

    >>> pair, both = np.full(2, 1e-10), np.full(2, 5.0)
    >>> round(Circuit(pair, pair, both, both, shape=2.0).first_break, 9)
    5.0
    """

    inner: Array
    outer: Array
    inner_breakdown: Array
    outer_breakdown: Array
    shape: float | None = None

    @cached_property
    def elements(self) -> Array:
        """Capacitance of each element from ring to ring, shape (n,) [F]."""
        return series(self.inner, self.outer)

    @cached_property
    def capacitance(self) -> float:
        """Capacitance of the bearing [F]."""
        return float(np.sum(self.elements))

    @cached_property
    def inner_share(self) -> Array:
        """Share of the bearing voltage on each inner contact, shape (n,); the outer one has the rest."""
        return self.outer / (self.inner + self.outer)

    @cached_property
    def inner_breaks(self) -> Array:
        """Bearing voltages at which the inner contacts break down, outer ones intact, shape (n,) [V]."""
        return self.inner_breakdown / self.inner_share

    @cached_property
    def outer_breaks(self) -> Array:
        """Bearing voltages at which the outer contacts break down, inner ones intact, shape (n,) [V]."""
        return self.outer_breakdown / (1.0 - self.inner_share)

    @cached_property
    def inner_first(self) -> Mask:
        """Whether the inner contact of each element breaks down before or with the outer one, shape (n,)."""
        return self.inner_breaks <= self.outer_breaks

    @cached_property
    def first_breaks(self) -> Array:
        """Bearing voltages at which the first contact of each element breaks down, shape (n,) [V]."""
        return np.minimum(self.inner_breaks, self.outer_breaks)

    @cached_property
    def through_breaks(self) -> Array:
        """Bearing voltages at which both contacts of each element have broken down, shape (n,) [V].

        After the first of them has broken down, the other one carries the whole bearing voltage.
        """
        remaining = np.where(self.inner_first, self.outer_breakdown, self.inner_breakdown)
        return np.maximum(self.first_breaks, remaining)

    @cached_property
    def first_break(self) -> float:
        """Smallest bearing voltage at which a contact breaks down [V].

        With Weibull's law, it is the voltage at which the probability that any contact has broken down is
        63.2 %. The exponents (V/V_k)^m of all contacts then add up to 1, where V_k is the bearing voltage at
        which contact k alone has this probability.

        W. Weibull, J. Appl. Mech. 18 (1951) 293, doi:10.1115/1.4010337.
        """
        least = float(np.min(self.first_breaks))
        if self.shape is None or not np.isfinite(least):
            return least
        breaks = np.concatenate([self.inner_breaks, self.outer_breaks])
        # Number of contacts as weak as the weakest one. Powers of the voltages themselves would overflow.
        number = float(np.sum((least / breaks) ** self.shape))
        return least * float(number ** (-1.0 / self.shape))

    @property
    def through_breakdown(self) -> float:
        """Smallest bearing voltage at which an element breaks down from ring to ring [V].

        With Weibull's law, each contact breaks down at the voltage of its own 63.2 %.
        """
        return float(np.min(self.through_breaks))


def leakage_conductance(
    inner: tuple[Array, Array], outer: tuple[Array, Array], relaxation_time: float
) -> float:
    """Conductance of a bearing whose oil conducts, at frequencies far above the corner frequency of the oil.

    Both contacts of an element are in series and share the voltage by their capacitances C. With the
    conductances G = C_oil/tau, an element has (G_i C_o^2 + G_o C_i^2)/(C_i + C_o)^2.

    Parameters
    ----------
    inner, outer : tuple of ndarray, shape (n,)
        Capacitance of each element's contact with the ring, and the part of it in oil [F].
    relaxation_time : float
        Charge relaxation time tau = eps0 eps_r/sigma of the oil [s].

    Returns
    -------
    float
        Conductance [S].

    Examples
    --------
    With oil everywhere, it is the capacitance of the bearing over tau:

    >>> both = np.array([2e-10]), np.array([2e-10])
    >>> leakage_conductance(both, both, 1.0)
    1e-10
    """
    (first, first_oil), (second, second_oil) = inner, outer
    share = second / (first + second)
    conductances = (first_oil * share**2 + second_oil * (1.0 - share) ** 2) / relaxation_time
    return float(np.sum(conductances))


def leaking_admittance(
    inner: tuple[Array, Array], outer: tuple[Array, Array], relaxation_time: float, frequency: Array
) -> Array:
    """Admittance of a bearing whose oil conducts, while the air around its films does not.

    A contact has the admittance i 2 pi f C + C_oil/tau. Both contacts of an element are in series, and the
    elements are in parallel.

    Parameters
    ----------
    inner, outer : tuple of ndarray, shape (n,)
        Capacitance of each element's contact with the ring, and the part of it in oil [F].
    relaxation_time : float
        Charge relaxation time tau = eps0 eps_r/sigma of the oil [s].
    frequency : ndarray, shape (m,)
        Frequency f [Hz].

    Returns
    -------
    ndarray of complex, shape (m,)
        Admittance [S].

    Examples
    --------
    With oil everywhere, it is C (i 2 pi f + 1/tau) of the bearing's capacitance C:

    >>> both = np.array([2e-10]), np.array([2e-10])
    >>> y = leaking_admittance(both, both, 1.0, np.array([1.0]))
    >>> bool(np.isclose(y[0], 1e-10 * (2j * np.pi + 1.0)))
    True
    """
    omega = 2.0 * np.pi * frequency[:, np.newaxis]
    first, second = (1j * omega * whole + oil / relaxation_time for whole, oil in (inner, outer))
    y: Array = np.sum(first * second / (first + second), axis=1)
    return y
