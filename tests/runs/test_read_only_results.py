"""Arrays of results are read-only: of every kind, of loaded results, and of their pickles and copies."""

import copy
import pickle
from collections.abc import Mapping
from dataclasses import is_dataclass, replace

import numpy as np
import pytest

from ehlectric import BearingCase, Case, Sweep, load, run_motion, run_sweep, save, solve, solve_motion
from tests.helpers.cycles import HEADS, ROWS
from tests.helpers.drives import small_drive
from tests.helpers.moving_cases import TABLES, moving
from tests.helpers.places import EXAMPLES

LINE, BALL = (
    {"contact": TABLES[geometry]["contact"], "lubricant": {"base": "paper"}, "grid": {"nodes": nodes}}
    for geometry, nodes in (("line", 129), ("point", 65))
)
LINE |= {"discharge": {"dielectric_strength": "15 V/um"}}


def bearing():
    return BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})


def arrays_in(value, name, seen):
    """All arrays in an object, by their names: in attributes, mappings, lists and datasets."""
    if id(value) in seen:
        return
    seen.add(id(value))
    if isinstance(value, np.ndarray):
        yield name, value
    elif hasattr(value, "data_vars"):
        yield from ((f"{name}[{key}]", variable.values) for key, variable in value.variables.items())
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from arrays_in(item, f"{name}[{key}]", seen)
    elif isinstance(value, list | tuple):
        for place, item in enumerate(value):
            yield from arrays_in(item, f"{name}[{place}]", seen)
    elif is_dataclass(value):
        for key, item in vars(value).items():
            yield from arrays_in(item, f"{name}.{key}", seen)


def writeable(result):
    """Names of the arrays of a result that can be written to."""
    found = dict(arrays_in(result, "", set()))
    assert found
    return [name for name, array in found.items() if array.flags.writeable]


def compute(result):
    """Compute all properties of a result, which keeps them."""
    for name in dir(type(result)):
        if not name.startswith("_") and not callable(getattr(type(result), name)):
            getattr(result, name)


def check(result, folder=None):
    compute(result)
    kept = [result, pickle.loads(pickle.dumps(result)), copy.deepcopy(result), replace(result)]
    if folder is not None:
        save(result, folder)
        kept.append(load(folder))
    for one in kept:
        assert writeable(one) == []


@pytest.mark.parametrize("table", [LINE, BALL])
def test_contacts(tmp_path, table):
    result = solve(Case.from_dict(table))
    check(result, tmp_path)
    before = result.film.pressure.copy()
    with pytest.raises(ValueError, match="read-only"):
        result.film.pressure[:] = 0.0
    assert np.array_equal(result.film.pressure, before)
    with pytest.raises(ValueError, match="read-only"):
        pickle.loads(pickle.dumps(result.film)).pressure[:] = 0.0


@pytest.mark.slow
def test_bearings_with_duty_cycle(tmp_path):
    file = tmp_path / "cycle.csv"
    file.write_text(f"{HEADS}\n{ROWS}")
    result = solve(bearing().replace({"duty.file": str(file)}))
    assert result.duty is not None
    check(result, tmp_path / "saved")


@pytest.mark.slow
def test_drives(tmp_path):
    check(solve(small_drive()), tmp_path)


@pytest.mark.slow
def test_moving_roughness(tmp_path):
    check(solve_motion(moving()))
    run_motion(moving(), tmp_path)
    check(load(tmp_path))


def test_sweeps(tmp_path):
    speeds = ["1000 rpm", "3000 rpm"]
    sweep = Sweep.from_dict({"case": bearing(), "vary": {"bearing.inner_speed": speeds}})
    result = run_sweep(sweep, tmp_path, workers=1)
    for key in ("bearing.inner_speed", "bearing.capacitance"):
        with pytest.raises(ValueError, match="read-only"):
            result.values(key)[0] = 0.0
    assert writeable(pickle.loads(pickle.dumps(result))) == []
