"""Elastic rings under pressure: growth of their diameters by Lame, and pressure of an interference fit."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ThickRing:
    """Plain ring, shaft or housing of one material, in plane stress.

    Attributes
    ----------
    inner_diameter : float
        Diameter of the bore [m]; 0 for a solid shaft.
    outer_diameter : float
        Outer diameter [m]; infinite for a housing without an end.
    youngs_modulus : float
        Young's modulus E [Pa].
    poissons_ratio : float
        Poisson's ratio, dimensionless.
    expansion : float
        Coefficient of thermal expansion [1/K].

    Notes
    -----
    With the pressures p_i in the bore d and p_o on the outside D, Lame's solution for a ring whose faces are
    free (plane stress) has the circumferential strain

        E e(r) = (1 - nu) (p_i d^2 - p_o D^2)/(D^2 - d^2)
                 + (1 + nu) (p_i - p_o) d^2 D^2/(D^2 - d^2)/(2 r)^2,

    and a diameter 2 r grows by 2 r e(r). R. Beardmore, Roymech, "Cylinders",
    http://www.roymech.co.uk/Useful_Tables/Mechanics/Cylinders.html, derives the same equations.
    """

    inner_diameter: float
    outer_diameter: float
    youngs_modulus: float
    poissons_ratio: float
    expansion: float

    def growth(self, diameter: float, *, bore_pressure: float = 0.0, outside_pressure: float = 0.0) -> float:
        """Growth of a diameter of the ring under pressure from inside and from outside.

        Parameters
        ----------
        diameter : float
            Diameter in the ring [m], from the bore to the outer diameter.
        bore_pressure, outside_pressure : float
            Pressures in the bore and on the outside [Pa].

        Returns
        -------
        float
            Change of the diameter [m], negative where it shrinks.

        Examples
        --------
        A thin ring of 1 m and 10 mm grows by p d^2/(2 t E), here 1 MPa (1 m)^2/(20 mm 200 GPa):

        >>> thin = ThickRing(1.0, 1.02, 200e9, 0.3, 12e-6)
        >>> round(1e6 * thin.growth(1.0, bore_pressure=1e6))
        254
        """
        square = self.inner_diameter**2
        ratio = (self.inner_diameter / self.outer_diameter) ** 2
        mean = (bore_pressure * ratio - outside_pressure) / (1.0 - ratio)
        # A solid shaft has no second term, and its centre a diameter of 0.
        other = (bore_pressure - outside_pressure) * square / (1.0 - ratio) / diameter if square else 0.0
        nu = self.poissons_ratio
        return ((1.0 - nu) * mean * diameter + (1.0 + nu) * other) / self.youngs_modulus

    def warmed(self, diameter: float, rise: float) -> float:
        """Growth of a diameter [m] of the free ring under a rise of its temperature [K]."""
        return self.expansion * rise * diameter


def fit_pressure(within: ThickRing, around: ThickRing, interference: float) -> float:
    """Pressure in an interference fit of two rings.

    Parameters
    ----------
    within : ThickRing
        Inner one of both, such as a shaft.
    around : ThickRing
        Outer one of both, such as the inner ring of a bearing.
    interference : float
        Diameter of the inner one less the bore of the outer one, both free [m]; negative for a loose fit.

    Returns
    -------
    float
        Pressure [Pa]; 0 for a loose fit.

    Notes
    -----
    The pressure at which the bore of the outer one grows, and the outside of the inner one shrinks, by the
    interference together.

    Examples
    --------
    For a solid shaft and a ring of the same material, p = E delta (1 - d^2/D^2)/(2 d):

    >>> shaft = ThickRing(0.0, 40e-3, 208e9, 0.3, 12.5e-6)
    >>> ring = ThickRing(40e-3, 48e-3, 208e9, 0.3, 12.5e-6)
    >>> pressure = fit_pressure(shaft, ring, 10e-6)
    >>> round(pressure / (208e9 * 10e-6 * (1 - (40 / 48) ** 2) / (2 * 40e-3)), 12)
    1.0
    """
    if interference <= 0.0:
        return 0.0
    diameter = around.inner_diameter
    compliance = around.growth(diameter, bore_pressure=1.0) - within.growth(
        within.outer_diameter, outside_pressure=1.0
    )
    return interference / compliance
