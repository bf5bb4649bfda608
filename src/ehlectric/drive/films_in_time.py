"""Films of a network over time: their circuit in each state, and a march through the voltage of the source.

Each bearing and each gear mesh is a film between two nodes of the network. Films that conduct for good merge
their nodes, and have no discharges. After each discharge all films are checked again, so that a discharge of
a mesh may raise the voltage of the next shaft up to the threshold of its bearings.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.drive.circuit_equations import FRAME, StateSpace
from ehlectric.drive.circuit_states import CircuitStates
from ehlectric.drive.discharges.films_and_source import Films, Measuring, Segments, films_of
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.drive_record import SIMULATING, Record
from ehlectric.drive.network import HOUSING, Film, Network, network_of
from ehlectric.drive.source_in_time import SourceInTime
from ehlectric.quantities.inputs import ENDS
from ehlectric.runtime.progress import Progress


@dataclass(frozen=True, eq=False)
class TimedFilm:
    """Film of a bearing or a gear mesh, over its positions."""

    name: str
    first: str  # shaft
    second: str  # shaft or housing
    film: BearingElement
    # Number or name from which its random numbers follow; empty for the name of the film.
    stream: int | str = ""

    @property
    def lower(self) -> str:
        """Node at its second end: a coating lies between a ring and the housing."""
        return f"ring of {self.name}" if self.film.path.coated else self.second

    def parts(self, place: int = 0, conductance: float = 0.0) -> Iterator[Film]:
        """Elements of the network with the film at a place, a conductance of an arc or of touching asperities
        parallel to the oil [S], a coating, and what is parallel to both.
        """
        path, leak = self.film.path, self.film.conductance + conductance
        yield Film(self.name, self.first, self.lower, float(self.film.capacitance[place]), conductance=leak)
        if path.coated:
            through = float(1.0 / path.resistance) if math.isfinite(path.resistance) else 0.0
            yield Film(
                f"coating of {self.name}", self.lower, HOUSING, float(path.coating), conductance=through
            )
        if path.parallel:
            yield Film(f"parallel to {self.name}", self.first, HOUSING, float(path.parallel))


@dataclass(frozen=True, eq=False)
class NetworkInTime:
    """Network with films that discharge.

    Attributes
    ----------
    network : Network
        Shafts, and all elements that do not change.
    films : tuple of TimedFilm
        Bearings and meshes.
    breakdown : Breakdown
        Arc, and what ends it.
    ring : complex, optional
        Rate at which the source rings [1/s].
    """

    network: Network
    films: tuple[TimedFilm, ...]
    breakdown: Breakdown
    ring: complex | None = None

    @property
    def active(self) -> tuple[TimedFilm, ...]:
        """Films between two nodes of the circuit; all others are short-circuited."""
        nodes = self.network.nodes
        return tuple(each for each in self.films if nodes[each.first] != nodes[each.second])

    @property
    def floating(self) -> tuple[str, ...]:
        """Shafts that no conducting element connects to the housing."""
        return tuple(shaft for shaft in self.network.shafts if self.network.nodes[shaft] != FRAME)

    @cached_property
    def at_rest(self) -> Network:
        """Network with all films at their first place, which insulate."""
        return self.with_films(len(self.active) * (0,), len(self.active) * (0.0,))

    def with_films(self, places: tuple[int, ...], conductances: tuple[float, ...]) -> Network:
        """Network with each active film at a place, and a conductance of it [S]."""
        films = zip(self.active, places, conductances, strict=True)
        parts = (part for film, place, conductance in films for part in film.parts(place, conductance))
        return replace(self.network, elements=(*self.network.elements, *parts))

    @property
    def divider(self) -> tuple[float, ...]:
        """Voltage across each active film per volt of the source right after an edge, dimensionless."""
        potentials = self.at_rest.potentials(1.0)
        return tuple(abs(self.at_rest.voltage(next(each.parts()), potentials)) for each in self.active)

    def states(self) -> CircuitStates:
        """Circuit in the states that a march meets."""
        nodes, films = self.at_rest.nodes, [each.film for each in self.active]
        arc = 1.0 / self.breakdown.arc_resistance if self.breakdown.arc_resistance else math.inf
        doing = [(0.0, arc, 1.0 / film.touch_resistance) for film in films]

        def system_in(places: tuple[int, ...], what: tuple[int, ...]) -> StateSpace:
            conductances = tuple(each[k] for each, k in zip(doing, what, strict=True))
            return self.with_films(places, conductances).equations

        across = [(nodes[each.first], nodes[each.lower]) for each in self.active]
        shafts = [(nodes[shaft], FRAME) for shaft in self.floating]
        return CircuitStates(system_in, [film.capacitance.size for film in films], across, shafts, self.ring)

    def films_in_time(self) -> Films:
        """Films as the march reads them."""
        return films_of([each.film for each in self.active], self.breakdown)

    def march(
        self,
        chunks: Iterator[Segments],
        measuring: Measuring,
        seed: int,
        progress: Callable[[float], None] = lambda _: None,
        compiling: Callable[[str], None] = lambda _: None,
    ) -> Record:
        """March through a source, and record what happens; arguments as in ``simulate``."""
        # It loads the compiler.
        from ehlectric.drive.discharges.simulation import simulate

        streams = [each.name if each.stream == "" else each.stream for each in self.active]
        return simulate(
            self.states(), self.films_in_time(), chunks, measuring, seed, progress, compiling, streams
        )

    def record(self, source: SourceInTime, divider: float, seed: int, progress: Progress) -> Record:
        """March through a whole source, with a ``progress`` in percent.

        ``divider`` is the largest voltage of a film or a shaft per volt of the source.
        """
        whole = source.settling + source.duration
        return self.march(
            source.chunks(),
            source.measuring(divider),
            seed,
            lambda time: progress(round(100.0 * min(time / whole, 1.0)), 100, SIMULATING),
            lambda text: progress(0, 100, text),
        )


def network_of_ends(
    case: DriveCase, elements: Sequence[BearingElement], ring: complex | None = None
) -> NetworkInTime:
    """Network of a drive with both bearings as elements; ``ring``, rate at which its source rings [1/s]."""
    return NetworkInTime(network_of(case), films_of_ends(elements, case.rotor_name), case.breakdown, ring)


def films_of_ends(elements: Sequence[BearingElement], rotor: str = "rotor") -> tuple[TimedFilm, ...]:
    """Films of both bearings of a drive between the rotor and the housing."""
    bearings = enumerate(zip(ENDS, elements, strict=True))
    return tuple(TimedFilm(end, rotor, HOUSING, element, b) for b, (end, element) in bearings)
