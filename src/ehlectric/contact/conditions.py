"""Operating conditions of line and point contacts: bodies, load, speeds, and size of the dry contact."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from ehlectric.contact.bodies import check_pressure, check_width
from ehlectric.film.problem import velocity_parameter
from ehlectric.formulas import hertz_line as hertz
from ehlectric.formulas import hertz_point
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.lubricant.oil import Oil

# Half of the domain's width across entrainment, in semi-axes across: 1.6 for a long ellipse, whose sides
# hardly matter; 3.0 for a circle; at most 4.5, as long as the inlet, for an ellipse that is short across.
_LEAST_SIDE, _CIRCLE_SIDE, _MOST_SIDE = 1.6, 3.0, 4.5

# Exponents of the entrainment speed in the film thickness of hard contacts: lines (Pan and Hamrock), points
# (Hamrock and Dowson). They convert a film factor to a factor of the entrainment speed.
LINE_FILM_EXPONENT, POINT_FILM_EXPONENT = 0.69, 0.67


@dataclass(frozen=True)
class Conditions:
    """Operating conditions of a line contact, SI units.

    Attributes
    ----------
    reduced_radius, reduced_modulus, load_per_length : float
        R [m], E' [Pa] with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, and w [N/m].
    entrainment_speed : float
        (u1 + u2)/2 [m/s].
    slide_to_roll_ratio : float
        (u1 - u2)/entrainment_speed, dimensionless.
    viscosity, pressure_viscosity_coefficient : float
        Viscosity eta0 at ambient pressure [Pa s], and reciprocal asymptotic coefficient alpha* [1/Pa].
    half_width, max_pressure : float
        Half-width b [m] and Hertz pressure p_h [Pa] of the dry contact.
    curvature_share, compliance_share : float
        Surface 1's shares of 1/R and of 2/E', dimensionless; 0.5 if only the reduced values are known.
    boundary_film : float
        Thickness of the boundary film [m] at which the surfaces touch; zero where they are taken not to.
    hardness : float or None
        Largest pressure where the surfaces touch [Pa]; None for elastic asperities.
    film_factor : float
        Film thickness divided by that of an isothermal, fully flooded film, dimensionless; see ``contact``.
    """

    geometry: ClassVar[str] = "line"

    reduced_radius: float
    reduced_modulus: float
    load_per_length: float
    entrainment_speed: float
    slide_to_roll_ratio: float
    viscosity: float
    pressure_viscosity_coefficient: float
    half_width: float
    max_pressure: float
    curvature_share: float = 0.5
    compliance_share: float = 0.5
    boundary_film: float = 0.0
    hardness: float | None = None
    film_factor: float = 1.0

    @property
    def contact(self) -> LineContact:
        """Inputs of the film-thickness formulas and of the Reynolds equation.

        ``film_factor`` acts only here. It reduces the entrainment speed to u film_factor^(1/0.69), at which
        an isothermal, fully flooded film is thinner by that factor.
        """
        return LineContact(
            self.reduced_radius,
            self.reduced_modulus,
            self.load_per_length,
            self.entrainment_speed * self.film_factor ** (1.0 / LINE_FILM_EXPONENT),
            self.viscosity,
            self.pressure_viscosity_coefficient,
        )

    @property
    def formulas(self) -> LineContact:
        """Alias of ``contact``."""
        return self.contact

    @property
    def velocity_parameter(self) -> float:
        """Dimensionless velocity parameter Lambda = 6 eta0 u_s R^2/(b^3 p_h), where u_s = u1 + u2."""
        return velocity_parameter(
            viscosity=self.viscosity,
            entrainment_speed=self.contact.entrainment_speed,
            radius=self.reduced_radius,
            half_width=self.half_width,
            max_pressure=self.max_pressure,
        )

    @property
    def semi_axes(self) -> tuple[float, ...]:
        """Half-width of the dry contact [m], as a tuple of one number."""
        return (self.half_width,)

    @property
    def thickness_scale(self) -> float:
        """Film thickness that corresponds to H = 1, b^2/R [m]."""
        return self.half_width**2 / self.reduced_radius


def line_conditions(
    oil: Oil,
    *,
    reduced_radius: float,
    reduced_modulus: float,
    load_per_length: float,
    entrainment_speed: float,
    slide_to_roll_ratio: float = 0.0,
    bodies: Sequence[float] = (),
    curvature_share: float = 0.5,
    compliance_share: float = 0.5,
    film_factor: float = 1.0,
    boundary_film: float = 0.0,
    hardness: float | None = None,
) -> Conditions:
    """Compute the operating conditions of a line contact from numbers in SI units, without a case.

    Parameters
    ----------
    oil : Oil
        Oil at the temperature of the contact.
    reduced_radius, reduced_modulus, load_per_length : float
        R [m], E' [Pa] and w [N/m].
    entrainment_speed, slide_to_roll_ratio : float
        (u1 + u2)/2 [m/s], and (u1 - u2)/entrainment_speed, dimensionless.
    bodies : sequence of float
        Radii of both bodies [m], if they are known; the dry contact must be small compared to them.
    curvature_share, compliance_share, film_factor : float
        Surface 1's shares of 1/R and of 2/E', and the film factor, dimensionless; see ``Conditions``.
    boundary_film, hardness : float
        Gap at which the surfaces touch [m], zero where they are taken not to, and largest pressure there
        [Pa].

    Returns
    -------
    Conditions
        Operating conditions, including half-width [m] and Hertz pressure [Pa] of the dry contact.

    Raises
    ------
    InputError
        If the dry contact is too wide for its bodies, or the Hertz pressure is near the ambient pressure.

    Examples
    --------
    >>> from ehlectric.cases.oils.lubricant import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> inputs = {"reduced_radius": 0.01, "reduced_modulus": 226e9, "load_per_length": 3e5}
    >>> conditions = line_conditions(oil, **inputs, entrainment_speed=2.0)
    >>> round(conditions.max_pressure / 1e9, 3)
    1.039
    """
    half_width = hertz.line_half_width(load_per_length, reduced_radius, reduced_modulus)
    max_pressure = hertz.line_max_pressure(load_per_length, reduced_radius, reduced_modulus)
    check_width(half_width, min([reduced_radius, *bodies]))
    check_pressure(max_pressure, oil)
    return Conditions(
        reduced_radius=reduced_radius,
        reduced_modulus=reduced_modulus,
        load_per_length=load_per_length,
        entrainment_speed=entrainment_speed,
        slide_to_roll_ratio=slide_to_roll_ratio,
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.alpha_star,
        half_width=half_width,
        max_pressure=max_pressure,
        curvature_share=curvature_share,
        compliance_share=compliance_share,
        boundary_film=boundary_film,
        hardness=hardness,
        film_factor=film_factor,
    )


@dataclass(frozen=True)
class PointConditions:
    """Operating conditions of a point contact, SI units; x runs along entrainment, y across it.

    Attributes
    ----------
    radius_x, radius_y : float
        Reduced radii along and across entrainment [m].
    reduced_modulus : float
        E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    load : float
        F [N].
    entrainment_speed : float
        (u1 + u2)/2 [m/s].
    slide_to_roll_ratio : float
        (u1 - u2)/entrainment_speed, dimensionless.
    viscosity, pressure_viscosity_coefficient : float
        Viscosity eta0 at ambient pressure [Pa s], and reciprocal asymptotic coefficient alpha* [1/Pa].
    semi_axis_x, semi_axis_y, max_pressure : float
        Semi-axes b along and a across entrainment [m], and Hertz pressure p_h [Pa] of the dry contact.
    side : float
        Half of the domain's width across entrainment, in semi-axes across.
    compliance_share : float
        Surface 1's share of 2/E', dimensionless; 0.5 if only the reduced modulus is known.
    boundary_film : float
        Thickness of the boundary film [m] at which the surfaces touch; zero where they are taken not to.
    hardness : float or None
        Largest pressure where the surfaces touch [Pa]; None for elastic asperities.
    film_factor : float
        Film thickness divided by that of an isothermal, fully flooded film, dimensionless; see ``contact``.
    """

    geometry: ClassVar[str] = "point"

    radius_x: float
    radius_y: float
    reduced_modulus: float
    load: float
    entrainment_speed: float
    slide_to_roll_ratio: float
    viscosity: float
    pressure_viscosity_coefficient: float
    semi_axis_x: float
    semi_axis_y: float
    max_pressure: float
    side: float
    compliance_share: float = 0.5
    boundary_film: float = 0.0
    hardness: float | None = None
    film_factor: float = 1.0

    @property
    def contact(self) -> PointContact:
        """Inputs of the film-thickness formulas and of the Reynolds equation.

        ``film_factor`` acts only here. It reduces the entrainment speed to u film_factor^(1/0.67), at which
        an isothermal, fully flooded film is thinner by that factor.
        """
        return PointContact(
            self.radius_x,
            self.radius_y,
            self.reduced_modulus,
            self.load,
            self.entrainment_speed * self.film_factor ** (1.0 / POINT_FILM_EXPONENT),
            self.viscosity,
            self.pressure_viscosity_coefficient,
        )

    @property
    def formulas(self) -> PointContact:
        """Alias of ``contact``."""
        return self.contact

    @property
    def velocity_parameter(self) -> float:
        """Dimensionless velocity parameter Lambda = 6 eta0 u_s Rx^2/(b^3 p_h), where u_s = u1 + u2."""
        return velocity_parameter(
            viscosity=self.viscosity,
            entrainment_speed=self.contact.entrainment_speed,
            radius=self.radius_x,
            half_width=self.semi_axis_x,
            max_pressure=self.max_pressure,
        )

    @property
    def half_width(self) -> float:
        """Semi-axis of the dry contact along entrainment [m], which scales x and y."""
        return self.semi_axis_x

    @property
    def semi_axes(self) -> tuple[float, ...]:
        """Semi-axes of the dry contact along and across entrainment [m]."""
        return self.semi_axis_x, self.semi_axis_y

    @property
    def ratio(self) -> float:
        """Ratio k = a/b of the semi-axes of the dry contact, a across and b along entrainment."""
        return self.semi_axis_y / self.semi_axis_x

    @property
    def thickness_scale(self) -> float:
        """Film thickness that corresponds to H = 1, b^2/Rx [m]."""
        return self.semi_axis_x**2 / self.radius_x


def point_conditions(
    oil: Oil,
    *,
    radii: tuple[float, float],
    reduced_modulus: float,
    load: float,
    entrainment_speed: float,
    slide_to_roll_ratio: float = 0.0,
    bodies: tuple[Sequence[float], Sequence[float]] = ((), ()),
    side: float | None = None,
    compliance_share: float = 0.5,
    film_factor: float = 1.0,
    boundary_film: float = 0.0,
    hardness: float | None = None,
) -> PointConditions:
    """Compute the operating conditions of a point contact from numbers in SI units, without a case.

    Parameters
    ----------
    oil : Oil
        Oil at the temperature of the contact.
    radii : tuple of float
        Reduced radii along and across entrainment [m].
    reduced_modulus, load : float
        E' [Pa] and F [N].
    entrainment_speed, slide_to_roll_ratio : float
        (u1 + u2)/2 [m/s], and (u1 - u2)/entrainment_speed, dimensionless.
    bodies : tuple of sequence of float
        Radii of both bodies along and across entrainment [m], if they are known; the dry contact must be
        small compared to them.
    side : float, optional
        Half of the domain's width, in semi-axes across; ``default_side`` if not given.
    compliance_share, film_factor : float
        Surface 1's share of 2/E', and the film factor, dimensionless; see ``PointConditions``.
    boundary_film, hardness : float
        Gap at which the surfaces touch [m], zero where they are taken not to, and largest pressure there
        [Pa].

    Returns
    -------
    PointConditions
        Operating conditions, including semi-axes [m] and Hertz pressure [Pa] of the dry contact.

    Raises
    ------
    InputError
        If the dry contact is too wide for its bodies, or the Hertz pressure is near the ambient pressure.

    Examples
    --------
    >>> from ehlectric.cases.oils.lubricant import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> inputs = {"radii": (0.01, 0.01), "reduced_modulus": 226e9, "load": 20.0}
    >>> conditions = point_conditions(oil, **inputs, entrainment_speed=2.0)
    >>> round(conditions.max_pressure / 1e9, 3)
    0.791
    """
    dry = hertz_point.dry_contact(load, *radii, reduced_modulus)
    check_width(dry.semi_axis_x, min([radii[0], *bodies[0]]))
    check_width(dry.semi_axis_y, min([radii[1], *bodies[1]]))
    check_pressure(dry.max_pressure, oil)
    return PointConditions(
        radius_x=radii[0],
        radius_y=radii[1],
        reduced_modulus=reduced_modulus,
        load=load,
        entrainment_speed=entrainment_speed,
        slide_to_roll_ratio=slide_to_roll_ratio,
        viscosity=oil.viscosity,
        pressure_viscosity_coefficient=oil.alpha_star,
        semi_axis_x=dry.semi_axis_x,
        semi_axis_y=dry.semi_axis_y,
        max_pressure=dry.max_pressure,
        side=default_side(dry.semi_axis_y / dry.semi_axis_x) if side is None else side,
        compliance_share=compliance_share,
        boundary_film=boundary_film,
        hardness=hardness,
        film_factor=film_factor,
    )


def default_side(ratio: float) -> float:
    """Default half-width of the domain of a point contact: 1.6 + 1.4/k, at most 4.5 semi-axes across.

    Parameters
    ----------
    ratio : float
        Ratio k = a/b of the semi-axes of the dry contact, a across and b along entrainment, dimensionless.

    Returns
    -------
    float
        Half of the domain's width, in semi-axes across, dimensionless.

    Examples
    --------
    >>> default_side(1.0), round(default_side(9.3), 2), default_side(0.2)
    (3.0, 1.75, 4.5)
    """
    return min(_MOST_SIDE, _LEAST_SIDE + (_CIRCLE_SIDE - _LEAST_SIDE) / ratio)
