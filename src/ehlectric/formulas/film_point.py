"""Film-thickness formulas, Moes groups and lubrication regimes of point contacts.

The published formulas are fits to numerical solutions of their time. Within their ranges they differ from
each other, and from the film that ehlectric computes, by up to 40 %. Results show them for comparison only.
The x axis runs along entrainment, the y axis across it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Numbers, as_float
from ehlectric.formulas.film_line import (
    BothThicknesses,
    CentralThickness,
    Formula,
    Thickness,
    below_both,
    dominant,
)
from ehlectric.formulas.hertz import axis_ratio


@dataclass(frozen=True, kw_only=True)
class PointContact:
    """Point contact with the inputs of the film-thickness formulas, in SI units.

    ``radius_x`` and ``radius_y``, reduced radii Rx along and Ry across entrainment [m]; ``reduced_modulus``,
    reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ``load`` [N]; ``entrainment_speed``,
    mean surface speed (u1 + u2)/2 [m/s]; ``viscosity``, viscosity eta0 at zero pressure [Pa s];
    ``pressure_viscosity_coefficient``, reciprocal asymptotic coefficient alpha of the oil's law [1/Pa], which
    is the slope of ln(eta) for Barus' law; zero for an isoviscous lubricant.
    """

    radius_x: Numbers
    radius_y: Numbers
    reduced_modulus: Numbers
    load: Numbers
    entrainment_speed: Numbers
    viscosity: Numbers
    pressure_viscosity_coefficient: Numbers

    @property
    def _u(self) -> Numbers:
        """Speed parameter U = eta0 u/(E' Rx), with the mean speed u = (u1 + u2)/2."""
        return self.viscosity * self.entrainment_speed / (self.reduced_modulus * self.radius_x)

    @property
    def _g(self) -> Numbers:
        """Materials parameter G = alpha E'."""
        return self.pressure_viscosity_coefficient * self.reduced_modulus

    @property
    def _w(self) -> Numbers:
        """Load parameter W = F/(E' Rx^2)."""
        return self.load / (self.reduced_modulus * self.radius_x**2)

    @property
    def moes_m(self) -> Numbers:
        """Moes load group, M = F/(E' Rx^2) (eta0 u_s/(E' Rx))^(-3/4) with u_s = u1 + u2."""
        return self._w * as_float((2.0 * self._u) ** -0.75)

    @property
    def moes_l(self) -> Numbers:
        """Moes lubricant group, L = alpha E' (eta0 u_s/(E' Rx))^(1/4) with u_s = u1 + u2."""
        return self._g * as_float((2.0 * self._u) ** 0.25)


def hamrock_dowson(contact: PointContact) -> BothThicknesses:
    """Minimum and central film thickness after Hamrock and Dowson.

    Minimum h/Rx = 3.63 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k)), central h/Rx = 2.69 U^0.67 G^0.53 W^-0.067
    (1 - 0.61 exp(-0.73 k)).

    U = eta0 u/(E' Rx) with the mean speed u = (u1 + u2)/2, G = alpha E' and W = F/(E' Rx^2). k is the
    semi-axis of the dry contact across entrainment over the semi-axis along it. The formulas are for
    piezoviscous lubricants: for alpha = 0 they give zero.

    Returns minimum and central film thickness [m].

    B. J. Hamrock and D. Dowson, J. Lubr. Technol. 99 (1977) 264-275, doi:10.1115/1.3453074. The formulas are
    fits to solutions for hard contacts (steel and oil) with k from 1 to 8 and entrainment along the minor
    axis. Contacts with Ry below Rx are outside their range. The exact k replaces the fit of the paper,
    k = 1.03 (Ry/Rx)^0.64, which is 3 % too high for a circle.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=20.0, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> film = hamrock_dowson(contact)
    >>> round(film.minimum_thickness * 1e6, 3), round(film.central_thickness * 1e6, 3)
    (0.251, 0.438)
    """
    u, g, w = contact._u, contact._g, contact._w
    k = axis_ratio(contact.radius_x, contact.radius_y)
    minimum = 3.63 * u**0.68 * g**0.49 * w**-0.073 * (1.0 - np.exp(-0.68 * k))
    central = 2.69 * u**0.67 * g**0.53 * w**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k))
    return BothThicknesses(
        minimum_thickness=as_float(minimum * contact.radius_x),
        central_thickness=as_float(central * contact.radius_x),
    )


def chittenden(contact: PointContact) -> BothThicknesses:
    """Minimum and central film thickness after Chittenden, Dowson, Dunn and Taylor.

    Minimum h/Rx = 3.68 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.67 (Ry/Rx)^(2/3))), central
    h/Rx = 4.31 U^0.68 G^0.49 W^-0.073 (1 - exp(-1.23 (Ry/Rx)^(2/3))).

    U = eta0 u/(E' Rx) with the mean speed u = (u1 + u2)/2, G = alpha E' and W = F/(E' Rx^2). The formulas are
    for piezoviscous lubricants: for alpha = 0 they give zero.

    Returns minimum and central film thickness [m].

    R. J. Chittenden, D. Dowson, J. F. Dunn and C. M. Taylor, Proc. R. Soc. Lond. A 397 (1985) 245-294,
    doi:10.1098/rspa.1985.0014, and the paper that follows it in the same volume. Their radii Re and Rs are Rx
    and Ry here. The formulas are fits to solutions for hard contacts, with entrainment along either axis of
    the ellipse.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=20.0, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> film = chittenden(contact)
    >>> round(film.minimum_thickness * 1e6, 3), round(film.central_thickness * 1e6, 3)
    (0.252, 0.427)
    """
    h = 4.31 * contact._u**0.68 * contact._g**0.49 * contact._w**-0.073 * contact.radius_x
    sides = (contact.radius_y / contact.radius_x) ** (2.0 / 3.0)
    minimum = 3.68 / 4.31 * h * (1.0 - np.exp(-0.67 * sides))
    central = h * (1.0 - np.exp(-1.23 * sides))
    return BothThicknesses(minimum_thickness=as_float(minimum), central_thickness=as_float(central))


def _asymptotes(contact: PointContact) -> dict[str, Numbers]:
    """Central film thickness H = (h/Rx) (eta0 u_s/(E' Rx))^(-1/2) in the four limiting regimes, by name."""
    moes_m, moes_l = contact.moes_m, contact.moes_l
    d = contact.radius_x / contact.radius_y
    ellipse = 1.0 + 0.006 * as_float(np.log(d)) + 0.63 * d ** (4 / 7)
    return {
        "isoviscous-rigid": 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / (d * moes_m**2),
        "isoviscous-elastic": 3.18 * ellipse ** (-14 / 25) * d ** (-1 / 15) * moes_m ** (-2 / 15),
        "piezoviscous-rigid": 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * moes_l ** (2 / 3),
        "piezoviscous-elastic": (
            1.48 * ellipse ** (-7 / 20) * d ** (-1 / 24) * moes_m ** (-1 / 12) * moes_l ** (3 / 4)
        ),
    }


def nijenbanning_venner_moes(contact: PointContact) -> CentralThickness:
    """Central film thickness after Nijenbanning, Venner and Moes, for all four lubrication regimes.

    H = ((H_RI^(3/2) + (H_EI^-4 + H_00^-4)^(-3/8))^(2s/3) + (H_RP^-8 + H_EP^-8)^(-s/8))^(1/s) with
    s = (3/2) (1 + exp(-1.2 H_EI/H_EP)), H_00 = 1.8/D, D = Rx/Ry, B = 1 + 0.006 ln(D) + 0.63 D^(4/7),
    H_RI = 145 (1 + 0.796 D^(14/15))^(-15/7) D^-1 M^-2, H_EI = 3.18 B^(-14/25) D^(-1/15) M^(-2/15),
    H_RP = 1.29 (1 + 0.691 D)^(-2/3) L^(2/3) and H_EP = 1.48 B^(-7/20) D^(-1/24) M^(-1/12) L^(3/4).

    H = (h/Rx) (eta0 u_s/(E' Rx))^(-1/2), and M and L are the Moes groups of the contact, all with the sum of
    the surface speeds u_s = u1 + u2.

    Returns central film thickness [m].

    G. Nijenbanning, C. H. Venner and H. Moes, Wear 176 (1994) 217-229, doi:10.1016/0043-1648(94)90150-3. The
    formula holds for D up to 1, that is, entrainment along the minor axis, and for all M and L.

    For D towards 0 the elastic limits and the piezoviscous-rigid limit become the limits of the line contact,
    ``film_line.moes``, at the middle of the long ellipse. The load per length there is 3 F/4 over the long
    semi-axis. In the isoviscous-rigid limit H_RI is the film thickness where the pressure gradient vanishes,
    1.226 times the film thickness at the centre. H_00 bounds the isoviscous-elastic film H_EI, which would
    otherwise grow without bound as the load falls.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=20.0, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(nijenbanning_venner_moes(contact).central_thickness * 1e6, 3)
    0.45
    """
    ri, ei, rp, ep = _asymptotes(contact).values()
    most = 1.8 * contact.radius_y / contact.radius_x
    isoviscous = ri ** (3 / 2) + below_both(ei, most, 4) ** (3 / 2)
    # Where the viscosity does not rise with pressure, the film does not depend on s.
    s = 1.5 * (1.0 + np.exp(-1.2 * ei / np.where(ep > 0.0, ep, 1.0)))
    h = (isoviscous ** (2 * s / 3) + below_both(rp, ep, 8) ** s) ** (1.0 / s)
    return CentralThickness(central_thickness=as_float(h * contact.radius_x * np.sqrt(2.0 * contact._u)))


def brewe_hamrock_taylor(contact: PointContact) -> Thickness:
    """Minimum film thickness between rigid bodies with an isoviscous lubricant.

    h/Rx = 128 a (phi (0.131 arctan(a/2) + 1.683) U/W)^2 with a = Ry/Rx, phi = 1/(1 + 2/(3 a)),
    U = eta0 u/(E' Rx), the mean speed u = (u1 + u2)/2 and W = F/(E' Rx^2). The reduced modulus cancels. The
    film is the limit for light loads.

    Returns minimum film thickness [m].

    D. E. Brewe, B. J. Hamrock and C. M. Taylor, J. Lubr. Technol. 101 (1979) 231-239.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=1.0, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(brewe_hamrock_taylor(contact).minimum_thickness * 1e6, 2)
    0.9
    """
    ratio = contact.radius_y / contact.radius_x
    side = 1.0 / (1.0 + 2.0 / (3.0 * ratio))
    h = 128.0 * ratio * (side * (0.131 * np.arctan(0.5 * ratio) + 1.683) * contact._u / contact._w) ** 2
    return Thickness(minimum_thickness=as_float(h * contact.radius_x))


# Relative step of the load in the derivative of a formula.
_STEP = 1e-3


def load_exponent(contact: PointContact) -> Numbers:
    """Exponent with which the formula of Nijenbanning, Venner and Moes falls over the load, -d ln h/d ln F.

    It is 2 for rigid bodies with an isoviscous lubricant, and 2/15 to 1/12 for heavily loaded ones.

    Examples
    --------
    >>> light = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=1e-6, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=0.0,
    ... )
    >>> round(load_exponent(light), 2), round(load_exponent(replace(light, load=1e3)), 2)
    (2.0, 0.13)
    """
    less, more = (
        nijenbanning_venner_moes(replace(contact, load=contact.load * factor)).central_thickness
        for factor in (1.0 / (1.0 + _STEP), 1.0 + _STEP)
    )
    return as_float(np.log(less / more) / (2.0 * np.log1p(_STEP)))


def regime(contact: PointContact) -> str:
    """Lubrication regime of a point contact: the limit that dominates the formula of Nijenbanning et al.

    Of the two isoviscous regimes, rigid and elastic, the one with the thicker film counts; of the two
    piezoviscous regimes, the one with the thinner film. The thicker film of these two names the regime. The
    formula combines the four films in the same way.

    Examples
    --------
    >>> regime(PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=2e3, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... ))
    'piezoviscous-elastic'
    >>> regime(PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=1e-3, entrainment_speed=2.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=0.0,
    ... ))
    'isoviscous-rigid'
    """
    return dominant({name: float(film) for name, film in _asymptotes(contact).items()})


# Ratios k of the semi-axes of the solutions behind the formula of Hamrock and Dowson.
_LEAST_RATIO, _MOST_RATIO = 1.0, 8.0

# Largest M/k^3 of the minimum film by the formulas of Hamrock and Dowson and of Chittenden and others. Their
# solutions are for moderate loads. At heavier loads the minimum lies in narrow side lobes: compared with the
# atlas, the formulas are up to 40 % too thick at M/k^3 = 250, and 130 % at 3000.
_HEAVIEST = 250.0


def _of_hard_contacts(contact: PointContact) -> str:
    # Between both piezoviscous regimes the formulas keep their accuracy, compared with the atlas.
    name = regime(contact)
    return f"{name} regime" if name.startswith("isoviscous") else ""


def _of_hamrock_and_dowson(contact: PointContact) -> str:
    ratio = axis_ratio(contact.radius_x, contact.radius_y)
    within = _LEAST_RATIO - _ROUNDING <= ratio <= _MOST_RATIO
    axes = "" if within else f"semi-axes a/b = {ratio:.3g}, range {_LEAST_RATIO:g} to {_MOST_RATIO:g}"
    regime_of: str = _of_hard_contacts(contact)
    return regime_of or axes


def _of_moderate_loads(contact: PointContact) -> str:
    heaviness = contact.moes_m / axis_ratio(contact.radius_x, contact.radius_y) ** 3
    return "" if heaviness <= _HEAVIEST else f"heavy load, M b³/a³ = {heaviness:.3g} above {_HEAVIEST:g}"


def _along_the_minor_axis(contact: PointContact) -> str:
    ratio = contact.radius_x / contact.radius_y
    return "" if ratio <= 1.0 + _ROUNDING else f"Rx/Ry = {ratio:.3g}, range up to 1"


# Relative difference of radii that is rounding.
_ROUNDING = 1e-9

FORMULAS = {
    "hamrock_dowson": Formula(
        "Hamrock-Dowson",
        hamrock_dowson,
        piezoviscous=True,
        outside=_of_hamrock_and_dowson,
        outside_minimum=_of_moderate_loads,
    ),
    "chittenden": Formula(
        "Chittenden et al.",
        chittenden,
        piezoviscous=True,
        outside=_of_hard_contacts,
        outside_minimum=_of_moderate_loads,
    ),
    "nijenbanning_venner_moes": Formula(
        "Nijenbanning et al.", nijenbanning_venner_moes, outside=_along_the_minor_axis
    ),
}
