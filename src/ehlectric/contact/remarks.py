"""What to know of a contact before it is solved."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.lubricant import Lubricant
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas
from ehlectric.lubricant.viscosity import roelands_exponent

# Hertz pressure at which bearing steel deforms permanently, of line contacts (ISO 76) [Pa].
_LINE_PERMANENT = 4e9

# A rigid film builds up over some ten sqrt(2 R h), which is this over M in half-widths.
_RIGID_INLET = 14.0

# Hertz pressure at which bearing steel deforms permanently, of point contacts (ISO 76) [Pa].
_POINT_PERMANENT = 4.2e9


def line_remarks(setup: Case | Setup, conditions: Conditions) -> Iterator[str]:
    """What a user should know about a case before it is solved, one text each."""
    yield from regime_remarks(conditions)
    width = (setup.grid.outlet - setup.grid.inlet) / (0.5 * np.pi)
    yield from pressure_remarks(setup.lubricant, conditions.max_pressure, width, "line", _LINE_PERMANENT)


def regime_remarks(conditions: Conditions) -> Iterator[str]:
    """What to know of a line contact far from those that the film formulas were made for."""
    regime = film_formulas.regime(conditions.contact)
    if regime == "isoviscous-rigid":
        yield rigid_remark("half-width", "half-widths", _RIGID_INLET / conditions.contact.moes_m)
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


def point_remarks(setup: Case | Setup, conditions: PointConditions) -> Iterator[str]:
    """What a user should know about a point contact before it is solved, one text each."""
    yield from point_regime_remarks(conditions)
    area = (setup.grid.outlet - setup.grid.inlet) * 2.0 * conditions.side
    domain = area / (2.0 * np.pi / 3.0)
    yield from pressure_remarks(setup.lubricant, conditions.max_pressure, domain, "point", _POINT_PERMANENT)


def point_regime_remarks(conditions: PointConditions) -> Iterator[str]:
    """What to know of a point contact far from those that the film formulas were made for."""
    contact = conditions.contact
    regime = point_formulas.regime(contact)
    if regime == "isoviscous-rigid":
        film = point_formulas.nijenbanning_venner_moes(contact).central_thickness
        assert film is not None
        # A rigid film builds up over some ten sqrt(2 R h).
        reach = 10.0 * float(np.sqrt(2.0 * contact.radius_x * film)) / conditions.semi_axis_x
        yield rigid_remark("semi-axis", "semi-axes", reach)
    elif regime == "isoviscous-elastic":
        yield (
            f"{regime} regime: the film formulas but that of Nijenbanning, Venner and Moes are for "
            "piezoviscous contacts"
        )
