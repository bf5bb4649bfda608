"""Static answer of an axle: loads of all bearings, state of all films, and their voltages after an edge.

The films of bearings and meshes are solved at the speed and the load of the axle, with capacitances as mean
values over the positions of the rolling elements and over the phase of the mesh. Right after an edge of the
common-mode voltage the network of capacitances gives the voltage of each element. The element with the
largest ratio of its voltage to its breakdown voltage breaks down first.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import product
from typing import Literal, cast

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.adjusted_rows import AdjustedRows
from ehlectric.axle.shaft_loads import forces_of_mesh
from ehlectric.bearing import (
    BearingResult,
    BearingSolution,
    InclinedRow,
    breakdown_of,
    duty_of,
    film_error,
    shaft_capacitance,
    solve_bearing,
)
from ehlectric.cases.axle_case import AxleCase, Turning
from ehlectric.cases.axle_inputs import Shaft
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.gear_inputs import Conduction
from ehlectric.drive import (
    HOUSING,
    Edge,
    Film,
    Network,
    measured_edge,
    network_of,
    oscillation_warning,
    rank,
    remedy_notes,
    ring_warning,
)
from ehlectric.errors import ConvergenceError, InputError, within
from ehlectric.formulas.shaft_statics import BearingLoads, ForceAt, bearing_loads, on_axis, weight_at
from ehlectric.gear import (
    GearSolution,
    drawing_of,
    gear_pair,
    gear_warnings,
    insulating_part,
    solve_loose_pairs,
    state_at,
)
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.formats import CELSIUS, amount, speed_text
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.progress import Progress, silent

# Assumptions about the conduction of gear meshes.
CONDUCTIONS: tuple[Conduction, ...] = ("by-film", "always", "never")

# Difference of temperatures that counts as none [K].
_SAME_TEMPERATURE = 0.5

# Part of a capacitance that stands for none, so that each shaft keeps its path to the housing.
_NO_CAPACITANCE = 1e-6

# Overshoot from which it is stated.
_RINGS = 1.05

# Forces that are no load of a bearing [N].
_NO_FORCE = 1e-6

# Quotient of two torques that differ by more than rounding.
_LARGER = 1.0 + 1e-9

# Largest load of the bearings of a shaft that a torque near 0 gives [N].
_SMALL = 1e-3


# Number of an element in a file, NaN where the element has none.
_number = partial(stored, rule="finite or NaN")


@dataclass(frozen=True)
class Element:
    """Bearing or gear mesh of an axle, with its film."""

    name: str
    kind: Literal["bearing", "mesh"]
    first: str  # shaft
    second: str  # shaft or housing
    capacitance: float = field(metadata=_number())  # mean capacitance [F]
    # Voltage at which the film breaks down [V]; None where summits touch, and for ceramic elements.
    breakdown_voltage: float | None = field(metadata=_number(unknown=True))
    # Share of time in which metallic contacts conduct.
    contact_time_share: float = field(metadata=_number())
    lambda_ratio: float = field(metadata=_number())  # smallest film divided by the composite Rq
    # Loads of a bearing: radial load, and axial force along z [N]; None for a mesh.
    radial_load: float | None = field(default=None, metadata=_number(unknown=True))
    axial_load: float | None = field(default=None, metadata=_number(unknown=True))
    conduction: Conduction = "by-film"  # of the gear file of a mesh
    # Whether summits touch, so that no breakdown voltage is computed.
    touching: bool = field(default=False, metadata=_number(dtype="f8"))
    film_error: float = field(default=0.0, metadata=_number())  # relative error of the films

    @property
    def state(self) -> str:
        """State: conducts, conducts at times, or insulates."""
        return state_at(self.contact_time_share, self.conduction)

    @property
    def limit(self) -> float:
        """Breakdown voltage [V]: 0 where summits touch, infinite for an element that does not break down."""
        if self.breakdown_voltage is None:
            return 0.0 if self.touching else math.inf
        return self.breakdown_voltage

    def film(self, conduction: Conduction) -> Film:
        """Element of the network; ``conduction`` is an assumption about meshes, "by-film" as in its file."""
        conducts = self.insulating_part(conduction) == 0.0
        return Film(self.name, self.first, self.second, self.capacitance, conducts)

    def insulating_part(self, conduction: Conduction) -> float:
        """Weight of the network in which the element insulates, with an assumption about meshes."""
        given = self.conduction if self.kind == "bearing" or conduction == "by-film" else conduction
        return insulating_part(self.contact_time_share, given)


@dataclass(frozen=True, eq=False)
class AxleSolution:
    """Axle with solved films."""

    case: AxleCase
    turning: Mapping[str, Turning]  # speeds and torques of the shafts
    elements: tuple[Element, ...]
    warnings: tuple[ResultWarning, ...] = ()  # of bearings and meshes, each with the name of its element
    # Largest edge of a measured common-mode voltage; None for a described one.
    measured_edge: Edge | None = None

    @property
    def edge(self) -> Edge:
        """Largest edge of the common-mode voltage."""
        return self.measured_edge or Edge(self.case.edge, self.case.source.rise_time or 0.0)

    @property
    def converged(self) -> bool:
        """Whether the films of all bearings are converged. Films of meshes are: others raise an error."""
        return all(warning.code != "not-converged" for warning in self.warnings)

    def network(self, conduction: Conduction = "by-film") -> Network:
        """Network of all elements, links and capacitances of the machine."""
        return self._networks[conduction]

    @cached_property
    def _networks(self) -> dict[Conduction, Network]:
        """Networks by the assumption about the meshes; a network keeps its solution."""
        return {conduction: self._network(self.films(conduction)) for conduction in CONDUCTIONS}

    @cached_property
    def _weighted_networks(self) -> dict[Conduction, tuple[tuple[float, Network], ...]]:
        """Weights and networks with all combinations of elements that almost conduct: insulating in one, and
        conducting in the other; by the assumption about the meshes.
        """
        return {conduction: tuple(self._weighted(conduction)) for conduction in CONDUCTIONS}

    def _weighted(self, conduction: Conduction) -> Iterator[tuple[float, Network]]:
        parts = [each.insulating_part(conduction) for each in self.elements]
        between = [number for number, part in enumerate(parts) if 0.0 < part < 1.0]
        if not between:
            yield 1.0, self.network(conduction)
            return
        for conducting in product((False, True), repeat=len(between)):
            films, weight = [*self.films(conduction)], 1.0
            for number, conducts in zip(between, conducting, strict=True):
                films[number] = replace(films[number], conducts=conducts)
                weight *= 1.0 - parts[number] if conducts else parts[number]
            yield weight, self._network(films)

    def _network(self, of_elements: Iterable[Film]) -> Network:
        base = network_of(self.case)
        return replace(base, elements=(*base.elements, *of_elements))

    def films(self, conduction: Conduction = "by-film") -> tuple[Film, ...]:
        """Bearings and meshes as elements of the network."""
        return tuple(element.film(conduction) for element in self.elements)

    def potentials(self, conduction: Conduction = "by-film", edge: float | None = None) -> dict[str, float]:
        """Voltages of the shafts against the housing after an edge [V], by default the edge of the case.

        They are weighted means over the networks of elements that almost conduct.
        """
        edge, rise_time = self.edge.voltage if edge is None else edge, self.edge.rise_time
        potentials = dict.fromkeys(self.turning, 0.0)
        for weight, network in self._weighted_networks[conduction]:
            for shaft, potential in network.potentials(edge, rise_time).items():
                potentials[shaft] += weight * potential
        return potentials

    def voltages(self, conduction: Conduction = "by-film") -> dict[str, float]:
        """Absolute voltages of bearings and meshes after the edge of the case [V] by their names."""
        network, potentials = self.network(conduction), self.potentials(conduction)
        return {film.name: abs(network.voltage(film, potentials)) for film in self.films(conduction)}

    def voltage_of(self, name: str) -> float:
        """Absolute voltage of a bearing or mesh after the edge of the case [V]."""
        return self.voltages()[name]

    def energies(self) -> dict[str, float]:
        """Energies of breakdowns after the edge of the case [J] by the names of elements with a voltage.

        They are means over the networks in which the element insulates.
        """
        weights: dict[str, float] = {}
        sums: dict[str, float] = {}
        names = {each.name for each in self.elements}
        for weight, network in self._weighted_networks["by-film"]:
            potentials = network.potentials(*self.edge)
            for film in network.elements:
                if film.name in names and not film.conducts and network.voltage(film, potentials):
                    energy = network.breakdown(film, potentials).energy
                    weights[film.name] = weights.get(film.name, 0.0) + weight
                    sums[film.name] = sums.get(film.name, 0.0) + weight * energy
        return {name: energy / weights[name] for name, energy in sums.items()}

    @property
    def breakdown_voltages(self) -> dict[str, float]:
        """Breakdown voltages by the names of the elements that have one [V]."""
        return {
            element.name: element.breakdown_voltage
            for element in self.elements
            if element.breakdown_voltage is not None
        }

    def ranking(self, conduction: Conduction = "by-film") -> list[tuple[str, float]]:
        """Names of elements with the ratio U/V_b after the edge of the case, the first to discharge first.

        The ratio is infinite for an element whose summits touch under a voltage: its contacts that open
        discharge at any voltage. Of several such elements, the element with the largest voltage is first.
        As the element becomes a conductor, its ratio falls to 0.
        """
        voltages, limits = self.voltages(conduction), self._limits(conduction)
        return rank(voltages, {name: limit for name, limit in limits.items() if math.isfinite(limit)})

    def _limits(self, conduction: Conduction) -> dict[str, float]:
        """Breakdown voltages of all elements [V], with the limits of ``voltage_ratios``.

        An element whose summits touch and that almost conducts, with the insulating part w, has the margin
        (1 - w)/w.
        """
        limits = {}
        for each in self.elements:
            part = each.insulating_part(conduction)
            if part == 0.0:
                limits[each.name] = math.inf
            elif each.limit == 0.0:
                limits[each.name] = -(1.0 - part) / part
            else:
                limits[each.name] = each.limit
        return limits

    def discharging(self, conduction: Conduction = "by-film") -> list[tuple[str, float]]:
        """Elements of the ranking that have a voltage."""
        return [row for row in self.ranking(conduction) if row[1] > 0.0]

    def ratios(self, conduction: Conduction = "by-film") -> dict[str, float]:
        """Ratios U/V_b of the elements with a breakdown voltage that do not conduct, the largest first."""
        known = self.breakdown_voltages
        return {name: ratio for name, ratio in self.ranking(conduction) if name in known}

    def ratio_ends(self) -> dict[str, tuple[float, float]]:
        """Smallest and largest ratio U/V_b of the elements, with the meshes that conduct by their films, with
        all meshes conducting, and with no mesh conducting; only of elements with a ratio in all of them.
        """
        first, *others = (self.ratios(conduction) for conduction in CONDUCTIONS)
        values = {name: (ratio, *(each.get(name, 0.0) for each in others)) for name, ratio in first.items()}
        return {name: (min(each), max(each)) for name, each in values.items() if min(each) > 0.0}

    def voltages_and_limits(self) -> tuple[Array, Array]:
        """Return voltages and breakdown voltages of all elements after the edge of the case [V].

        Both have the shape (elements,); limits as in ``voltage_ratios``.
        """
        voltages, limits = self.voltages(), self._limits("by-film")
        return np.array([*voltages.values()]), np.array([*limits.values()])

    @property
    def bounded(self) -> tuple[str, ...]:
        """Names of bearings whose capacitances are upper bounds, as their elements are ceramic."""
        tables = zip(self.case.names_of_bearings(), self.case.tables_of_bearings, strict=True)
        return tuple(name for name, bearing in tables if bearing.capacitance_is_bound)

    @cached_property
    def ends_of_bounds(self) -> tuple[AxleSolution, ...]:
        """Axles with almost no capacitance instead of those that are upper bounds, on each set of shafts.

        A voltage is a ratio of two linear functions of each capacitance, so that it is largest at one of
        these ends or in the axle itself.
        """
        shafts = [*dict.fromkeys(each.first for each in self.elements if each.name in self.bounded)]
        ends = []
        for chosen in product((False, True), repeat=len(shafts)):
            without = {shaft for shaft, none in zip(shafts, chosen, strict=True) if none}
            elements = tuple(
                replace(each, capacitance=_NO_CAPACITANCE * each.capacitance)
                if each.name in self.bounded and each.first in without
                else each
                for each in self.elements
            )
            if without:
                ends.append(replace(self, elements=elements))
        return tuple(ends)

    @cached_property
    def overshoot(self) -> float:
        """Largest voltage after an edge with the inductances, over the voltage without them, for the least
        damped oscillation of the circuit: 1 without one, and 2 without damping.
        """
        _, quality = next(iter(self.network().oscillations()), (0.0, 0.5))
        # The first turn of a step response with the damping ratio 1/(2 Q).
        damping = 0.5 / quality
        return 1.0 + math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2)) if damping < 1.0 else 1.0

    @property
    def rings(self) -> bool:
        """Whether the circuit has an oscillation that raises the voltages after an edge noticeably."""
        return self.overshoot > _RINGS

    @cached_property
    def first_ratios(self) -> tuple[float, float]:
        """Smallest and largest U/V_b of the first element, over the capacitances that are upper bounds."""
        firsts = [each.discharging()[:1] for each in (self, *self.ends_of_bounds)]
        ratios = [rows[0][1] if rows else 0.0 for rows in firsts]
        return min(ratios), max(ratios)

    @cached_property
    def changed_ranks(self) -> tuple[str, ...]:
        """Names of elements whose rank depends on whether all meshes conduct or none does, among the elements
        that insulate in both cases.
        """
        always, never = ([name for name, _ in self.ranking(conduction)] for conduction in ("always", "never"))
        first = [name for name in always if name in never]
        second = [name for name in never if name in always]
        return tuple(name for name in second if first.index(name) != second.index(name))


# What exerts a force on a shaft: a mesh with the name of the other shaft, weight, or a force with its number.
Cause = tuple[Literal["mesh", "weight", "force"], str]


def forces_on_shafts(case: AxleCase) -> dict[str, list[tuple[Cause, ForceAt]]]:
    """Forces on each shaft whose loads follow from statics, each with its cause."""
    turning = case.turning()
    forces: dict[str, list[tuple[Cause, ForceAt]]] = {}
    for number, mesh in enumerate(case.mesh):
        gear = mesh.pair.gear
        with within(f"mesh.{number + 1}.pair"):
            pair = gear_pair(drawing_of(gear))
        torque = case.torque_of_gear(number, turning)
        both = forces_of_mesh(pair, torque, gear.hand or "right", mesh.direction, (mesh.at[0], mesh.at[1]))
        for name, other, force in zip(mesh.gears, mesh.gears[::-1], both, strict=True):
            forces.setdefault(name, []).append((("mesh", other), force))
    for shaft in case.shaft:
        if shaft.mass is not None and shaft.mass_at is not None:
            down = weight_at(shaft.mass, shaft.mass_at, case.drive.gravity_direction)
            forces.setdefault(shaft.name, []).append((("weight", ""), down))
    for number, (name, each) in enumerate(case.placed_forces, 1):
        force = on_axis(each.at, each.x, each.y, each.z)
        forces.setdefault(name, []).append((("force", str(number)), force))
    return forces


def loads_on_shafts(case: AxleCase) -> dict[str, BearingLoads]:
    """Loads of the bearings of each shaft with gears, a mass or forces, by the name of the shaft."""
    (loads,) = loads_of_axles([case])
    if isinstance(loads, Exception):
        raise loads
    return loads


def loads_of_axles(
    cases: Sequence[AxleCase],
) -> list[dict[str, BearingLoads] | InputError | ConvergenceError]:
    """Loads as ``loads_on_shafts`` computes them of many axles, or the error of an axle without loads.

    Adjusted rows that are alike are solved together.
    """
    loads: list[dict[str, BearingLoads] | InputError | ConvergenceError] = []
    adjusted: dict[AdjustedRows, list[tuple[int, str, float]]] = {}
    for place, case in enumerate(cases):
        try:
            turning, of_case = case.turning(), dict[str, BearingLoads]()
            inclined: list[tuple[AdjustedRows, str]] = []
            forces = forces_on_shafts(case)
            for shaft in case.shaft:
                if shaft.name not in forces:
                    continue
                rows = _adjusted_rows(case, shaft)
                of_shaft = [force for _, force in forces[shaft.name]]
                of_case[shaft.name] = _loads_on(case, shaft.name, of_shaft, rows)
                if rows is not None:
                    inclined.append((rows, shaft.name))
        except InputError as error:
            loads.append(error)
            continue
        loads.append(of_case)
        for rows, name in inclined:
            adjusted.setdefault(rows, []).append((place, name, turning[name].speed))
    for rows, shafts in adjusted.items():
        _share(rows, shafts, loads)
    return loads


def _share(
    rows: AdjustedRows,
    shafts: Sequence[tuple[int, str, float]],
    loads: list[dict[str, BearingLoads] | InputError | ConvergenceError],
) -> None:
    """Give the axial forces on equal rows of many shafts to the loads of these shafts.

    ``shafts`` are places of axles, names of their shafts, and speeds [rad/s].
    """
    places = [(place, name, speed) for place, name, speed in shafts if isinstance(loads[place], dict)]
    of_shafts = [cast("dict[str, BearingLoads]", loads[place])[name] for place, name, _ in places]
    first, second = np.array([each.radial for each in of_shafts]).T
    axial = np.array([each.axial for each in of_shafts])
    share = rows.share((first, second), axial, np.array([speed for *_, speed in places]))
    for (place, name, _), each, forces, unloaded in zip(
        places, of_shafts, share.forces.T.tolist(), share.unloaded.T.tolist(), strict=True
    ):
        of_axle = loads[place]
        if np.isnan(forces).any() or isinstance(of_axle, Exception):
            text = f"no equilibrium of the adjusted bearings of shaft {name!r} was found"
            loads[place] = ConvergenceError(text)
        else:
            of_axle[name] = replace(each, shares=tuple(forces), unloaded=tuple(unloaded))


def _loads_on(
    case: AxleCase, shaft: str, forces: Sequence[ForceAt], rows: AdjustedRows | None
) -> BearingLoads:
    """Loads of both bearings of a shaft from the forces of its gears; adjusted rows have no shares yet."""
    first, second = case.bearings_of(shaft)
    places = case.bearing[first].at, case.bearing[second].at
    with case.naming(second):
        if places[0] == places[1]:
            raise InputError(
                "bearing.at",
                got=f"{readable(1e3 * places[1])} mm, the place of bearing.{first + 1} of shaft {shaft!r}",
                takes="another place: two bearings at one place carry no moment",
            )
        return bearing_loads(forces, places if rows is None else rows.pressure_centres(places))


def _adjusted_rows(case: AxleCase, shaft: Shaft) -> AdjustedRows | None:
    """Rows of a shaft that are adjusted against each other; None if they are not adjusted."""
    adjustment = case.adjustment_of(shaft)
    if adjustment is None:
        return None
    rows = []
    first, second = case.bearings_of(shaft.name)
    for number in (first, second):
        with case.naming(number), within("bearing"):
            rows.append(InclinedRow.of(case.tables_of_bearings[number]))
    return AdjustedRows((rows[0], rows[1]), adjustment, case.bearing[first].at < case.bearing[second].at)


@dataclass(frozen=True, eq=False)
class SolvedFilms:
    """Solved bearings and meshes of an axle, in the order of its case."""

    case: AxleCase
    turning: Mapping[str, Turning]  # speeds and torques of the shafts
    loads: Mapping[str, BearingLoads]  # of the bearings of each shaft with gears
    bearings: tuple[BearingResult, ...]
    axial: tuple[float, ...]  # axial forces along z on the bearings [N]; 0 if the file contains the load
    meshes: tuple[GearSolution, ...]


def solve_films(case: AxleCase, progress: Progress = silent) -> SolvedFilms:
    """Solve bearings and meshes of an axle; arguments and errors as in ``solve_elements``."""
    turning, loads = case.turning(), loads_on_shafts(case)
    bearings: list[BearingResult] = []
    axial: list[float] = []
    meshes: list[GearSolution] = []
    names, count = (*case.names_of_bearings(), *case.names_of_meshes()), len(case.bearing) + len(case.mesh)
    for number, bearing in enumerate(case.bearing):
        radial, force = load_of(case, number, loads)
        of_bearing = case.bearing_case(number, turning[bearing.shaft].speed, radial, abs(force))
        with naming_torque(case, number, of_bearing), case.naming(number):
            bearings.append(solve_bearing(of_bearing, workers=1))
        axial.append(force)
        progress(len(bearings), count, names[len(bearings) - 1])
    for number in range(len(case.mesh)):
        with within(f"mesh.{number + 1}.pair"):
            (outcome,) = solve_loose_pairs([case.gear_case(number, turning)])
            if isinstance(outcome, Exception):
                raise outcome
        meshes.append(outcome)
        done = len(bearings) + len(meshes)
        progress(done, count, names[done - 1])
    return SolvedFilms(case, turning, loads, tuple(bearings), tuple(axial), tuple(meshes))


# Load that a bearing carries if only its own load is too large [N].
_LIGHT_LOAD = 100.0


@contextmanager
def naming_torque(case: AxleCase, number: int, of_bearing: BearingCase) -> Iterator[None]:
    """Context in which the error of a bearing names the torque and the load if its load is the cause.

    It is the cause if the bearing can be solved with a load of 100 N.
    """
    try:
        yield
    except InputError as error:
        mounted, loads = case.bearing[number], of_bearing.bearing
        light = case.bearing_case(number, loads.inner_speed, _LIGHT_LOAD, 0.0)
        if mounted.loaded or not _is_solved(light):
            raise
        name = case.names_of_bearings()[number]
        radial, axial = amount(loads.radial_load, "N"), amount(loads.axial_load, "N")
        geared = mounted.shaft in case.geared_shafts
        cause = f"{readable(case.drive.torque)} N m" if geared else "forces and weight"
        text = (
            f"got {cause}, with which {name} carries {radial} of radial load and "
            f"{axial} of axial load; {error.key}: {error.text.removesuffix(f' ({name})')}"
        )
        raise error.with_text("drive.torque" if geared else "force", text) from None


def _is_solved(case: BearingCase) -> bool:
    """Whether a bearing has a solution."""
    try:
        solve_bearing(case, workers=1)
    except (InputError, ConvergenceError):
        return False
    return True


def solve_elements(case: AxleCase, progress: Progress = silent) -> AxleSolution:
    """Solve the films of all bearings and meshes of an axle.

    ``progress`` is called with the number of solved elements, the number of all, and a text. Raises
    InputError where a bearing cannot carry its load, or gears cannot run together.
    """
    return elements_of(solve_films(case, progress))


def elements_of(films: SolvedFilms) -> AxleSolution:
    """Axle with the elements of its solved films."""
    case, elements = films.case, list[Element]()
    of_elements = list[tuple[str, tuple[ResultWarning, ...]]]()
    mounted = zip(case.names_of_bearings(), case.bearing, films.bearings, films.axial, strict=True)
    for name, bearing, result, axial in mounted:
        of_elements.append(
            (name, tuple(each for each in result.warnings if each.code != "capacitance-bound"))
        )
        elements += bearing_elements(result.solution, [(name, bearing.shaft, axial)])
    for number, (name, mesh) in enumerate(zip(case.names_of_meshes(), case.mesh, strict=True)):
        gears = films.meshes[number]
        elements.append(mesh_element(name, mesh.gears, gears))
        torque = case.torque_of_gear(number, films.turning)
        of_elements.append((name, tuple(mesh_warnings(gears, torque))))
    of_axle = axle_warnings(case, films.turning, films.loads)
    warnings = named_warnings((*of_axle, *thinnest_first(elements, of_elements)))
    edge, of_source = measured_edge(case.source)
    solution = AxleSolution(case, films.turning, tuple(elements), (*of_source, *warnings), edge)
    return replace(
        solution, warnings=(*solution.warnings, *_bound_warning(solution), *machine_notes(solution))
    )


def machine_notes(solution: AxleSolution) -> Iterator[ResultWarning]:
    """Warnings about the machine of an axle: remedies that do not apply, its ring, and what rings."""
    case = solution.case
    yield from remedy_notes(case)
    yield from ring_warning(case.circuit, case.drive.speed)
    if solution.rings:
        yield ResultWarning.of("edge-rings", times=solution.overshoot)
    if case.circuit.inductive:
        yield from oscillation_warning(case.circuit, solution.network())


def _bound_warning(solution: AxleSolution) -> Iterator[ResultWarning]:
    """Warning of bearings whose capacitances are upper bounds, with the voltages between the bounds and none.

    In a network with one source, a capacitance to the housing that falls raises the voltages of all shafts.
    """
    ends = solution.ends_of_bounds
    if not ends:
        return
    potentials = [each.potentials() for each in (solution, *ends)]
    voltages = ", ".join(
        f"{shaft.name} {_range([abs(each[shaft.name]) for each in potentials])} V"
        for shaft in solution.case.shaft
    )
    names = dict.fromkeys(each.discharging()[0][0] for each in (solution, *ends) if each.discharging())
    low, high = solution.first_ratios
    if len(names) > 1:
        first = f". Depending on them, the first element is {', '.join(names)}"
    elif math.isfinite(high):
        first = f", and U/V_b of the first element, {next(iter(names), 'none')}, is {_range([low, high])}"
    else:
        first = ""
    yield ResultWarning.of(
        "capacitance-bound", "axle", bearings=", ".join(solution.bounded), voltages=voltages, first=first
    )


def _range(values: Sequence[float]) -> str:
    """Smallest and largest value as text."""
    return f"{readable(min(values))} to {readable(max(values))}"


def axle_warnings(
    case: AxleCase, turning: Mapping[str, Turning], loads: Mapping[str, BearingLoads]
) -> Iterator[tuple[str, tuple[ResultWarning, ...]]]:
    """Warnings about meshes that raise the speed, and about bearings that are adjusted against each other,
    with the names of meshes, shafts and bearings.
    """
    names = case.names_of_bearings()
    yield from _notes_of_meshes(case, turning)
    for shaft in case.shaft:
        if shaft.name not in loads or loads[shaft.name].shares is None:
            continue
        if shaft.adjustment is None:
            yield shaft.name, (ResultWarning.of("adjustment-assumed"),)
        elif shaft.adjustment.arrangement is None:
            yield shaft.name, (ResultWarning.of("adjustment-assumed", "arrangement"),)
        for number, unloaded in zip(case.bearings_of(shaft.name), loads[shaft.name].unloaded, strict=True):
            if unloaded:
                yield names[number], (ResultWarning.of("row-unloaded"),)


def _notes_of_meshes(
    case: AxleCase, turning: Mapping[str, Turning]
) -> Iterator[tuple[str, tuple[ResultWarning, ...]]]:
    """Notes of meshes whose oil temperature the axle replaces, and of meshes that raise the speed."""
    order = [*turning]
    for name, mesh in zip(case.names_of_meshes(), case.mesh, strict=True):
        of_file, oil = mesh.pair.gear.operation, case.drive.temperature
        if abs(of_file.oil_temperature - oil) > _SAME_TEMPERATURE:
            flanks = f"{CELSIUS.text(oil)} and flanks "
            if isinstance(of_file.bulk_temperature, str):
                flanks += "by bulk_temperature 'iso'"
            else:
                flanks += f"of {CELSIUS.text(of_file.bulk_temperature + oil - of_file.oil_temperature)}"
            given = CELSIUS.text(of_file.oil_temperature)
            yield name, (ResultWarning.of("mesh-temperature", given=given, used=flanks),)
        driving, driven = sorted(mesh.gears, key=order.index)
        slow, fast = (abs(turning[shaft].speed) for shaft in (driving, driven))
        if fast > slow:
            raised = ResultWarning.of(
                "speed-raised", driven=driven, slow=speed_text(slow), fast=speed_text(fast)
            )
            yield name, (raised,)


def thinnest_first(
    elements: Sequence[Element], warnings: Iterable[tuple[str, tuple[ResultWarning, ...]]]
) -> list[tuple[str, tuple[ResultWarning, ...]]]:
    """Names of elements with their warnings, the smallest lambda ratio first."""
    ratios = {element.name: element.lambda_ratio for element in elements}
    return sorted(warnings, key=lambda row: ratios[row[0]])


# Largest number of elements that a warning names.
_MOST_NAMED = 4


def named_warnings(warnings: Iterable[tuple[str, Iterable[ResultWarning]]]) -> Iterator[ResultWarning]:
    """Warnings with the names of their elements: each code once, with the text of the first element, which is
    the one with the smallest lambda ratio.
    """
    first: dict[str, ResultWarning] = {}
    names: dict[str, list[str]] = {}
    texts: dict[str, set[str]] = {}
    for name, of_element in warnings:
        for warning in of_element:
            first.setdefault(warning.code, warning)
            texts.setdefault(warning.code, set()).add(str(warning))
            if name not in names.setdefault(warning.code, []):
                names[warning.code].append(name)
    for code, warning in first.items():
        name, *others = names[code]
        numbers = ", with other numbers" if len(texts[code]) > 1 else ""
        further = f" The same holds for {_named(others)}{numbers}." if others else ""
        yield ResultWarning(warning.code, f"{name}: {warning}{further}")


def _named(names: Sequence[str]) -> str:
    """Names of some elements, or the first of many and the number of the others."""
    few = names if len(names) < _MOST_NAMED else names[: _MOST_NAMED - 2]
    rest = len(names) - len(few)
    return ", ".join(few) + (f" and {rest} others" if rest else "")


def load_of(case: AxleCase, number: int, loads: Mapping[str, BearingLoads]) -> tuple[float, float]:
    """Radial load and axial force of a bearing by statics [N]; 0 on a shaft with given loads.

    Raises InputError for forces that load no bearing of the shaft.
    """
    bearing = case.bearing[number]
    if bearing.shaft not in loads:
        return 0.0, 0.0
    on_shaft = loads[bearing.shaft]
    place = case.bearings_of(bearing.shaft).index(number)
    largest = max(*on_shaft.radial, abs(on_shaft.axial))
    if max(on_shaft.radial[place], abs(on_shaft.axial)) <= _NO_FORCE and largest < _SMALL:
        geared = bearing.shaft in case.geared_shafts
        cause = f"{readable(case.drive.torque)} N m" if geared else "forces and weight"
        raise InputError(
            "drive.torque" if geared else "force",
            got=f"{cause}, with which the bearings of {bearing.shaft} carry at most {_SMALL:g} N",
            takes=f"{'a larger torque' if geared else 'other forces'}; or the mass of the shaft, or a table "
            "[[force]]: a bearing without a load has no film that is computed",
        )
    radial = on_shaft.radial[place]
    radial = radial if radial > _NO_FORCE else 0.0
    if on_shaft.shares is not None:
        return radial, on_shaft.shares[place]
    return radial, on_shaft.axial if bearing.locating and abs(on_shaft.axial) > _NO_FORCE else 0.0


def bearing_elements(solution: BearingSolution, mounted: Sequence[tuple[str, str, float]]) -> list[Element]:
    """Elements of solved bearings, one or n of shape (n,).

    ``mounted``, name, shaft and axial force along z [N] of each bearing; the force is 0 if the file contains
    the load.
    """
    breakdown, bearing = breakdown_of(solution), solution.case.bearing
    breaks = solution.case.discharge.has_strength and not solution.conditions.ceramic
    limit = math.nan if breakdown is None else breakdown.shaft_ring_to_ring_breakdown
    columns = (
        shaft_capacitance(solution),
        limit,
        duty_of(solution).contact_time_share,
        solution.least_film / bearing.composite_rq,
        bearing.radial_load,
        bearing.axial_load,
        film_error(solution),
    )
    rows = zip(*(np.broadcast_to(column, len(mounted)).tolist() for column in columns), strict=True)
    return [
        Element(
            name=name,
            kind="bearing",
            touching=breaks and math.isnan(voltage),
            first=shaft,
            second=HOUSING,
            capacitance=capacitance,
            breakdown_voltage=None if math.isnan(voltage) else voltage or None,
            contact_time_share=share,
            lambda_ratio=ratio,
            radial_load=radial,
            axial_load=axial or given,
            film_error=error,
        )
        for (name, shaft, axial), (capacitance, voltage, share, ratio, radial, given, error) in zip(
            mounted, rows, strict=True
        )
    ]


def mesh_warnings(gears: GearSolution, torque: float) -> Iterator[ResultWarning]:
    """Warnings of a mesh with a torque [N m], also of one that has a larger torque in its solution."""
    solved = abs(gears.case.gear.operation.pinion_torque)
    loose = solved > _LARGER * abs(torque)
    for warning in gear_warnings(gears, in_axle=True):
        # The teeth are in the middle of the backlash.
        if not (loose and warning.code == "film-fills-backlash"):
            yield warning
    if loose:
        yield ResultWarning.of("mesh-loose", torque=amount(abs(torque), "N m"), solved=amount(solved, "N m"))


def mesh_element(name: str, gears: tuple[str, ...], solution: GearSolution) -> Element:
    """Element of a solved mesh."""
    loads, breakdown = solution.loads, solution.breakdown_voltage
    return Element(
        name=name,
        kind="mesh",
        touching=breakdown is not None and not np.min(breakdown),
        first=gears[0],
        second=gears[1],
        capacitance=float(loads.mean(solution.capacitance)),
        breakdown_voltage=None if breakdown is None else float(np.min(breakdown)) or None,
        contact_time_share=float(loads.mean(solution.contact_time_share())),
        lambda_ratio=float(np.nanmin(solution.films.minimum)) / solution.rq,
        conduction=solution.case.gear.contact.conduction,
        film_error=solution.film_error,
    )
