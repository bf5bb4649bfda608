"""Size of a dry contact, from which values per length become those of the whole contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.cases.discharge import Discharge


@dataclass(frozen=True)
class Size:
    """Size of the dry contact.

    Attributes
    ----------
    half_width : float
        Half-width of a line contact, or semi-axis of a point contact along entrainment [m].
    hertz : float
        Width of a dry line contact [m], or area of a dry point contact [m^2].
    length : float or None
        Length of a line contact [m], None if the case does not give it; 1 for a point contact.
    line : bool
        Whether the contact is a line contact.
    """

    half_width: float
    hertz: float
    length: float | None
    line: bool

    @classmethod
    def of(cls, semi_axes: tuple[float, ...], discharge: Discharge) -> Size:
        """Size of a dry contact from its half-width [m], or from its two semi-axes [m]."""
        b = semi_axes[0]
        if len(semi_axes) == 1:
            return cls(b, 2.0 * b, discharge.length, line=True)
        return cls(b, np.pi * b * semi_axes[1], 1.0, line=False)

    def total(self, per_length: float) -> float | None:
        """Value of the whole contact from a value per length; None for a line contact of unknown length.

        A value of a point contact is returned unchanged.
        """
        return None if self.length is None else self.length * per_length
