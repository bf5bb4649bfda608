"""Result of a drive, as ``solve_drive`` returns it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ehlectric.cases.drive_case import DriveCase, within_remedy
from ehlectric.drive.drive_cycle import DriveDuty, run_drive_cycle
from ehlectric.drive.drive_record import DriveSolution, event_rows
from ehlectric.drive.stored import dataset_of
from ehlectric.drive.summary import drive_summary, whole_summary, with_cycle
from ehlectric.drive.verdict_rule import drive_verdict
from ehlectric.drive.warnings import drive_warnings, unused_keys
from ehlectric.quantities.former_keys import warning_tables
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import DRIVE_KEYS, EVENT_COLUMNS, NAMES_OF_ENDS, SPECTRUM_COLUMNS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.runtime.display import ResultKind, Shown, headline
from ehlectric.runtime.progress import Progress, silent
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@dataclass(frozen=True, eq=False, repr=False)
class DriveResult(Shown):
    """Result of a drive: what happened over time, its summary, and its remedies.

    Attributes
    ----------
    solution : DriveSolution
        Bearings and record.
    remedies : tuple of (str, dict, DriveSolution)
        Title, changes and solution of each remedy.
    duty : DriveDuty, optional
        Expected discharges over the duty cycle of the case.
    remedy_duties : tuple of DriveDuty
        Expected discharges over the duty cycle with each remedy; empty without a duty cycle.
    seconds : float
        Computing time [s].
    version : str
        Version of ehlectric that solved it.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.DriveCase.from_toml(ehlectric.example("drive.toml"))
    >>> case = case.replace({"drive.duration": "1 ms"}, remedies=[])
    >>> result = ehlectric.solve_drive(case)
    >>> result.summary()["drive_end"]["events"] > 0
    True
    """

    result_kind: ClassVar[ResultKind] = "drive"

    solution: DriveSolution
    remedies: tuple[tuple[str, dict[str, Any], DriveSolution], ...] = ()
    duty: DriveDuty | None = None
    seconds: float = field(default=0.0, compare=False)
    version: str = __version__
    remedy_duties: tuple[DriveDuty, ...] = ()

    @property
    def case(self) -> DriveCase:
        """Case of the drive that was solved."""
        return self.solution.case

    @property
    def converged(self) -> bool:
        """Whether the films of both bearings are converged."""
        return self.solution.converged

    @cached_property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about where the result is unreliable, each once."""
        of_cycle = () if self.duty is None else self.duty.warnings
        return (*drive_warnings(self.solution), *unused_keys(self.case), *of_cycle)

    @cached_property
    def verdict(self) -> Verdict:
        """Answer, as sentences and as a colour."""
        summary = {"converged": self.converged, **drive_summary(self.solution)}
        return drive_verdict(self.case, summary, self.warnings)

    def summary(self) -> dict[str, Any]:
        """Return the results nested as in summary.json, SI units; None instead of NaN."""
        remedies = [(variant.title, variant.changes, variant.tables) for variant in self.variants]
        summary = whole_summary(self.solution, remedies, self.warnings, self.seconds, self.version)
        summary = summary if self.duty is None else with_cycle(summary, self.duty)
        return warning_tables(summary, DRIVE_KEYS)

    @property
    def variants(self) -> tuple[Variant, ...]:
        """Remedies with what they change, in the order of the case."""
        duties = self.remedy_duties or (None,) * len(self.remedies)
        return tuple(
            Variant(title, changes, DriveResult(solution, duty=duty))
            for (title, changes, solution), duty in zip(self.remedies, duties, strict=True)
        )

    def events(self) -> list[dict[str, Any]]:
        """Table of discharges in the order of time, SI units; the first 200 000 of them.

        ``voltage`` and ``charge`` have the sign of the shaft against the housing.
        """
        return event_rows(self.solution.record, "bearing", ENDS)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the discharges as a table of pandas; ``attrs["units"]`` contains the units of columns."""
        import pandas as pd

        frame = pd.DataFrame(self.events(), columns=["bearing", *EVENT_COLUMNS])
        frame.attrs["units"] = dict(EVENT_COLUMNS)
        return frame

    def spectrum(self) -> pd.DataFrame:
        """Return the one-sided amplitude spectrum of the shaft voltage, as in spectrum.csv.

        The shaft voltage is the voltage of the rotor against the frame, which is the voltage across the films
        of a bearing without a coating.

        Returns
        -------
        pandas.DataFrame
            Columns ``frequency`` [Hz] and ``shaft_voltage`` [V], a row for each line;
            ``attrs["units"]`` has the units. Without rows for a file of version 1.0, which has no spectrum.

        Notes
        -----
        The lines are at whole multiples of the resolution, which is one over the measured time. The highest
        one is at 10 MHz, or is line 200 000 where that is lower: at 200 kHz for a time of 1 s.

        Amplitudes are peak values: a sine of 1 V has a line of 1 V, and an rms voltage of 0.707 V. The line
        at 0 Hz is the absolute mean. By Parseval's equation the rms voltage is the root of the squared mean
        and half of the sum of all other squared amplitudes.

        The Fourier coefficients are integrals over the exact voltage between two switchings, with eight
        triangular means for each line, whose frequency response is divided out. A component above the highest
        frequency F is folded onto a line f as by sampling with 8 F; the component at 8 F - f has a weight of
        (f/(8 F - f))^2, at most 1/49.

        There is no window. Lines are sharp where the measured time is a whole number of periods of the
        source, such as the 50 periods of the fundamental without ``drive.duration``. Otherwise lines leak
        into their neighbours, as with most measured sources.
        """
        import pandas as pd

        amplitudes = self.solution.record.spectrum
        frequencies = np.arange(amplitudes.size) / self.solution.record.duration
        frame = pd.DataFrame(dict(zip(SPECTRUM_COLUMNS, (frequencies, amplitudes), strict=True)))
        frame.attrs["units"] = dict(SPECTRUM_COLUMNS)
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Return the dataset of the result, as drive.nc contains it; SI units."""
        duties = (self.duty, *self.remedy_duties)
        return dataset_of(self.solution, self.remedies, duties, self.seconds, self.version)

    def key_numbers(self) -> tuple[str | None, ...]:
        """Return the rates of both bearings and the state as texts."""
        tables = drive_summary(self.solution)
        rates = (
            f"{name} {readable(tables[end]['events_per_second'])} discharges/s"
            for end, name in NAMES_OF_ENDS.items()
        )
        return *rates, "converged" if self.converged else "NOT CONVERGED"

    def _headline(self) -> str:
        return headline(self.case.title, *self.key_numbers())


@dataclass(frozen=True)
class Variant:
    """Remedy of a drive: title, changes by dotted key, and the result of the changed drive."""

    title: str
    changes: dict[str, Any]
    result: DriveResult

    @property
    def tables(self) -> dict[str, Any]:
        """Tables of the changed drive, with its duty cycle if it has one; SI units."""
        tables, duty = drive_summary(self.result.solution), self.result.duty
        return tables if duty is None else with_cycle(tables, duty)


def _parts(report: Progress, number: int) -> Iterator[Progress]:
    """Yield the progress of each simulation as a part of the whole progress."""
    for part in range(number):

        def progress_of_part(done: int, of: int, text: str, part: int = part) -> None:
            report(round(100.0 * (part + done / of) / number), 100, text)

        yield progress_of_part


def solve_drive(
    case: DriveCase, *, progress: Progress | None = None, workers: int | None = None
) -> DriveResult:
    """Solve a drive: its bearings, the voltage across their films over time, and their discharges.

    The remedies of the case are solved as well, with the same random numbers. With a duty cycle, some of
    its rows are simulated, for the drive and for each remedy.

    Parameters
    ----------
    case : DriveCase
        Drive file.
    progress : callable, optional
        Called with the part that is done in percent, 100, and a text.
    workers : int, optional
        Number of processes that solve the contacts of the bearings; the number of cores if not given.

    Returns
    -------
    DriveResult
        Result with its summary, its table of events and its warnings.

    Raises
    ------
    InputError
        Where a bearing cannot be solved, or lacks a value that discharges need; where a remedy changes a
        key that does not exist; or where the duty cycle cannot be used.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.DriveCase.from_toml(ehlectric.example("drive.toml"))
    >>> case = case.replace({"drive.duration": "1 ms"}, remedies=[])
    >>> summary = ehlectric.solve_drive(case).summary()
    >>> summary["drive_end"]["peak_voltage"] > summary["drive_end"]["breakdown_voltage"]
    True
    """
    # Loads the compiler of the simulation, which stored results do not need.
    from ehlectric.drive.solver import solve

    start, report = time.perf_counter(), progress or silent
    # A mistake in a remedy is reported before the drive itself takes its time.
    variants = case.variants()
    parts = _parts(report, (1 + len(variants)) * (1 if case.duty is None else 2))
    solution = solve(case, next(parts), workers=workers)
    remedies = []
    for (number, remedy), variant in zip(case.numbered_remedies, variants, strict=True):
        with within_remedy(number):
            solved = solve(variant, next(parts), workers=workers)
        remedies.append((remedy.title, dict(remedy.changes), solved))
    duty, *others = _duties(
        [
            (0, case, solution),
            *(
                (number, variant, solved)
                for (number, _), variant, (*_, solved) in zip(
                    case.numbered_remedies, variants, remedies, strict=True
                )
            ),
        ],
        partial(solve, workers=workers),
        parts,
    )
    result = DriveResult(solution, tuple(remedies), duty, remedy_duties=tuple(filter(None, others)))
    return replace(result, seconds=time.perf_counter() - start)


def _duties(
    drives: Sequence[tuple[int, DriveCase, DriveSolution]],
    solve: Callable[[DriveCase], DriveSolution],
    parts: Iterator[Progress],
) -> Iterator[DriveDuty | None]:
    """Duty cycle of a drive with the number 0, and of each remedy with its number in the file; None without a
    cycle.
    """
    for number, case, solution in drives:
        if case.duty is None:
            yield None
            continue
        with within_remedy(number):
            yield run_drive_cycle(case, solution.highest_source, solve, next(parts))
