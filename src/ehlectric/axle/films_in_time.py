"""Films of an axle over time: their circuit in each state, and a march through the voltage of the source.

Each bearing and each gear mesh is a film between two nodes of the network. Films that conduct for good merge
their nodes, and have no discharges. After each discharge all films are checked again, so that a discharge of
a mesh may raise the voltage of the next shaft up to the threshold of its bearings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ehlectric.axle.network import Network
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.drive import (
    FRAME,
    WINDING,
    BearingElement,
    CircuitStates,
    Films,
    Measuring,
    Record,
    Segments,
    films_of,
    states_in_time,
)


@dataclass(frozen=True, eq=False)
class TimedFilm:
    """Film of a bearing or a gear mesh of an axle, over its positions."""

    name: str
    first: str  # shaft
    second: str  # shaft or housing
    film: BearingElement
    # Number or name from which its random numbers follow; empty for the name of the film.
    stream: int | str = ""


@dataclass(frozen=True, eq=False)
class AxleInTime:
    """Network of an axle with films that discharge.

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

    def states(self) -> CircuitStates:
        """Circuit in the states that a march meets."""
        nodes = self.network.nodes
        films = [((nodes[each.first], self._lower(each)), each.film) for each in self.active]
        shafts = [(nodes[shaft], FRAME) for shaft in self.floating]
        fixed = list(self.network.circuit())
        return states_in_time(fixed, films, shafts, (WINDING, FRAME), self.breakdown, self.ring)

    def films_in_time(self) -> Films:
        """Films as the march reads them."""
        return films_of([each.film for each in self.active], self.breakdown)

    def _lower(self, film: TimedFilm) -> str:
        """Node at the second end of a film: a coating lies between it and the housing."""
        return f"ring of {film.name}" if film.film.path.coated else self.network.nodes[film.second]

    def march(
        self,
        chunks: Iterator[Segments],
        measuring: Measuring,
        seed: int,
        progress: Callable[[float], None] = lambda _: None,
        compiling: Callable[[str], None] = lambda _: None,
    ) -> Record:
        """March through a source, and record what happens; arguments as in ``simulate``."""
        streams = [each.name if each.stream == "" else each.stream for each in self.active]
        # It loads the compiler.
        from ehlectric.drive import simulate

        return simulate(
            self.states(), self.films_in_time(), chunks, measuring, seed, progress, compiling, streams
        )
