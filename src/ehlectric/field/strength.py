"""Largest field strength in the gap of a contact, shared by line and point contacts."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.runtime.stored import number, stored
from ehlectric.runtime.values import Values

# Long names in files of results.
_POSITION = "position along entrainment, columns of the field"
_FRACTION = "fraction of the gap, from surface 1 to surface 2"
_STRENGTH = "electric field strength"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class GapField(Values):
    """Electric potential and field strength in the gap of a contact, in SI units.

    The two walls are the surfaces of the contact; both are conductors of constant potential. Values of
    columns have the shape (nx,) in a line contact and (nx, ny) in a point contact; values in the gap have a
    last axis across it, of length ns.

    Attributes
    ----------
    x, s : ndarray, shapes (nx,), (ns,)
        Position along the gap [m]; height above the lower wall over the gap, from 0 to 1.
    permittivity, potential : ndarray, shape (..., ns)
        Relative permittivity and potential [V].
    field_x, field_y, strength : ndarray, shape (..., ns)
        Components of E = -grad V and its magnitude [V/m].
    middle_strength : ndarray
        abs(E) at s = 1/2 [V/m].
    thin_gap_strength : ndarray
        Voltage over the gap of each column [V/m].
    capacitance_density : ndarray
        Charge of wall 2 per area and voltage [F/m^2]. Its integral is ``capacitance_by_charge``: by the
        trapezoidal rule over x, or its sum weighted with ``node_areas``.
    voltage : float
        Magnitude of the potential difference of the walls [V].
    capacitance, capacitance_by_charge : float
        Capacitance [F], of a line contact per length [F/m], from the energy of the field and from the charge
        of wall 2. Free charge in the gap is left out. The two values agree, unless potentials are prescribed
        on the end faces.
    thin_gap_capacitance : float
        Integral of eps0 eps/h over the columns [F or F/m].
    strength_error : float or None
        Estimated relative error of the largest field strength; None if it is not known, which it is only for
        a permittivity that is constant across the gap, without charge and without prescribed potentials of
        the end faces.
    sufficient_degree : int or None
        Polynomial degree across the gap at which its part of that error is below 0.5 %; None if it is not
        known.
    """

    x: Array = field(metadata=stored("x_field", "m", "increasing", _POSITION, name="x_field"))
    s: Array = field(metadata=stored("s", "1", "increasing", _FRACTION))
    permittivity: Array = field(metadata=stored("columns s", "1", "positive", "relative permittivity"))
    potential: Array = field(metadata=stored("columns s", "V", "finite", "electric potential"))
    field_x: Array = field(metadata=stored("columns s", "V/m", "finite", "electric field along x"))
    field_y: Array = field(metadata=stored("columns s", "V/m", "finite", "electric field along y"))
    strength: Array = field(metadata=stored("columns s", "V/m", "not negative", _STRENGTH))
    middle_strength: Array = field(
        metadata=stored("columns", "V/m", "not negative", f"{_STRENGTH} at mid-film")
    )
    thin_gap_strength: Array = field(
        metadata=stored("columns", "V/m", "positive", "voltage / film thickness")
    )
    capacitance_density: Array = field(metadata=stored("columns", "F/m^2", "finite", "capacitance per area"))
    voltage: float = field(metadata=number("positive"))
    capacitance: float = field(metadata=number("positive"))
    capacitance_by_charge: float = field(metadata=number("finite"))
    thin_gap_capacitance: float = field(metadata=number("positive"))
    strength_error: float | None = field(default=None, metadata=number())
    sufficient_degree: int | None = field(default=None, metadata=number())

    @property
    def column_strength(self) -> Array:
        """Largest abs(E) of each column, on either wall or at mid-film [V/m]."""
        strength: Array = np.max(self._sections, axis=0)
        return strength

    @property
    def max_strength(self) -> float:
        """Largest abs(E) on either wall or at mid-film [V/m]."""
        return float(np.max(self._sections))

    @property
    def max_strength_wall(self) -> str:
        """Location of the largest abs(E) across the film: "surface 1", "mid-film" or "surface 2"."""
        sections = self._sections.reshape(3, -1)
        return ("surface 1", "mid-film", "surface 2")[int(np.argmax(np.max(sections, axis=1)))]

    @property
    def _sections(self) -> Array:
        return np.stack([self.strength[..., 0], self.middle_strength, self.strength[..., -1]])
