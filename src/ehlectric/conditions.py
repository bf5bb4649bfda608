"""What a case means: its alternatives resolved, the dry contact, the dimensionless groups."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ehlectric import film_formulas, hertz
from ehlectric.case import Case
from ehlectric.contact_inputs import Body, Contact
from ehlectric.errors import InputError
from ehlectric.inputs import Lubricant
from ehlectric.lubricant import DENSITY_LAWS, PERMITTIVITY_LAWS, VISCOSITY_LAWS, Law, roelands_exponent
from ehlectric.typing import Array

# Hertz pressure at which bearing steel deforms permanently, of line contacts (ISO 76) [Pa].
_PERMANENT = 4e9

# A rigid film builds up over some ten sqrt(2 R h), which is this over M in half-widths.
_RIGID_INLET = 14.0


@dataclass(frozen=True)
class Conditions:
    """Operating conditions of a line contact, SI units.

    Attributes
    ----------
    reduced_radius, reduced_modulus, load_per_length : float
        R [m], E' [Pa] with the factor two, and w [N/m].
    entrainment_speed : float
        (u1 + u2)/2 [m/s].
    slide_to_roll_ratio : float
        (u1 - u2)/entrainment_speed.
    half_width, max_pressure : float
        b [m] and p_h [Pa] of the dry contact.
    velocity_parameter : float
        lambda = 6 eta0 u_s R^2/(b^3 p_h) with u_s = u1 + u2.
    curvature_share, compliance_share : float
        Parts of 1/R and of 2/E' that are surface 1's.
    formulas : film_formulas.LineContact
        The contact as the film-thickness formulas take it.
    """

    reduced_radius: float
    reduced_modulus: float
    load_per_length: float
    entrainment_speed: float
    slide_to_roll_ratio: float
    half_width: float
    max_pressure: float
    velocity_parameter: float
    curvature_share: float
    compliance_share: float
    formulas: film_formulas.LineContact

    @property
    def semi_axes(self) -> tuple[float, ...]:
        """Half-width of the dry contact [m]."""
        return (self.half_width,)

    @property
    def thickness_scale(self) -> float:
        """b^2/R, the film thickness of H = 1 [m]."""
        return self.half_width**2 / self.reduced_radius


def resolve(case: Case) -> Conditions:
    """Operating conditions of a case.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    Conditions
        With every alternative resolved.

    Raises
    ------
    InputError
        Where the values contradict each other: no positive reduced radius, a Hertz pressure below the
        ambient one, a dry contact wider than its bodies.

    Examples
    --------
    >>> contact = {"radius_1": "20 mm", "radius_2": "20 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "speed_1": 3.0, "speed_2": 1.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> conditions = resolve(case)
    >>> conditions.reduced_radius, conditions.entrainment_speed, conditions.slide_to_roll_ratio
    (0.01, 2.0, 1.0)
    """
    contact, lubricant = case.contact, case.lubricant
    if contact.geometry != "line":
        raise InputError(
            f"contact.geometry: got {contact.geometry!r}, takes 'line' for a line contact's conditions"
        )
    radius, curvature_share = _radius(contact)
    modulus, compliance_share = modulus_of(contact)
    speed, ratio = speeds_of(contact)
    load = contact.load_per_length
    if load is None:
        assert contact.max_hertz_pressure is not None
        load = hertz.line_load(contact.max_hertz_pressure, radius, modulus)
    half_width = hertz.line_half_width(load, radius, modulus)
    max_pressure = hertz.line_max_pressure(load, radius, modulus)
    bodies = [abs(r) for r in (contact.radius_1, contact.radius_2) if r is not None]
    check_width(half_width, min([radius, *bodies]))
    check_pressure(max_pressure, lubricant)
    eta0, alpha = lubricant.viscosity, effective_alpha(lubricant)
    return Conditions(
        reduced_radius=radius,
        reduced_modulus=modulus,
        load_per_length=load,
        entrainment_speed=speed,
        slide_to_roll_ratio=ratio,
        half_width=half_width,
        max_pressure=max_pressure,
        velocity_parameter=12.0 * eta0 * speed * radius**2 / (half_width**3 * max_pressure),
        curvature_share=curvature_share,
        compliance_share=compliance_share,
        formulas=film_formulas.LineContact(radius, modulus, load, speed, eta0, alpha),
    )


def _radius(contact: Contact) -> tuple[float, float]:
    """Reduced radius, and the part of 1/R that is surface 1's: a half where only R is known."""
    if contact.reduced_radius is not None:
        return contact.reduced_radius, 0.5
    r1, r2 = contact.radius_1, contact.radius_2
    assert r1 is not None and r2 is not None
    if not 1.0 / r1 + 1.0 / r2 > 0.0:
        raise InputError(
            f"contact.radius_1: got {r1:g} m with radius_2 {r2:g} m, takes radii with "
            "1/radius_1 + 1/radius_2 above 0: a concave body must be wider than the other"
        )
    radius = hertz.reduced_radius(r1, r2)
    return radius, radius / r1


def modulus_of(contact: Contact) -> tuple[float, float]:
    """Reduced modulus, and the part of 2/E' that is surface 1's: a half where only E' is known."""
    if contact.reduced_modulus is not None:
        return contact.reduced_modulus, 0.5
    assert contact.body_1 is not None and contact.body_2 is not None
    first, second = (_compliance(body) for body in (contact.body_1, contact.body_2))
    return hertz.reduced_modulus(first, second), first / (first + second)


def _compliance(body: Body) -> float:
    assert body.youngs_modulus is not None and body.poissons_ratio is not None
    return hertz.body_compliance(body.youngs_modulus, body.poissons_ratio)


def speeds_of(contact: Contact) -> tuple[float, float]:
    """Entrainment speed and slide-to-roll ratio."""
    if contact.entrainment_speed is not None:
        return contact.entrainment_speed, contact.slide_to_roll_ratio or 0.0
    assert contact.speed_1 is not None and contact.speed_2 is not None
    mean = 0.5 * (contact.speed_1 + contact.speed_2)
    return mean, (contact.speed_1 - contact.speed_2) / mean


def surface_ratios(slide_to_roll_ratio: float) -> tuple[float, float]:
    """Speeds of both surfaces over the entrainment speed.

    Examples
    --------
    >>> surface_ratios(0.5)
    (1.25, 0.75)
    """
    return 1.0 + 0.5 * slide_to_roll_ratio, 1.0 - 0.5 * slide_to_roll_ratio


def check_width(half_width: float, radius: float) -> None:
    """Refuse a dry contact as wide as its bodies, which no half-space or parabola describes."""
    if half_width > 0.5 * radius:
        raise InputError(
            f"contact: the dry contact would be {half_width:.3g} m wide on each side, more than half of the "
            f"smallest radius {radius:.3g} m; takes less load, a larger modulus or less conforming bodies"
        )


def check_pressure(pressure: float, lubricant: Lubricant) -> None:
    """Refuse a Hertz pressure near the ambient one, or one at which the permittivity has no value."""
    least = max(1e4, 10.0 * lubricant.ambient_pressure)
    if pressure < least:
        raise InputError(
            f"contact: the Hertz pressure would be {pressure:.3g} Pa, takes a load that gives at least "
            f"{least:.3g} Pa, well above the ambient {lubricant.ambient_pressure:.3g} Pa"
        )
    # A permittivity law that fails at the Hertz pressure does so here; one that fails at the pressure spike
    # alone can only do so when the film is there.
    permittivity_law(lubricant)(density_law(lubricant)(np.array([pressure]))[0])


def effective_alpha(lubricant: Lubricant) -> float:
    """Pressure-viscosity coefficient [1/Pa] that the film formulas see: zero for a constant viscosity."""
    if lubricant.viscosity_law == "constant":
        return 0.0
    assert lubricant.pressure_viscosity_coefficient is not None
    return lubricant.pressure_viscosity_coefficient


def _bound(law: Law, lubricant: Lubricant) -> Callable[..., Any]:
    """A law with its parameters from the case."""
    return partial(law.function, **{name: getattr(lubricant, name) for name in law.parameters})


def viscosity_law(lubricant: Lubricant) -> Callable[[Array], tuple[Array, Array]]:
    """ln(eta/eta0) and its derivative [1/Pa] over pressure [Pa]."""
    return _bound(VISCOSITY_LAWS[lubricant.viscosity_law], lubricant)


def density_law(lubricant: Lubricant) -> Callable[[Array], tuple[Array, Array]]:
    """rho/rho0 and its derivative [1/Pa] over pressure [Pa]."""
    return _bound(DENSITY_LAWS[lubricant.density_law], lubricant)


def permittivity_law(lubricant: Lubricant) -> Callable[[Array], Array]:
    """Relative permittivity over rho/rho0."""
    return _bound(PERMITTIVITY_LAWS[lubricant.permittivity_law], lubricant)


def remarks(case: Case, conditions: Conditions) -> Iterator[str]:
    """What a user should know about a case before it is solved, one text each."""
    yield from regime_remarks(conditions)
    width = (case.grid.outlet - case.grid.inlet) / (0.5 * np.pi)
    yield from pressure_remarks(case.lubricant, conditions.max_pressure, width, "line", _PERMANENT)


def regime_remarks(conditions: Conditions) -> Iterator[str]:
    """What to know of a line contact far from those that the film formulas were made for."""
    regime = film_formulas.regime(conditions.formulas)
    if regime == "isoviscous-rigid":
        yield rigid_remark("half-width", "half-widths", _RIGID_INLET / conditions.formulas.moes_m)
    elif regime != "piezoviscous-elastic":
        yield f"{regime} regime: the film formulas but Moes' are for piezoviscous-elastic contacts"


def rigid_remark(length: str, lengths: str, reach: float) -> str:
    """What to know of a film of rigid bodies, which builds up over ``reach`` of those lengths."""
    return (
        f"isoviscous-rigid regime: the bodies hardly deform, and {length} and Hertz pressure scale "
        f"nothing; the film builds up over about {reach:.2g} {lengths}, which grid.inlet must hold"
    )


def pressure_remarks(
    lubricant: Lubricant, pressure: float, domain: float, kind: str, permanent: float
) -> Iterator[str]:
    """What to know of a contact of that Hertz pressure [Pa], one text each.

    ``domain`` is the load of a unit pressure over the whole domain, in that of the dry contact at a unit
    Hertz pressure; ``permanent`` the Hertz pressure above which bearing steel deforms permanently in contacts
    of that ``kind`` [Pa].
    """
    ambient_load = lubricant.ambient_pressure / pressure * domain
    if ambient_load > 0.01:
        yield (
            f"the ambient pressure carries {100 * ambient_load:.1f} % of the load over this domain; "
            "lubricant.ambient_pressure = 0 leaves it out"
        )
    if pressure > permanent:
        yield (
            f"the Hertz pressure is {pressure / 1e9:.3g} GPa: bearing steel deforms "
            f"permanently above {permanent / 1e9:g} GPa in {kind} contacts, and the bodies are elastic here; "
            "are load and radii right?"
        )
    if lubricant.viscosity_law == "barus" and pressure > 0.5e9:
        yield "Barus' law overstates the viscosity above some 0.5 GPa by orders of magnitude"
    if lubricant.viscosity_law == "roelands":
        alpha, p0 = lubricant.pressure_viscosity_coefficient, lubricant.roelands_pressure
        assert alpha is not None and p0 is not None and lubricant.roelands_z is not None
        z = roelands_exponent(lubricant.viscosity, alpha, p0)
        if abs(z / lubricant.roelands_z - 1.0) > 0.1:
            yield (
                f"roelands_z is {lubricant.roelands_z:g}; Roelands' own relation gives {z:.3g} for this "
                "viscosity and pressure-viscosity coefficient"
            )
