"""Film of a bearing contact solved with its heat: factor on the film, friction and temperature."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.conditions import ContactFriction
from ehlectric.bearing.ring_contacts import Contact, RingContacts, check_contact, error_of_contact
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.contact_inputs import Body as BodyTable
from ehlectric.cases.film_inputs import thermal_properties
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact import KINDS, Conditions, PointConditions, Setup, hot_oil, reached_rise
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.film import Body, Film, OilSupply, Physics, PointFilm, Rheology, Thermal
from ehlectric.readable import readable
from ehlectric.runtime.progress import LOGGER

# Intervals along entrainment for one across: half of the nodes across change the factor by 1e-4.
_ACROSS = 2

# Least number of intervals of a ball's contact along entrainment. With twice as many the factor of a 6208 at
# 15 000 rpm is 0.4 % larger.
_ALONG = 128

# Grids that are tried, each with twice the nodes of the last: thin films of slow contacts need more of them.
_GRIDS = 2


@dataclass(frozen=True)
class _HotContact:
    """Contact whose film is solved with and without heat; equal ones have the same heat."""

    conditions: Conditions | PointConditions  # operating conditions of the isothermal, fully flooded film
    temperature: float  # temperature of the oil that enters, and of the ring [K]
    bodies: tuple[Body, Body]
    identity: str  # lubricant and solver of the file, as text
    # lubricant and setup: lubricant, and setup with its grid; both follow from the other attributes.
    lubricant: Lubricant = field(compare=False, repr=False)
    setup: Setup = field(compare=False, repr=False)

    @property
    def physics(self) -> Physics:
        """Heat and shear of the film, whose surfaces have one speed."""
        conditions, stress = self.conditions, self.lubricant.eyring_stress
        rheology = Rheology() if stress is None else Rheology("eyring", {"eyring_stress": stress})
        temperatures = (self.temperature, *(body.temperature for body in self.bodies))
        oil = hot_oil(self.lubricant, temperatures, conditions.max_pressure)
        speeds = (conditions.entrainment_speed, conditions.entrainment_speed)
        thermal = Thermal(self.bodies, self.temperature, oil)
        return Physics(rheology, speeds, conditions.viscosity, thermal)

    def film(self, grid: Grid, supply: OilSupply | None = None) -> Film | PointFilm:
        """Film with heat on a grid, flooded or with a supply of oil."""
        kind, setup = KINDS[self.conditions.geometry], replace(self.setup, grid=grid)
        problem = kind.film_problem(setup, self.conditions, ())
        film: Film | PointFilm = kind.solve_film(replace(problem, physics=self.physics, supply=supply))
        return film


def solved_contact(
    case: BearingCase, ring: RingContacts[Any], load: float
) -> tuple[float, ContactFriction | None]:
    """Film factor of the heat in a contact, and its friction and temperature in pure rolling.

    ``load`` [N]. Returns ``factor``, central film thickness with heat divided by the thickness of the
    isothermal Newtonian film, both flooded, dimensionless; ``friction``, rolling friction and temperature of
    the film with its heat and its supply of oil, None where the film with both does not converge; results of
    equal contacts are kept. Raises InputError where the contact is beyond the model, or the oil has no values
    at its temperatures; ConvergenceError where one of both flooded films does not converge.

    A share of the flooded film as supply is solved together with the heat. A rule for the supply has no film
    of its own: it is a factor on the film, and as published one on the force of rolling.

    Both surfaces have the entrainment speed: the slip by spin, of the cage and along the ellipse is
    neglected. The oil thins where it is sheared if the lubricant has an Eyring stress, and is Newtonian
    otherwise.
    """
    contact: Contact = kind_of(ring).contact(_flooded(ring), load)
    check_contact(contact)
    hot = _hot(case, contact)
    try:
        flooded = _solved(hot)
    except InputError as error:
        raise error_of_contact(contact, error) from None
    except ConvergenceError as error:
        where = f"{ring.name} contact at {readable(load, 4)} N"
        text = f"bearing.film_factor 'solved': {where}: {error}; 'inlet-shear' needs no solved film"
        raise ConvergenceError(text) from None
    friction: ContactFriction | None = flooded.friction
    if case.bearing.by_supply_rule:
        friction = _by_rule(flooded.friction, float(ring.supply_factor))
    elif ring.supply_factor < 1.0:
        friction = _starved(hot, flooded.grid, float(ring.supply_factor))
    if friction is None:
        return flooded.factor, None
    # Load and power of a line contact hold for a metre of it.
    length = case.bearing.roller_length or 1.0
    return flooded.factor, replace(friction, load=load, power_loss=length * friction.power_loss)


def _flooded(ring: RingContacts[Any]) -> RingContacts[Any]:
    """Contacts with a ring whose films are isothermal and fully flooded."""
    inner, outer = (replace(ring_conditions, film_factor=1.0) for ring_conditions in ring.conditions.rings)
    return replace(ring, conditions=replace(ring.conditions, inner=inner, outer=outer))


def _hot(case: BearingCase, contact: Contact) -> _HotContact:
    """Contact of a bearing with its bodies, its oil and its grid."""
    ring, bearing, grid = contact.ring, case.bearing, contact.grid
    temperature = bearing.ring_temperature(inner=ring.inner)
    return _HotContact(
        contact.conditions_on(grid),
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


@dataclass(frozen=True)
class _FloodedFilm:
    """Flooded film with heat of a contact."""

    factor: float  # central film with heat / film without heat, dimensionless
    friction: ContactFriction
    grid: Grid  # grid on which it converged


@lru_cache(maxsize=256)
def _solved(hot: _HotContact) -> _FloodedFilm:
    """Flooded film with heat and without it; seconds for a roller, more for a ball."""
    grid = hot.setup.grid
    for _ in range(_GRIDS):
        film = hot.film(grid)
        assert film.heated is not None
        isothermal = film.heated.isothermal_central_thickness
        if film.converged and isothermal is not None:
            factor = float(film.central_thickness / isothermal)
            nodes = " x ".join(map(str, film.thickness.shape))
            LOGGER.info("thermal reduction factor: %.4g on %s nodes", factor, nodes)
            return _FloodedFilm(factor, _friction(film, hot), grid)
        grid = _with_nodes(grid, 2 * (grid.nodes_along - 1))
    if film.converged:
        raise ConvergenceError("the isothermal film did not converge; raise solver.max_iterations")
    assert film.heated is not None
    reached = f"{film.status} at a residual of {film.residual:.1e}, {reached_rise(film.heated)}"
    raise ConvergenceError(f"film with heat, {reached}")


@lru_cache(maxsize=256)
def _starved(hot: _HotContact, grid: Grid, ratio: float) -> ContactFriction | None:
    """Friction of the film with heat under the layer of oil that leaves a ratio of the flooded film.

    None where this film does not converge, as some do that are only slightly starved. It takes seconds.
    """
    film = hot.film(grid, OilSupply(film_ratio=ratio))
    if not film.converged or film.starvation is None:
        LOGGER.info("film with heat at %.4g of the flooded one: %s", ratio, film.status)
        return None
    return replace(_friction(film, hot), oil_layer=film.starvation.oil_layer)


def _by_rule(flooded: ContactFriction, factor: float) -> ContactFriction:
    """Friction by a rule for the supply, a factor on the film and on the force of rolling; the temperatures
    are the temperatures of the flooded film.
    """
    assert flooded.solved_thickness is not None
    return replace(
        flooded,
        rolling_coefficient=factor * flooded.rolling_coefficient,
        power_loss=factor * flooded.power_loss,
        solved_thickness=factor * flooded.solved_thickness,
    )


def _friction(film: Film | PointFilm, hot: _HotContact) -> ContactFriction:
    """Friction and temperature of a film with heat."""
    heated, conditions = film.heated, hot.conditions
    assert heated is not None and heated.mid_temperature is not None
    same = ("rolling_coefficient", "power_loss", "max_temperature_rise", "temperature_rise_error")
    return ContactFriction(
        load=conditions.load if isinstance(conditions, PointConditions) else conditions.load_per_length,
        inlet_temperature_rise=float(np.max(heated.mid_temperature[film.x <= 0.0])) - hot.temperature,
        solved_thickness=film.central_thickness,
        **{name: getattr(heated, name) for name in same},
    )
