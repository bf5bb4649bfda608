"""Netlist of a bearing for circuit simulators: equivalent circuit over the speed, subcircuit, test bench."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from string import Template
from typing import Literal

import numpy as np

from ehlectric.bearing import (
    BearingResult,
    BearingSolution,
    Path,
    Solid,
    bearing_state,
    breakdown_of,
    capacitance,
    capacitance_is_bound,
    conducts,
    duty_of,
    lambda_text,
    oil_conductance,
    oil_relaxation_time,
    rough_capacitance,
    shaft_path,
    solve_bearing,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Motor
from ehlectric.cases.defaults import HOW
from ehlectric.errors import InputError, printable, shown
from ehlectric.quantities.formats import amount, operating_point, rpm_text, speed_text
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.units import rpm
from ehlectric.runtime.progress import Progress, silent
from ehlectric.version import __version__

# Beginning of the first line of every file that is written here, by which it is recognised.
SIGNATURE = "* ehlectric "

# Meanings, notes and test benches.
TEXTS = data_file("ehlectric.drive", "netlist_texts.toml")

_WIDTH = 100  # of a comment [characters]

# Letters that texts of ehlectric have, in ASCII: not every simulator reads UTF-8.
_LETTERS = str.maketrans(
    {"µ": "u", "Ω": "Ohm", "°": "deg ", "≤": "<=", "≥": ">=", "×": "x", "–": "-", "²": "^2", "³": "^3"}
    | {"\xa0": " "}
)


def ascii_of(text: str) -> str:
    r"""Text on one line in printable ASCII; other letters are escaped.

    Examples
    --------
    >>> print(ascii_of("film of 0.1 µm\nR1 1 0 5"))
    film of 0.1 um\nR1 1 0 5
    >>> print(ascii_of("14\xa0000 rpm"))
    14 000 rpm
    """
    return printable(text).translate(_LETTERS).encode("ascii", "backslashreplace").decode("ascii")


def comment(text: str) -> Iterator[str]:
    """Lines of a comment with any text of a user, wrapped.

    Every line begins with an asterisk and a space: ngspice takes ``*#`` for a command.

    Examples
    --------
    >>> list(comment("a title"))
    ['* a title']
    """
    for line in textwrap.wrap(ascii_of(text), _WIDTH) or [""]:
        yield f"* {line}".rstrip()


def filled(text: str, **parts: object) -> str:
    r"""Text of the table of texts with its parts instead of their names; a part of several lines is a list.

    Examples
    --------
    >>> print(filled("R_$name a b 1\n$others", name="leak", others=["C_1 a b 1", "C_2 a b 1"]))
    R_leak a b 1
    C_1 a b 1
    C_2 a b 1
    """
    return Template(text).substitute(
        {name: "\n".join(part) if isinstance(part, list) else part for name, part in parts.items()}
    )


def number(value: float) -> str:
    """Number with nine digits; it has no suffix, since "M" is a thousandth in SPICE.

    Examples
    --------
    >>> number(1.2e-10), number(3000.0)
    ('1.2e-10', '3000')
    """
    return f"{value:.9g}"


def name_of(text: str) -> str:
    """Name of a subcircuit or a file: lower-case letters, digits and underscores.

    Examples
    --------
    >>> name_of("NU-205")
    'nu_205'
    """
    return re.sub(r"[^a-z0-9]+", "_", ascii_of(text).lower()).strip("_")


@dataclass(frozen=True)
class Parameter:
    """Parameter of a netlist."""

    name: str
    value: float
    unit: str
    meaning: str

    @property
    def line(self) -> str:
        """Assignment with the unit and the meaning as a comment.

        Examples
        --------
        >>> Parameter("C_films", 1.2e-10, "F", "films").line
        'C_films=1.2e-10 ; F, films'
        """
        return f"{self.name}={number(self.value)} ; {self.unit}, {ascii_of(self.meaning)}"


# Resistance instead of an insulator [Ohm]. It has no effect on a drive: with the capacitance of a bearing it
# has a time constant of minutes. Without it, a node between capacitors has no voltage before the first step.
OPEN = 1e12

# What lies between the rings: films of oil, ceramic elements, or contacts of metal.
State = Literal["films", "ceramic", "metal"]


@dataclass(frozen=True)
class Equivalent:
    """Equivalent circuit of what lies between the rings of a bearing, at one speed."""

    speed: float  # speed of the inner ring [rad/s]
    state: State  # "films"; "ceramic" for elements that insulate; "metal" where the surfaces touch
    capacitance: float  # capacitance with smooth films, mean over the positions of the cage [F]
    # Resistance parallel to it, of the oil or of contacts of metal [Ohm]; None for oil without a conductivity
    # and for ceramic elements.
    resistance: float | None
    # Smallest voltage from ring to ring at which an element breaks down [V]; None where there is none.
    threshold: float | None


def equivalent_of(solution: BearingSolution) -> Equivalent:
    """Equivalent circuit of what lies between the rings of a solved bearing.

    Where the surfaces touch, an element conducts while both of its contacts are closed, by two contact
    resistances in series. The conductance is the mean over time of the conductance of all elements. Raises
    InputError where the surfaces touch, and the case has no ``bearing.contact_resistance``.
    """
    speed, of_films = solution.case.bearing.inner_speed, float(capacitance(solution))
    if solution.conditions.ceramic:
        return Equivalent(speed, "ceramic", of_films, None, None)
    if conducts(solution):
        return Equivalent(speed, "metal", of_films, _metal_resistance(solution), None)
    tau, breakdown = oil_relaxation_time(solution), breakdown_of(solution)
    return Equivalent(
        speed,
        "films",
        of_films,
        None if tau is None else 1.0 / float(oil_conductance(solution, tau)),
        None if breakdown is None else float(breakdown.ring_to_ring_breakdown),
    )


def _metal_resistance(solution: BearingSolution) -> float:
    """Reciprocal mean conductance of contacts that close at times [Ohm]."""
    resistance = solution.case.bearing.contact_resistance
    if resistance is None:
        raise InputError.missing(
            "bearing.contact_resistance",
            f"a value: at {speed_text(solution.case.bearing.inner_speed)} asperity contact is frequent "
            f"(lambda ratio {lambda_text(solution)}), so that the bearing is a resistance; or a "
            "film that separates the surfaces",
        )
    shares = [
        float(np.sum(inner.contact_time_share * outer.contact_time_share))
        for inner, outer in duty_of(solution).rings
    ]
    mean = float(np.mean(shares))
    return OPEN if mean * OPEN <= 2.0 * resistance else 2.0 * resistance / mean


# Largest number of speeds in a range, and the smallest ratio of two speeds: the logarithm of their ratio, to
# nine digits, is divided by.
_MOST, _APART = 99, 1.001

_RANGE = re.compile(r"\s*(?P<low>[^:]+):(?P<high>[^:]+):\s*(?P<count>\d{1,4})\s*")
_TAKES = "speeds with units, as '500 rpm, 1000 rpm', or a range with its number, as '500 rpm : 3000 rpm : 7'"

# Number of factors on a line of an expression.
_FACTORS = 4


def speeds_of(case: BearingCase, text: str) -> tuple[float, ...]:
    """Speeds of the inner ring [rad/s] from the text of an option; an InputError where a part is no speed."""
    match = _RANGE.fullmatch(text)
    if match is None:
        return tuple(_speed(case, part) for part in text.split(","))
    low, high, count = _speed(case, match["low"]), _speed(case, match["high"]), int(match["count"])
    if not (2 <= count <= _MOST and 0.0 < low < high):
        raise InputError(
            "--speeds",
            got=shown(text),
            takes=f"a range from a lower to a higher speed in 2 to {_MOST} speeds",
        )
    return tuple(float(speed) for speed in np.geomspace(low, high, count))


def _speed(case: BearingCase, text: str) -> float:
    try:
        return case.replace({SPEED: text.strip()}).bearing.inner_speed
    except InputError as error:
        if error.key != SPEED:
            raise
        raise InputError("--speeds", got=error.got or shown(text.strip()), takes=_TAKES) from None


def solve_at_speeds(
    case: BearingCase, speeds: Sequence[float], progress: Progress = silent, *, workers: int | None = None
) -> list[BearingResult]:
    """Solve a bearing at its speed and at others [rad/s], all at the same temperature.

    The first result is at the speed of the case. Raises the errors of ``solve_bearing``.
    """
    speed_of_case = case.bearing.inner_speed
    others = [
        speed for speed in dict.fromkeys(speeds) if not np.isclose(speed, speed_of_case, rtol=1e-9, atol=0.0)
    ]
    results = []
    for speed in (speed_of_case, *others):

        def tell(done: int, of: int, text: str, at: str = speed_text(speed)) -> None:
            progress(done, of, f"{text}, {at}")

        changed = case if speed == speed_of_case else case.replace({SPEED: speed})
        results.append(solve_bearing(changed, progress=tell, workers=workers))
    return results


def check_table(results: Sequence[BearingResult]) -> None:
    """Refuse several results that are no table over the speed. Raises InputError if they differ in more than
    the speed, two have nearly the same speed, or surfaces touch at some.
    """
    if len(results) == 1:
        return
    speed_of_case = results[0].case.bearing.inner_speed
    inputs = [result.case.replace({SPEED: speed_of_case}).to_dict() for result in results]
    if any(table != inputs[0] for table in inputs):
        raise InputError("result", got="bearings that differ in other inputs", takes="one bearing, at speeds")
    for low, high in pairwise(sorted(result.case.bearing.inner_speed for result in results)):
        if high < low * _APART:
            speeds = f"{rpm(low):.6g} rpm and {rpm(high):.6g} rpm"
            raise InputError(SPEED, got=speeds, takes="speeds that differ by 0.1 % or more")
    touching = [result.case.bearing.inner_speed for result in results if conducts(result.solution)]
    if touching:
        speeds = ", ".join(speed_text(speed) for speed in sorted(touching))
        raise InputError(
            SPEED,
            got=f"{speeds}, at which asperity contact is frequent",
            takes="in a table over the speed, speeds at which films separate the surfaces",
        )


def nodes(circuits: Sequence[Equivalent], *, leaks: bool, breaks: bool) -> Iterator[Parameter]:
    """Parameters of a table: speeds [rpm], and the quantities at them, by increasing speed."""
    for k, circuit in enumerate(circuits, 1):
        at = f"at n_{k}"
        yield Parameter(f"n_{k}", rpm(circuit.speed), "rpm", f"speed {k} of the table")
        yield Parameter(f"C_{k}", circuit.capacitance, "F", f"capacitance of the films {at}")
        if leaks and circuit.resistance is not None:
            yield Parameter(f"R_{k}", circuit.resistance, "Ohm", f"leak of the films {at}")
        if breaks and circuit.threshold is not None:
            yield Parameter(f"V_{k}", circuit.threshold, "V", f"breakdown voltage of the films {at}")


def parts(count: int) -> Iterator[str]:
    """Expressions of the logarithms by which the speed has passed through each interval, over its length.

    They use functions that ngspice and LTspice both have: 0 below the interval and 1 above it.
    """
    for k in range(1, count):
        low, high = f"n_{k}", f"n_{k + 1}"
        yield f"x_{k}={{ln(min(max(speed,{low}),{high})/{low})/ln({high}/{low})}}"


def interpolated(name: str, letter: str, count: int) -> Iterator[str]:
    """Lines of a quantity that is a power of the speed between two nodes, and constant outside of all.

    Examples
    --------
    >>> list(interpolated("C_films", "C", 3))
    ['C_films={C_1', '+ *pow(C_2/C_1,x_1)*pow(C_3/C_2,x_2)}']
    """
    factors = [f"*pow({letter}_{k + 1}/{letter}_{k},x_{k})" for k in range(1, count)]
    lines = ["".join(factors[at : at + _FACTORS]) for at in range(0, len(factors), _FACTORS)]
    yield f"{name}={{{letter}_1" + "}" * (not lines)
    for at, line in enumerate(lines, 1):
        yield f"+ {line}" + "}" * (at == len(lines))


# Resistance of an open switch divided by the resistance of the leak parallel to it.
_OPEN_SWITCH = 1e6


@dataclass(frozen=True)
class Arc:
    """Arc across the films of a bearing."""

    resistance: float  # [Ohm]
    extinction: float  # voltage across the films below which it goes out [V]


@dataclass(frozen=True)
class Subcircuit:
    """Subcircuit of a bearing."""

    # Results at one speed or several; the first one is at the speed that is the default.
    results: tuple[BearingResult, ...]
    circuits: tuple[Equivalent, ...]  # equivalent circuits of the results, by increasing speed
    arc: Arc | None  # arc across the films; None for a subcircuit without a switch
    notes: tuple[str, ...]  # what the circuit neglects, or stands for
    suffix: str = ""  # end of the name, of one of several bearings in a file

    @property
    def subcircuits(self) -> tuple[Subcircuit]:
        """Subcircuits of its file: this one."""
        return (self,)

    @property
    def case(self) -> BearingCase:
        """Case at the speed that is the default."""
        return self.results[0].case

    @property
    def path(self) -> Path:
        """Circuit parallel to the films."""
        return shaft_path(self.results[0].solution)

    @property
    def name(self) -> str:
        """Name of the subcircuit."""
        base = name_of(self.case.bearing.base or "")
        return "_".join(filter(None, ["bearing", base, self.suffix]))

    @property
    def default(self) -> Equivalent:
        """Equivalent circuit at the speed that is the default."""
        return next(circuit for circuit in self.circuits if circuit.speed == self.case.bearing.inner_speed)

    @property
    def tabulated(self) -> bool:
        """Whether the speed is a parameter."""
        return len(self.circuits) > 1

    def parameters(self) -> Iterator[Parameter]:
        """Parameters that an instance may change."""
        circuit = self.circuits[0]
        if self.tabulated:
            speed = rpm(self.case.bearing.inner_speed)
            yield Parameter("speed", speed, "rpm", "speed of the inner ring")
        else:
            yield Parameter("C_films", circuit.capacitance, "F", TEXTS["capacitances"][circuit.state])
        if not self.tabulated or circuit.resistance is None:
            if circuit.resistance is None:
                yield Parameter("R_leak", OPEN, "Ohm", "stands for an insulator")
            else:
                yield Parameter("R_leak", circuit.resistance, "Ohm", TEXTS["leaks"][circuit.state])
        if self.arc is not None:
            if not self.tabulated and circuit.threshold is not None:
                yield Parameter(
                    "V_break", circuit.threshold, "V", "voltage across the films at which they break"
                )
            yield Parameter(
                "V_ext", self.arc.extinction, "V", "voltage across the films below which an arc ends"
            )
            yield Parameter("R_arc", self.arc.resistance, "Ohm", "resistance of the arc")
        path = self.path
        if path.coated:
            leaks = path.resistance < OPEN
            yield Parameter("C_coat", float(path.coating), "F", "capacitance of the coating")
            meaning = "insulation of the coating" if leaks else "stands for an insulator"
            yield Parameter("R_coat", float(path.resistance if leaks else OPEN), "Ohm", meaning)
        if path.parallel > 0.0:
            yield Parameter("C_par", float(path.parallel), "F", "capacitance of cage, shields and wiring")

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

    def bench(self, library: str) -> Iterator[str]:
        """Lines of a test bench that simulates periods of the inverter; raises the errors of ``drive_of``."""
        motor, bench = drive_of(self.case), TEXTS["bearing_bench"]
        bearing = f"{self.name} speed={{n_shaft}}" if self.tabulated else self.name
        text = filled(
            bench["lines"],
            signature=f"{SIGNATURE}test bench of {self.name}; ehlectric {__version__}",
            comments=[*comment(f"title: {self.case.title or '(none)'}"), *comment(bench["about"])],
            library=library,
            parameters=[f".param {parameter.line}" for parameter in _parameters(self, motor)],
            bearing=bearing,
            other_end=list(_other_end(self, motor, bearing)),
        )
        yield from text.split("\n")

    def _header(self) -> Iterator[str]:
        """Comments: bearing, operating point, how it was solved, notes and warnings."""
        case, bearing, solution = self.case, self.case.bearing, self.results[0].solution
        yield f"title: {case.title or '(none)'}"
        yield f"bearing: {bearing.name or 'own dimensions'}, {bearing.kind}, {bearing.elements} elements"
        at = ", ".join(operating_point(bearing.inner_speed, bearing.oil_temperature, "degC"))
        yield (
            f"operating point: {at}, radial load {amount(bearing.radial_load, 'N')}, "
            f"axial load {amount(bearing.axial_load, 'N')}; lambda ratio {lambda_text(solution)}, "
            f"{bearing_state(solution)}"
        )
        if self.tabulated:
            speeds = ", ".join(rpm_text(circuit.speed) for circuit in self.circuits)
            yield filled(TEXTS["notes"]["table"], speeds=speeds)
        converged = all(result.converged for result in self.results)
        yield f"contacts: {HOW[case.contacts]}, {'converged' if converged else 'NOT CONVERGED'}"
        rough = rough_capacitance(solution)
        if rough is not None:
            yield f"C_films is for smooth films; with roughness in the Hertzian contact areas: {rough:.4g} F"
        yield TEXTS["circuit"]
        yield from (f"note: {text}" for text in self.notes)
        yield from (f"{warning.severity}: {warning}" for warning in self.warnings())

    def warnings(self) -> Iterator[ResultWarning]:
        """Warnings at the speed that is the default, and warnings of further codes with their speed."""
        codes: set[str] = set()
        for result in self.results:
            new = [warning for warning in result.warnings if warning.code not in codes]
            codes.update(warning.code for warning in new)
            at = speed_text(result.case.bearing.inner_speed)
            for warning in new:
                is_default = result is self.results[0]
                yield warning if is_default else ResultWarning(warning.code, f"at {at}: {warning}")

    def _table(self) -> Iterator[str]:
        """Nodes over the speed, and the quantities at the speed of the instance."""
        count, circuit = len(self.circuits), self.circuits[0]
        leaks, breaks = circuit.resistance is not None, self.arc is not None
        for parameter in nodes(self.circuits, leaks=leaks, breaks=breaks):
            yield f".param {parameter.line}"
        yield "* part of each interval that the speed has passed, from 0 to 1"
        yield from (f".param {line}" for line in parts(count))
        quantities = [
            ("C_films", "C", "F", True),
            ("R_leak", "R", "Ohm", leaks),
            ("V_break", "V", "V", breaks),
        ]
        for name, letter, unit, present in quantities:
            if present:
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


def subcircuit_of(results: Sequence[BearingResult], arc: Arc | None) -> Subcircuit:
    """Subcircuit of a bearing at one speed, or over several.

    ``arc``, arc across the films; None for a subcircuit without a switch. Returns subcircuit with its notes;
    it has no arc where there is no film that breaks down. Raises InputError if the results are no table over
    the speed, the surfaces touch without ``bearing.contact_resistance``, or the arc has no breakdown voltage
    above the voltage of its extinction.
    """
    check_table(results)
    circuits = sorted(
        (equivalent_of(result.solution) for result in results), key=lambda circuit: circuit.speed
    )
    films = circuits[0].state == "films"
    if films and arc is not None:
        check_strength(results[0].case)
        _check_arc(circuits, arc)
    return Subcircuit(
        tuple(results), tuple(circuits), arc if films else None, tuple(_notes(results[0], circuits, arc))
    )


def check_strength(case: BearingCase) -> None:
    """Refuse a switch without a dielectric strength, before anything is solved. Raises InputError if steel
    elements have no dielectric strength of the film.
    """
    known = case.discharge.has_strength or case.discharge.weibull is not None
    if Solid.of(case.bearing.element_material).conducting and not known:
        raise InputError.missing(
            "discharge.dielectric_strength", "a value, for the breakdown voltage of the switch"
        )


def _check_arc(circuits: Sequence[Equivalent], arc: Arc) -> None:
    """Refuse an arc without a breakdown voltage, or that would go out above it."""
    least = min(circuit.threshold for circuit in circuits if circuit.threshold is not None)
    if arc.extinction >= least:
        raise InputError(
            "extinction_voltage",
            got=f"{arc.extinction:.4g} V",
            takes=f"less than {least:.4g} V, the smallest breakdown voltage of the films",
        )


def _notes(result: BearingResult, circuits: Sequence[Equivalent], arc: Arc | None) -> Iterator[str]:
    """Notes about the limits of the circuit: effects that it neglects, and values that are bounds."""
    circuit, path, notes = circuits[0], shaft_path(result.solution), TEXTS["notes"]
    if circuit.state == "ceramic":
        bound = capacitance_is_bound(result.solution)
        yield filled(notes["ceramic"], known=notes["ceramic_bound"] if bound else "C_films")
    elif circuit.state == "metal":
        yield notes["metal"]
    elif arc is None:
        least = min(
            (circuit.threshold for circuit in circuits if circuit.threshold is not None), default=None
        )
        known = "" if least is None else f"; the films break down from ring to ring at {least:.4g} V"
        yield filled(notes["no_switch"], known=known)
    else:
        yield notes["switch"]
        if result.case.discharge.weibull is not None:
            yield notes["weibull"]
    if circuit.state == "films" and circuit.resistance is None:
        yield filled(notes["no_leak"], open=f"{OPEN:g}")
    if path.coated and path.resistance >= OPEN:
        yield filled(notes["coating"], open=f"{OPEN:g}")


def file_text(lines: Iterator[str]) -> bytes:
    """Content of a file with lines of ASCII."""
    return ("\n".join(map(ascii_of, lines)) + "\n").encode("ascii")


def drive_of(case: BearingCase) -> Motor:
    """Table ``[motor]`` of a bearing with all that a test bench needs.

    Raises InputError if the case has no motor, a key is missing, or an edge lasts half a period.
    """
    motor = case.motor
    if motor is None:
        raise InputError.missing("motor", "a table, for the drive of the test bench")
    for key in ("switching_frequency", "rise_time"):
        if getattr(motor, key) is None:
            raise InputError.missing(f"motor.{key}", "a value, for the voltage of the test bench")
    assert motor.switching_frequency is not None and motor.rise_time is not None
    half = 0.5 / motor.switching_frequency
    if motor.rise_time >= half:
        raise InputError(
            "motor.rise_time",
            got=f"{motor.rise_time:g} s",
            takes=f"less than {half:.3g} s, half a period of motor.switching_frequency",
        )
    return motor


def _parameters(subcircuit: Subcircuit, motor: Motor) -> Iterator[Parameter]:
    """Parameters of the drive, from the table ``[motor]``."""
    assert motor.switching_frequency is not None and motor.rise_time is not None
    yield Parameter("V_peak", motor.common_mode_voltage, "V", "motor.common_mode_voltage, peak")
    yield Parameter("f_switch", motor.switching_frequency, "Hz", "motor.switching_frequency")
    yield Parameter("t_rise", motor.rise_time, "s", "motor.rise_time, of an edge")
    yield Parameter("C_wr", motor.winding_rotor_capacitance, "F", "motor.winding_rotor_capacitance")
    yield Parameter("C_rf", motor.rotor_frame_capacitance, "F", "motor.rotor_frame_capacitance")
    if motor.second_bearing_capacitance is not None:
        yield Parameter("C_second", motor.second_bearing_capacitance, "F", "motor.second_bearing_capacitance")
    if subcircuit.tabulated:
        yield Parameter("n_shaft", rpm(subcircuit.case.bearing.inner_speed), "rpm", SPEED)


def _other_end(subcircuit: Subcircuit, motor: Motor, bearing: str) -> Iterator[str]:
    """Bearing at the other end: one like this one, or its given capacitance, which does not break down."""
    if motor.second_bearing_capacitance is None:
        yield f"X_other_end shaft 0 {bearing}"
        return
    yield "C_second shaft 0 {C_second}"
    resistance = subcircuit.default.resistance
    if subcircuit.default.state == "films" and resistance is not None:
        # The oil of the first bearing, and therefore its relaxation time.
        yield "* the other bearing has the same oil, and leaks with the same time constant"
        leak = resistance * subcircuit.default.capacitance / motor.second_bearing_capacitance
        yield f".param {Parameter('R_second', leak, 'Ohm', 'leak through the oil of the other bearing').line}"
        yield "R_second shaft 0 {R_second}"
