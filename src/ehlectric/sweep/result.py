"""Results of a sweep: values of its points as columns, a dataset, CSV, NetCDF and Parquet."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, ClassVar

import numpy as np
import tomli

from ehlectric.arrays import Array
from ehlectric.cases.input_keys import kind_of, of_both_ends, unit_of
from ehlectric.cases.table import nearest
from ehlectric.errors import InputError
from ehlectric.quantities.former_keys import current_key
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import TEXTS_OF_POINTS, is_text_of_points
from ehlectric.quantities.sheets import SWEEP_COLUMNS
from ehlectric.quantities.units import ROTATION
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import file_texts
from ehlectric.runtime.display import ResultKind, Shown, headline, is_number, read_only
from ehlectric.runtime.files import Content, column_head, csv_of, write_together
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.netcdf import content_of
from ehlectric.runtime.result_names import OF_SWEEPS, SWEEP_CSV, SWEEP_NETCDF, SWEEP_PARQUET
from ehlectric.sweep.axis_labels import label_of, result_keys
from ehlectric.sweep.points import Point, Range, Spacing, Status, SweepPoints, as_number, flat, kinds_of
from ehlectric.sweep.verdict_rule import sweep_verdict
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def columns_of(results: SweepPoints) -> dict[str, list[Any]]:
    """Columns of the table of a sweep, with one row for each point.

    Returns columns by name; first are number, status, reason, warnings, warning_codes and seconds; several
    warnings of a point are joined by "; ". The varied inputs and the results follow by dotted key, in SI
    units. A result is None if the point is not solved, or its summary has no such value. An input that the
    summary repeats has a column only if it differs between points. A value of the summary with the key of a
    varied input, such as a film factor, has no column of its own.
    """
    points = results.points
    columns: dict[str, list[Any]] = {
        "number": [point.number for point in points],
        "status": [point.status for point in points],
        "reason": [point.reason for point in points],
        "warnings": ["; ".join(map(str, point.warnings)) for point in points],
        "warning_codes": ["; ".join(warning.code for warning in point.warnings) for point in points],
        "seconds": [point.seconds for point in points],
    }
    columns |= {key: [point.inputs[key] for point in points] for key in results.varied}
    columns |= {key: file_texts(values) for key, values in columns.items() if key.endswith(".file")}
    summaries = texts_of(results) | numbers_of(results)
    return columns | {key: values for key, values in summaries.items() if key not in columns}


def texts_of(results: SweepPoints) -> dict[str, list[str | None]]:
    """Texts of the summaries of bearings, gears and axles by dotted key, each a list over the points."""
    known = [key for key in results.columns if is_text_of_points(key)]
    return {key: results.columns[key] for key in [*TEXTS_OF_POINTS, *known] if key in results.columns}


def numbers_of(results: SweepPoints) -> dict[str, list[float | None]]:
    """Numbers of the summaries by dotted key, each a list over the points, None if a point has none.

    An input that the summaries repeat is kept only if it differs between points and is not a varied key. An
    example is a viscosity that follows from a varied temperature.
    """
    varied = {f"inputs.{key}" for key in results.varied for key in of_both_ends(key)}
    return {
        key: values
        for key, values in results.numbers.items()
        if not key.startswith("inputs.") or (key not in varied and len({*values} - {None}) > 1)
    }


def _written(key: str, value: Any) -> Any:
    """Value as a file has it: a rotational speed without a unit is refused there."""
    return f"{value!r} {ROTATION}" if unit_of(key) == ROTATION and is_number(value) else value


def dataset_of(results: SweepPoints) -> xr.Dataset:
    """Convert a sweep to a dataset in SI units. Returns dataset over the varied keys for a "grid" design,
    else over ``point``.
    """
    import xarray as xr

    gridded = results.design == "grid"
    dimensions = results.varied if gridded else ("point",)
    shape = tuple(len(axis) for axis in results.axes.values()) if gridded else (len(results.points),)

    def laid_out(values: list[Any]) -> tuple[tuple[str, ...], Any]:
        return dimensions, array_of(values).reshape(shape)

    columns = columns_of(results)
    about = {name: (*laid_out(columns.pop(name)), attributes) for name, attributes in SWEEP_COLUMNS.items()}
    inputs = {key: columns.pop(key) for key in results.varied}
    coordinates = {
        key: (
            key if gridded else "point",
            array_of(list(results.axes[key] if gridded else values)),
            _attributes(key, results),
        )
        for key, values in inputs.items()
    }
    summaries = {
        key: (
            dimensions,
            (array_of(values) if is_text_of_points(key) else np.array(values, dtype=float)).reshape(shape),
            _attributes(key, results),
        )
        for key, values in columns.items()
    }
    return xr.Dataset(
        about | summaries,
        coords=coordinates,
        attrs={
            "Conventions": "CF-1.11",
            "title": results.title or results.case.title or "Sweep of a lubricated contact",
            "source": f"ehlectric {__version__}",
            "comment": "SI units; NaN where a point is not solved; see warnings before a value is used",
            "case": results.case.described_toml(),
            "design": results.design,
            "ranges": json.dumps({key: vars(over) for key, over in results.ranges.items()}),
            "samples": results.samples,
            "seed": results.seed,
            "uncertainty_samples": results.uncertainty_samples,
        },
    )


_NUMBERS = frozenset({int, float})


def array_of(values: list[Any]) -> Any:
    """Values as an array of numbers, or of texts if some are not numbers; lists become JSON texts."""
    if kinds_of(values) <= _NUMBERS:
        return np.array(values)
    return np.array([cell(value) for value in values], dtype=object)


def cell(value: Any) -> Any:
    """Text of a value in a CSV file: None as an empty text, a float with all digits, lists as JSON."""
    if value is None or isinstance(value, str):
        return value or ""
    return repr(value) if isinstance(value, float) else json.dumps(value)


def _attributes(key: str, results: SweepPoints) -> dict[str, str]:
    """CF attributes of an input or result: its name and, if it is a number, its unit."""
    return label_of(key, results.case).attributes(number=not _has_texts(key, results))


def _has_texts(key: str, results: SweepPoints) -> bool:
    """Whether an input or result is a text."""
    return is_text_of_points(key) or (key in results.varied and kind_of(key) is None)


def unit_of_column(results: SweepPoints, key: str) -> str | None:
    """SI unit of a column of numbers, empty for a dimensionless one; None for texts and for point numbers."""
    if key in SWEEP_COLUMNS:
        return "s" if key == "seconds" else None
    if _has_texts(key, results):
        return None
    return label_of(key, results.case).unit


__all__ = ["Point", "Range", "Spacing", "Status", "SweepResults", "as_number", "flat", "write_tables"]


@dataclass(frozen=True, eq=False, repr=False)
class SweepResults(Shown, SweepPoints):
    """Results of a sweep, complete or still in progress.

    Attributes
    ----------
    case : Case, BearingCase, DriveCase, AxleCase or GearCase
        Base case of the sweep.
    design : str
        "grid", "paired" or "sobol".
    axes : mapping
        Values of each varied key in the order of the input, in SI units; empty for a "sobol" design.
    ranges : mapping
        Range of each varied key of a "sobol" design, in the order of the input; empty for other designs.
    samples : int
        Base samples n of a "sobol" design; 0 for other designs.
    points : tuple of Point
        All points in the order of the design; in a "grid" the last varied key varies fastest.
    seed : int
        Seed of the random numbers of a "sobol" design.
    title : str
        Title of the sweep, for figures.
    uncertainty_samples : int
        Samples of the probability of breakdown at each point; 0 where it is not computed.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> vary = {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]}
    >>> sweep = ehlectric.Sweep.from_dict({"case": case.replace(contacts="atlas"), "vary": vary})
    >>> with TemporaryDirectory() as folder:
    ...     results = ehlectric.run_sweep(sweep, folder, workers=1)
    >>> slow, fast = results.numbers["bearing.capacitance"]
    >>> slow > fast
    True
    """

    result_kind: ClassVar[ResultKind] = "sweep"

    def values(self, key: str) -> Array:
        """Return the value of a key of the summary at every point.

        Parameters
        ----------
        key : str
            Dotted key of the summary, such as "discharge.breakdown_voltage".

        Returns
        -------
        ndarray, shape (points,)
            Values in SI units, doubtful points included; NaN where a point is not solved, or its summary has
            no number at this key. The array is read-only.

        Raises
        ------
        InputError
            If ``key`` is neither a varied key nor a key of the summary; the message has the nearest key.
        """
        if key in self.varied:
            return read_only(np.array([as_number(point.inputs.get(key)) for point in self.points]))
        key = current_key(key, result_keys(self.case))
        self._check(key)
        # None becomes NaN.
        return read_only(np.array(self.numbers.get(key, [None] * len(self.points)), dtype=float))

    @cached_property
    def verdict(self) -> Verdict | None:
        """Verdict: at how many points breakdown is expected; None where no point has a margin."""
        return sweep_verdict(self)

    def _check(self, key: str) -> None:
        """Raise an InputError for a key that no summary has and that is not documented."""
        if key in self.columns or key_of(result_keys(self.case), key) is not None:
            return
        known = list(numbers_of(self)) or list(result_keys(self.case))
        table = key.partition(".")[0] + "."
        alike = [name for name in known if name.startswith(key) or name.endswith(f".{key}")]
        within = [name for name in known if name.startswith(table)]
        raise InputError.unknown(key, alike[0] if alike else nearest(key, within or known))

    def summary(self) -> dict[str, Any]:
        """Return the number of points of each status, and the design of the sweep.

        Returns
        -------
        dict
            ``title``, ``design``, ``varied``, ``points`` (number of all points), the numbers of points that
            are ``solved``, ``not converged``, ``failed`` and ``open``, and the time ``seconds`` [s].
        """
        counts = Counter(point.status for point in self.points)
        states: tuple[Status, ...] = ("solved", "not converged", "failed", "open")
        return {
            "title": self.title or self.case.title,
            "design": self.design,
            "varied": list(self.varied),
            "points": len(self.points),
            **{status: counts[status] for status in states},
            "seconds": sum(point.seconds for point in self.points),
        }

    def to_toml(self) -> str:
        """Return the sweep as TOML text in SI units, from which ``Sweep.from_toml`` has the same points.
        Raises InputError for a case with laws of the user's own.
        """
        return self._toml(self.case.to_toml())

    def described_toml(self) -> str:
        """Return the TOML text of the sweep for a report; it names laws of the user's own."""
        return self._toml(self.case.described_toml())

    def _toml(self, case: str) -> str:
        import tomli_w

        table: dict[str, Any] = {"title": self.title, "design": self.design}
        if self.design == "sobol":
            table |= {"samples": self.samples, "seed": self.seed}
        if self.uncertainty_samples:
            table["uncertainty_samples"] = self.uncertainty_samples
        ranges = {
            key: {"from": _written(key, span.start), "to": _written(key, span.stop), "spacing": span.spacing}
            for key, span in self.ranges.items()
        }
        axes = {key: [_written(key, value) for value in values] for key, values in self.axes.items()}
        return tomli_w.dumps(table | {"case": tomli.loads(case), "vary": axes | ranges})

    def to_xarray(self) -> xr.Dataset:
        """Return inputs and results over the varied keys in a "grid" design, as in sweep.nc."""
        return dataset_of(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the points as a table of pandas, a row for each.

        Returns
        -------
        pandas.DataFrame
            Columns by dotted key as in sweep.csv, SI units; NaN where a point is not solved.
            ``attrs["units"]`` has the unit of each column of numbers.
        """
        import pandas as pd

        columns = columns_of(self)
        units = {key: unit_of_column(self, key) for key in columns}
        frame = pd.DataFrame(columns)
        frame.attrs["units"] = {key: unit for key, unit in units.items() if unit is not None}
        return frame

    def key_numbers(self) -> tuple[str | None, ...]:
        """Return the number of points, varied keys and states as texts."""
        counts = self.summary()
        others = [f"{counts[status]} {status}" for status in ("not converged", "failed", "open")]
        return (
            f"{self.design} of {len(self.points)} points over {', '.join(map(self._name, self.varied))}",
            f"{counts['solved']} solved",
            *(text for text in others if not text.startswith("0 ")),
        )

    def _headline(self) -> str:
        return headline(self.title or self.case.title, *self.key_numbers(), verdict=self.verdict)

    def _name(self, key: str) -> str:
        return label_of(key, self.case).name


CSV, PARQUET, NETCDF, FILES = SWEEP_CSV, SWEEP_PARQUET, SWEEP_NETCDF, OF_SWEEPS


def write_tables(results: SweepResults, folder: str | Path) -> list[Path]:
    """Write sweep.csv, sweep.nc and, if pyarrow is installed, sweep.parquet, all of them or none. ``folder``,
    output folder; created if it does not exist. Returns files written. Raises InputError if the folder cannot
    be written to, its disk is full, or another command writes into it.
    """
    columns = columns_of(results)
    rows = zip(*map(_cells, columns.values()), strict=True)
    contents: dict[str, Content] = {
        CSV: csv_of(_heads(results, columns), rows, ending="\n"),
        NETCDF: content_of(results.to_xarray()),
    }
    if find_spec("pyarrow") is not None:
        contents[PARQUET] = partial(_write_parquet, columns)
    with alone_in(folder, FILES, locks=[FIGURE_LOCK]) as folder:
        return write_together(folder, contents, FILES)


def _write_parquet(columns: Mapping[str, list[Any]], file: BinaryIO) -> None:
    import pyarrow
    from pyarrow import parquet

    # In memory: the library would close the file itself.
    sink = pyarrow.BufferOutputStream()
    parquet.write_table(pyarrow.table({key: _plain(column) for key, column in columns.items()}), sink)
    file.write(sink.getvalue())


def _cells(column: list[Any]) -> Iterable[Any]:
    """Values of a column for the cells of sweep.csv."""
    return column if kinds_of(column) <= _NUMBERS else map(_cell, column)


def _cell(value: Any) -> Any:
    """Value for a cell of sweep.csv."""
    # The writer of Python quotes no carriage return where lines end in line feeds; no title has one.
    if isinstance(value, str):
        return value.replace("\r", r"\r")
    return value if is_number(value) else cell(value)


def _heads(results: SweepResults, columns: Iterable[str]) -> list[str]:
    """Heads of sweep.csv: the dotted key of each column, and the unit of numbers in brackets."""
    units = {key: unit_of_column(results, key) for key in columns}
    return [key if unit is None else column_head(key, unit) for key, unit in units.items()]


def _plain(column: list[Any]) -> list[Any]:
    """Column with values of a single type, as Parquet needs."""
    kinds = kinds_of(column) - {type(None)}
    if not kinds <= _NUMBERS:
        return [None if value is None else cell(value) for value in column]
    if kinds == _NUMBERS:
        return [None if value is None else float(value) for value in column]
    return column
