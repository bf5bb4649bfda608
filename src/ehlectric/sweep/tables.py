"""Tables of a sweep: CSV, NetCDF (gridded for a grid design) and, if pyarrow is installed, Parquet."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ehlectric.runtime.files import clear, prepare, whole
from ehlectric.runtime.tables import column_head, csv_text
from ehlectric.sweep.columns import cell, columns_of, unit_of_column
from ehlectric.sweep.results import SweepResults

CSV = "sweep.csv"
PARQUET = "sweep.parquet"
NETCDF = "sweep.nc"
FILES = (CSV, PARQUET, NETCDF)


def write_tables(results: SweepResults, folder: str | Path) -> list[Path]:
    """Write sweep.csv, sweep.nc and, if pyarrow is installed, sweep.parquet.

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
        If the folder cannot be written to.
    """
    folder = prepare(folder, FILES)
    columns = columns_of(results)
    clear(folder, FILES)
    files = [folder / CSV, folder / NETCDF]
    # Names of files in reasons may hold bytes that are no text in UTF-8; they are escaped.
    code: dict[str, Any] = {"encoding": "utf-8", "errors": "backslashreplace", "newline": ""}
    with whole(files[0]) as path, path.open("w", **code) as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_heads(results, columns))
        writer.writerows(zip(*(map(_cell, column) for column in columns.values()), strict=True))
    with whole(files[1]) as path:
        results.to_xarray().to_netcdf(path, engine="h5netcdf")
    if find_spec("pyarrow") is not None:
        import pyarrow
        from pyarrow import parquet

        files.append(folder / PARQUET)
        with whole(files[-1]) as path:
            parquet.write_table(pyarrow.table({key: _plain(column) for key, column in columns.items()}), path)
    return files


def _cell(value: Any) -> Any:
    """Value for a cell of sweep.csv; a text is no formula for a spreadsheet."""
    # The writer of Python quotes no carriage return where lines end in line feeds; no title has one.
    return csv_text(value.replace("\r", r"\r")) if isinstance(value, str) else cell(value)


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
