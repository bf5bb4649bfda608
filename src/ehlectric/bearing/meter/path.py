"""Circuit between shaft and housing: films in series with a coating, and a capacitance parallel to both."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import Circuit
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.runtime.stored import stored


@dataclass(frozen=True)
class Path:
    """Capacitances between shaft and housing beside those of the films.

    Attributes
    ----------
    coating : float
        Capacitance of the coating on a ring, in series with all films [F]; infinite without a coating.
    parallel : float
        Capacitance of cage, shields and wiring, parallel to films and coating [F].
    resistance : float
        Insulation resistance of the coating [Ohm]; infinite where it does not leak.
    coating_breakdown : float or None
        Breakdown voltage of the coating alone [V]; None without one.

    Examples
    --------
    Films of 250 pF behind a coating of 1 nF have four fifths of the shaft voltage. A meter reads the 200 pF
    of both in series, and 30 pF of cage and wiring:

    >>> path = Path(coating=1e-9, parallel=30e-12)
    >>> path.film_share(250e-12), round(1e12 * path.total(250e-12), 6)
    (0.8, 230.0)
    """

    coating: float = field(default=math.inf, metadata=stored("", "F", "positive or infinite"))
    parallel: float = field(default=0.0, metadata=stored("", "F", "not negative"))
    resistance: float = field(default=math.inf, metadata=stored("", "ohm", "positive or infinite"))
    coating_breakdown: float | None = field(
        default=None, metadata=stored("", "V", "finite or NaN", unknown=True)
    )

    @property
    def coated(self) -> bool:
        """Whether a ring has a coating."""
        return math.isfinite(self.coating)

    def film_share(self, films: float) -> float:
        """Share of the shaft voltage across films of a capacitance [F], C_c/(C_c + C), dimensionless.

        The share is that of a capacitive divider: right after an edge of the voltage, and at frequencies far
        above those at which oil and coating conduct.
        """
        return 1.0 / (1.0 + films / self.coating)

    def film_shares(self, films: Array) -> Array:
        """Share of the shaft voltage across films of several capacitances [F], as ``film_share``."""
        shares: Array = 1.0 / (1.0 + films / self.coating)
        return shares

    def total(self, films: float) -> float:
        """Capacitance from shaft to housing with films of a capacitance [F]."""
        return self.parallel + films * self.film_share(films)

    def behind_coating(self, beside: float) -> float:
        """Capacitance C_s C_c/(C_s + C_c) [F] of another capacitance C_s [F] that is behind the coating."""
        return beside / (1.0 + beside / self.coating)

    def admittance(self, films: Array, frequency: Array) -> Array:
        """Admittance from shaft to housing with films of an admittance [S], shape (n,).

        Parameters
        ----------
        films : ndarray of complex, shape (n,)
            Admittance of the films [S].
        frequency : ndarray, shape (n,)
            Frequency f [Hz].

        Returns
        -------
        ndarray of complex, shape (n,)
            Admittance Y_c Y/(Y_c + Y) + i 2 pi f C_p [S], with Y_c = i 2 pi f C_c + 1/R_c of the coating.
        """
        omega = 2.0 * np.pi * frequency
        through = films
        if self.coated:
            own = 1j * omega * self.coating + 1.0 / self.resistance
            through = films * own / (films + own)
        y: Array = through + 1j * omega * self.parallel
        return y


def path_of(bearing: Bearing) -> Path:
    """Circuit between shaft and housing of a bearing, beside its films.

    Parameters
    ----------
    bearing : Bearing
        Table ``[bearing]`` of the file.

    Returns
    -------
    Path
        Capacitances in SI units; without the keys there is no coating and no parallel capacitance.
    """
    coating = bearing.coating
    if coating is None:
        return Path(parallel=bearing.parallel_capacitance or 0.0)
    return Path(
        coating=bearing.coating_capacitance(),
        parallel=bearing.parallel_capacitance or 0.0,
        resistance=math.inf if coating.resistance is None else coating.resistance,
        coating_breakdown=coating.voltage,
    )


def shaft_first_break(circuit: Circuit, path: Path) -> float:
    """Smallest shaft voltage at which a contact breaks down [V].

    Examples
    --------
    The films of the example of ``Circuit`` break down at 10 V. A coating of the same capacitance as theirs
    takes half of the shaft voltage:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> shaft_first_break(circuit, Path(coating=5e-11))
    20.0
    """
    return circuit.first_break / path.film_share(circuit.capacitance)


def shaft_through_breakdown(circuit: Circuit, path: Path) -> float:
    """Smallest shaft voltage at which an element breaks down from ring to ring [V].

    After the first contact of an element has broken down, the capacitance of its element is that of the other
    contact. The capacitance of the films is then larger, and their share of the shaft voltage smaller.

    Examples
    --------
    Both contacts of the only element have 100 pF. After the first breakdown, the films have 100 pF in place
    of 50 pF, and a third of the shaft voltage instead of a half. The other contact withstands 20 V:

    >>> circuit = Circuit(np.array([1e-10]), np.array([1e-10]), np.array([5.0]), np.array([20.0]))
    >>> round(shaft_through_breakdown(circuit, Path(coating=5e-11)), 9)
    60.0
    """
    other = np.where(circuit.inner_first, circuit.outer, circuit.inner)
    remaining = np.where(circuit.inner_first, circuit.outer_breakdown, circuit.inner_breakdown)
    shorted = circuit.capacitance - circuit.elements + other
    first = circuit.first_breaks / path.film_share(circuit.capacitance)
    return float(np.min(np.maximum(first, remaining / path.film_shares(shorted))))
