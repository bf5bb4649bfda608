"""Film-thickness formulas, Moes groups and lubrication regimes of line contacts.

The published formulas are fits to numerical solutions of their time. Within their ranges they differ from
each other, and from the film that ehlectric computes, by up to 40 %. Results show them for comparison only.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np

from ehlectric.arrays import Numbers, V, as_float


@dataclass(frozen=True, kw_only=True)
class Thickness:
    """Film thicknesses from a formula [m]; None for a thickness that the formula does not give."""

    minimum_thickness: Numbers | None = None
    central_thickness: Numbers | None = None


@dataclass(frozen=True, kw_only=True)
class CentralThickness(Thickness):
    """Film thicknesses from a formula that gives the central thickness [m]."""

    central_thickness: Numbers


@dataclass(frozen=True, kw_only=True)
class BothThicknesses(CentralThickness):
    """Film thicknesses from a formula that gives the minimum and the central thickness [m]."""

    minimum_thickness: Numbers


class Piezoviscous(Protocol):
    """Contact with a pressure-viscosity coefficient [1/Pa]."""

    @property
    def pressure_viscosity_coefficient(self) -> Numbers:
        """Slope of ln(eta) at zero pressure [1/Pa]; zero for an isoviscous lubricant."""
        ...


_Contact = TypeVar("_Contact", bound=Piezoviscous)


@dataclass(frozen=True)
class Formula(Generic[_Contact]):
    """Film-thickness formula, an entry of the table ``FORMULAS`` of its module.

    To add a formula, write its function and add an entry to ``FORMULAS``. Results, summaries and tables then
    contain it.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=0.0,
    ... )
    >>> Formula("Pan-Hamrock", pan_hamrock, piezoviscous=True)(contact)
    Thickness(minimum_thickness=None, central_thickness=None)
    """

    name: str
    function: Callable[[_Contact], Thickness]  # function of a contact that returns its ``Thickness``
    # Whether the formula holds for piezoviscous lubricants only. It then gives no film thickness for an
    # isoviscous lubricant.
    piezoviscous: bool = False
    # Functions of a contact that return why it is outside the range of the formula, or "" if it is within:
    # range of both films, and further range of the minimum film.
    outside: Callable[[_Contact], str] = lambda _: ""
    outside_minimum: Callable[[_Contact], str] = lambda _: ""

    def __call__(self, contact: _Contact) -> Thickness:
        """Film thicknesses of a contact [m]; all None where the formula does not hold."""
        if self.piezoviscous and not np.any(contact.pressure_viscosity_coefficient):
            return Thickness()
        return self.function(contact)

    def ranges(self, contact: _Contact) -> dict[str, str | None]:
        """Reason why a contact is outside the range of each film thickness, by its key; None within it.

        Examples
        --------
        >>> light = LineContact(
        ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1e3, entrainment_speed=4.0,
        ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
        ... )
        >>> FORMULAS["pan_hamrock"].ranges(light)["central_thickness"]
        'isoviscous-rigid regime'
        """
        both = self.outside(contact)
        return {
            "minimum_thickness": both or self.outside_minimum(contact) or None,
            "central_thickness": both or None,
        }


@dataclass(frozen=True, kw_only=True)
class LineContact:
    """Line contact with the inputs of the film-thickness formulas, in SI units.

    ``reduced_radius`` [m]; ``reduced_modulus``, reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 -
    nu2^2)/E2; ``load_per_length`` [N/m]; ``entrainment_speed``, mean surface speed (u1 + u2)/2 [m/s];
    ``viscosity``, viscosity eta0 at zero pressure [Pa s]; ``pressure_viscosity_coefficient``, reciprocal
    asymptotic coefficient alpha of the oil's law [1/Pa], which is the slope of ln(eta) for Barus' law; zero
    for an isoviscous lubricant.
    """

    reduced_radius: Numbers
    reduced_modulus: Numbers
    load_per_length: Numbers
    entrainment_speed: Numbers
    viscosity: Numbers
    pressure_viscosity_coefficient: Numbers

    @property
    def _u(self) -> Numbers:
        """Speed parameter U = eta0 u/(E' R), with the mean speed u = (u1 + u2)/2."""
        return self.viscosity * self.entrainment_speed / (self.reduced_modulus * self.reduced_radius)

    @property
    def _g(self) -> Numbers:
        """Materials parameter G = alpha E'."""
        return self.pressure_viscosity_coefficient * self.reduced_modulus

    @property
    def _w(self) -> Numbers:
        """Load parameter W = w/(E' R)."""
        return self.load_per_length / (self.reduced_modulus * self.reduced_radius)

    @property
    def moes_m(self) -> Numbers:
        """Moes load group, M = w/(E' R) (eta0 u_s/(E' R))^(-1/2) with u_s = u1 + u2.

        Eq. (9) of Morris et al. (2022), doi:10.3390/lubricants10050087.
        """
        return as_float(self._w / np.sqrt(2.0 * self._u))

    @property
    def moes_l(self) -> Numbers:
        """Moes lubricant group, L = alpha E' (eta0 u_s/(E' R))^(1/4) with u_s = u1 + u2.

        Eq. (8) of Morris et al. (2022), doi:10.3390/lubricants10050087.
        """
        return self._g * as_float((2.0 * self._u) ** 0.25)


def dowson_higginson(contact: LineContact) -> Thickness:
    """Minimum film thickness after Dowson and Higginson, h/R = 2.65 U^0.70 G^0.54 W^-0.13.

    U = eta0 u/(E' R) with the mean speed u = (u1 + u2)/2, G = alpha E' and W = w/(E' R). The formula is for
    piezoviscous lubricants: for alpha = 0 it gives zero.

    Returns minimum film thickness [m].

    D. Dowson, Elastohydrodynamics, Proc. Inst. Mech. Eng. 182 (3A), 1967-68, 151-167.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(dowson_higginson(contact).minimum_thickness * 1e6, 3)
    0.615
    """
    h = 2.65 * contact._u**0.70 * contact._g**0.54 * contact._w**-0.13
    return Thickness(minimum_thickness=h * contact.reduced_radius)


def dowson_toyoda(contact: LineContact) -> CentralThickness:
    """Central film thickness after Dowson and Toyoda, h/R = 3.06 U^0.69 G^0.56 W^-0.10.

    U = eta0 u/(E' R) with the mean speed u = (u1 + u2)/2, G = alpha E' and W = w/(E' R). The formula is for
    piezoviscous lubricants: for alpha = 0 it gives zero.

    Returns central film thickness [m].

    D. Dowson and S. Toyoda, A central film thickness formula for elastohydrodynamic line contacts,
    Proc. 5th Leeds-Lyon Symposium on Tribology, 1978.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(dowson_toyoda(contact).central_thickness * 1e6, 3)
    0.85
    """
    h = 3.06 * contact._u**0.69 * contact._g**0.56 * contact._w**-0.10
    return CentralThickness(central_thickness=h * contact.reduced_radius)


def pan_hamrock(contact: LineContact) -> BothThicknesses:
    """Minimum and central film thickness after Pan and Hamrock.

    Minimum h/R = 1.714 U^0.694 G^0.568 W^-0.128, central h/R = 2.922 U^0.692 G^0.470 W^-0.166.

    U = eta0 u/(E' R) with the mean speed u = (u1 + u2)/2, G = alpha E' and W = w/(E' R). The formulas are for
    piezoviscous lubricants: for alpha = 0 they give zero.

    Returns minimum and central film thickness [m].

    P. Pan and B. J. Hamrock, J. Tribol. 111 (1989) 246-251, doi:10.1115/1.3261900.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(pan_hamrock(contact).minimum_thickness * 1e6, 3)
    0.574
    """
    u, g, w = contact._u, contact._g, contact._w
    minimum = 1.714 * u**0.694 * g**0.568 * w**-0.128
    central = 2.922 * u**0.692 * g**0.470 * w**-0.166
    radius = contact.reduced_radius
    return BothThicknesses(minimum_thickness=minimum * radius, central_thickness=central * radius)


def _moes_asymptotes(contact: LineContact) -> dict[str, Numbers]:
    """Central film thickness H = (h/R) (eta0 u_s/(E' R))^(-1/2) in the four limiting regimes, by name."""
    moes_m, moes_l = contact.moes_m, contact.moes_l
    return {
        "isoviscous-rigid": 3.0 / moes_m,
        "isoviscous-elastic": 2.621 * moes_m**-0.2,
        "piezoviscous-rigid": 1.287 * moes_l ** (2.0 / 3.0),
        "piezoviscous-elastic": 1.311 * moes_m**-0.125 * moes_l**0.75,
    }


def martin(contact: LineContact) -> Thickness:
    """Minimum film thickness between rigid bodies with an isoviscous lubricant, h/R = 4.896 U/W.

    U = eta0 u/(E' R) with the mean speed u = (u1 + u2)/2, and W = w/(E' R). The reduced modulus cancels. The
    film is the limit for light loads, after Martin (1916), in the numbers of Moes' group: H = 2.448/M.

    Returns minimum film thickness [m].

    H. M. Martin, Lubrication of gear teeth, Engineering 102 (1916) 119-121.

    Examples
    --------
    A roller of 11 mm under 3.72 N, 338 N/m:

    >>> contact = LineContact(
    ...     reduced_radius=6.5e-3, reduced_modulus=226e9, load_per_length=338.0, entrainment_speed=4.0,
    ...     viscosity=0.0125, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(martin(contact).minimum_thickness * 1e6, 2)
    4.71
    """
    h = 4.896 * contact._u / contact._w
    return Thickness(minimum_thickness=as_float(h * contact.reduced_radius))


def moes(contact: LineContact) -> CentralThickness:
    """Central film thickness after Moes, for all four lubrication regimes.

    H = ((H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(-7/2) + H_EP^(-7/2))^(-2s/7))^(1/s),
    s = (7 + 8 exp(-2 H_EI/H_RI))/5, with H_RI = 3/M, H_EI = 2.621 M^(-1/5), H_RP = 1.287 L^(2/3) and
    H_EP = 1.311 M^(-1/8) L^(3/4).

    H = (h/R) (eta0 u_s/(E' R))^(-1/2), and M and L are the Moes groups of the contact, all with the sum of
    the surface speeds u_s = u1 + u2.

    Returns central film thickness [m].

    In the isoviscous-rigid limit (Martin's contact) 3/M is the film thickness where the pressure gradient
    vanishes; the minimum there is 2.447/M.

    H. Moes, Optimum similarity analysis with applications to elastohydrodynamic lubrication, Wear 159
    (1992) 57-66, doi:10.1016/0043-1648(92)90286-H.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> round(moes(contact).central_thickness * 1e6, 3)
    0.876
    """
    ri, ei, rp, ep = _moes_asymptotes(contact).values()
    s = (7.0 + 8.0 * np.exp(-2.0 * ei / ri)) / 5.0
    h = (ri ** (7 / 3) + ei ** (7 / 3)) ** (3 * s / 7) + below_both(rp, ep, 7 / 2) ** s
    scale = contact.reduced_radius * np.sqrt(2.0 * contact._u)
    return CentralThickness(central_thickness=as_float(h ** (1.0 / s) * scale))


def below_both(first: Numbers, second: Numbers, power: float) -> Numbers:
    """Film (H1^-n + H2^-n)^(-1/n) from the films H1 and H2 of two regimes, of which the thinner one counts.

    ``power``, n > 0. The result is zero where both films are zero, as without a rise of the viscosity with
    pressure; powers of thin films do not overflow.

    Examples
    --------
    >>> round(float(below_both(1.0, 2.0, 8)), 4), float(below_both(0.0, 0.0, 8))
    (0.9995, 0.0)
    """
    thinner, thicker = np.minimum(first, second), np.maximum(first, second)
    ratio = thinner / np.where(thicker > 0.0, thicker, 1.0)
    return thinner * (1.0 + ratio**power) ** (-1.0 / power)


def regime(contact: LineContact) -> str:
    """Lubrication regime of a line contact: the limiting regime that dominates the Moes formula.

    Of the two isoviscous regimes, rigid and elastic, the one with the thicker film counts; of the two
    piezoviscous regimes, the one with the thinner film. The thicker film of these two names the regime. The
    Moes formula combines the four films in the same way.

    Examples
    --------
    >>> regime(LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1.57e6, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=22e-9,
    ... ))
    'piezoviscous-elastic'
    >>> regime(LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=1e3, entrainment_speed=4.0,
    ...     viscosity=0.04, pressure_viscosity_coefficient=0.0,
    ... ))
    'isoviscous-rigid'
    """
    return dominant({name: float(film) for name, film in _moes_asymptotes(contact).items()})


def dominant(films: Mapping[str, float]) -> str:
    """Lubrication regime that dominates, from the film thicknesses in the four limiting regimes.

    The thicker film of the isoviscous pair and the thinner film of the piezoviscous pair are compared, and
    the thicker of the two names the regime.

    Examples
    --------
    >>> names = "isoviscous-rigid", "isoviscous-elastic", "piezoviscous-rigid", "piezoviscous-elastic"
    >>> dominant(dict(zip(names, (0.1, 2.0, 9.0, 5.0), strict=True)))
    'piezoviscous-elastic'
    """
    isoviscous = max(("isoviscous-rigid", "isoviscous-elastic"), key=films.__getitem__)
    piezoviscous = min(("piezoviscous-rigid", "piezoviscous-elastic"), key=films.__getitem__)
    return max((isoviscous, piezoviscous), key=films.__getitem__)


def _of_hard_contacts(contact: LineContact) -> str:
    name = regime(contact)
    return "" if name == "piezoviscous-elastic" else f"{name} regime"


# The solutions behind all formulas except the formula of Moes are for hard contacts with piezoviscous oils.
FORMULAS = {
    "dowson_higginson": Formula(
        "Dowson-Higginson", dowson_higginson, piezoviscous=True, outside=_of_hard_contacts
    ),
    "dowson_toyoda": Formula("Dowson-Toyoda", dowson_toyoda, piezoviscous=True, outside=_of_hard_contacts),
    "pan_hamrock": Formula("Pan-Hamrock", pan_hamrock, piezoviscous=True, outside=_of_hard_contacts),
    "moes": Formula("Moes", moes),
}


def velocity_parameter(
    *,
    viscosity: V,
    entrainment_speed: V,
    radius: V,
    half_width: V,
    max_pressure: V,
) -> V:
    """Dimensionless velocity parameter lambda = 6 eta0 u_s R^2/(b^3 p_h) of the Reynolds equation.

    ``viscosity``, viscosity eta0 of the lubricant at zero pressure [Pa s]; ``entrainment_speed``, mean
    surface speed (u1 + u2)/2 [m/s]; ``radius``, reduced radius R along entrainment [m]; ``half_width``,
    half-width b of a line contact, or semi-axis b along entrainment of a point contact [m]; ``max_pressure``,
    Hertz pressure p_h [Pa]. Returns velocity parameter lambda, dimensionless.

    The definition of Morris et al. (2022), doi:10.3390/lubricants10050087, uses the sum of the surface
    speeds, u_s = u1 + u2, which is twice the entrainment speed.

    Examples
    --------
    >>> oil = {"viscosity": 0.01, "entrainment_speed": 1.0}
    >>> round(velocity_parameter(**oil, radius=0.01, half_width=1e-4, max_pressure=1e9), 6)
    0.012
    """
    sum_of_speeds = 2.0 * entrainment_speed
    return 6.0 * viscosity * sum_of_speeds * radius**2 / (half_width**3 * max_pressure)
