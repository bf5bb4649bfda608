"""Netlist of an axle for circuit simulators: all bearings, meshes and links between winding and housing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ehlectric.axle.solution import AxleSolution, Element, SolvedFilms, elements_of, solve_films
from ehlectric.bearing import oil_conductance, oil_relaxation_time, shaft_path
from ehlectric.cases.axle_case import AxleCase
from ehlectric.drive import (
    EARTH,
    HOUSING,
    OPEN,
    SIGNATURE,
    SOURCE,
    WINDING,
    Film,
    Parameter,
    bench_lines,
    check_extinction,
    check_targets,
    comment,
    element_lines,
    element_parameters,
    filled,
    measured_waveform,
    name_of,
    number,
    write_files,
)
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.quantities.quantity import data_file
from ehlectric.runtime.progress import Progress, silent
from ehlectric.version import __version__

# Resistance of an element that conducts [Ohm]: much smaller than all others, with which it is in series.
_METAL = 1e-3

# Resistance of an open switch [Ohm].
_OFF = 1e15

# Notes, subcircuits of films, and the test bench.
_TEXTS = data_file("ehlectric.axle", "axle_netlist_texts.toml")


@dataclass(frozen=True, eq=False)
class AxleNetlist:
    """Netlist of an axle with solved films."""

    solution: AxleSolution
    # Conductances of the oil by the names of the elements that leak [S].
    leaks: Mapping[str, float] = field(default_factory=dict)

    @property
    def case(self) -> AxleCase:
        """Case of the axle."""
        return self.solution.case

    @property
    def nodes(self) -> dict[str, str]:
        """Names of the nodes in the netlist by the names of shafts, winding and housing."""
        shafts = [shaft.name for shaft in self.case.shaft]
        names = {WINDING: "winding", HOUSING: "housing"}
        if self.case.circuit.inductive:
            names |= {SOURCE: "inverter", EARTH: "earth"}
        return names | dict(zip(shafts, _distinct(shafts, "shaft", (*names.values(), "0")), strict=True))

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes about the limits of the circuit."""
        conducting = [film.name for film in self._films.values() if film.conducts]
        touching = [each.name for each in self.solution.elements if each.touching]
        touching = [name for name in touching if name not in conducting]
        return (
            _TEXTS["no_switch"] if self.case.breakdown is None else _TEXTS["switch"],
            *([filled(_TEXTS["conducting"], names=", ".join(conducting))] if conducting else []),
            *([filled(_TEXTS["touching"], names=", ".join(touching))] if touching else []),
            *([] if self.leaks else [filled(_TEXTS["no_leak"], open=number(OPEN))]),
            _TEXTS["left_out_with_inductances" if self.case.circuit.inductive else "left_out"],
        )

    @property
    def _films(self) -> dict[str, Film]:
        """Elements of the network by names that are distinct in a netlist."""
        films = self.solution.network().elements
        return dict(zip(_distinct([film.name for film in films], "element", ()), films, strict=True))

    def parameters(self) -> Iterator[Parameter]:
        """Parameters of the axle: values of all elements, and of the arc."""
        breakdown = self.case.breakdown
        for name, film in self._films.items():
            limit = self._limit(film)
            if film.conducts:
                continue
            for each in film.circuit(film.first, film.second):
                yield from element_parameters(name, each, film.name, f"in series with {film.name}")
            if film.name in self.leaks:
                yield Parameter(f"R_leak_{name}", 1.0 / self.leaks[film.name], "Ohm", f"leak of {film.name}")
            if limit is not None:
                yield Parameter(f"V_{name}", limit, "V", f"breakdown voltage, {film.name}")
        yield Parameter("R_metal", _METAL, "Ohm", "stands for contacts of metal")
        if breakdown is not None:
            yield Parameter(
                "V_ext", breakdown.lowest_voltage, "V", "voltage of a film below which an arc ends"
            )
            yield Parameter("R_arc", breakdown.arc_resistance, "Ohm", "resistance of an arc")

    def _limit(self, film: Film) -> float | None:
        """Breakdown voltage of an element with a switch [V]; None for elements without one."""
        element = self._element(film)
        if element is None or film.conducts or self.case.breakdown is None:
            return None
        return element.breakdown_voltage

    def _element(self, film: Film) -> Element | None:
        return next((each for each in self.solution.elements if each.name == film.name), None)

    def lines(self) -> Iterator[str]:
        """Lines of the file with the subcircuits."""
        yield f"{SIGNATURE}netlist of an axle; ehlectric {__version__}"
        for text in self._header():
            yield from comment(text)
        yield "*"
        yield from filled(_TEXTS["film"], open=number(OPEN), off=number(_OFF)).split("\n")
        yield from filled(_TEXTS["insulator"], open=number(OPEN)).split("\n")
        yield f".subckt axle {' '.join(self.nodes.values())}"
        for parameter in self.parameters():
            yield f"+ {parameter.line}"
        for name, film in self._films.items():
            yield from self._instances(name, film)
        yield ".ends axle"

    def _header(self) -> Iterator[str]:
        """Comments: title, operating point, notes and warnings."""
        drive = self.case.drive
        yield f"title: {self.case.title or '(none)'}"
        at = ", ".join(operating_point(drive.speed, drive.temperature, "degC"))
        yield f"operating point: {amount(drive.torque, 'N m')} and {at}"
        yield _TEXTS["circuit"]
        yield from (f"note: {text}" for text in self.notes)
        yield from (f"{warning.severity}: {warning}" for warning in self.solution.warnings)

    def _instances(self, name: str, film: Film) -> Iterator[str]:
        """Lines of an element between its nodes."""
        ends = f"{self.nodes[film.first]} {self.nodes[film.second]}"
        if film.conducts:
            yield f"R_{name} {ends} {{R_metal}}"
            return
        for each in film.circuit(film.first, film.second):
            if each.kind != "capacitor":
                yield from element_lines(name, each, *ends.split())
        if not film.capacitance:
            return
        leak = f" R_leak={{R_leak_{name}}}" if film.name in self.leaks else ""
        if self._limit(film) is None:
            yield f"X_{name} {ends} insulator C_films={{C_{name}}}{leak}"
        else:
            yield f"X_{name} {ends} film C_films={{C_{name}}} V_break={{V_{name}}}"
            yield f"+ V_ext={{V_ext}} R_arc={{R_arc}}{leak}"

    def bench(self, library: str) -> Iterator[str]:
        """Lines of a test bench, which includes the file of the subcircuits: the inverter at the winding."""
        waveform, _ = measured_waveform(self.case.source, None)
        nodes = {name: "0" if name == HOUSING else node for name, node in self.nodes.items()}
        measures = (
            f".meas tran {nodes[shaft.name]}_{word} {kind} V({nodes[shaft.name]})"
            for shaft in self.case.shaft
            for word, kind in (("peak_to_peak", "PP"), ("highest", "MAX"), ("lowest", "MIN"))
        )
        yield from bench_lines(
            self.case,
            "axle",
            _TEXTS["bench"],
            waveform,
            ends=[nodes[name] for name in self.solution.network().source],
            library=library,
            pins=" ".join(nodes.values()),
            measures=list(measures),
        )


def _distinct(texts: Iterable[str], other: str, taken: Iterable[str]) -> list[str]:
    """Names of a netlist for some texts, which differ from each other and from names that are taken.

    Examples
    --------
    >>> _distinct(["Rotor", "rotor", "轴"], "shaft", ())
    ['rotor', 'rotor_2', 'shaft']
    """
    names: list[str] = []
    for text in texts:
        plain = name_of(text) if text.isascii() else ""
        name = base = plain or other
        number_of_name = 1
        while name in names or name in taken:
            number_of_name += 1
            name = f"{base}_{number_of_name}"
        names.append(name)
    return names


def axle_netlist(case: AxleCase, progress: Progress = silent) -> AxleNetlist:
    """Solve the films of an axle, and make its netlist.

    Raises InputError if an element cannot be solved, or an arc would go out above a breakdown voltage.
    """
    films = solve_films(case, progress)
    solution = elements_of(films)
    if case.breakdown is not None:
        for name, limit in solution.breakdown_voltages.items():
            check_extinction(case.breakdown, limit, name)
    return AxleNetlist(solution, dict(leaks_of(films)))


def leaks_of(films: SolvedFilms) -> Iterator[tuple[str, float]]:
    """Names of elements, and the conductance C/tau of their oil [S] with its relaxation time tau = eps/sigma.

    Oil without a conductivity, ceramic elements and coated rings do not leak.
    """
    for name, result in zip(films.case.names_of_bearings(), films.bearings, strict=True):
        solution = result.solution
        tau = oil_relaxation_time(solution)
        if tau is not None and not (solution.conditions.ceramic or shaft_path(solution).coated):
            yield name, float(oil_conductance(solution, tau))
    for name, gears in zip(films.case.names_of_meshes(), films.meshes, strict=True):
        if gears.relaxation_time is not None:
            yield name, float(gears.loads.mean(gears.capacitance)) / gears.relaxation_time


def write_axle_netlist(
    case: AxleCase, path: str | Path, *, bench: str | Path | None = None, progress: Progress = silent
) -> list[Path]:
    """Write the netlist of an axle for ngspice and LTspice: all elements, and a bench with the inverter.

    Parameters
    ----------
    case : AxleCase
        Axle. With its table ``breakdown``, films have switches that close at their breakdown voltages.
    path : str or Path
        File of the subcircuits, such as axle.lib. An existing file is replaced if ehlectric wrote it.
    bench : str or Path, optional
        File of a test bench: the voltage of the inverter over four periods of its carrier at the winding.
    progress : callable, optional
        Called with the number of solved bearings and meshes, the number of all, and a text.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If a bearing or a mesh cannot be solved, an arc would go out above a breakdown voltage, or a file
        cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.AxleCase.from_toml(ehlectric.example("e_axle.toml")).replace(remedies=[])
    >>> with TemporaryDirectory() as folder:
    ...     files = ehlectric.write_axle_netlist(case, Path(folder) / "axle.lib")
    >>> [file.name for file in files]
    ['axle.lib']
    """
    path, bench = Path(path), None if bench is None else Path(bench)
    check_targets(path, bench)
    return write_files(axle_netlist(case, progress), path, bench)
