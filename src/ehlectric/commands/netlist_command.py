"""The command that writes a bearing, a drive or an axle as a netlist for circuit simulators."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ehlectric.commands.options import command
from ehlectric.commands.terminal import (
    NOT_CONVERGED,
    echo_files,
    print_rows,
    progress_bar,
    say,
    user_errors,
    warn,
)
from ehlectric.errors import InputError
from ehlectric.readable import readable

if TYPE_CHECKING:
    from ehlectric.drive import Arc, Netlist, Parameter, Subcircuit
    from ehlectric.quantities.rows import Row
    from ehlectric.runs.file_kinds import InputFile
    from ehlectric.runtime.progress import Progress

# Options by the names of their inputs.
_OPTIONS = {"arc_resistance": "--arc-resistance", "extinction_voltage": "--extinction-voltage"}


@command("spice")
def spice(
    input_file: Path,
    output: Path = Path("bearing.lib"),
    bench: Path | None = None,
    arc_resistance: str | None = None,
    extinction_voltage: str | None = None,
    speeds: str | None = None,
    contacts: str = "",
    quiet: bool = False,
) -> None:
    """Write a bearing as a netlist for ngspice and LTspice: a subcircuit from shaft to housing.

    It has the capacitance of the films and the leak through their oil, the coating of a ring and the parallel
    capacitance, and with both of its options a switch that closes where the films break down. Every parameter
    has a line with its unit. The table [motor] is only needed for --bench. Of a drive file both bearings are
    written, with the arc of its table [breakdown]; the bench has its inverter and its circuit. Of an axle all
    bearings, meshes and links are written, with switches if the file contains [breakdown].

    Exit status 0: written. 2: the input is wrong, or there is another file of this name. 3: a contact is not
    converged, the files are still written; or memory ran out.
    """
    with user_errors(), _named_as_options():
        from ehlectric.drive import arc_of, check_targets, write_files
        from ehlectric.runs.file_kinds import expect
        from ehlectric.runtime.files import clear_left_behind

        file = expect(input_file, "bearing", "drive", "axle")
        given = {"--arc-resistance": arc_resistance, "--extinction-voltage": extinction_voltage}
        if file.kind != "bearing":
            _refuse_with_drive({**given, "--speeds": speeds})
        arc = arc_of(arc_resistance, extinction_voltage)
        check_targets(output, bench)
        if file.kind == "axle":
            _write_axle(file, output, bench, contacts, quiet=quiet)
            return
        with progress_bar(shown=not quiet) as progress:
            if file.kind == "drive":
                netlist = _drive(file, contacts, progress)
            else:
                netlist = _bearing(file, contacts, arc, speeds, progress, motor=bench is not None)
        clear_left_behind(output.parent)
        files = write_files(netlist, output, bench)
    subcircuits = netlist.subcircuits
    if not quiet:
        for subcircuit in subcircuits:
            print_rows(_rows(subcircuit), subcircuit.case.title)
        echo_files(files)
        warn(dict.fromkeys(warning for subcircuit in subcircuits for warning in subcircuit.warnings()))
        if file.kind == "drive" and bench is None:
            say("note: only the bearings; --bench FILE.cir also writes the inverter and the motor", err=True)
        for note in dict.fromkeys(note for subcircuit in subcircuits for note in subcircuit.notes):
            say(f"note: {note}", err=True)
    if not all(result.converged for subcircuit in subcircuits for result in subcircuit.results):
        say("error: not converged: a contact of the bearing", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _refuse_with_drive(options: Mapping[str, str | None]) -> None:
    """Refuse options whose values a drive file has."""
    for name, value in options.items():
        if value is not None:
            raise InputError(name, got="it with a drive file", takes="the value of the drive file, or none")


def _bearing(
    file: InputFile, contacts: str, arc: Arc | None, speeds: str | None, progress: Progress, *, motor: bool
) -> Netlist:
    from ehlectric.drive import check_strength, drive_of, solve_at_speeds, speeds_of, subcircuit_of
    from ehlectric.runs import by_kind

    case = by_kind.read_bearing(file)
    case = case.replace({"contacts": contacts}) if contacts else case
    if arc is not None:
        check_strength(case)
    if motor:
        drive_of(case)
    others = () if speeds is None else speeds_of(case, speeds)
    return subcircuit_of(solve_at_speeds(case, others, progress), arc)


def _drive(file: InputFile, contacts: str, progress: Progress) -> Netlist:
    from ehlectric.drive import drive_netlist
    from ehlectric.runs import by_kind

    case = by_kind.read_drive(file)
    case = case.replace({"drive.contacts": contacts}) if contacts else case
    return drive_netlist(case, progress)


def _write_axle(file: InputFile, output: Path, bench: Path | None, contacts: str, *, quiet: bool) -> None:
    """Write the netlist of an axle, and print its parameters, notes and warnings."""
    from ehlectric.axle import axle_netlist
    from ehlectric.drive import write_files
    from ehlectric.runs import by_kind
    from ehlectric.runtime.files import clear_left_behind

    case = by_kind.read_axle(file)
    case = case.replace({"drive.contacts": contacts}) if contacts else case
    with progress_bar(shown=not quiet) as progress:
        netlist = axle_netlist(case, progress)
    clear_left_behind(output.parent)
    files = write_files(netlist, output, bench)
    if not quiet:
        print_rows(map(_row, netlist.parameters()), case.title)
        echo_files(files)
        warn(netlist.solution.warnings)
        for note in netlist.notes:
            say(f"note: {note}", err=True)


@contextmanager
def _named_as_options() -> Iterator[None]:
    """Context in which an input of the arc is named by its option."""
    try:
        yield
    except InputError as error:
        raise error.with_text(_OPTIONS.get(error.key or "", error.key), error.text) from None


def _row(parameter: Parameter) -> Row:
    """Row of a parameter."""
    from ehlectric.quantities.formats import amount
    from ehlectric.quantities.rows import Row

    unit = parameter.unit.replace("Ohm", "Ω")
    shown = f"{readable(parameter.value, 4)} rpm" if unit == "rpm" else amount(parameter.value, unit)
    return Row(parameter.name, shown, "", f", {parameter.meaning}")


def _rows(subcircuit: Subcircuit) -> Iterator[Row]:
    """Rows of the table: the subcircuit and its parameters, and what it has at each speed of a table."""
    from ehlectric.quantities.formats import amount, speed_text
    from ehlectric.quantities.rows import Row

    yield Row("subcircuit", f"{subcircuit.name} shaft housing")
    yield from map(_row, subcircuit.parameters())
    for point in subcircuit.circuits if subcircuit.tabulated else ():
        breaks = "" if point.threshold is None else f", breakdown at {readable(point.threshold, 4)} V"
        yield Row(f"at {speed_text(point.speed)}", amount(point.capacitance, "F"), "", breaks)
