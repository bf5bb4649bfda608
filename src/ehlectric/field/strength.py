"""Largest field strength in the gap of a contact, shared by line and point contacts."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.runtime.values import Values


class GapField(Values):
    """Electric field in the gap between two walls, of a line or a point contact.

    Attributes
    ----------
    strength : ndarray, shape (nx, ns) or (nx, ny, ns)
        abs(E) at the nodes [V/m]; the last axis runs across the gap.
    middle_strength : ndarray, shape (nx,) or (nx, ny)
        abs(E) at mid-film [V/m].
    strength_error : float or None
        Estimated relative error of the largest field strength; None if it is not known.
    sufficient_degree : int or None
        Polynomial degree across the gap at which its part of that error is below 0.5 %.
    """

    strength: Array
    middle_strength: Array
    strength_error: float | None
    sufficient_degree: int | None

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
