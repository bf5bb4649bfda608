"""Warnings of a solved bearing: films, voltages, clearance, shoulders, and single contacts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ehlectric.bearing.breakdown import breakdown_of
from ehlectric.bearing.contacts import ContactSolution
from ehlectric.bearing.limits import TAKEN, groove_ratio, shoulder_angle
from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import (
    BearingSolution,
    Position,
    capacitance_is_bound,
    insulating,
    lambda_ratio,
    lubrication,
)
from ehlectric.cases.bearing import Bearing
from ehlectric.discharge.verdict import breakdown_warning
from ehlectric.errors import ResultWarning

# Temperature below which the viscosity, extrapolated from 40 and 100 degC, may be far off [K].
_COLD = 273.15


def bearing_warnings(solution: BearingSolution) -> list[ResultWarning]:
    """Warnings that tell where the result of a bearing is unreliable, each once."""
    warnings = [*film_warnings(solution), *voltage_warnings(solution), *_warnings_of_contacts(solution)]
    return list(dict.fromkeys(warnings))


def film_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of the films of a whole bearing: how they are computed, oil, temperature and clearance."""
    if solution.case.contacts == "formula":
        text = "contacts by formula: films may be 30 % off, and fields are voltages over the minimum film"
        yield ResultWarning("formula-contacts", text)
    if solution.conditions.film_factor == 1.0:
        factor = solution.case.bearing.film_factor
        name = factor if isinstance(factor, str) else f"{factor:g}"
        text = f"film_factor {name}: the film is isothermal and fully flooded, voltages are upper bounds"
        yield ResultWarning("isothermal-film", text)
    if solution.case.lubricant.temperature is None:
        text = "lubricant.viscosity is given: bearing.temperature has no part in the films"
        yield ResultWarning("temperature-unused", text)
    elif solution.case.bearing.temperature < _COLD:
        cold = solution.case.bearing.temperature - 273.15
        text = f"bearing.temperature is {cold:.3g} °C: the viscosity from 40 and 100 °C may be far off"
        yield ResultWarning("temperature-low", text)
    yield from clearance_warnings(solution.conditions.geometry.clearance, solution.positions[0])


def voltage_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of the capacitance and the voltages of a bearing: lubrication, ceramics, Weibull strength."""
    state, ceramic = lubrication(solution), solution.conditions.ceramic
    touching = f"lambda is {lambda_ratio(solution):.2g}: surfaces"
    if state == "conducting":
        text = f"{touching} touch and conduct, nothing breaks down, and no shaft voltage is stated"
        yield ResultWarning("touching", text)
    elif state == "touching":
        yield ResultWarning("touching", f"{touching} touch, and the elements insulate")
    elif state == "partial film":
        text = f"{touching} may touch" + ("" if ceramic else ", voltages are upper bounds")
        yield ResultWarning("partial-film", text)
    if capacitance_is_bound(solution):
        yield ResultWarning(
            "capacitance-bound",
            "the elements are ceramic: the capacitance is an upper bound, that of conducting ones, and "
            "no shaft voltage follows from it; bearing.element_capacitance gives one",
        )
    breakdown, shaft = breakdown_of(solution), shaft_voltage(solution)
    if breakdown is not None and shaft is not None and breakdown.first_break < shaft and solution.converged:
        at = f"first breakdown at {breakdown.first_break:.3g} V"
        yield breakdown_warning("shaft voltage", shaft, at, breakdown.first_break / shaft)
    if solution.case.discharge.weibull is not None and insulating(solution):
        text = "first break and through breakdown are voltages at a probability of 63.2 % (Weibull)"
        yield ResultWarning("weibull-voltage", text)


def _warnings_of_contacts(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of single contacts, and of contacts that reach over the shoulder of a groove."""
    yield from edge_warnings(solution.case.bearing, solution.positions)
    yield from contact_warnings(
        {"inner": solution.inner_curve.solutions, "outer": solution.outer_curve.solutions}
    )


def edge_warnings(bearing: Bearing, positions: Sequence[Position]) -> Iterator[ResultWarning]:
    """Warnings of contact ellipses that reach over the shoulder of a groove, at most one per ring.

    Of the contacts that reach over, the warning names the one with the largest load.

    Parameters
    ----------
    bearing : Bearing
        Dimensions of the bearing, with its grooves.
    positions : sequence of Position
        Contacts at each position of the cage.
    """
    for k, name in enumerate(("inner", "outer")):
        shoulder = shoulder_angle(bearing, inner=k == 0)
        groove = groove_ratio(bearing, inner=k == 0) * bearing.element_diameter
        load, reached = 0.0, 0.0
        for position in positions:
            ring, angle = position.rings[k], position.equilibrium.ring(inner=k == 0).angle
            ends = np.abs(angle) + ring.values.semi_axis_y / groove
            over = np.where(ends > shoulder, ring.load, 0.0)
            heaviest = int(np.argmax(over))
            if over[heaviest] > load:
                load, reached = float(over[heaviest]), float(ends[heaviest])
        if load > 0.0:
            yield ResultWarning(
                "shoulder-reached",
                f"{name} ring: the contact with {load:.3g} N would reach {math.degrees(reached):.1f} deg up "
                f"a groove that ends at {math.degrees(shoulder):.1f} deg: the shoulder cuts it off, and the "
                "pressure on that edge is not in this",
            )


def clearance_warnings(clearance: float, position: Position) -> Iterator[ResultWarning]:
    """Warnings of films that take up much of the clearance, an effect that the equilibrium neglects.

    Parameters
    ----------
    clearance : float
        Radial internal clearance, the full diametral play [m]; negative with a preload.
    position : Position
        Loads and films at one position of the cage.
    """
    at, room = position.equilibrium, clearance
    most = int(np.argmax(at.inner_load))
    films = sum(float(ring.values.central_thickness[most]) for ring in position.rings)
    beside = "a clearance of"
    if room <= 0.0:
        # Preloaded elements have no clearance: the films are compared with the elastic approach.
        room, beside = float(at.inner_approach[most] + at.outer_approach[most]), "elements pressed in by"
    if films > TAKEN * room:
        yield ResultWarning(
            "clearance-taken-up",
            f"both films of the most loaded element are {1e6 * films:.2g} um, beside {beside} "
            f"{1e6 * room:.2g} um: loads are those of dry contacts, which such films change",
        )


def contact_warnings(rings: Mapping[str, Sequence[ContactSolution]]) -> list[ResultWarning]:
    """Warnings of the contacts of a bearing; equal warnings of several contacts become one.

    Parameters
    ----------
    rings : mapping of str to sequence of ContactSolution
        Solved contacts by the name of their ring.

    Returns
    -------
    list of ResultWarning
        Warnings in the order of the contacts. The text of a warning names ring and load, unless all contacts
        have the same warning, for example about their oil.
    """
    loads_by_ring: dict[ResultWarning, dict[str, list[float]]] = {}
    for ring, contacts in rings.items():
        for contact in contacts:
            for warning in dict.fromkeys(contact.warnings):
                loads_by_ring.setdefault(warning, {}).setdefault(ring, []).append(contact.load)
    every = sum(map(len, rings.values()))
    return [
        warning
        if sum(map(len, by_ring.values())) == every
        else ResultWarning(
            warning.code, ", ".join(_named(ring, loads) for ring, loads in by_ring.items()) + f": {warning}"
        )
        for warning, by_ring in loads_by_ring.items()
    ]


def _named(ring: str, loads: Sequence[float]) -> str:
    """Text that names one or several contacts with a ring by their loads [N].

    Examples
    --------
    >>> _named("inner", [800.0]), _named("outer", [20.0, 40.0, 80.0])
    ('inner contact at 800 N', '3 outer contacts at 20 to 80 N')
    """
    if len(loads) == 1:
        return f"{ring} contact at {loads[0]:.4g} N"
    return f"{len(loads)} {ring} contacts at {min(loads):.4g} to {max(loads):.4g} N"
