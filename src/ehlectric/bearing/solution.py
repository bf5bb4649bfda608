"""A solved bearing as data: contacts of all elements, circuits, capacitance, and films against roughness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.circuit import Circuit, series
from ehlectric.bearing.conditions import BearingConditions
from ehlectric.bearing.contacts import ContactCurve, ContactValues
from ehlectric.bearing.kinds import kind_of
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.version import __version__

# Lambda ratios below which surfaces touch, and below which they do now and then.
CONDUCTING, PARTIAL = 1.0, 3.0


@dataclass(frozen=True)
class RingState:
    """Contacts of all elements with one ring at one position of the cage.

    Attributes
    ----------
    load, gap : ndarray, shape (n,)
        Load [N], and the distance where element and ring do not touch [m], 0 elsewhere.
    solved : ndarray of bool, shape (n,)
        Whether film and field are solved ones; a gap of rigid bodies otherwise.
    values : ContactValues
        Films, capacitances and voltages, shape (n,); pressure, semi-axes and plate are 0 without load.
    """

    load: Array
    gap: Array
    solved: Mask
    values: ContactValues[Array]

    def capacitance(self, fill: str) -> Array:
        """Capacitance of each contact, with oil or air around the film [F]."""
        values = self.values
        return values.inside + (values.outside_oil if fill == "oil" else values.outside_air)


def ring_state(ring: RingContacts[Any], curve: ContactCurve, *, load: Array, gap: Array) -> RingState:
    """Contacts of all elements with one ring.

    Parameters
    ----------
    ring : RingContacts
        The ring.
    curve : ContactCurve
        Its loaded contacts.
    load, gap : ndarray, shape (n,)
        Load [N] and, without one, distance [m] of each element.

    Returns
    -------
    RingState
        Contacts without load count as rigid bodies.
    """
    solved = load > 0.0
    pairs = zip(
        _loaded(ring, curve, load[solved]).columns(),
        _unloaded(ring, curve, gap[~solved]).columns(),
        strict=True,
    )

    def together(loaded: Array, unloaded: Array) -> Array:
        column = np.empty_like(load)
        column[solved], column[~solved] = loaded, unloaded
        return column

    return RingState(load, gap, solved, ContactValues(*(together(*pair) for pair in pairs)))


def _loaded(ring: RingContacts[Any], curve: ContactCurve, load: Array) -> ContactValues[Array]:
    """Contacts at loads [N]: lighter ones than any solved have its film, but their own dry contact."""
    pressure, along, across, *others = curve.at(load).columns()
    lighter = np.minimum(1.0, load / curve.solutions[0].load)
    exponents = kind_of(ring).dry_exponents
    dry = (
        values * lighter**exponent
        for values, exponent in zip((pressure, along, across), exponents, strict=True)
    )
    return ContactValues(*dry, *others)


def _unloaded(ring: RingContacts[Any], curve: ContactCurve, gap: Array) -> ContactValues[Array]:
    """Contacts of rigid bodies a gap [m] apart, no narrower than the film that the lightest load leaves."""
    conditions, rigid = ring.conditions, kind_of(ring).rigid_capacitance
    apart = np.maximum(gap, curve.solutions[0].values.central_thickness)
    vacuum = np.array([rigid(ring, float(thickness)) for thickness in apart])
    none = np.zeros_like(apart)
    return ContactValues(
        max_pressure=none,
        semi_axis_x=none,
        semi_axis_y=none,
        minimum_thickness=apart,
        central_thickness=apart,
        inside=none,
        outside_oil=vacuum * conditions.lubricant.relative_permittivity,
        outside_air=vacuum,
        plate=none,
        strength_per_volt=1.0 / apart,
        breakdown_voltage=np.array([conditions.gap_breakdown(float(thickness)) for thickness in apart]),
    )


@dataclass(frozen=True)
class Position:
    """A bearing at one position of its cage; ``shape`` is that of a Weibull strength."""

    equilibrium: Equilibrium
    inner: RingState
    outer: RingState
    shape: float | None = None

    @property
    def rings(self) -> tuple[RingState, RingState]:
        """Contacts with the inner and with the outer ring."""
        return self.inner, self.outer

    def circuit(self, fill: str) -> Circuit:
        """Circuit of the bearing, with oil or air around the films."""
        return Circuit(
            self.inner.capacitance(fill),
            self.outer.capacitance(fill),
            self.inner.values.breakdown_voltage,
            self.outer.values.breakdown_voltage,
            self.shape,
        )


@dataclass(frozen=True)
class BearingSolution:
    """A bearing over one pitch of its elements.

    Attributes
    ----------
    case : BearingCase
        Bearing file.
    conditions : BearingConditions
        Geometry, materials, oil and strength.
    inner, outer : RingContacts
        The contacts with both rings.
    inner_curve, outer_curve : ContactCurve
        Their solutions over the load.
    positions : tuple of Position
        Positions of the cage; the first has an element on the load line.
    seconds : float
        Time it took [s].
    version : str
        Version of ehlectric that solved it.
    """

    case: BearingCase
    conditions: BearingConditions[Any]
    inner: RingContacts[Any]
    outer: RingContacts[Any]
    inner_curve: ContactCurve
    outer_curve: ContactCurve
    positions: tuple[Position, ...]
    seconds: float
    version: str = __version__

    @property
    def curves(self) -> tuple[ContactCurve, ContactCurve]:
        """Solutions over the load of the contacts with the inner and with the outer ring."""
        return self.inner_curve, self.outer_curve

    @property
    def converged(self) -> bool:
        """Whether all contacts are converged."""
        return all(contact.converged for curve in self.curves for contact in curve.solutions)

    def circuits(self, fill: str | None = None) -> list[Circuit]:
        """The circuit at each position, with "oil" or "air" around the films, or what the file says."""
        return [position.circuit(fill or self.case.bearing.fill) for position in self.positions]


def lambda_ratio(solution: BearingSolution) -> float:
    """Least film thickness of the loaded contacts over the roughness of both surfaces, dimensionless."""
    films = [
        np.min(ring.values.minimum_thickness[ring.solved])
        for position in solution.positions
        for ring in position.rings
    ]
    return float(min(films)) / solution.case.bearing.composite_rq


def lubrication(solution: BearingSolution) -> str:
    """Lubrication by the lambda ratio: "conducting" below 1, "partial film" up to 3, "full film" above.

    Ceramic elements do not conduct where they touch: "touching" below 1.
    """
    ratio = lambda_ratio(solution)
    if ratio < CONDUCTING:
        return "touching" if solution.conditions.ceramic else "conducting"
    return "partial film" if ratio < PARTIAL else "full film"


def insulating(solution: BearingSolution) -> bool:
    """Whether there are voltages on films: elements conduct, and surfaces do not touch."""
    return not solution.conditions.ceramic and lubrication(solution) != "conducting"


def capacitance(solution: BearingSolution, fill: str | None = None) -> float:
    """Capacitance of the bearing, mean over the positions; of ceramic elements as given, or an upper bound.

    Parameters
    ----------
    solution : BearingSolution
        A solved bearing.
    fill : str, optional
        "oil" or "air" around the films; as the file says if not given.

    Returns
    -------
    float
        [F].
    """
    bearing = solution.case.bearing
    if bearing.element_capacitance is not None:
        return bearing.elements * bearing.element_capacitance
    return float(np.mean([circuit.capacitance for circuit in solution.circuits(fill)]))


def capacitance_is_bound(solution: BearingSolution) -> bool:
    """Whether no more than an upper bound of the capacitance is known: of ceramic elements."""
    return solution.conditions.ceramic and solution.case.bearing.element_capacitance is None


def plate_capacitance(solution: BearingSolution) -> float | None:
    """Capacitance by plates of the Hertz areas, h(0) apart, mean over the positions [F].

    None of ceramic elements, which are no plate.
    """
    if solution.conditions.ceramic:
        return None
    totals = []
    for position in solution.positions:
        inner, outer = (ring.values.plate for ring in position.rings)
        loaded = (inner > 0.0) & (outer > 0.0)
        totals.append(float(np.sum(series(inner[loaded], outer[loaded]))))
    return float(np.mean(totals))
