"""Moes groups, published film-thickness formulas of point contacts, and lubrication regimes.

The formulas are fits to solutions of their time; they differ from each other and from the solved film by
up to 40 %. They stand beside a result, never in its place. x is the direction of entrainment, y across it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.formulas.film_line import BothThicknesses, CentralThickness, Formula, dominant
from ehlectric.formulas.hertz_point import axis_ratio


@dataclass(frozen=True)
class PointContact:
    """What the formulas ask of a point contact, SI units.

    Parameters
    ----------
    radius_x, radius_y : float
        Reduced radii along and across entrainment [m].
    reduced_modulus : float
        E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    load : float
        F [N].
    entrainment_speed : float
        Mean surface speed (u1 + u2)/2 [m/s].
    viscosity : float
        eta0 at zero pressure [Pa s].
    pressure_viscosity_coefficient : float
        alpha [1/Pa]; zero for an isoviscous lubricant.
    """

    radius_x: float
    radius_y: float
    reduced_modulus: float
    load: float
    entrainment_speed: float
    viscosity: float
    pressure_viscosity_coefficient: float

    @property
    def _u(self) -> float:
        """Speed parameter of the mean speed, eta0 u/(E' Rx)."""
        return self.viscosity * self.entrainment_speed / (self.reduced_modulus * self.radius_x)

    @property
    def _g(self) -> float:
        """Materials parameter, alpha E'."""
        return self.pressure_viscosity_coefficient * self.reduced_modulus

    @property
    def _w(self) -> float:
        """Load parameter, F/(E' Rx^2)."""
        return self.load / (self.reduced_modulus * self.radius_x**2)

    @property
    def moes_m(self) -> float:
        """Moes load group, M = F/(E' Rx^2) (eta0 u_s/(E' Rx))^(-3/4) with u_s = u1 + u2."""
        return self._w * float((2.0 * self._u) ** -0.75)

    @property
    def moes_l(self) -> float:
        """Moes lubricant group, L = alpha E' (eta0 u_s/(E' Rx))^(1/4) with u_s = u1 + u2."""
        return self._g * float((2.0 * self._u) ** 0.25)


def hamrock_dowson(contact: PointContact) -> BothThicknesses:
    """Films of Hamrock and Dowson.

    Minimum h/Rx = 3.63 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k)), central h/Rx = 2.69 U^0.67 G^0.53 W^-0.067
    (1 - 0.61 exp(-0.73 k)), with the ratio k of the semi-axes, across entrainment over along it.

    Parameters
    ----------
    contact : PointContact
        With U of the mean speed.
        For piezoviscous lubricants: zero without a pressure-viscosity coefficient.

    Returns
    -------
    Thickness
        Minimum and central film [m].

    Notes
    -----
    B. J. Hamrock and D. Dowson, J. Lubr. Technol. 99 (1977) 264-275, doi:10.1115/1.3453074. From solutions of
    k from 1 to 8, entrainment along the minor axis, and U, W and G of hard contacts: steel and oil. Beyond
    its range where Ry is below Rx. The exact k stands in place of their fit 1.03 (Ry/Rx)^0.64, 3 % off for a
    circle.

    Examples
    --------
    >>> contact = PointContact(10e-3, 10e-3, 226e9, 20.0, 2.0, 0.04, 22e-9)
    >>> film = hamrock_dowson(contact)
    >>> round(film.minimum_thickness * 1e6, 3), round(film.central_thickness * 1e6, 3)
    (0.251, 0.438)
    """
    u, g, w = contact._u, contact._g, contact._w
    k = axis_ratio(contact.radius_x, contact.radius_y)
    minimum = 3.63 * u**0.68 * g**0.49 * w**-0.073 * (1.0 - np.exp(-0.68 * k))
    central = 2.69 * u**0.67 * g**0.53 * w**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k))
    return BothThicknesses(
        minimum_thickness=float(minimum * contact.radius_x),
        central_thickness=float(central * contact.radius_x),
    )


def chittenden(contact: PointContact) -> BothThicknesses:
    """Films of Chittenden, Dowson, Dunn and Taylor, for entrainment along either axis of the ellipse.

    Minimum h/Rx = 3.68 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.67 (Ry/Rx)^(2/3))), central
    h/Rx = 4.31 U^0.68 G^0.49 W^-0.073 (1 - exp(-1.23 (Ry/Rx)^(2/3))).

    Parameters
    ----------
    contact : PointContact
        With U of the mean speed; their Re is Rx and their Rs is Ry.
        For piezoviscous lubricants: zero without a pressure-viscosity coefficient.

    Returns
    -------
    Thickness
        Minimum and central film [m].

    Notes
    -----
    R. J. Chittenden, D. Dowson, J. F. Dunn and C. M. Taylor, Proc. R. Soc. Lond. A 397 (1985) 245-294,
    doi:10.1098/rspa.1985.0014 and the paper that follows it there. From solutions of hard contacts,
    entrainment along either axis.

    Examples
    --------
    >>> contact = PointContact(10e-3, 10e-3, 226e9, 20.0, 2.0, 0.04, 22e-9)
    >>> film = chittenden(contact)
    >>> round(film.minimum_thickness * 1e6, 3), round(film.central_thickness * 1e6, 3)
    (0.252, 0.427)
    """
    h = 4.31 * contact._u**0.68 * contact._g**0.49 * contact._w**-0.073 * contact.radius_x
    sides = (contact.radius_y / contact.radius_x) ** (2.0 / 3.0)
    minimum = 3.68 / 4.31 * h * (1.0 - np.exp(-0.67 * sides))
    central = h * (1.0 - np.exp(-1.23 * sides))
    return BothThicknesses(minimum_thickness=float(minimum), central_thickness=float(central))


def _asymptotes(contact: PointContact) -> dict[str, float]:
    """Central H = (h/Rx) (eta0 u_s/(E' Rx))^(-1/2) of the four limits, by regime."""
    moes_m, moes_l = contact.moes_m, contact.moes_l
    d = contact.radius_x / contact.radius_y
    ellipse = 1.0 + 0.006 * float(np.log(d)) + 0.63 * d ** (4 / 7)
    return {
        "isoviscous-rigid": 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / (d * moes_m**2),
        "isoviscous-elastic": 3.18 * ellipse ** (-14 / 25) * d ** (-1 / 15) * moes_m ** (-2 / 15),
        "piezoviscous-rigid": 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * moes_l ** (2 / 3),
        "piezoviscous-elastic": (
            1.48 * ellipse ** (-7 / 20) * d ** (-1 / 24) * moes_m ** (-1 / 12) * moes_l ** (3 / 4)
        ),
    }


def nijenbanning_venner_moes(contact: PointContact) -> CentralThickness:
    """Central film of Nijenbanning, Venner and Moes, over all four regimes.

    H = ((H_RI^(3/2) + (H_EI^-4 + H_00^-4)^(-3/8))^(2s/3) + (H_RP^-8 + H_EP^-8)^(-s/8))^(1/s) with
    s = (3/2) (1 + exp(-1.2 H_EI/H_EP)), H_00 = 1.8/D, D = Rx/Ry, B = 1 + 0.006 ln(D) + 0.63 D^(4/7),
    H_RI = 145 (1 + 0.796 D^(14/15))^(-15/7) D^-1 M^-2, H_EI = 3.18 B^(-14/25) D^(-1/15) M^(-2/15),
    H_RP = 1.29 (1 + 0.691 D)^(-2/3) L^(2/3) and H_EP = 1.48 B^(-7/20) D^(-1/24) M^(-1/12) L^(3/4).

    Parameters
    ----------
    contact : PointContact
        With M and L of the sum of the surface speeds.

    Returns
    -------
    Thickness
        Central film [m].

    Notes
    -----
    G. Nijenbanning, C. H. Venner and H. Moes, Wear 176 (1994) 217-229, doi:10.1016/0043-1648(94)90150-3. For
    D up to 1, entrainment along the minor axis, and all M and L. For D towards 0 each limit is that of
    ``film_line.moes`` at the middle of the long ellipse, where the load per length is 3 F/4 over its
    semi-axis. As there, the film of a rigid isoviscous contact is the one where the pressure gradient
    vanishes, 1.226 of that at the centre. H_00 bounds the film of bodies that hardly touch.

    Examples
    --------
    >>> contact = PointContact(10e-3, 10e-3, 226e9, 20.0, 2.0, 0.04, 22e-9)
    >>> round(nijenbanning_venner_moes(contact).central_thickness * 1e6, 3)
    0.45
    """
    ri, ei, rp, ep = _asymptotes(contact).values()
    most = 1.8 * contact.radius_y / contact.radius_x
    isoviscous = ri ** (3 / 2) + (ei**-4 + most**-4) ** (-3 / 8)
    if ep > 0.0:
        s = 1.5 * (1.0 + np.exp(-1.2 * ei / ep))
        h = (isoviscous ** (2 * s / 3) + (rp**-8 + ep**-8) ** (-s / 8)) ** (1.0 / s)
    else:
        h = isoviscous ** (2 / 3)
    film = float(h * contact.radius_x * np.sqrt(2.0 * contact._u))
    return CentralThickness(central_thickness=film)


FORMULAS = {
    "hamrock_dowson": Formula("Hamrock-Dowson", hamrock_dowson, piezoviscous=True),
    "chittenden": Formula("Chittenden et al.", chittenden, piezoviscous=True),
    "nijenbanning_venner_moes": Formula("Nijenbanning et al.", nijenbanning_venner_moes),
}


def regime(contact: PointContact) -> str:
    """Lubrication regime: the limit of the formula of all regimes that dominates it.

    Rigid or elastic is decided within the isoviscous and the piezoviscous pair as the formula does, by the
    thicker and the thinner film; the thicker of the two then names the regime.

    Parameters
    ----------
    contact : PointContact
        The contact.

    Returns
    -------
    str
        "isoviscous-rigid", "isoviscous-elastic", "piezoviscous-rigid" or "piezoviscous-elastic".

    Examples
    --------
    >>> regime(PointContact(10e-3, 10e-3, 226e9, 2e3, 2.0, 0.04, 22e-9))
    'piezoviscous-elastic'
    >>> regime(PointContact(10e-3, 10e-3, 226e9, 1e-3, 2.0, 0.04, 0.0))
    'isoviscous-rigid'
    """
    return dominant(_asymptotes(contact))
