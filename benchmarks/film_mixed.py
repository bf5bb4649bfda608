"""Film thickness and asperity load share of rough contacts by the formulas of Masjedi and Khonsari.

The formulas are fits to solutions with smooth mean surfaces and a statistical model of the asperities. A
contact whose roughness is solved point by point flattens its asperities first, so that its share of the load
on asperities is smaller below lambda 1.

The constants are from memory: about 85 % sure for the line, 75 % for the point. The smooth limits and the
order of the shares were checked. The ranges of the fits are not known here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz import axis_ratio


@dataclass(frozen=True, kw_only=True)
class MixedFilm:
    """Film of a rough contact; None for a number that the formula does not give.

    Attributes
    ----------
    central_thickness, minimum_thickness : float or None
        Film thicknesses between the mean planes [m].
    asperity_share : float or None
        Share of the load on asperities, dimensionless, from 0 to 1.
    """

    central_thickness: float | None = None
    minimum_thickness: float | None = None
    asperity_share: float | None = None


@dataclass(frozen=True, kw_only=True)
class RoughBodies:
    """Roughness and hardness of both bodies.

    Attributes
    ----------
    roughness : float
        Composite roughness sigma = sqrt(Rq1^2 + Rq2^2) [m], >= 0.
    hardness : float
        Vickers hardness HV of the softer body as a pressure [Pa]; 7e9 for hardened bearing steel of 700 HV.
    """

    roughness: float
    hardness: float


def masjedi_khonsari_line(contact: LineContact, bodies: RoughBodies) -> MixedFilm:
    """Film thickness and asperity load share of a rough line contact after Masjedi and Khonsari.

    With s = sigma/R and V = HV/E':
    h_c/R = 2.691 W^-0.135 U^0.705 G^0.556 (1 + 0.2 s^1.222 V^0.223 W^-0.229 U^-0.748 G^-0.842),
    h_min/R = 1.652 W^-0.077 U^0.716 G^0.695 (1 + 0.026 s^1.120 V^0.185 W^-0.312 U^-0.809 G^-0.977),
    share = 0.00005 W^-0.408 U^-0.088 G^0.103 ln(1 + 4470 s^6.015 V^1.168 W^0.485 U^-3.741 G^-2.898).

    Parameters
    ----------
    contact : LineContact
        Radius, modulus, load, speed and lubricant of the contact.
    bodies : RoughBodies
        Roughness and hardness.

    Returns
    -------
    MixedFilm
        Central and minimum film thickness, and share of the load on asperities, at most 1. All are None for
        an isoviscous lubricant, and where the film of the formula would grow faster than the roughness:
        there it is more than 5.5 times that of smooth surfaces.

    Notes
    -----
    M. Masjedi and M. M. Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514; constants from memory,
    85 % sure. Smooth, the central film is within 12 % of Pan and Hamrock's for W from 5e-5 to 5e-4.

    Examples
    --------
    >>> contact = LineContact(
    ...     reduced_radius=14.1e-3, reduced_modulus=226e9, load_per_length=400e3, entrainment_speed=0.5,
    ...     viscosity=0.01, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> found = masjedi_khonsari_line(contact, RoughBodies(roughness=100e-9, hardness=7e9))
    >>> round(found.central_thickness * 1e9, 1), round(found.asperity_share, 3)
    (82.3, 0.292)
    """
    w, u, g = contact._w, contact._u, contact._g
    s, v = bodies.roughness / contact.reduced_radius, bodies.hardness / contact.reduced_modulus
    if g == 0.0:
        return MixedFilm()
    thicker = 0.2 * s**1.222 * v**0.223 * w**-0.229 * u**-0.748 * g**-0.842
    if _beyond(thicker, 1.222):
        return MixedFilm()
    least = 1.652 * w**-0.077 * u**0.716 * g**0.695
    least *= 1.0 + 0.026 * s**1.120 * v**0.185 * w**-0.312 * u**-0.809 * g**-0.977
    touching = 4470.0 * s**6.015 * v**1.168 * w**0.485 * u**-3.741 * g**-2.898
    return MixedFilm(
        central_thickness=2.691 * w**-0.135 * u**0.705 * g**0.556 * (1.0 + thicker) * contact.reduced_radius,
        minimum_thickness=least * contact.reduced_radius,
        asperity_share=_share(5e-5 * w**-0.408 * u**-0.088 * g**0.103, touching),
    )


def masjedi_khonsari_point(contact: PointContact, bodies: RoughBodies) -> MixedFilm:
    """Film thickness and asperity load share of a rough point contact after Masjedi and Khonsari.

    With s = sigma/Rx, V = HV/E' and the ratio k of the semi-axes: h_c/Rx = 3.672 W^(-0.045 k^0.18)
    U^(0.663 k^0.025) G^(0.502 k^0.064) (1 - 0.573 exp(-0.74 k)) (1 + 0.025 s^1.248 V^0.119 W^-0.133 U^-0.884
    G^-0.977 k^0.081), share = 0.1 W^-0.083 U^0.143 G^0.314 ln(1 + s^4.689 V^0.509 W^-0.501 U^-2.9 G^-2.87
    k^-0.911).

    Parameters
    ----------
    contact : PointContact
        Radii, modulus, load, speed and lubricant of the contact.
    bodies : RoughBodies
        Roughness and hardness.

    Returns
    -------
    MixedFilm
        Central film thickness, and share of the load on asperities, at most 1. All are None for an
        isoviscous lubricant, and where the film of the formula would grow faster than the roughness: there
        it is more than five times that of smooth surfaces.

    Notes
    -----
    M. Masjedi and M. M. Khonsari, Tribol. Int. 82 (2015) 228-244, doi:10.1016/j.triboint.2014.09.010;
    constants from memory, 75 % sure. Smooth, the central film is within 5 % of Hamrock and Dowson's for a
    circle with W from 1e-6 to 5e-6 and U from 1e-12 to 1e-10, and up to 15 % below it for k = 8.

    Examples
    --------
    >>> contact = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=50.0, entrainment_speed=0.2,
    ...     viscosity=0.02, pressure_viscosity_coefficient=22e-9,
    ... )
    >>> found = masjedi_khonsari_point(contact, RoughBodies(roughness=50e-9, hardness=7e9))
    >>> round(found.central_thickness * 1e9, 1), round(found.asperity_share, 3)
    (63.1, 0.156)
    """
    w, u, g = contact._w, contact._u, contact._g
    s, v = bodies.roughness / contact.radius_x, bodies.hardness / contact.reduced_modulus
    k = axis_ratio(contact.radius_x, contact.radius_y)
    if g == 0.0:
        return MixedFilm()
    thicker = 0.025 * s**1.248 * v**0.119 * w**-0.133 * u**-0.884 * g**-0.977 * k**0.081
    if _beyond(thicker, 1.248):
        return MixedFilm()
    smooth = 3.672 * w ** (-0.045 * k**0.18) * u ** (0.663 * k**0.025) * g ** (0.502 * k**0.064)
    smooth *= 1.0 - 0.573 * float(np.exp(-0.74 * k))
    touching = s**4.689 * v**0.509 * w**-0.501 * u**-2.9 * g**-2.87 * k**-0.911
    return MixedFilm(
        central_thickness=smooth * (1.0 + thicker) * contact.radius_x,
        asperity_share=_share(0.1 * w**-0.083 * u**0.143 * g**0.314, touching),
    )


def _beyond(thicker: float, exponent: float) -> bool:
    """Whether lambda rises with the roughness: (1 + c s^e)/s has its minimum at c s^e = 1/(e - 1)."""
    return thicker > 1.0 / (exponent - 1.0)


def _share(factor: float, touching: float) -> float:
    return min(1.0, factor * float(np.log1p(touching)))
