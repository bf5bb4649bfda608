"""Files of a bearing's result: it is loaded as it was saved, and other files are refused."""

import csv
import dataclasses
import json

import numpy as np
import pytest
import xarray as xr

from ehlectric import InputError, load
from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.result import BearingResult, solve_bearing
from ehlectric.bearing.ring_contacts import ContactCurve
from ehlectric.bearing.run import CONTACTS, FILES, IMPEDANCE, NETCDF, SUMMARY, save
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.result_names import DUTY
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

# With a wide clearance some balls do not touch the inner ring.
UNLOADED = {"contacts": "formula", "bearing__radial_clearance": "30 um", "bearing__axial_load": 0.0}


@pytest.fixture(scope="module", params=[BALLS, ROLLERS], ids=["balls", "rollers"])
def result(request):
    changes = UNLOADED if request.param is BALLS else {"contacts": "formula"}
    return solve_bearing(bearing_case(request.param, **changes))


def equal(first, second):
    """Whether two values are the same, number by number, through data classes, tuples and arrays."""
    if isinstance(first, ContactCurve):
        # Contacts have all of its numbers, and the warnings, which are made when they are asked for.
        return type(first) is type(second) and equal(first.solutions, second.solutions)
    if dataclasses.is_dataclass(first):
        # Fields alone: results also keep what has once been computed from them.
        names = [field.name for field in dataclasses.fields(first)]
        return type(first) is type(second) and all(
            equal(getattr(first, name), getattr(second, name)) for name in names
        )
    if isinstance(first, dict):
        return first.keys() == second.keys() and all(equal(first[key], second[key]) for key in first)
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(equal, first, second))
    if isinstance(first, np.ndarray):
        return first.dtype == second.dtype and np.array_equal(first, second)
    return first == second


@pytest.mark.slow
def test_a_result_is_loaded_as_it_was_saved(result, tmp_path):
    """Every array of every position, the contacts that were solved, and what follows from them."""
    files = save(result, tmp_path)
    assert [file.name for file in files] == [SUMMARY, CONTACTS, IMPEDANCE, NETCDF]
    loaded = load(tmp_path / NETCDF)
    assert loaded.summary() == result.summary()
    assert equal(loaded.solution.curves, result.solution.curves)
    for mine, theirs in zip(loaded.solution.positions, result.solution.positions, strict=True):
        assert equal(mine.rings, theirs.rings)
        assert equal(mine.equilibrium.ring(inner=True), theirs.equilibrium.ring(inner=True))
    for mine, theirs in ((loaded.solution.inner, result.solution.inner),):
        assert (mine.angle, mine.speed, mine.inner) == (theirs.angle, theirs.speed, theirs.inner)
    mine, theirs = (impedance_of(one.solution) for one in (loaded, result))
    np.testing.assert_array_equal(mine.values, theirs.values)


@pytest.mark.slow
def test_the_other_files_are_the_summary_and_its_tables(result, tmp_path):
    save(result, tmp_path)
    summary = json.loads((tmp_path / SUMMARY).read_text(encoding="utf-8"), parse_constant=pytest.fail)
    assert summary == json.loads(json.dumps(result.summary()))
    with (tmp_path / CONTACTS).open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["load [N]"]) for row in rows] == [row["load"] for row in summary["contacts"]]
    angles = [float(row["contact_angle [rad]"]) for row in rows]
    assert angles == [row["contact_angle"] for row in summary["contacts"]]
    assert {"element", "ring", "solved", "lambda_ratio [-]"} <= set(rows[0])
    with (tmp_path / IMPEDANCE).open(newline="", encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    impedance = impedance_of(result.solution)
    np.testing.assert_allclose(
        [float(row["magnitude [ohm]"]) for row in lines], impedance.magnitude, rtol=1e-12
    )


def changed(result, **values):
    """The result with other values of its solution."""
    return BearingResult(dataclasses.replace(result.solution, **values))


@pytest.mark.slow
def test_what_is_not_known_stays_unknown(result, tmp_path):
    """A strength that is none, a Weibull shape, an error of one contact alone, and another version."""
    solution = result.solution
    curve = solution.inner_curve
    one = dataclasses.replace(
        curve.solutions[0],
        error=0.02,
        converged=False,
        warnings=(ResultWarning("regime", "a"), ResultWarning("tunnelling", "b")),
    )
    positions = tuple(dataclasses.replace(position, shape=8.0) for position in solution.positions)
    curve = ContactCurve.of((one, *curve.solutions[1:]))
    other = changed(result, inner_curve=curve, positions=positions, version="0.1", seconds=3.5)
    save(other, tmp_path)
    loaded = load(tmp_path / NETCDF)
    assert equal(loaded.solution.inner_curve, curve)
    assert {position.shape for position in loaded.solution.positions} == {8.0}
    assert not loaded.converged
    assert loaded.summary()["version"] == "0.1"
    assert loaded.summary() == other.summary()


@pytest.mark.slow
def test_a_bearing_without_strength_and_conductivity(tmp_path):
    """Infinite breakdown voltages are kept, and the impedance of an earlier result goes."""
    (tmp_path / IMPEDANCE).write_text("earlier", encoding="utf-8")
    result = solve_bearing(bearing_case(BALLS, contacts="formula", discharge=None))
    files = save(result, tmp_path)
    assert IMPEDANCE not in {file.name for file in files}
    assert {path.name for path in tmp_path.iterdir()} == {*FILES} - {IMPEDANCE, DUTY}
    loaded = load(tmp_path / NETCDF)
    assert np.all(loaded.solution.positions[0].inner.values.breakdown_voltage == np.inf)
    assert loaded.summary() == result.summary()


@pytest.mark.slow
def test_variables_have_units(result, tmp_path):
    save(result, tmp_path)
    with xr.open_dataset(tmp_path / NETCDF, engine="h5netcdf") as dataset:
        assert dataset["minimum_thickness"].dims == ("cage_position", "ring", "element")
        assert dataset["breakdown_voltage"].attrs["units"] == "V"
        assert dataset["inner_curve_inside"].attrs["units"] == "F"


@pytest.mark.slow
def test_what_is_no_result_of_a_bearing_is_refused(result, tmp_path):
    with pytest.raises(InputError, match=r"none\.nc: "):
        load(tmp_path / "none.nc")
    (tmp_path / "text.nc").write_text("text", encoding="utf-8")
    with pytest.raises(InputError, match=r"text\.nc: .*NetCDF"):
        load(tmp_path / "text.nc")
    save(result, tmp_path)
    with xr.open_dataset(tmp_path / NETCDF, engine="h5netcdf") as file:
        dataset = file.load()
    for name, broken, message in (
        ("other.nc", dataset.assign_attrs(schema="ehlectric.bearing.solution/0"), "bearing"),
        ("less.nc", dataset.drop_vars("outside_oil"), "outside_oil"),
        ("case.nc", dataset.assign_attrs(case="bearing = 1"), "case"),
    ):
        broken.to_netcdf(tmp_path / name, engine="h5netcdf")
        with pytest.raises(InputError, match=rf"{name}: .*{message}"):
            load(tmp_path / name)
