"""Film factor and friction of a contact of a bearing, from its film solved with and without heat."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric.bearing.conditions import ContactFriction
from ehlectric.bearing.kinds import kind_of
from ehlectric.bearing.ring_contacts import Contact, RingContacts, check_contact, error_of_contact
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.contact import Body as BodyTable
from ehlectric.cases.films.physics import thermal_properties
from ehlectric.cases.grid import Grid
from ehlectric.cases.oils.lubricant import Lubricant
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.heat.oil import hot_oil
from ehlectric.contact.kinds import KINDS
from ehlectric.contact.setup import Setup
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.thermal.physics import Body, Physics, Thermal
from ehlectric.runtime.log import LOGGER

# Intervals along entrainment for one across: half of the nodes across change the factor by 1e-4.
_ACROSS = 2

# Least number of intervals of a ball's contact along entrainment. With twice as many the factor of a 6208 at
# 15 000 rpm is 0.4 % larger.
_ALONG = 128

# Grids that are tried, each with twice the nodes of the last: thin films of slow contacts need more of them.
_GRIDS = 2


@dataclass(frozen=True)
class _HotContact:
    """Contact whose film is solved with and without heat; equal ones have the same heat.

    Attributes
    ----------
    conditions : Conditions or PointConditions
        Operating conditions of the isothermal, fully flooded film.
    temperature : float
        Temperature of the oil that enters, and of the ring [K].
    bodies : tuple of Body
        Ring and element.
    identity : str
        Lubricant and solver of the file, as text.
    lubricant, setup
        Lubricant, and setup with its grid; both follow from the other attributes.
    """

    conditions: Conditions | PointConditions
    temperature: float
    bodies: tuple[Body, Body]
    identity: str
    lubricant: Lubricant = field(compare=False, repr=False)
    setup: Setup = field(compare=False, repr=False)


def solved_heat(case: BearingCase, ring: RingContacts[Any], load: float) -> tuple[float, ContactFriction]:
    """Film factor of the heat in a contact, and its friction and temperature in pure rolling.

    Parameters
    ----------
    case : BearingCase
        Bearing file, with ``bearing.film_factor`` "solved".
    ring : RingContacts
        Contacts with the ring; their film factor is not used.
    load : float
        Load of the contact [N].

    Returns
    -------
    factor : float
        Central film thickness with heat over that of the isothermal Newtonian film, dimensionless.
    friction : ContactFriction
        Rolling friction and temperature of the film with heat. Those of the same contact are kept.

    Raises
    ------
    InputError
        Where the contact is beyond the model, or the oil has no values at its temperatures.
    ConvergenceError
        Where one of both films does not converge.

    Notes
    -----
    Both surfaces have the entrainment speed: the slip by spin, of the cage and along the ellipse is left out.
    The oil thins where it is sheared if the lubricant has an Eyring stress, and is Newtonian otherwise.
    """
    kind = kind_of(ring)
    contact: Contact = kind.contact(_flooded(ring), load)
    check_contact(contact)
    try:
        factor, found = _solved(_hot(case, contact, kind.grid(contact)))
    except InputError as error:
        raise error_of_contact(contact, error) from None
    except ConvergenceError as error:
        where = f"{ring.name} contact at {load:.4g} N"
        text = f"bearing.film_factor 'solved': {where}: {error}; 'inlet-shear' needs no solved film"
        raise ConvergenceError(text) from None
    # Load and power of a line contact are those of a metre of it.
    length = case.bearing.roller_length or 1.0
    return factor, replace(found, load=load, power_loss=length * found.power_loss)


def _flooded(ring: RingContacts[Any]) -> RingContacts[Any]:
    """Contacts with a ring whose films are isothermal and fully flooded."""
    at = ring.conditions
    inner, outer = (replace(own, film_factor=1.0) for own in (at.inner, at.outer))
    return replace(ring, conditions=replace(at, inner=inner, outer=outer))


def _hot(case: BearingCase, contact: Contact, grid: Grid) -> _HotContact:
    """Contact of a bearing with its bodies, its oil and its grid."""
    ring, bearing = contact.ring, case.bearing
    temperature = bearing.ring_temperature(inner=ring.inner)
    conditions: Conditions | PointConditions = contact.conditions
    if isinstance(conditions, PointConditions):
        assert grid.side is not None
        conditions = replace(conditions, side=grid.side)
    return _HotContact(
        conditions,
        temperature,
        (
            _body(bearing.ring_material, temperature, "bearing.ring_material"),
            _body(bearing.element_material, bearing.element_temperature, "bearing.element_material"),
        ),
        f"{case.lubricant.model_dump_json()} {case.solver.model_dump_json()}",
        case.lubricant,
        Setup(ring.oil, _coarse(grid), solver=case.solver),
    )


def _body(material: str, temperature: float, key: str) -> Body:
    """Body of a material of the library at a temperature [K]."""
    return Body(temperature, **thermal_properties(BodyTable.from_dict({"material": material}), key))


def _coarse(grid: Grid) -> Grid:
    """Grid for the factor, on the domain of a grid for the film: errors of both films nearly cancel."""
    if grid.side is None:
        return _with_nodes(grid, grid.nodes_along // 2)
    parts = _ALONG
    while parts + 1 < grid.nodes_along:
        parts *= 2
    return _with_nodes(grid, parts)


def _with_nodes(grid: Grid, parts: int) -> Grid:
    """Grid with a number of intervals along entrainment, which is not refined."""
    across = {} if grid.side is None else {"nodes_y": parts // _ACROSS + 1}
    return grid.model_copy(update={"nodes": parts + 1, "refine": None, **across})


@lru_cache(maxsize=256)
def _solved(hot: _HotContact) -> tuple[float, ContactFriction]:
    """Central film with heat over that without it, and friction; seconds for a roller, more for a ball."""
    conditions, lubricant = hot.conditions, hot.lubricant
    stress = lubricant.eyring_stress
    rheology = Rheology() if stress is None else Rheology("eyring", {"eyring_stress": stress})
    temperatures = (hot.temperature, *(body.temperature for body in hot.bodies))
    oil = hot_oil(lubricant, temperatures, conditions.max_pressure)
    speeds = (conditions.entrainment_speed, conditions.entrainment_speed)
    physics = Physics(rheology, speeds, conditions.viscosity, Thermal(hot.bodies, hot.temperature, oil))
    kind, setup = KINDS[conditions.geometry], hot.setup
    for _ in range(_GRIDS):
        film = kind.solve_film(replace(kind.film_problem(setup, conditions, ()), physics=physics))
        isothermal = film.heated.isothermal_central_thickness
        if film.converged and isothermal is not None:
            factor = float(film.central_thickness / isothermal)
            nodes = " x ".join(map(str, film.thickness.shape))
            LOGGER.info("film factor of the heat: %.4g on %s nodes", factor, nodes)
            return factor, _friction(film, conditions, hot.temperature)
        setup = replace(setup, grid=_with_nodes(setup.grid, 2 * (setup.grid.nodes_along - 1)))
    if film.converged:
        raise ConvergenceError("the isothermal film did not converge; raise solver.max_iterations")
    raise ConvergenceError(f"film with heat, {film.status} at a residual of {film.residual:.1e}")


def _friction(
    film: Film | PointFilm, conditions: Conditions | PointConditions, temperature: float
) -> ContactFriction:
    """Friction and temperature of a film with heat whose oil enters with a temperature [K]."""
    heated = film.heated
    assert heated is not None and heated.mid_temperature is not None
    assert heated.max_temperature_rise is not None
    assert heated.rolling_coefficient is not None and heated.power_loss is not None
    return ContactFriction(
        load=conditions.load if isinstance(conditions, PointConditions) else conditions.load_per_length,
        rolling_coefficient=heated.rolling_coefficient,
        power_loss=heated.power_loss,
        inlet_temperature_rise=float(np.max(heated.mid_temperature[film.x <= 0.0])) - temperature,
        max_temperature_rise=heated.max_temperature_rise,
        temperature_rise_error=heated.temperature_rise_error,
    )
