"""Tables of a sweep: CSV, NetCDF (gridded for a grid design) and, if pyarrow is installed, Parquet."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any, BinaryIO

from ehlectric.runtime.files import Content, write_together
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.netcdf import content_of
from ehlectric.runtime.tables import column_head, csv_of
from ehlectric.runtime.values import is_number
from ehlectric.sweep.columns import cell, columns_of, unit_of_column
from ehlectric.sweep.results import SweepResults

CSV = "sweep.csv"
PARQUET = "sweep.parquet"
NETCDF = "sweep.nc"
FILES = (CSV, PARQUET, NETCDF)


def write_tables(results: SweepResults, folder: str | Path) -> list[Path]:
    """Write sweep.csv, sweep.nc and, if pyarrow is installed, sweep.parquet, all of them or none.

    Parameters
    ----------
    results : SweepResults
        A sweep, finished or not.
    folder : str or Path
        Output folder; created if it does not exist.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If the folder cannot be written to, its disk is full, or another command writes into it.
    """
    columns = columns_of(results)
    rows = zip(*(map(_cell, column) for column in columns.values()), strict=True)
    contents: dict[str, Content] = {
        CSV: csv_of(_heads(results, columns), rows, ending="\n"),
        NETCDF: content_of(results.to_xarray()),
    }
    if find_spec("pyarrow") is not None:
        contents[PARQUET] = partial(_write_parquet, columns)
    with alone_in(folder, FILES, locks=[FIGURE_LOCK]) as folder:
        return write_together(folder, contents, FILES)


def _write_parquet(columns: Mapping[str, list[Any]], file: BinaryIO) -> None:
    """Write columns as Parquet."""
    import pyarrow
    from pyarrow import parquet

    # In memory: the library would close the file itself.
    sink = pyarrow.BufferOutputStream()
    parquet.write_table(pyarrow.table({key: _plain(column) for key, column in columns.items()}), sink)
    file.write(sink.getvalue())


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
    texts = any(isinstance(value, str | list | bool) for value in column)
    if texts:
        return [None if value is None else cell(value) for value in column]
    if any(isinstance(value, float) for value in column):
        return [None if value is None else float(value) for value in column]
    return column
