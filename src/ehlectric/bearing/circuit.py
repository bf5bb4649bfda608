"""Electrical circuit of a bearing: contacts of all elements, and coating and capacitances next to them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.quantities.field_metadata import stored
from ehlectric.runtime.display import read_only_property

# Relative difference of voltages that are equal within rounding, such as of elements that share the load
# evenly. Without it the processor would choose the contact that is named.
EQUAL = 1e-6


def series(first: Array, second: Array) -> Array:
    """Capacitance of two capacitors in series, C1 C2/(C1 + C2) [F], or admittance of two of them [S].

    Examples
    --------
    >>> float(series(np.array(2e-10), np.array(2e-10)))
    1e-10
    """
    return first * second / (first + second)


@dataclass(frozen=True)
class Circuit:
    """Capacitances of a bearing's contacts and the voltages at which their films break down.

    Of one bearing, or of many points of operation: arrays then have the shape of the points before the axis
    of the n elements.

    Examples
    --------
    Two equal contacts have half of the bearing voltage each. The inner one, which withstands 5 V, breaks down
    at a bearing voltage of 10 V. The outer one then carries the whole voltage, up to 20 V:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> [float(value) for value in (circuit.capacitance, circuit.first_break, circuit.ring_to_ring_breakdown)]
    [5e-11, 10.0, 20.0]

    By Weibull's law the voltage of the first break falls with the number of equal contacts to the power -1/m,
    here from 10 V for a single contact to 5 V for four:

    >>> pair, both = np.full(2, 1e-10), np.full(2, 5.0)
    >>> round(float(Circuit(pair, pair, both, both, shape=2.0).first_break), 9)
    5.0
    """

    # inner and outer: capacitance of the contact of each element with the inner and the outer ring [F],
    # shape (..., n).
    inner: Array
    outer: Array
    # inner_breakdown and outer_breakdown: breakdown voltage of each contact by itself [V]; infinite without a
    # dielectric strength, shape (..., n).
    inner_breakdown: Array
    outer_breakdown: Array
    # Shape parameter m of Weibull's law. The breakdown voltages then have a probability of 63.2 %.
    # None for a strength without scatter.
    shape: Numbers | None = None

    @read_only_property
    def elements(self) -> Array:
        """Capacitance of each element from ring to ring, shape (..., n) [F]."""
        return series(self.inner, self.outer)

    @read_only_property
    def capacitance(self) -> Numbers:
        """Capacitance of the bearing, shape (...) [F]."""
        total: Numbers = np.sum(self.elements, axis=-1)
        return total

    @read_only_property
    def inner_share(self) -> Array:
        """Share of the bearing voltage on each inner contact, shape (..., n); the outer one has the rest."""
        return self.outer / (self.inner + self.outer)

    @read_only_property
    def inner_breaks(self) -> Array:
        """Bearing voltages at which the inner contacts break down, outer ones intact, shape (..., n) [V]."""
        return self.inner_breakdown / self.inner_share

    @read_only_property
    def outer_breaks(self) -> Array:
        """Bearing voltages at which the outer contacts break down, inner ones intact, shape (..., n) [V]."""
        return self.outer_breakdown / (1.0 - self.inner_share)

    @read_only_property
    def inner_first(self) -> Mask:
        """Whether the inner contact breaks down before or with the outer one, shape (..., n)."""
        # Equal within rounding, as in thrust bearings whose contacts are alike, they break down together.
        return self.inner_breaks <= self.outer_breaks * (1.0 + EQUAL)

    @read_only_property
    def first_breaks(self) -> Array:
        """Bearing voltages at which the first contact of each element breaks down, shape (..., n) [V]."""
        return np.minimum(self.inner_breaks, self.outer_breaks)

    @read_only_property
    def first_break(self) -> Numbers:
        """Smallest bearing voltage at which a contact breaks down, shape (...) [V].

        With Weibull's law, it is the voltage at which the probability that any contact has broken down is
        63.2 %. The exponents (V/V_k)^m of all contacts then add up to 1, where V_k is the bearing voltage at
        which contact k by itself has this probability.

        W. Weibull, J. Appl. Mech. 18 (1951) 293, doi:10.1115/1.4010337.
        """
        least: Numbers = np.min(self.first_breaks, axis=-1)
        finite = np.isfinite(least)
        if self.shape is None or not np.any(finite):
            return least
        breaks = np.concatenate([self.inner_breaks, self.outer_breaks], axis=-1)
        # Number of contacts as weak as the weakest one. Powers of the voltages themselves would overflow.
        shape = np.asarray(self.shape)[..., np.newaxis]
        weakest = np.where(finite, least, 1.0)[..., np.newaxis]
        number = np.sum((weakest / breaks) ** shape, axis=-1)
        together: Numbers = np.where(finite, least * number ** (-1.0 / self.shape), least)[()]
        return together

    @property
    def ring_to_ring_breakdown(self) -> Numbers:
        """Smallest bearing voltage at which an element breaks down from ring to ring, shape (...) [V].

        After the first contact of an element has broken down, the other one carries the whole bearing
        voltage. With Weibull's law, each contact breaks down at the voltage of its own 63.2 %.
        """
        return shaft_ring_to_ring_breakdown(self, Path())


def leakage_conductance(
    inner: tuple[Array, Array], outer: tuple[Array, Array], relaxation_time: Numbers
) -> Numbers:
    """Conductance of a bearing whose oil conducts, at frequencies far above the corner frequency of the oil.

    Both contacts of an element are in series and share the voltage by their capacitances C. With the
    conductances G = C_oil/tau, an element has (G_i C_o^2 + G_o C_i^2)/(C_i + C_o)^2.

    ``inner`` and ``outer``, capacitance of each element's contact with the ring, and the part of it in oil
    [F], shape (..., n); ``relaxation_time``, charge relaxation time tau = eps0 eps_r/sigma of the oil [s],
    shape (...). Returns conductance [S], shape (...).

    Examples
    --------
    With oil everywhere, it is the capacitance of the bearing over tau:

    >>> both = np.array([2e-10]), np.array([2e-10])
    >>> float(leakage_conductance(both, both, 1.0))
    1e-10
    """
    (first, first_oil), (second, second_oil) = inner, outer
    share = second / (first + second)
    oil: Numbers = np.sum(first_oil * share**2 + second_oil * (1.0 - share) ** 2, axis=-1)
    return oil / relaxation_time


def leaking_admittance(
    inner: tuple[Array, Array], outer: tuple[Array, Array], relaxation_time: float, frequency: Array
) -> Array:
    """Admittance of a bearing whose oil conducts, while the air around its films does not.

    A contact has the admittance i 2 pi f C + C_oil/tau. Both contacts of an element are in series, and the
    elements are in parallel.

    ``inner`` and ``outer``, capacitance of each element's contact with the ring, and the part of it in oil
    [F], shape (n,); ``relaxation_time``, charge relaxation time tau = eps0 eps_r/sigma of the oil [s];
    ``frequency`` [Hz], shape (m,). Returns admittance [S], shape (m,).

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


@dataclass(frozen=True)
class Path:
    """Capacitances between shaft and housing in parallel to the films.

    Examples
    --------
    Films of 250 pF behind a coating of 1 nF have four fifths of the shaft voltage. A meter reads the 200 pF
    of both in series, and 30 pF of cage and wiring:

    >>> path = Path(coating=1e-9, parallel=30e-12)
    >>> path.film_share(250e-12), round(1e12 * path.total(250e-12), 6)
    (0.8, 230.0)
    """

    # Capacitance of the coating on a ring, in series with all films [F]; infinite without a coating.
    coating: Numbers = field(default=math.inf, metadata=stored("", "F", "positive or infinite"))
    # Capacitance of cage, shields and wiring, parallel to films and coating [F].
    parallel: Numbers = field(default=0.0, metadata=stored("", "F", "not negative"))
    # Insulation resistance of the coating [Ohm]; infinite where it does not leak.
    resistance: Numbers = field(default=math.inf, metadata=stored("", "ohm", "positive or infinite"))
    coating_breakdown: Numbers | None = field(
        default=None, metadata=stored("", "V", "finite or NaN", unknown=True)
    )  # breakdown voltage of only the coating [V]; None without one

    @property
    def coated(self) -> bool:
        """Whether a ring has a coating."""
        return bool(np.all(np.isfinite(self.coating)))

    def film_share(self, films: Numbers) -> Numbers:
        """Share of the shaft voltage across films of a capacitance [F], C_c/(C_c + C), dimensionless.

        The share is the share of a capacitive divider: right after an edge of the voltage, and at frequencies
        far above the frequencies at which oil and coating conduct.
        """
        return 1.0 / (1.0 + films / self.coating)

    def total(self, films: Numbers) -> Numbers:
        """Capacitance from shaft to housing with films of a capacitance [F]."""
        return self.parallel + films * self.film_share(films)

    def behind_coating(self, other: Numbers) -> Numbers:
        """Capacitance C_s C_c/(C_s + C_c) [F] of another capacitance C_s [F] that is behind the coating."""
        return other / (1.0 + other / self.coating)

    def admittance(self, films: Array, frequency: Array) -> Array:
        """Admittance from shaft to housing with films of an admittance [S], shape (n,). ``films`` [S],
        shape (n,); ``frequency`` [Hz], shape (n,). Returns admittance Y_c Y/(Y_c + Y) + i 2 pi f C_p [S],
        with Y_c = i 2 pi f C_c + 1/R_c of the coating, shape (n,).
        """
        omega = 2.0 * np.pi * frequency
        through = films
        if self.coated:
            of_coating = 1j * omega * self.coating + 1.0 / self.resistance
            through = films * of_coating / (films + of_coating)
        y: Array = through + 1j * omega * self.parallel
        return y


def shaft_first_break(circuit: Circuit, path: Path) -> Numbers:
    """Smallest shaft voltage at which a contact breaks down, shape (...) [V].

    Examples
    --------
    The films of the example of ``Circuit`` break down at 10 V. A coating of the same capacitance as theirs
    takes half of the shaft voltage:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> float(shaft_first_break(circuit, Path(coating=5e-11)))
    20.0
    """
    return circuit.first_break / path.film_share(circuit.capacitance)


def shaft_ring_to_ring_breakdown(circuit: Circuit, path: Path) -> Numbers:
    """Smallest shaft voltage at which an element breaks down from ring to ring, shape (...) [V].

    After the first contact of an element has broken down, the capacitance of its element equals the
    capacitance of the other contact. The capacitance of the films is then larger, and their share of the
    shaft voltage smaller.

    Examples
    --------
    Both contacts of the only element have 100 pF. After the first breakdown, the films have 100 pF in place
    of 50 pF, and a third of the shaft voltage instead of a half. The other contact withstands 20 V:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> round(float(shaft_ring_to_ring_breakdown(circuit, Path(coating=5e-11))), 9)
    60.0
    """
    other = np.where(circuit.inner_first, circuit.outer, circuit.inner)
    remaining = np.where(circuit.inner_first, circuit.outer_breakdown, circuit.inner_breakdown)
    films = np.asarray(circuit.capacitance)[..., np.newaxis]
    first, second = (
        1.0 + values / np.asarray(path.coating)[..., np.newaxis]
        for values in (films, films - circuit.elements + other)
    )
    least: Numbers = np.min(np.maximum(circuit.first_breaks * first, remaining * second), axis=-1)
    return least
