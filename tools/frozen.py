"""Freeze all numbers and texts of drives and axles, and compare them after a change that keeps them.

``python -m tools.frozen make FOLDER`` before the change, and ``python -m tools.frozen compare FOLDER`` after
it, on the same machine. Keys, texts, whole numbers and events must be equal, other numbers to 1e-10. A file
that is refused and a netlist that is not written fail ``make``. Names of parts may follow the folder.
"""

import argparse
import csv
import json
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from tests.helpers.full_cases import cases_of
from tests.helpers.input_effects import Answer
from tests.helpers.places import DATA, EXAMPLES
from typer.testing import CliRunner

import ehlectric
from ehlectric.axle.axle_discharges import simulate_axle
from ehlectric.commands.command_line import app
from ehlectric.errors import ConvergenceError, InputError

# Relative difference of two numbers that counts as none.
_EQUAL = 1e-10

# Values by which two runs of the same program differ, and lines with them.
_OF_RUNS = ("seconds", "version")
_LINE_OF_RUN = re.compile(r"ehlectric \d|\d s\b.*(computing|solved)|/tmp/|[Ss]aved|[Ww]rote|report")

_FOLDERS = re.compile(rf"{re.escape(tempfile.gettempdir())}/tmp\w+")
_NUMBER = re.compile(r"-?\d+\.?\d*(e[+-]?\d+)?")

# Table of arcs of an axle over time.
_ARC = {"arc_resistance": 10.0, "extinction_current": 0.01, "recovery_time": 1e-7, "weibull_shape": 5.0}
_TIMED = {
    "drive.duration": "2 ms",
    "breakdown": _ARC,
    "bearings.contact_resistance": 1.0,
    **{f"mesh.{number}.contact_resistance": 1.0 for number in (1, 2)},
}

# Files of the examples, and what of them is changed.
FILES: dict[str, dict[str, Any]] = {
    **{name: {} for name in ("drive", "drive_scope", "drive_measured", "duty_drive", "grounding_brush")},
    "e_axle": {},
    "duty_e_axle": {},
    "e_axle over time": _TIMED,
}

# Keys and values of the points that are evaluated.
_POINTS: dict[str, dict[str, Any]] = {
    "drive": {
        "drive.speed": np.geomspace(20.0, 600.0, 20),
        "drive_end.bearing.radial_load": np.geomspace(3000.0, 200.0, 20),
    },
    "e_axle": {
        "drive.torque": np.linspace(-60.0, 90.0, 20),
        "drive.speed": np.geomspace(40.0, 1500.0, 20),
    },
}


def _plain(values: object) -> Any:
    """Values as JSON stores them, without those that differ between two runs."""
    return _without(json.loads(json.dumps(values, default=_listed)))


def _listed(value: Any) -> Any:
    """Array, set or number of NumPy as JSON takes it; a text of others, such as times and cases."""
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else str(value)


def _without(values: Any) -> Any:
    if isinstance(values, dict):
        return {name: _without(value) for name, value in values.items() if name not in _OF_RUNS}
    return [_without(value) for value in values] if isinstance(values, list) else values


def _case(name: str) -> Any:
    """Case of a file of the examples."""
    path = EXAMPLES / f"{name}.toml"
    axle = "[[shaft]]" in path.read_text("utf-8")
    return (ehlectric.AxleCase if axle else ehlectric.DriveCase).from_toml(path)


def of_file(name: str) -> dict[str, Any]:
    """Numbers, texts, files and netlists of a case in every way in which they can be had."""
    case = _case(name.partition(" ")[0])
    case = case.replace(FILES[name]) if FILES[name] else case
    with tempfile.TemporaryDirectory() as folder:
        result = ehlectric.solve(case)
        files = ehlectric.save(result, folder)
        loaded = ehlectric.load(folder)
        tables = {file.name: _rows(file) for file in files if file.suffix == ".csv"}
        answer = _of_result(result)
        again = [each for each in differences(answer, _of_result(loaded)) if "solution" not in each]
        if again:
            raise ValueError(f"the stored result differs: {again[:3]}")
    return {**answer, **tables, "printed": _printed(case), "netlist": _netlist(case)}


def _rows(path: Path) -> list[list[Any]]:
    """Rows of a file, numbers as such."""
    rows = csv.reader(path.read_text("utf-8").splitlines())
    return [[float(value) if _NUMBER.fullmatch(value) else value for value in row] for row in rows]


def _of_result(result: Any) -> Any:
    """Summary, verdict, discharges and variables of a result."""
    verdict = result.verdict
    dataset = result.to_xarray()
    return _plain(
        {
            "summary": result.summary(),
            "verdict": [
                verdict.level,
                verdict.code,
                str(verdict),
                [str(reason) for reason in verdict.reasons],
            ],
            "events": _events_of(result),
            "variables": {name: dataset[name].values.tolist() for name in sorted(dataset.variables)},
            "warnings": [str(warning) for warning in result.warnings],
        }
    )


def _events_of(result: Any) -> list[Any]:
    """Rows of the record of a result and of those of its remedies, where time is simulated."""
    if isinstance(result, ehlectric.DriveResult):
        records = [result.solution.record, *(solution.record for _, _, solution in result.remedies)]
    else:
        simulated = [result.discharges, *result.remedied_discharges]
        records = [each.record for each in simulated if each is not None]
    return [record.events.tolist() for record in records]


def _printed(case: Any) -> list[str]:
    """Lines that the command prints."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "case.toml")
        path.write_text(case.to_toml(), encoding="utf-8")
        words = ["drive", str(path), "-o", str(Path(folder, "out")), "--no-plots"]
        done = CliRunner().invoke(app, words, env={"COLUMNS": "120"})
    if done.exit_code:
        raise ValueError(f"the command ends with {done.exit_code}: {done.output}")
    return [line for line in done.output.splitlines() if not _LINE_OF_RUN.search(line)]


def _netlist(case: Any) -> dict[str, list[str]]:
    """Lines of the files of a netlist and its bench."""
    with tempfile.TemporaryDirectory() as folder:
        write = getattr(
            ehlectric, f"write_{'drive' if isinstance(case, ehlectric.DriveCase) else 'axle'}_netlist"
        )
        files = write(case, Path(folder, "n.lib"), bench=Path(folder, "n.cir"))
        texts = {file.name: file.read_text("utf-8").splitlines() for file in files}
    if not texts:
        raise ValueError("no netlist is written")
    return {name: [line for line in text if "ehlectric" not in line] for name, text in texts.items()}


def of_inputs(kind: str) -> list[Any]:
    """Summaries, or the reasons of refusal, of the files that together contain every key of a kind."""
    with tempfile.TemporaryDirectory() as folder:
        return [_plain(_of_input(kind, tables, Path(folder))) for tables in cases_of(kind)]


def _of_input(kind: str, tables: Any, folder: Path) -> Any:
    try:
        answer = Answer(kind, tables, folder)
        values: list[Any] = [answer.stage(number) for number in range(answer.count)]
        result = answer.result
        values += [str(axle) for axle in result.warnings] + [str(result.verdict)]
        if kind == "axle" and answer.case.drive.duration is not None:
            discharges = simulate_axle(result.solution)
            values.append([] if discharges is None else discharges.record.events.tolist())
    except (InputError, ConvergenceError) as error:
        return str(error)
    return values


def of_release() -> dict[str, Any]:
    """Stored results of version 1.0.0."""
    folder = DATA / "releases/1.0.0"
    drive, sweep = ehlectric.load(folder / "drive"), ehlectric.read_sweep(folder / "drives")
    return {"drive": _of_result(drive), "sweep": _plain(sweep.to_dataframe().to_dict("list"))}


def evaluated(name: str) -> Any:
    """Numbers of 20 points."""
    found = ehlectric.evaluate(_case(name), _POINTS[name])
    return _plain({key: found[key].values.tolist() for key in found.variables})


def calibrated(name: str) -> Any:
    """Posterior of a calibration: its summary and its factors."""
    case = _case("e_axle").replace(_MEASURED) if name == "axle" else _case("drive_measured")
    return _plain(ehlectric.calibrate(case).summary())


_MEASURED = {
    "measured": {
        "elements": {
            "rotor_1": {"capacitance": "60 pF +- 20 %"},
            "mesh_1": {"breakdown_voltage": "3 V +- 30 %"},
        },
        "shafts": {"rotor": {"voltage": "13 V +- 10 %"}},
    },
    "ranges": {"discharge.dielectric_strength": ["10 V/um", "25 V/um"]},
}

PARTS: dict[str, Callable[[], Any]] = {
    **{name: partial(of_file, name) for name in FILES},
    **{
        f"inputs of {kind}": partial(of_inputs, kind)
        for kind in ("drive", "axle", "duty of drive", "duty of axle")
    },
    "release": of_release,
    **{f"points of {name}": partial(evaluated, name) for name in _POINTS},
    **{f"calibration of {name}": partial(calibrated, name) for name in ("drive", "axle")},
}


def differences(before: Any, after: Any, place: str = "", *, exact: bool = False) -> Iterator[str]:
    """Differences of two nested values; ``exact`` for numbers of events."""
    if isinstance(before, dict) and isinstance(after, dict):
        for key in sorted(before.keys() | after.keys()):
            if key not in before or key not in after:
                yield f"{place}.{key}: {'new' if key not in before else 'gone'}"
            else:
                yield from differences(
                    before[key], after[key], f"{place}.{key}", exact=exact or key == "events"
                )
    elif isinstance(before, list) and isinstance(after, list):
        if len(before) != len(after):
            yield f"{place}: {len(after)} entries, before {len(before)}"
        for number, pair in enumerate(zip(before, after, strict=False)):
            yield from differences(*pair, f"{place}[{number}]", exact=exact)
    elif not exact and isinstance(before, float) and isinstance(after, int | float):
        if abs(before - after) > _EQUAL * max(abs(before), abs(after)) or (before != before) != (
            after != after
        ):
            yield f"{place}: {after!r}, before {before!r}"
    elif before != after and not (before != before and after != after):
        yield f"{place}: {after!r}, before {before!r}"


def main() -> None:
    """Make or compare the parts, and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("action", choices=["make", "compare"])
    parser.add_argument("folder", type=Path)
    parser.add_argument("parts", nargs="*", help=", ".join(PARTS))
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    failed = 0
    for name in given.parts or PARTS:
        file, start = given.folder / f"{name.replace(' ', '_')}.json", time.process_time()
        text = _FOLDERS.sub("", json.dumps(PARTS[name]()))
        if given.action == "make":
            file.write_text(text, encoding="utf-8")
            lines = [f"{file.stat().st_size // 1000} kB"]
        else:
            before = json.loads(file.read_text("utf-8"))
            found = [*differences(before, json.loads(text))]
            failed += bool(found)
            lines = [f"{len(found)} differences" if found else "equal", *found[:8]]
        print(
            f"{name} ({time.process_time() - start:.0f} s):",
            *lines,
            sep="\n    " if lines[1:] else " ",
            flush=True,
        )
    sys.exit(min(failed, 1))


if __name__ == "__main__":
    main()
