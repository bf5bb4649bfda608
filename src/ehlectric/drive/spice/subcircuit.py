"""Subcircuit of a bearing from shaft to housing, in the syntax that ngspice and LTspice share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ehlectric.bearing.conditions import Solid
from ehlectric.bearing.meter.path import Path
from ehlectric.bearing.meter.reading import rough_capacitance, shaft_path
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import capacitance_is_bound, lambda_text, lubrication
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import HOW
from ehlectric.drive.spice.equivalent import OPEN, Equivalent, equivalent_of
from ehlectric.drive.spice.over_speed import check_table, interpolated, nodes, parts
from ehlectric.drive.spice.text import SIGNATURE, Parameter, ascii_of, comment, name_of
from ehlectric.errors import InputError, ResultWarning
from ehlectric.quantities.formats import amount
from ehlectric.quantities.units import rpm, rpm_text
from ehlectric.version import __version__

# Resistance of an open switch over that of the leak beside it.
_OPEN_SWITCH = 1e6

_CELSIUS = 273.15

_CIRCUIT = (
    "circuit from shaft to housing: the films (C_films, R_leak and, where there is one, the arc) are "
    "parallel to each other; the coating of a ring (C_coat, R_coat), where there is one, is in series with "
    "them; the capacitance of cage, shields and wiring (C_par), where there is one, is parallel to all"
)


@dataclass(frozen=True)
class Arc:
    """Arc across the films of a bearing.

    Attributes
    ----------
    resistance : float
        Resistance of the arc [Ohm].
    extinction : float
        Voltage across the films below which it goes out [V].
    """

    resistance: float
    extinction: float


@dataclass(frozen=True)
class Subcircuit:
    """Subcircuit of a bearing.

    Attributes
    ----------
    results : tuple of BearingResult
        Results at one speed or several; the first one is at the speed that is the default.
    found : tuple of Equivalent
        Equivalent circuits of the results, by increasing speed.
    arc : Arc or None
        Arc across the films; None for a subcircuit without a switch.
    notes : tuple of str
        What the circuit leaves out, or stands for.
    suffix : str
        End of the name, of one of several bearings in a file.
    """

    results: tuple[BearingResult, ...]
    found: tuple[Equivalent, ...]
    arc: Arc | None
    notes: tuple[str, ...]
    suffix: str = ""

    @property
    def case(self) -> BearingCase:
        """Case at the speed that is the default."""
        return self.results[0].case

    @property
    def path(self) -> Path:
        """Circuit beside the films."""
        return shaft_path(self.results[0].solution)

    @property
    def name(self) -> str:
        """Name of the subcircuit."""
        base = name_of(self.case.bearing.base or "")
        return "_".join(filter(None, ["bearing", base, self.suffix]))

    @property
    def default(self) -> Equivalent:
        """Equivalent circuit at the speed that is the default."""
        return next(one for one in self.found if one.speed == self.case.bearing.inner_speed)

    @property
    def tabulated(self) -> bool:
        """Whether the speed is a parameter."""
        return len(self.found) > 1

    def parameters(self) -> Iterator[Parameter]:
        """Parameters that an instance may change."""
        one = self.found[0]
        if self.tabulated:
            speed = rpm(self.case.bearing.inner_speed)
            yield Parameter("speed", speed, "rpm", "speed of the inner ring")
        else:
            yield Parameter("C_films", one.capacitance, "F", _CAPACITANCES[one.state])
        if not self.tabulated or one.resistance is None:
            meaning = _LEAKS[one.state] if one.resistance is not None else "stands for an insulator"
            yield Parameter("R_leak", OPEN if one.resistance is None else one.resistance, "Ohm", meaning)
        if self.arc is not None:
            if not self.tabulated and one.threshold is not None:
                yield Parameter("V_break", one.threshold, "V", "voltage across the films at which they break")
            yield Parameter(
                "V_ext", self.arc.extinction, "V", "voltage across the films below which an arc ends"
            )
            yield Parameter("R_arc", self.arc.resistance, "Ohm", "resistance of the arc")
        path = self.path
        if path.coated:
            resistance = min(path.resistance, OPEN)
            yield Parameter("C_coat", path.coating, "F", "capacitance of the coating")
            yield Parameter("R_coat", resistance, "Ohm", _insulation(path))
        if path.parallel > 0.0:
            yield Parameter("C_par", path.parallel, "F", "capacitance of cage, shields and wiring")

    def lines(self) -> Iterator[str]:
        """Lines of the file."""
        yield f"{SIGNATURE}netlist of a bearing from shaft to housing; ehlectric {__version__}"
        for text in self._header():
            yield from comment(text)
        yield "*"
        yield f".subckt {self.name} shaft housing"
        for parameter in self.parameters():
            yield f"+ {parameter.line}"
        if self.tabulated:
            yield from self._table()
        yield from self._elements()
        yield f".ends {self.name}"

    def _header(self) -> Iterator[str]:
        """Comments: bearing, operating point, how it was solved, notes and warnings."""
        case, bearing, solution = self.case, self.case.bearing, self.results[0].solution
        yield f"title: {case.title or '(none)'}"
        yield f"bearing: {bearing.base or 'own dimensions'}, {bearing.kind}, {bearing.elements} elements"
        yield (
            f"operating point: {rpm_text(bearing.inner_speed)} rpm, "
            f"{bearing.oil_temperature - _CELSIUS:.4g} degC, radial load {amount(bearing.radial_load, 'N')}, "
            f"axial load {amount(bearing.axial_load, 'N')}; lambda ratio {lambda_text(solution)}, "
            f"{lubrication(solution)}"
        )
        if self.tabulated:
            speeds = ", ".join(rpm_text(one.speed) for one in self.found)
            yield (
                f"table over the speed at this temperature: {speeds} rpm; between two speeds each quantity "
                "is a power of the speed, below and above the table it is constant"
            )
        converged = all(result.converged for result in self.results)
        yield f"contacts: {HOW[case.contacts]}, {'converged' if converged else 'NOT CONVERGED'}"
        rough = rough_capacitance(solution)
        if rough is not None:
            yield f"C_films is that of smooth films; with roughness in their Hertz areas: {rough:.4g} F"
        yield _CIRCUIT
        yield from (f"note: {text}" for text in self.notes)
        yield from (f"{warning.severity}: {warning}" for warning in self.warnings())

    def warnings(self) -> Iterator[ResultWarning]:
        """Warnings at the speed that is the default, and those of further codes with their speed."""
        codes: set[str] = set()
        for result in self.results:
            new = [warning for warning in result.warnings if warning.code not in codes]
            codes.update(warning.code for warning in new)
            at = rpm_text(result.case.bearing.inner_speed)
            for warning in new:
                own = result is self.results[0]
                yield warning if own else ResultWarning(warning.code, f"at {at} rpm: {warning}")

    def _table(self) -> Iterator[str]:
        """Nodes over the speed, and the quantities at the speed of the instance."""
        count, one = len(self.found), self.found[0]
        leaks, breaks = one.resistance is not None, self.arc is not None
        for parameter in nodes(self.found, leaks=leaks, breaks=breaks):
            yield f".param {parameter.line}"
        yield "* part of each interval that the speed has passed, from 0 to 1"
        yield from (f".param {line}" for line in parts(count))
        quantities = [
            ("C_films", "C", "F", True),
            ("R_leak", "R", "Ohm", leaks),
            ("V_break", "V", "V", breaks),
        ]
        for name, letter, unit, wanted in quantities:
            if wanted:
                yield f"* {name} in {unit}, at the speed"
                first, *others = interpolated(name, letter, count)
                yield from (f".param {first}", *others)

    def _elements(self) -> Iterator[str]:
        """Capacitors, resistors and the switches of the arc: one for each sign of the voltage."""
        path, node = self.path, "ring" if self.path.coated else "shaft"
        if path.coated:
            yield f"C_coat shaft {node} {{C_coat}}"
            yield f"R_coat shaft {node} {{R_coat}}"
        yield f"C_films {node} housing {{C_films}}"
        yield f"R_leak {node} housing {{R_leak}}"
        if path.parallel > 0.0:
            yield "C_par shaft housing {C_par}"
        if self.arc is not None:
            yield f"S_positive {node} housing {node} housing arc OFF"
            yield f"S_negative {node} housing housing {node} arc OFF"
            yield "* closes above Vt + Vh = V_break and opens below Vt - Vh = V_ext"
            yield f".model arc SW(Ron={{R_arc}} Roff={{{_OPEN_SWITCH:g}*R_leak}}"
            yield "+ Vt={(V_break+V_ext)/2} Vh={(V_break-V_ext)/2})"


_CAPACITANCES = {
    "films": "capacitance of the smooth films, mean over the positions of the cage",
    "ceramic": "capacitance of the ceramic elements",
    "metal": "capacitance of the smooth films, beside contacts of metal",
}
_LEAKS = {
    "films": "leak through the oil of the films",
    "metal": "contacts of metal, reciprocal mean conductance over time",
}


def _insulation(path: Path) -> str:
    return "insulation of the coating" if path.resistance < OPEN else "stands for an insulator"


def subcircuit_of(results: Sequence[BearingResult], arc: Arc | None) -> Subcircuit:
    """Subcircuit of a bearing at one speed, or over several.

    Parameters
    ----------
    results : sequence of BearingResult
        Results of one bearing at different speeds; the speed of the first one is the default.
    arc : Arc or None
        Arc across the films; None for a subcircuit without a switch.

    Returns
    -------
    Subcircuit
        Subcircuit with its notes. It has no arc where there is no film that breaks down.

    Raises
    ------
    InputError
        If the results are no table over the speed, the surfaces touch without ``bearing.contact_resistance``,
        or the arc has no breakdown voltage above that of its extinction.
    """
    check_table(results)
    found = sorted((equivalent_of(result.solution) for result in results), key=lambda one: one.speed)
    films = found[0].state == "films"
    if films and arc is not None:
        check_strength(results[0].case)
        _check_arc(found, arc)
    return Subcircuit(
        tuple(results), tuple(found), arc if films else None, tuple(_notes(results[0], found, arc))
    )


def check_strength(case: BearingCase) -> None:
    """Refuse a switch without a dielectric strength, before anything is solved.

    Raises
    ------
    InputError
        If steel elements have no dielectric strength of the film.
    """
    known = case.discharge.has_strength or case.discharge.weibull is not None
    if Solid.of(case.bearing.element_material).conducting and not known:
        raise InputError.missing(
            "discharge.dielectric_strength", "a value, for the breakdown voltage of the switch"
        )


def _check_arc(found: Sequence[Equivalent], arc: Arc) -> None:
    """Refuse an arc without a breakdown voltage, or that would go out above it."""
    least = min(one.threshold for one in found if one.threshold is not None)
    if arc.extinction >= least:
        raise InputError(
            "extinction_voltage",
            got=f"{arc.extinction:.4g} V",
            takes=f"less than {least:.4g} V, the smallest breakdown voltage of the films",
        )


def _notes(result: BearingResult, found: Sequence[Equivalent], arc: Arc | None) -> Iterator[str]:
    """Notes about the limits of the circuit: effects that it leaves out, and values that are bounds."""
    one, case, path = found[0], result.case, shaft_path(result.solution)
    if one.state == "ceramic":
        bound = capacitance_is_bound(result.solution)
        known = "an upper bound of it, since bearing.element_capacitance is missing" if bound else "C_films"
        yield f"ceramic elements insulate: the subcircuit is their capacitance, {known}; it has no switch"
    elif one.state == "metal":
        yield (
            "the surfaces touch: the subcircuit is the resistance of contacts of metal, reciprocal mean "
            "conductance over time, parallel to the capacitance of smooth films; it has no switch"
        )
    elif arc is None:
        least = min((one.threshold for one in found if one.threshold is not None), default=None)
        known = "" if least is None else f"; the films break down from ring to ring at {least:.4g} V"
        yield (
            "no switch: it needs the resistance of the arc and the voltage at which it goes out "
            f"(--arc-resistance, --extinction-voltage), which have no default{known}"
        )
    else:
        yield (
            "the switch closes at the ring-to-ring breakdown voltage of the films, smallest over the "
            "positions of the cage, for both signs; the first break of a single contact, which leaves the "
            "other one of its element intact, is left out"
        )
        if case.discharge.weibull is not None:
            yield "V_break is that of a contact at a probability of 63.2 % (Weibull)"
    if one.state == "films" and one.resistance is None:
        yield (
            f"no leak: the oil has no discharge.conductivity; R_leak of {OPEN:g} Ohm only gives the films a "
            "path for direct current"
        )
    if path.coated and path.resistance >= OPEN:
        yield (
            f"the coating does not leak; R_coat of {OPEN:g} Ohm only gives the shaft a path for direct "
            "current"
        )


def file_text(lines: Iterator[str]) -> bytes:
    """Content of a file with lines of ASCII."""
    return ("\n".join(map(ascii_of, lines)) + "\n").encode("ascii")
