"""Nodes of the atlas: dimensionless groups, the film problems that have them, and the numbers stored of
each film.

A smooth, fully flooded, isothermal contact has Moes' groups M and L, and for points the ratio k of the
semi-axes, k = a/b with a across entrainment. The scales of the film equations follow only from them. For
lines

    lambda = 3 pi^2/(8 M^2),   alpha p_h = L (M/(2 pi))^(1/2),   H_Moes = (8 M/pi) H,

and for points, with q = (2/pi) R_D(0, k^2, 1) and N = M q^(1/4)/k^(3/4),

    lambda = 4 pi/N^(4/3),   alpha p_h = 3 L M^(1/3)/(2 pi k q^(2/3)),   H_Moes = (q M)^(2/3) H

with H = h R/b^2 and H_Moes = (h/R) (eta0 u_s/(E' R))^(-1/2); R is the radius along entrainment.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.arrays import Numbers, as_float
from ehlectric.formulas.carlson import complete_rd
from ehlectric.formulas.film_line import LineContact, moes
from ehlectric.formulas.film_point import PointContact, load_exponent, nijenbanning_venner_moes

# Speed parameter eta0 u_s/(E' R) with which formulas in SI units are evaluated; it cancels.
_U = 1e-11

# Domain: least inlet and sides in semi-axes, and factors of the length sqrt(2 h R) over which a thick film
# builds up, at which the domain costs the film at most 0.15 %.
_INLET, OUTLET, _INLET_LENGTHS = 4.5, 1.5, 18.0
_SIDE, _SIDE_LENGTHS = 1.6, 7.0


# Exponent of the load group in the lubricant coordinate Y = L N^(1/6). In bearings L falls and N rises with
# the viscosity and the speed, so that L and N are correlated, whereas the correlation of Y and N is weak.
SKEW = 1.0 / 6.0


@dataclass(frozen=True)
class Ellipse:
    """Shape of the dry contact of points: numbers, or arrays of shape (...)."""

    ratio: Numbers  # ratio k of the semi-axes, across over along entrainment
    radius_ratio: Numbers  # Ry/Rx
    q: Numbers  # factor q = (2/pi) R_D(0, k^2, 1) of b^3 = q F Rx/E'

    @classmethod
    def of(cls, ratio: Numbers, radius_ratio: Numbers | None = None) -> Ellipse:
        """Shape of contacts with a ratio of the semi-axes; ``radius_ratio``, Ry/Rx, where it is known."""
        size = complete_rd(ratio**2, 1.0)
        if radius_ratio is None:
            radius_ratio = as_float(size / complete_rd(1.0, ratio**2))
        return cls(ratio, as_float(radius_ratio), as_float(2.0 / math.pi * size))

    def among(self, shape: tuple[int, ...], places: Any) -> Ellipse:
        """Shapes of those contacts of an array of a ``shape`` that an index ``places`` picks."""
        return Ellipse(*(np.broadcast_to(values, shape)[places] for values in vars(self).values()))


@dataclass(frozen=True)
class Groups:
    """Moes' groups of a contact, or of many contacts: arrays that broadcast to a shape (...)."""

    # moes_m and moes_l: M and L, dimensionless. L is made with ``film_coefficient`` of the oil
    moes_m: Numbers
    moes_l: Numbers
    # Ratio k of the semi-axes, across over along entrainment; None for a line contact.
    ratio: Numbers | None = None
    # Shape of the dry contact with this ratio, where it is known already.
    known_ellipse: Ellipse | None = field(default=None, compare=False, repr=False)

    @cached_property
    def ellipse(self) -> Ellipse:
        """Shape of the dry contact of points."""
        assert self.ratio is not None
        return Ellipse.of(self.ratio) if self.known_ellipse is None else self.known_ellipse

    @property
    def _q(self) -> Numbers:
        return self.ellipse.q

    @property
    def radius_ratio(self) -> Numbers:
        """Ry/Rx, from the ratio of the semi-axes."""
        return self.ellipse.radius_ratio

    @cached_property
    def load_group(self) -> Numbers:
        """N of a point contact, M of a line contact: the group of the velocity parameter lambda."""
        if self.ratio is None:
            return self.moes_m
        return as_float(self.moes_m * (self._q**0.25 / self.ratio**0.75))

    @property
    def line_load(self) -> Numbers:
        """M of the line contact with the same velocity parameter."""
        if self.ratio is None:
            return self.load_group
        return as_float(math.sqrt(3.0 * math.pi / 32.0) * self.load_group ** (2.0 / 3.0))

    @property
    def velocity_parameter(self) -> Numbers:
        """Velocity parameter lambda = 6 eta0 u_s R^2/(b^3 p_h)."""
        if self.ratio is None:
            return 3.0 * math.pi**2 / (8.0 * self.moes_m**2)
        return as_float(4.0 * math.pi / self.load_group ** (4.0 / 3.0))

    @cached_property
    def hertz_number(self) -> Numbers:
        """Product alpha p_h, the Hertz pressure in units of 1/alpha."""
        if self.ratio is None:
            return as_float(self.moes_l * np.sqrt(self.moes_m / (2.0 * math.pi)))
        return as_float(
            np.cbrt(self.moes_m) * (1.5 / math.pi * self.moes_l / self._q ** (2.0 / 3.0) / self.ratio)
        )

    @property
    def thickness_unit(self) -> Numbers:
        """Film thickness in Moes' unit that corresponds to H = h R/b^2 = 1."""
        if self.ratio is None:
            return 8.0 * self.moes_m / math.pi
        return as_float((self._q * self.moes_m) ** (2.0 / 3.0))

    @cached_property
    def formula(self) -> Numbers:
        """Central film in Moes' unit by the formula of Moes, or of Nijenbanning, Venner and Moes."""
        if self.ratio is None:
            line = LineContact(
                reduced_radius=1.0,
                reduced_modulus=1.0,
                load_per_length=self.moes_m * _U**0.5,
                entrainment_speed=0.5 * _U,
                viscosity=1.0,
                pressure_viscosity_coefficient=self.moes_l / _U**0.25,
            )
            return as_float(moes(line).central_thickness / _U**0.5)
        return as_float(nijenbanning_venner_moes(self._point).central_thickness / _U**0.5)

    @property
    def _point(self) -> PointContact:
        """Point contact of radius and modulus 1 with these groups."""
        load, coefficient = self.moes_m * _U**0.75, self.moes_l / _U**0.25
        return PointContact(
            radius_x=1.0,
            radius_y=self.radius_ratio,
            reduced_modulus=1.0,
            load=load,
            entrainment_speed=0.5 * _U,
            viscosity=1.0,
            pressure_viscosity_coefficient=coefficient,
        )

    @property
    def load_exponent(self) -> Numbers:
        """Exponent with which the film of a point contact falls over the load, by the formula."""
        return load_exponent(self._point)

    @property
    def domain(self) -> tuple[Numbers, Numbers]:
        """Inlet length and half the width of the atlas domain, both in b.

        The width of a line contact is without meaning, and zero.
        """
        length = np.sqrt(self.formula / self.thickness_unit)
        inlet = as_float(np.maximum(_INLET, _INLET_LENGTHS * length))
        if self.ratio is None:
            return inlet, 0.0
        least = np.minimum(4.5, _SIDE + 1.4 / self.ratio)
        needed = _SIDE * self.ratio + _SIDE_LENGTHS * length * np.sqrt(self.radius_ratio)
        return inlet, as_float(np.maximum(least * self.ratio, needed))


def lubricant_coordinate(groups: Groups) -> Numbers:
    """Coordinate Y = L N^(1/6) of a contact with the load group N, M for a line contact.

    Examples
    --------
    >>> lubricant_coordinate(Groups(64.0, 10.0))
    20.0
    """
    return as_float(groups.moes_l * groups.load_group**SKEW)
