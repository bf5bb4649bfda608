"""The circuit of a bearing: two contacts of each element in series, elements in parallel. SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask


def series(first: Array, second: Array) -> Array:
    """Capacitance of two in series, C1 C2/(C1 + C2) [F].

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
        Capacitance of each element's contacts with the inner and the outer ring [F].
    inner_breakdown, outer_breakdown : ndarray, shape (n,)
        Breakdown voltage of each contact by itself [V]; infinite where it has none.
    shape : float or None
        m of Weibull's law, whose 63.2 % those voltages then are; none where the strength is a certain one.

    Examples
    --------
    Two equal contacts share the voltage; where one breaks down at half of what the other withstands, that one
    holds on alone.

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> circuit.capacitance, circuit.first_break, circuit.through_breakdown
    (5e-11, 10.0, 20.0)

    By Weibull's law four equal contacts break sooner than one, by the power 1/m of their number:

    >>> pair, both = np.full(2, 1e-10), np.full(2, 5.0)
    >>> round(Circuit(pair, pair, both, both, shape=2.0).first_break, 9)
    5.0
    """

    inner: Array
    outer: Array
    inner_breakdown: Array
    outer_breakdown: Array
    shape: float | None = None

    @property
    def elements(self) -> Array:
        """Capacitance of each element from ring to ring [F]."""
        return series(self.inner, self.outer)

    @property
    def capacitance(self) -> float:
        """Capacitance of the bearing [F]."""
        return float(np.sum(self.elements))

    @property
    def inner_share(self) -> Array:
        """Part of the bearing's voltage on each inner contact; the outer one has the rest."""
        return self.outer / (self.inner + self.outer)

    @property
    def inner_breaks(self) -> Array:
        """Bearing voltages at which the inner contacts break down, their partners being whole [V]."""
        return self.inner_breakdown / self.inner_share

    @property
    def outer_breaks(self) -> Array:
        """Bearing voltages at which the outer contacts break down, their partners being whole [V]."""
        return self.outer_breakdown / (1.0 - self.inner_share)

    @property
    def inner_first(self) -> Mask:
        """Whether the inner contact of each element breaks down before the outer one, or with it."""
        return self.inner_breaks <= self.outer_breaks

    @property
    def first_breaks(self) -> Array:
        """Bearing voltages at which the first contact of each element breaks down [V]."""
        return np.minimum(self.inner_breaks, self.outer_breaks)

    @property
    def through_breaks(self) -> Array:
        """Bearing voltages at which each element breaks down through both contacts [V].

        When the first one has broken down the other carries all of the voltage.
        """
        remaining = np.where(self.inner_first, self.outer_breakdown, self.inner_breakdown)
        return np.maximum(self.first_breaks, remaining)

    @property
    def first_break(self) -> float:
        """Least bearing voltage at which some contact breaks down [V].

        By Weibull's law that at which one of them has broken down with the probability 63.2 %: the exponents
        of all, (V/V_k)^m with the bearing voltage V_k of each one's own 63.2 %, add up to 1.

        W. Weibull, J. Appl. Mech. 18 (1951) 293, doi:10.1115/1.4010337.
        """
        least = float(np.min(self.first_breaks))
        if self.shape is None or not np.isfinite(least):
            return least
        breaks = np.concatenate([self.inner_breaks, self.outer_breaks])
        # Of the weakest, whose power alone would overflow.
        number = float(np.sum((least / breaks) ** self.shape))
        return least * float(number ** (-1.0 / self.shape))

    @property
    def through_breakdown(self) -> float:
        """Least bearing voltage at which some element breaks down from ring to ring [V].

        By Weibull's law each contact is taken at its own 63.2 %.
        """
        return float(np.min(self.through_breaks))


def impedance(capacitance: Array, relaxation_time: float, frequency: Array) -> Array:
    """Impedance of capacitances whose dielectric leaks, Z = 1/(C (i 2 pi f + 1/tau)).

    Parameters
    ----------
    capacitance : ndarray
        [F].
    relaxation_time : float
        tau = eps0 eps_r/sigma of the oil [s].
    frequency : ndarray, shape (n,)
        [Hz].

    Returns
    -------
    ndarray of complex, shape (n,)
        [Ohm].

    Examples
    --------
    >>> z = impedance(1e-10, 1.0, np.array([0.0]))
    >>> float(abs(z[0]))
    10000000000.0
    """
    z: Array = 1.0 / (capacitance * (2j * np.pi * frequency + 1.0 / relaxation_time))
    return z


def leaking_admittance(
    inner: tuple[Array, Array], outer: tuple[Array, Array], relaxation_time: float, frequency: Array
) -> Array:
    """Admittance of a bearing whose oil leaks, and the air around its films does not.

    A contact has i 2 pi f C + C_oil/tau; those of an element are in series, elements in parallel.

    Parameters
    ----------
    inner, outer : tuple of ndarray, shape (n,)
        Of each element's contacts with the inner and the outer ring all of the capacitance, and that of the
        oil in it [F].
    relaxation_time : float
        tau = eps0 eps_r/sigma of the oil [s].
    frequency : ndarray, shape (m,)
        [Hz].

    Returns
    -------
    ndarray of complex, shape (m,)
        [S].

    Examples
    --------
    All of it in oil, 1/Z of the bearing's capacitance:

    >>> both = np.array([2e-10]), np.array([2e-10])
    >>> y = leaking_admittance(both, both, 1.0, np.array([1.0]))
    >>> bool(np.isclose(y[0] * impedance(1e-10, 1.0, np.array([1.0]))[0], 1.0))
    True
    """
    omega = 2.0 * np.pi * frequency[:, np.newaxis]
    first, second = (1j * omega * whole + oil / relaxation_time for whole, oil in (inner, outer))
    y: Array = np.sum(first * second / (first + second), axis=1)
    return y
