"""The commands that solve a contact, a bearing or a drive, check a case, and list the bearings of the
library.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ehlectric.commands.options import (
    Look,
    command,
    figure_options,
)
from ehlectric.commands.terminal import (
    echo_files,
    print_answer,
    print_rows,
    print_table,
    print_verdict,
    progress_bar,
    progress_line,
    refuse_failure,
    refuse_undrawn,
    say,
    user_errors,
    warn,
)
from ehlectric.runtime.progress import Progress
from ehlectric.runtime.undrawn import Drawn

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.contact import PointResult, Result
    from ehlectric.runs.file_kinds import FileKind
    from ehlectric.runtime.progress import RunOutcome

    # Tables that a command prints of its outcome.
    Tables = Callable[[RunOutcome[Any]], Iterable[Table]]


@command("check")
def check(file: Path, quiet: bool = False, as_json: bool = False) -> None:
    """Check a file of any kind without solving it, and print what it means.

    Hertz contact, groups, regime and film formulas of a contact; with [discharge], an estimate of its
    breakdown voltage. Loads, speeds, oil, films, capacitance and margin of a bearing, unsolved. Source and
    bearings of a drive, not simulated. Number of points of a sweep, and its first point.

    Exit status 0: the file can be solved. 2: the input is wrong.
    """
    with user_errors():
        from ehlectric.runs import by_kind
        from ehlectric.runs.file_kinds import expect
        from ehlectric.runs.preview import preview_of

        checked = expect(file, "contact", "motion", "bearing", "drive", "gear", "axle", "sweep")
        preview = preview_of(by_kind.RUNS[checked.kind].read(checked))
    if as_json:
        typer.echo(json.dumps(preview.summary, indent=2))
    elif not quiet:
        print_rows(preview.rows, preview.title)
        print_verdict(preview.verdict)
    if not quiet:
        warn(preview.warnings)


@contextmanager
def _saved_steps(folder: Path, *, shown: bool) -> Iterator[Progress]:
    """Context of a transient run with a bar of its steps; where it is stopped, one line contains the number
    of saved steps.
    """
    steps = 0
    with progress_bar(shown=shown) as bar:

        def progress(done: int, of: int, text: str) -> None:
            nonlocal steps
            steps = of or steps
            bar(done, of, text)

        try:
            yield progress
        except (KeyboardInterrupt, SystemExit):
            if steps:
                from ehlectric.motion.stored_run import saved_run

                # Read from the file: the progress may not have been called for the last instant yet.
                saved, _ = saved_run(folder)
                rest = "resumes the run" if saved < steps else "sums them up"
                text = f"{saved} of {steps} steps are saved in {folder}; the same command {rest}"
                say(f"interrupted; {text}", err=True)
            raise


@command("run")
def run(
    case_file: Path,
    output: Path = Path("results"),
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    solver: str = "ehlectric",
    measured: Path | None = None,
    uncertainty: str | None = None,
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Solve a contact; write summary.json, result.nc, film.csv and figures.

    With --measured, film thicknesses over the entrainment speed give the film factor that explains them: in
    measured.json, measured.csv and a figure.

    A case with [motion] writes summary.json, motion.nc and figures. If it is interrupted, run the same
    command to resume it.

    The folder then holds only this result: files of an earlier result are removed, other files stay. A
    folder with a sweep, or with moving roughness of another case, is refused.

    Exit status 0: solved. 2: the input is wrong. 3: not converged, all files are still written; or memory
    ran out.
    """
    with ExitStack() as locked:
        with user_errors():
            look = figure_options(formats, style)

            from ehlectric.runs import by_kind
            from ehlectric.runs.file_kinds import expect
            from ehlectric.runs.measured_film_factors import MeasuredFile
            from ehlectric.runtime.folders import RESULT_LOCK, alone_in

            file = expect(case_file, "contact", "motion")
            kind, case = file.kind, by_kind.RUNS[file.kind].read(file)
            data = MeasuredFile.of(measured, None, uncertainty)
            if kind == "contact":
                from ehlectric.contact import prepare

                case = prepare(case)
                if not quiet:
                    warn(case.reach_warnings())
                shown = progress_line(shown=not quiet)
            else:
                shown = _saved_steps(output, shown=not quiet)
            folder = locked.enter_context(alone_in(output, locks=[RESULT_LOCK]))
            with shown as progress:
                outcome = by_kind.RUNS[kind].run(case, folder, progress, solver=solver, measured=data)
        tables = _tables if kind == "contact" else _transient_tables
        print_and_draw(outcome, tables, folder, look if plots else None, quiet=quiet, as_json=as_json)


def print_and_draw(
    outcome: RunOutcome[Any],
    tables: Tables,
    folder: Path,
    look: Look | None,
    *,
    quiet: bool,
    as_json: bool,
) -> None:
    """Print the answer of a run, and then draw its figures with their formats and style, or none.

    They are also drawn where the reader of the answer leaves, as in ``ehlectric run FILE | head``.
    """
    drawn = Drawn(())
    try:
        print_answer(outcome, tables, quiet=quiet, as_json=as_json)
    finally:
        if look is not None:
            from ehlectric.runs.by_kind import draw_outcome

            with user_errors(), progress_line(shown=not quiet) as progress:
                drawn = draw_outcome(outcome, folder, progress, **look)
    if not quiet:
        if drawn.files and not as_json:
            echo_files(drawn.files)
        warn(drawn.warnings)
    refuse_failure(outcome, drawn.undrawn)


def _tables(outcome: RunOutcome[Result | PointResult]) -> Iterator[Table]:
    """Tables of a stationary contact: its rough surfaces and its key figures."""
    from ehlectric.tables.contact_tables import result_rows
    from ehlectric.tables.measured_tables import measured_tables, table_of
    from ehlectric.tables.surface_tables import surface_table

    for rough in outcome.result.rough:
        if rough["steps"]:
            yield surface_table(rough)
    yield table_of(result_rows(outcome.result), outcome.result.case.title)
    yield from measured_tables(outcome)


def _transient_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    from ehlectric.tables.measured_tables import table_of
    from ehlectric.tables.motion_tables import run_rows

    yield table_of(run_rows(outcome.summary), outcome.summary["title"])


@command("plot")
def plot(
    result: Path,
    output: Path | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
) -> None:
    """Draw the figures of a result again.

    The result of a contact, of moving roughness, of a bearing, of a gear pair, of a drive or of a sweep. A
    sweep over one or two keys is drawn as a map and lines, and a Sobol design as its sensitivity; for other
    sweeps use ehlectric map.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.commands.draw_commands import load_and_draw
        from ehlectric.runs.file_kinds import refuse_input
        from ehlectric.runs.result_folders import stored_result

        refuse_input(result)
        file = stored_result(result)
        drawn = load_and_draw(file, file.parent if output is None else output, **look)
    if not quiet:
        echo_files(drawn.files)
        warn(drawn.warnings)
    refuse_undrawn(drawn.undrawn)


# Designations that are understood in addition to the bearings of the library.
_SERIES = (
    "designations of these series are also understood, such as 6314-C3 or SKF NU 210 ECP,",
    "with elements that are estimated from load ratings: 60, 62, 63, 68, 69, 160, 618, 619",
    "(bores of 3 to 240 mm); 70, 72, 73, 79, 719 with A, AC, B or C; NU, NJ, NUP, N 2, 3, 4,",
    "10, 22, 23 (to 160 mm); QJ 2, 3, 10; 302, 303, 313, 320, 322, 323, 329, 330, 331, 332;",
    "NA, RNA 49, 59, 69; HK, NK, AXK; 511 to 514 (to 120 mm)",
)


@command("bearings")
def bearings(as_json: bool = False) -> None:
    """List the bearings of the library, which a bearing file uses as base = "NAME".

    Designations of the usual series, such as "6314-C3", "NU 210 ECP", "32208" or "HK 2020", are also
    understood; the elements of a bearing that is not in the list are estimated from its load ratings.

    The elements are their number, diameter and length. They are "published", or follow "by rule" from both
    load ratings, or are "assumed". C and C0 are the load ratings that a maker prints.
    """
    with user_errors():
        from ehlectric.cases.library.bearing_catalogue import bearing_catalogue
        from ehlectric.runs.lookups import bearings as library_bearings
        from ehlectric.tables.oil_tables import catalogue_tables

        catalogue = bearing_catalogue()
    if as_json:
        typer.echo(json.dumps(library_bearings(), indent=2))
        return
    for table in catalogue_tables(catalogue):
        print_table(table)
        say("")
    say('in a bearing file: base = "6208"; the sources of all values are in the guide')
    for line in _SERIES:
        say(line)


@command("bearing")
def bearing(
    bearing_file: Path,
    output: Path = Path("bearing"),
    contacts: str = "",
    measured: Path | None = None,
    background: str | None = None,
    uncertainty: str | None = None,
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Solve a whole rolling bearing; write summary.json, bearing.nc, tables as CSV and figures.

    With --measured, capacitances over the speed give the film factor that explains them: in measured.json,
    measured.csv and a figure. With the table [duty] in the file, duty.csv and a figure have the bearing over
    the time of a duty cycle.

    The folder then holds only this result: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, all files are still
    written; or memory ran out, or the process of a contact was killed four times.
    """
    with ExitStack() as locked:
        with user_errors():
            look = figure_options(formats, style)

            from ehlectric.runs import by_kind
            from ehlectric.runs.file_kinds import expect
            from ehlectric.runs.measured_film_factors import MeasuredFile
            from ehlectric.runtime.folders import RESULT_LOCK, alone_in

            case = by_kind.read_bearing(expect(bearing_file, "bearing"))
            data = MeasuredFile.of(measured, background, uncertainty)
            folder = locked.enter_context(alone_in(output, locks=[RESULT_LOCK]))
            with progress_bar(shown=not quiet) as progress:
                outcome = by_kind.run_bearing(case, folder, progress, contacts=contacts, measured=data)
        print_and_draw(
            outcome, _bearing_tables, folder, look if plots else None, quiet=quiet, as_json=as_json
        )


def _bearing_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a bearing: loads, films and totals."""
    from ehlectric.tables.bearing_tables import films_table, loads_table, total_rows
    from ehlectric.tables.measured_tables import measured_tables, table_of

    summary = outcome.summary
    yield loads_table(summary)
    yield films_table(summary)
    yield table_of(total_rows(summary), summary["title"])
    yield from measured_tables(outcome)


@command("drive")
def drive(
    drive_file: Path,
    output: Path = Path("drive"),
    contacts: str = "",
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Simulate inverter, motor and both bearings over time; write tables, drive.nc and figures.

    The files are summary.json, events.csv with the discharges, spectrum.csv with the amplitudes of the shaft
    voltage over the frequency, drive.nc for ehlectric plot, and figures of the bearing voltage, its spectrum,
    the discharges of each bearing with their voltage, charge, energy and current, and these figures for each
    remedy of the file. With the table [duty] in the file, duty.csv and a figure have the expected discharges
    over the time of a duty cycle.

    A file with tables [[shaft]] is an axle. Its files are summary.json, elements.csv and shafts.csv with the
    voltages of all bearings, gear meshes and shafts right after an edge, and figures. With drive.duration and
    the table [breakdown] the axle is also simulated over time: events.csv has the discharges, and a figure
    the voltages of the shafts.

    The folder then holds only this result: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, all files are still
    written; or memory ran out, or the process of a contact was killed four times.
    """
    solve_file(
        drive_file,
        {"drive": _drive_tables, "axle": _axle_tables},
        output,
        progress=progress_bar,
        run=_solver(contacts),
        plots=plots,
        formats=formats,
        style=style,
        quiet=quiet,
        as_json=as_json,
    )


def _solver(contacts: str) -> Callable[..., RunOutcome[Any]]:
    """Function that solves a case of a kind of files to a folder, with a way to find contacts."""

    def run(kind: FileKind, case: Any, folder: Path, progress: Progress) -> RunOutcome[Any]:
        from ehlectric.runs import by_kind

        return by_kind.RUNS[kind].run(case, folder, progress, contacts=contacts)

    return run


def solve_file(
    path: Path,
    tables: Mapping[FileKind, Tables],
    output: Path,
    *,
    progress: Callable[..., AbstractContextManager[Progress]],
    run: Callable[..., RunOutcome[Any]],
    plots: bool,
    formats: list[str] | None,
    style: str,
    quiet: bool,
    as_json: bool,
) -> None:
    """Solve a file whose kind ``tables`` contains, and print and draw its answer with the given options.

    ``run`` takes the kind of the file, its case, the folder and the progress, and returns the outcome.
    """
    with ExitStack() as locked:
        with user_errors():
            look = figure_options(formats, style)

            from ehlectric.runs import by_kind
            from ehlectric.runs.file_kinds import expect
            from ehlectric.runtime.folders import RESULT_LOCK, alone_in

            file = expect(path, *tables)
            case = by_kind.RUNS[file.kind].read(file)
            folder = locked.enter_context(alone_in(output, locks=[RESULT_LOCK]))
            with progress(shown=not quiet) as shown:
                outcome = run(file.kind, case, folder, shown)
        print_and_draw(
            outcome, tables[file.kind], folder, look if plots else None, quiet=quiet, as_json=as_json
        )


def _drive_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a drive: its simulation, both bearings side by side, and its remedies."""
    from ehlectric.tables.drive_tables import ends_table, remedies_table, whole_rows
    from ehlectric.tables.measured_tables import table_of

    yield table_of(whole_rows(outcome.summary))
    yield ends_table(outcome.summary)
    if outcome.summary["remedies"]:
        yield remedies_table(outcome.summary)


def _axle_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of an axle: its bearings and meshes, and its shafts."""
    from ehlectric.tables.axle_tables import (
        chance_rows,
        chances_table,
        duty_table,
        elements_table,
        remedied_simulation_table,
        remedies_table,
        shafts_table,
        simulation_table,
    )
    from ehlectric.tables.measured_tables import table_of

    yield elements_table(outcome.summary)
    yield shafts_table(outcome.summary)
    if "simulation" in outcome.summary:
        yield simulation_table(outcome.summary)
    if "duty" in outcome.summary:
        yield duty_table(outcome.summary)
    if "uncertainty" in outcome.summary:
        yield chances_table(outcome.summary)
        yield table_of(chance_rows(outcome.summary))
    if outcome.summary["remedies"]:
        yield remedies_table(outcome.summary)
        if "simulation" in outcome.summary:
            yield remedied_simulation_table(outcome.summary)


@command("gear")
def gear(
    gear_file: Path,
    output: Path = Path("gear"),
    contacts: str = "",
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Solve a pair of cylindrical gears; write summary.json, tables as CSV, gear.nc and figures.

    The files are summary.json, path.csv with radii, speeds, loads and films at the points A to E of the path
    of contact, mesh.csv with capacitance and breakdown voltage over the phase of the mesh, gear.nc for
    ehlectric plot, and figures.

    The folder then holds only this result: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong.
    """
    solve_file(
        gear_file,
        {"gear": _gear_tables},
        output,
        progress=progress_line,
        run=_solver(contacts),
        plots=plots,
        formats=formats,
        style=style,
        quiet=quiet,
        as_json=as_json,
    )


def _gear_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a gear pair: points of the path of contact, and key figures."""
    from ehlectric.tables.gear_tables import gear_rows, points_table
    from ehlectric.tables.measured_tables import table_of

    yield points_table(outcome.summary)
    yield table_of(gear_rows(outcome.summary), outcome.summary["title"])
