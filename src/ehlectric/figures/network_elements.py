"""Elements of the network of an axle with their texts, as pictures of the network show them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ehlectric.axle import AxleSolution, Element
from ehlectric.cases.axle_inputs import LinkKind
from ehlectric.drive import HOUSING, Film
from ehlectric.quantities.formats import amount
from ehlectric.quantities.lubrication_states import CONDUCTS, NO_LIMIT, TOUCHES
from ehlectric.readable import readable

# Decades of U/V_b on each side of breakdown that a bar shows.
DECADES = 2.0


@dataclass(frozen=True)
class NetworkElement:
    """Element of the network as the picture shows it."""

    film: Film
    name: str
    value: str  # capacitance or resistance, or that it conducts
    voltage: str
    ratio: float | None  # U/V_b, infinite if summits touch; None without a voltage that breaks it down
    contact_time_share: float  # share of time in which metallic contacts conduct
    first: bool  # whether it discharges first

    @property
    def ends(self) -> set[str]:
        """Names of the nodes at both ends."""
        return {self.film.first, self.film.second}

    @property
    def mostly_conducts(self) -> bool:
        """Whether metallic contacts conduct for more than half of the time, in which the element has no
        voltage.
        """
        return not self.film.conducts and self.contact_time_share > 0.5

    @property
    def bar(self) -> float:
        """Length of the bar of U/V_b on a logarithmic scale, from 0 to 1; 0.5 is breakdown."""
        decades = math.log10(self.ratio) if self.ratio else -DECADES
        return min(max(0.5 * (1.0 + decades / DECADES), 0.0), 1.0)


def elements_of_network(solution: AxleSolution) -> Iterator[NetworkElement]:
    """Elements between shafts and housing with their names, values and voltages."""
    network, potentials = solution.network(), solution.potentials()
    elements = {element.name: element for element in solution.elements}
    limits = solution.breakdown_voltages
    ratios = {name: ratio if name in limits else math.inf for name, ratio in solution.discharging()}
    first = next(iter(ratios), None)
    kinds, shown = [link.kind for link in solution.case.link], {HOUSING, *network.shafts}
    for film in network.elements:
        # The winding, the inverter and earth are no shafts.
        if not {film.first, film.second} <= shown:
            continue
        voltage = abs(network.voltage(film, potentials))
        element = elements.get(film.name)
        yield NetworkElement(
            film,
            _name(film, element, kinds),
            _value(film),
            _voltages(film, element, voltage),
            None if film.conducts else ratios.get(film.name),
            0.0 if element is None else element.contact_time_share,
            first=film.name == first,
        )


def _name(film: Film, element: Element | None, kinds: list[LinkKind]) -> str:
    """Name of an element without the names of its shafts, which the picture shows."""
    if element is not None:
        return film.name.removesuffix(f" of {film.first}") if element.kind == "bearing" else "mesh"
    first, _, number = film.name.partition(" ")
    if first == "link" and number.isdecimal():
        return kinds[int(number) - 1]
    return {"grounding ring": "ring", "rotor and frame": "frame"}.get(film.name, "shaft")


def _value(film: Film) -> str:
    if film.conducts:
        return CONDUCTS
    parts = [amount(film.capacitance, "F")] if film.capacitance else []
    parts += [amount(1.0 / film.conductance, "ohm")] if film.conductance else []
    return ", ".join(parts)


def _voltages(film: Film, element: Element | None, voltage: float) -> str:
    """Voltage and breakdown voltage of a bearing or a mesh; no text for others."""
    if element is None or film.conducts:
        return ""
    if element.breakdown_voltage is None:
        return f"{readable(voltage, 3)} V, {TOUCHES if element.touching else NO_LIMIT}"
    ratio = voltage / element.breakdown_voltage
    return f"{readable(voltage, 3)} V / {readable(element.breakdown_voltage, 3)} V = {readable(ratio, 3)}"


def lanes_of(shown: list[NetworkElement], shafts: list[str]) -> Iterator[tuple[NetworkElement, int]]:
    """Elements between two shafts, each with its lane: 0 between neighbours, further ones above."""
    taken: dict[int, list[tuple[int, int]]] = {}
    for each in shown:
        if not each.ends <= {*shafts}:
            continue
        start, end = sorted(shafts.index(name) for name in each.ends)
        lane = 0 if end == start + 1 else 1
        while any(start < last and first < end for first, last in taken.get(lane, [])):
            lane += 1
        taken.setdefault(lane, []).append((start, end))
        yield each, lane
