"""Tables of a sweep: CSV, Parquet, NetCDF and SQLite say the same."""

import csv
import dataclasses
import json
import math
import sqlite3

import numpy as np
import pytest
import xarray as xr
from pyarrow import parquet

from ehlectric import read_sweep
from ehlectric.sweep.engine import Outcome, plan, solve_point
from ehlectric.sweep.points import flat
from ehlectric.sweep.result import columns_of, write_tables
from ehlectric.sweep.result import dataset_of as to_xarray
from ehlectric.sweep.store import NAME, Store
from tests.helpers.sweeps import LOAD, NODES, PRESSURE, SPEED, sweep_over

THICKNESS = "film.minimum_thickness"


@pytest.fixture(scope="module")
def gridded(tmp_path_factory):
    """2 x 3 x 2 points with two refused, one failed, one not converged and one open; and their folder."""
    folder = tmp_path_factory.mktemp("sweep")
    vary = {SPEED: [1.0, 2.0], NODES: [65, 129, 257], "grid.field_range": [[-0.5, 0.5], [-1.25, 1.25]]}
    sweep = sweep_over(vary | {"contact.slide_to_roll_ratio": [0.0]})
    planned = list(plan(sweep))
    with Store(folder) as store:
        store.begin(sweep, planned)
        for point in planned[:-1]:
            if point.key is not None:
                outcome = solve_point(sweep.case.replace(point.inputs).to_dict())
                if point.number == 1:
                    outcome = Outcome("failed", 'not solved: , "so"\tto say')
                if point.number == 3:
                    outcome = Outcome("not converged", "no", summary=outcome.summary)
                store.write([(point.key, outcome)])
    results = read_sweep(folder)
    write_tables(results, folder)
    return folder, results


def rows_of(folder):
    with (folder / "sweep.csv").open(encoding="utf-8", newline="") as file:
        return [{key.partition(" [")[0]: value for key, value in row.items()} for row in csv.DictReader(file)]


@pytest.mark.slow
def test_heads_of_the_csv_have_units(gridded):
    folder, results = gridded
    heads = (folder / "sweep.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
    assert heads[:6] == ["number", "status", "reason", "warnings", "warning_codes", "seconds [s]"]
    assert {f"{SPEED} [m/s]", f"{NODES} [-]", "grid.field_range", "film.max_pressure [Pa]"} <= set(heads)
    assert {"film.discretisation_error [-]", "field.capacitance_per_length [F/m]"} <= set(heads)
    frame = results.to_dataframe()
    assert [head.partition(" [")[0] for head in heads] == list(frame)
    assert frame.attrs["units"]["film.max_pressure"] == "Pa"
    assert "grid.field_range" not in frame.attrs["units"]
    np.testing.assert_array_equal(frame[THICKNESS].to_numpy(dtype=float), results.values(THICKNESS))


@pytest.mark.slow
@pytest.mark.gate
def test_the_csv_is_the_database(gridded):
    folder, _ = gridded
    with sqlite3.connect(folder / NAME) as file:
        found = file.execute(
            "SELECT number, inputs, refused, status, reason, summary "
            "FROM points LEFT JOIN results USING (key) ORDER BY number"
        ).fetchall()
    file.close()
    rows = rows_of(folder)
    assert len(rows) == len(found) == 12
    compared = 0
    for row, (number, inputs, refused, status, reason, summary) in zip(rows, found, strict=True):
        assert int(row["number"]) == number
        assert row["status"] == ("failed" if refused else status or "open")
        assert row["reason"] == (refused or reason or "")
        for key in ("warnings", "warning_codes"):
            assert row[key] == "; ".join(json.loads(summary)[key] if summary else [])
        varied = json.loads(inputs)
        assert [row[key] for key in varied] == [json.dumps(value) for value in varied.values()]
        numbers = flat(json.loads(summary)) if status == "solved" else {}
        for key in list(row)[6 + len(varied) :]:
            expected = numbers.get(key)
            assert row[key] == ("" if expected is None else repr(expected))
            compared += row[key] != ""
    kinds = [row["status"] for row in rows]
    # 65 nodes hold too few columns of the narrow field.
    assert [number for number, *_, refused, _, _, _ in found if refused] == [0, 6]
    assert (kinds[1], kinds[3], kinds[11]) == ("failed", "not converged", "open")
    assert kinds.count("solved") > 5
    assert compared > 5 * 20
    # 65 nodes make a film that is not to be used.
    assert any(row["status"] == "solved" and "do not use" in row["warnings"] for row in rows)


def test_parquet_is_the_csv(gridded):
    folder, _ = gridded
    table, rows = parquet.read_table(folder / "sweep.parquet").to_pydict(), rows_of(folder)
    assert list(table) == list(rows[0])
    for key, column in table.items():
        for row, value in zip(rows, column, strict=True):
            assert row[key] == ("" if value is None else str(value))
    assert {type(value) for value in table[THICKNESS]} == {float, type(None)}
    assert {type(value) for value in table[NODES]} == {int}


@pytest.mark.slow
@pytest.mark.gate
def test_the_netcdf_is_the_csv(gridded):
    folder, results = gridded
    with xr.open_dataset(folder / "sweep.nc") as file:
        dataset = file.load()
    assert dict(dataset.sizes) == {key: len(axis) for key, axis in results.axes.items()}
    for row in rows_of(folder):
        at = {key: float(row[key]) for key in (SPEED, NODES)}
        at |= {"grid.field_range": row["grid.field_range"], "contact.slide_to_roll_ratio": 0.0}
        point = dataset.sel(at)
        assert point["status"].item() == row["status"]
        assert point["reason"].item() == row["reason"]
        assert point["warnings"].item() == row["warnings"]
        assert point["warning_codes"].item() == row["warning_codes"]
        assert int(point["number"]) == int(row["number"])
        for key in dataset.data_vars:
            if key not in ("status", "reason", "warnings", "warning_codes", "number"):
                value = float(row[key]) if row[key] else math.nan
                np.testing.assert_equal(float(point[key]), value)
    assert dataset[SPEED].attrs["units"] == "m/s"
    assert "units" not in dataset["grid.field_range"].attrs
    assert all(dataset[key].attrs["long_name"] for key in dataset.variables)
    units = {key: dataset[key].attrs.get("units") for key in dataset.data_vars}
    assert [key for key, unit in units.items() if unit is None] == [
        "status",
        "reason",
        "warnings",
        "warning_codes",
    ]
    assert units[THICKNESS] == "m"
    assert units["field.capacitance_per_length"] == "F/m"
    assert units["film.newton_iterations"] == "1"
    assert dataset[THICKNESS].attrs["long_name"] == "minimum film thickness"
    assert dataset[NODES].dtype.kind == "i"
    assert dataset.attrs["design"] == "grid"


def test_inputs_that_stay_are_left_out_and_resolved_ones_kept(tmp_path):
    """A load that the varied Hertz pressure gives belongs to the results."""
    sweep = sweep_over({PRESSURE: [0.5e9, 1e9], SPEED: [2.0, 2.0]}, design="paired")
    planned = list(plan(sweep))
    with Store(tmp_path) as store:
        store.begin(sweep, planned)
        store.write([(p.key, solve_point(sweep.case.replace(p.inputs).to_dict())) for p in planned])
    columns = columns_of(read_sweep(tmp_path))
    assert [key for key in columns if key.startswith("inputs.")] == [f"inputs.{LOAD}"]
    # p_h = 2 w/(pi b) with b = sqrt(8 w R/(pi E')) gives w = 2 pi p_h^2 R/E'.
    expected = [2.0 * math.pi * p**2 * 0.0141 / 226e9 for p in (0.5e9, 1e9)]
    assert columns[f"inputs.{LOAD}"] == pytest.approx(expected, rel=1e-12)
    dataset = to_xarray(dataclasses.replace(read_sweep(tmp_path), title="A sweep of its own"))
    assert dataset.attrs["title"] == "A sweep of its own"
    assert dataset[THICKNESS].dims == ("point",)
    assert dataset[PRESSURE].attrs["units"] == "Pa"
    assert dataset[PRESSURE].values.tolist() == [0.5e9, 1e9]


@pytest.mark.slow
@pytest.mark.gate
def test_tables_of_an_earlier_sweep_are_replaced_whole(gridded, tmp_path):
    _, results = gridded
    for name in ("sweep.csv", "sweep.parquet", "sweep.nc"):
        (tmp_path / name).write_text("old")
    files = write_tables(results, tmp_path)
    assert sorted(path.name for path in files) == sorted(path.name for path in tmp_path.iterdir())
    assert not any(path.read_bytes() == b"old" for path in files)


def test_a_sweep_that_found_nothing_has_tables_too(tmp_path):
    sweep = sweep_over({SPEED: [1.0, 2.0]})
    with Store(tmp_path) as store:
        store.begin(sweep, plan(sweep))
    write_tables(read_sweep(tmp_path), tmp_path)
    assert [row["status"] for row in rows_of(tmp_path)] == ["open", "open"]
    with xr.open_dataset(tmp_path / "sweep.nc") as file:
        assert file["status"].values.tolist() == ["open", "open"]
    assert parquet.read_table(tmp_path / "sweep.parquet").num_rows == 2
