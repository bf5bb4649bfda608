"""Warnings about the operating conditions of a contact, known before it is solved."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.cases import library
from ehlectric.cases.case import Case
from ehlectric.cases.case_oil import viscosity_over_temperature
from ehlectric.cases.contact_inputs import modulus_doubt, radius_doubt
from ehlectric.cases.film_inputs import CONSTANTS
from ehlectric.cases.plausibility import PLAUSIBLE, extreme, oil_doubts, rq_warning_condition, unusual
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.result_warnings import ResultWarning, WarningCondition, active

if TYPE_CHECKING:
    from ehlectric.contact.setup import Setup

# Hertz pressure at which bearing steel deforms permanently in line and in point contacts (ISO 76) [Pa].
PERMANENT = {"line": 4e9, "point": 4.2e9}

# The film between rigid bodies builds up over a length of about 10 sqrt(2 R h). In half-widths of a line
# contact, this length is the following number divided by Moes' M.
_RIGID_INLET = 14.0


def case_warnings(setup: Case | Setup, conditions: Conditions | PointConditions) -> Iterator[ResultWarning]:
    """Warnings about the operating conditions of a contact, known before it is solved."""
    key = "radius_x" if isinstance(conditions, PointConditions) else "reduced_radius"
    yield from radius_doubt(key, conditions.radius_along)
    given = setup.contact.reduced_modulus if isinstance(setup, Case) else conditions.reduced_modulus
    # The moduli of two bodies, such as glass and steel, contain no factor 2.
    yield from () if given is None else modulus_doubt(given)
    yield from active(_doubts(setup, conditions))
    yield from user_law_warnings(setup, conditions)
    yield from temperature_warnings(setup)
    yield from rheology_warnings(setup)
    # Load that the Hertz pressure would carry on the whole domain, over the load of the contact.
    if isinstance(conditions, PointConditions):
        yield from point_regime_warnings(conditions)
        domain = setup.grid.length * 2.0 * conditions.side / (2.0 * np.pi / 3.0)
    else:
        yield from regime_warnings(conditions)
        domain = setup.grid.length / (0.5 * np.pi)
    yield from pressure_warnings(setup.oil, conditions, domain)
    yield from hardness_warnings(conditions)


def _doubts(setup: Case | Setup, conditions: Conditions | PointConditions) -> Iterator[WarningCondition]:
    """Conditions of warnings about values that no machine has."""
    yield from unusual("speed", conditions.entrainment_speed)
    if isinstance(setup, Case) and setup.contact.temperature is not None:
        yield extreme("contact.temperature", setup.contact.temperature)
    if conditions.reduced_modulus > PLAUSIBLE["modulus"].low:
        yield from unusual("pressure", conditions.max_pressure)
    yield from oil_doubts(setup.oil)
    yield from () if setup.discharge is None else unusual("strength", setup.discharge.dielectric_strength)
    for surface in setup.roughness:
        yield from unusual("roughness", surface.rq if surface.rescale_rq is None else surface.rescale_rq)
        yield from rq_warning_condition("roughness.ra", surface.ra, surface.rq_over_ra)
    if isinstance(setup, Case) and setup.meter is not None:
        yield from rq_warning_condition("meter.ra", setup.meter.ra, setup.meter.rq_over_ra)


def user_law_warnings(
    setup: Case | Setup, conditions: Conditions | PointConditions
) -> Iterator[ResultWarning]:
    """Notes about laws of the user's own, which no file contains, and which heat may not change."""
    if not isinstance(setup, Case) or setup.user_laws is None:
        return
    names = setup.user_laws.names
    yield ResultWarning.of("own-laws", laws=", ".join(f"{key}: {name}" for key, name in names.items()))
    if "viscosity" not in names or setup.film is None or not setup.film.thermal:
        return
    from ehlectric.contact.contact_heat import physics_of  # late: bearings of the atlas do not need it

    physics = physics_of(setup, conditions)
    assert physics is not None
    assert physics.thermal is not None
    first, last = physics.thermal.oil.oils[0], physics.thermal.oil.oils[-1]
    if math.isclose(first.viscosity, last.viscosity, rel_tol=1e-6):
        yield ResultWarning.of("temperature-unused", "law", law=names["viscosity"])


def temperature_warnings(setup: Case | Setup) -> Iterator[ResultWarning]:
    """Note about a temperature of the contact on which the oil of its case does not depend."""
    if not isinstance(setup, Case) or setup.contact.temperature is None:
        return
    if setup.user_laws is not None and "viscosity" in setup.user_laws.names:
        return
    if viscosity_over_temperature(setup.lubricant) is None:
        yield ResultWarning.of(
            "temperature-unused",
            "contact",
            viscosity=1e3 * setup.oil.viscosity,
            temperature=CELSIUS.text(setup.contact.temperature),
        )


def rheology_warnings(setup: Case | Setup) -> Iterator[ResultWarning]:
    """Note about constants of another law between shear stress and shear rate than the law of the film.

    Constants of the library's oil are no choice of the case, and a Newtonian film may stand for comparison.
    """
    if not isinstance(setup, Case) or setup.film is None or setup.film.rheology == "newtonian":
        return
    oil, rheology = setup.lubricant, setup.film.rheology
    base = library.tables("lubricant", oil.base)["lubricant"] if oil.base else {}
    for other, keys in CONSTANTS.items():
        given = [key for key in keys if getattr(oil, key) is not None and key not in base]
        if other != rheology and given:
            names = " and ".join(f"lubricant.{key}" for key in given)
            yield ResultWarning.of(
                "shear-constant-unused",
                names=names,
                are="are" if len(given) > 1 else "is",
                rheology=rheology,
                other=other,
            )


def hardness_warnings(conditions: Conditions | PointConditions) -> Iterator[ResultWarning]:
    """Warning about a hardness below the Hertz pressure: bodies would yield, not only asperities."""
    hardness, pressure = conditions.hardness, conditions.max_pressure
    if hardness is not None and hardness < pressure:
        yield ResultWarning.of("hardness-low", hardness=hardness / 1e9, pressure=pressure / 1e9)


def regime_warnings(conditions: Conditions) -> Iterator[ResultWarning]:
    """Warning about a line contact in a regime for which the film formulas were not made."""
    regime = film_formulas.regime(conditions.contact)
    if regime == "isoviscous-rigid":
        yield rigid_warning("Moes", "half-widths", float(_RIGID_INLET / conditions.contact.moes_m))
    elif regime != "piezoviscous-elastic":
        yield ResultWarning.of("regime", "line", regime=regime)


def rigid_warning(formula: str, lengths: str, reach: float) -> ResultWarning:
    """Warning about a contact in the isoviscous-rigid regime.

    The film builds up over ``reach`` half-widths or semi-axes, whose name is ``lengths``. ``formula`` is the
    only one that holds.
    """
    return ResultWarning.of("regime", "rigid", formula=formula, reach=reach, lengths=lengths, inlet=-reach)


def pressure_warnings(
    oil: Oil, conditions: Conditions | PointConditions, domain: float
) -> Iterator[ResultWarning]:
    """Warnings that follow from the Hertz pressure of a contact and from its oil.

    ``domain`` is the load that the Hertz pressure would carry if it acted on the whole domain, divided by
    the load of the contact.
    """
    pressure, kind = conditions.max_pressure, conditions.geometry
    permanent = PERMANENT[kind]
    ambient_load = oil.ambient_pressure / pressure * domain
    if ambient_load > 0.01:
        yield ResultWarning.of("ambient-pressure", percent=100 * ambient_load)
    if pressure > permanent:
        yield ResultWarning.of(
            "plastic-deformation", pressure=pressure / 1e9, limit=permanent / 1e9, kind=kind
        )
    yield from oil.warnings(pressure)


def point_regime_warnings(conditions: PointConditions) -> Iterator[ResultWarning]:
    """Warning about a point contact in a regime for which the film formulas were not made."""
    contact = conditions.contact
    regime = point_formulas.regime(contact)
    if regime == "isoviscous-rigid":
        film = point_formulas.nijenbanning_venner_moes(contact).central_thickness
        # The film between rigid bodies builds up over about 10 sqrt(2 R h).
        reach = 10.0 * float(np.sqrt(2.0 * contact.radius_x * film)) / conditions.semi_axis_x
        yield rigid_warning("Nijenbanning, Venner and Moes", "semi-axes", reach)
    elif regime == "isoviscous-elastic":
        yield ResultWarning.of("regime", "point", regime=regime)
