"""What a field in a gap has in two and in three dimensions: where and how strong it is at the most."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array


class GapField:
    """A field between two walls, its arrays by column and, the last axis, by node across the gap."""

    strength: Array
    middle_strength: Array

    @property
    def column_strength(self) -> Array:
        """Largest abs(E) of every column, on either wall or mid-film [V/m]."""
        strength: Array = np.max(self._sections, axis=0)
        return strength

    @property
    def max_strength(self) -> float:
        """Largest abs(E) on either wall or mid-film [V/m]."""
        return float(np.max(self._sections))

    @property
    def max_strength_wall(self) -> str:
        """Where across the film the largest abs(E) is: "surface 1", "mid-film" or "surface 2"."""
        sections = self._sections.reshape(3, -1)
        return ("surface 1", "mid-film", "surface 2")[int(np.argmax(np.max(sections, axis=1)))]

    @property
    def _sections(self) -> Array:
        return np.stack([self.strength[..., 0], self.middle_strength, self.strength[..., -1]])
