"""Random cases, each asked in every way: ``python -m tests.attack.agreement --seed 7 --first 0 --number 50``.

A case is asked by command, by Python, as the only point of a sweep, by ``evaluate``, after it was written to
a file and read again, after its result was saved and loaded, and with ``replace`` of each number by its
value. All ways have one value, or one reason.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from typer.testing import CliRunner

from ehlectric import Case, DriveCase, evaluate, load, run_sweep, solve
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import kind_of
from ehlectric.cases.table_edits import flattened
from ehlectric.commands.command_line import app
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.runtime.display import is_number
from tests.helpers.kinds_of_bearings import DISCHARGE, KINDS, LIFE, MOTOR, OIL, POINT

Table = dict[str, Any]
Asked = Case | BearingCase | DriveCase

# Relative difference of numbers that are the same: rounding, as sums have another order in some ways.
_ROUNDING = 1e-8

# Numbers of a summary that do not follow from the case: times, numbers of iterations, and sizes of rounding
# errors.
_NOT_COMPARED = ("seconds", "version", "residual", "interpolation_error", "file", "iterations")


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(f"{10.0 ** rng.uniform(math.log10(low), math.log10(high)):.6g}")


def _oil(rng: np.random.Generator) -> Table:
    oils: list[Table] = [
        {"base": "paper"},
        {"base": "paper", "viscosity": _log(rng, 0.01, 0.1)},
        {"base": "fva-3"},
        {"base": "iso-vg-46"},
        {"base": "e-axle-fluid"},
        OIL,
        {**OIL, "density_law": "incompressible"},
    ]
    return dict(oils[rng.integers(len(oils))])


def line(rng: np.random.Generator) -> Table:
    """Line contact on a coarse grid."""
    contact = {
        "geometry": "line",
        "reduced_radius": _log(rng, 3e-3, 3e-2),
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": _log(rng, 4e8, 1.5e9),
        "entrainment_speed": _log(rng, 0.5, 10.0),
        "temperature": float(rng.integers(300, 370)),
    }
    return _contact(rng, contact, {"nodes": int(rng.choice([257, 401, 513]))})


def point(rng: np.random.Generator) -> Table:
    """Point contact on a coarse grid."""
    contact = {
        "geometry": "point",
        "radius_x": _log(rng, 5e-3, 2e-2),
        "radius_y": _log(rng, 5e-3, 5e-2),
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": _log(rng, 4e8, 1e9),
        "entrainment_speed": _log(rng, 0.5, 5.0),
        "temperature": float(rng.integers(300, 370)),
    }
    return _contact(rng, contact, {"nodes": 65, "nodes_y": 65})


def _contact(rng: np.random.Generator, contact: Table, grid: Table) -> Table:
    table: Table = {"contact": contact, "lubricant": _oil(rng), "grid": grid}
    if rng.random() < 0.5:
        table["electric"] = {"potential_1": 0.0, "potential_2": _log(rng, 0.1, 50.0)}
    if rng.random() < 0.5:
        table["discharge"] = {"dielectric_strength": _log(rng, 5e6, 5e7), "conductivity": 1e-12}
    return table


def bearing(rng: np.random.Generator) -> Table:
    """Bearing of any kind, with contacts of the atlas or by formula, and some of its tables."""
    kind = list(KINDS)[rng.integers(len(KINDS))]
    own: Table = {**POINT, **KINDS[kind]}
    own["inner_speed"] = f"{_log(rng, 5.0, 15000.0):.1f} rpm"
    own["composite_rq"] = _log(rng, 1e-8, 2e-7)
    own["temperature"] = float(rng.integers(260, 420))
    if "radial_clearance" in own:
        own["radial_clearance"] = float(f"{rng.uniform(-5e-6, 40e-6):.3g}")
    if rng.random() < 0.3:
        own["fill"] = [0.4, "air"][rng.integers(2)]
    if rng.random() < 0.3:
        own["summit_height"] = float(rng.integers(0, 4))
    for key in ("radial_load", "axial_load"):
        if key in own:
            # A load may be far below the other one, and above the strength of the bearing.
            own[key] = 0.0 if rng.random() < 0.1 and key == "axial_load" else _log(rng, 0.5, 6e4)
    if rng.random() < 0.5:
        own["life"] = {**LIFE, "roughened_rq": 3e-7}
    table: Table = {"contacts": str(rng.choice(["atlas", "formula"])), "bearing": own}
    table["lubricant"] = {**OIL}
    if rng.random() < 0.7:
        table["discharge"] = {key: value for key, value in DISCHARGE.items() if key != "pit"}
    # A verdict takes a second.
    if rng.random() < 0.3:
        table["motor"] = {key: value for key, value in MOTOR.items() if rng.random() < 0.7 or key in _NEEDED}
    return table


_NEEDED = ("common_mode_voltage", "winding_rotor_capacitance", "rotor_frame_capacitance")


def drive(rng: np.random.Generator) -> Table:
    """Drive with two bearings, some with a duty cycle of a few rows, over a few milliseconds."""
    ends: list[Table] = []
    for _ in range(2):
        end = bearing(rng)
        end.pop("motor", None)
        end["bearing"]["contact_resistance"] = "1 ohm"
        end["discharge"] = {"dielectric_strength": _log(rng, 5e6, 3e7), "conductivity": 1e-12}
        ends.append(end)
    table: Table = {
        "drive": {
            "speed": f"{_log(rng, 300.0, 5000.0):.1f} rpm",
            "temperature": "70 degC",
            "duration": "5 ms",
            "seed": int(rng.integers(100)),
        },
        "source": {
            "dc_link": _log(rng, 300.0, 800.0),
            "modulation": str(rng.choice(["space-vector", "sinusoidal"])),
            "switching_frequency": "8 kHz",
            "pole_pairs": 2,
            "modulation_index": 0.8,
            "rise_time": "100 ns",
        },
        "circuit": {
            "winding_rotor_capacitance": "30 pF",
            "rotor_frame_capacitance": "700 pF",
            "winding_frame_capacitance": "5 nF",
        },
        "breakdown": {"arc_resistance": "10 ohm", "extinction_current": "10 mA", "recovery_time": "100 ns"},
        "drive_end": ends[0],
        "non_drive_end": ends[1],
    }
    if rng.random() < 0.3:
        rows = "\n".join(f"{k},{_log(rng, 100.0, 5000.0):.1f}" for k in range(3))
        table["duty"] = {"file": f"time [s],speed [rpm]\n{rows}\n"}
    return table


KINDS_OF_CASES: Mapping[str, tuple[str, Callable[[np.random.Generator], Table]]] = {
    "line": ("run", line),
    "point": ("run", point),
    "bearing": ("bearing", bearing),
    "drive": ("drive", drive),
}


def differences(kind: str, seed: int, number: int, folder: Path) -> tuple[list[str], str]:
    """Differences between the ways of asking for a random case, and its outcome: solved, or the reason."""
    command, draw = KINDS_OF_CASES[kind]
    table = draw(np.random.default_rng([seed, number]))
    if "duty" in table:
        (folder / "duty.csv").write_text(table["duty"]["file"])
        table["duty"]["file"] = str(folder / "duty.csv")
    try:
        case = _case_of(table)
    except InputError as error:
        return [], f"input: {error}"
    path, out = folder / "case.toml", folder / "out"
    path.write_text(case.to_toml())
    found = [f"case: {way}" for way in _of_case(case, path)]
    first = _command(command, path, out)
    ways: dict[str, Callable[[], Mapping[str, Any] | str]] = {
        "python": lambda: _python(case),
        "sweep": lambda: _sweep(case, folder / "sweep"),
    }
    if isinstance(first, Mapping):
        ways["load"] = lambda: json.loads(json.dumps(load(out).summary()))
    if not isinstance(case, Case):
        ways["evaluate"] = lambda: _evaluate(case)
    for name, ask in ways.items():
        found += [f"{name}: {one}" for one in _unlike(first, ask(), name)]
    return found, first if isinstance(first, str) else "solved"


def _case_of(table: Table) -> Asked:
    model = Case if "contact" in table else BearingCase if "bearing" in table else DriveCase
    return model.from_dict(table)


def _of_case(case: Asked, path: Path) -> Iterator[str]:
    """Ways in which a case that was written, or whose numbers are replaced by their values, differs."""
    if type(case).from_toml(path) != case:
        yield "read again it differs"
    if type(case).from_dict(case.to_dict()) != case:
        yield "from its tables it differs"
    for key, value in flattened(case.to_dict()).items():
        if is_number(value) and kind_of(key) is not None:
            try:
                same = case.replace({key: value})
            except InputError as error:
                yield f"{key} cannot be replaced by its value: {error}"
                continue
            if same != case:
                yield f"with {key} replaced by its value it differs"


def _command(command: str, path: Path, out: Path) -> Mapping[str, Any] | str:
    """Summary that a command writes, or the reason why it writes none."""
    done = CliRunner().invoke(app, [command, str(path), "-o", str(out), "--no-plots", "--quiet"])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        return f"traceback: {done.exception!r}"
    summary = out / "summary.json"
    if not summary.exists():
        last = [line for line in done.output.splitlines() if line.startswith("error: ")]
        return (last or [done.output])[-1].removeprefix("error: ").removeprefix("not converged: ")
    found: Mapping[str, Any] = json.loads(summary.read_text())
    return found


def _python(case: Asked) -> Mapping[str, Any] | str:
    try:
        result = solve(case, workers=1)
    except (InputError, ConvergenceError) as error:
        return str(error)
    found: Mapping[str, Any] = json.loads(json.dumps(result.summary()))
    return found


def _sweep(case: Asked, folder: Path) -> Mapping[str, Any] | str:
    """Summary of the only point of a sweep of a case over one of its numbers."""
    key, value = next(_numbers(case))
    with ThreadPoolExecutor(1) as executor:
        results = run_sweep({"case": case.to_dict(), "vary": {key: [value]}}, folder, executor)
    frame = results.to_dataframe()
    row = frame.iloc[0]
    if row["status"] == "failed":
        return str(row["reason"]).removeprefix("not solved: ")
    return {name.partition(" [")[0]: value for name, value in row.items()}


def _numbers(case: Asked) -> Iterator[tuple[str, float]]:
    wanted = ("entrainment_speed", "inner_speed", "drive.speed")
    for key, value in flattened(case.to_dict()).items():
        if key.endswith(wanted) and is_number(value) and not key.startswith(("drive_end", "non_drive_end")):
            yield key, value


def _evaluate(case: BearingCase | DriveCase) -> Mapping[str, Any] | str:
    """Numbers of a bearing, or of both bearings of a drive, at one point."""
    key, value = next(_numbers(case))
    found = evaluate(case, {key: [value]}).isel(point=0)
    for end in ("", "drive_end.", "non_drive_end."):
        if f"{end}converged" in found and not bool(found[f"{end}converged"]):
            return str(found[f"{end}reason"].item())
    values = {name: found[name].item() for name in found.data_vars}
    # The summary of a drive has the capacitance of each bearing next to numbers of the simulation.
    ends = [f"{end}.capacitance" for end in ENDS]
    return values | {key: values.get(key.replace(".", ".bearing.")) for key in ends}


def _unlike(first: Mapping[str, Any] | str, other: Mapping[str, Any] | str, way: str) -> Iterator[str]:
    """Differences of an outcome from that of the command."""
    if isinstance(first, str) or isinstance(other, str):
        texts = [one if isinstance(one, str) else "solved" for one in (first, other)]
        if " ".join(texts[0].split()) != " ".join(texts[1].split()):
            yield f"{texts[1][:150]!r}, and by command {texts[0][:150]!r}"
        return
    left, right = flattened(first), flattened(other)
    whole = way in ("python", "load")
    for key, value in left.items():
        if key.startswith("seconds") or key.endswith(_NOT_COMPARED) or (not whole and key in _OF_RESULTS):
            continue
        if key not in right:
            if whole:
                yield f"{key} is missing"
        elif not _alike(value, right[key]):
            yield f"{key} is {right[key]!r}, and by command {value!r}"
    if not whole and "warning_codes" in right and (codes := _codes(left) ^ _codes(right)):
        yield f"only one of both has the warnings {codes}"


# Keys that tables of many points have in another form, and beginnings of codes about a duty cycle or about a
# probability, which points do not have.
_OF_RESULTS = ("status", "warnings", "warning_codes", "title")


def _codes(table: Mapping[str, Any]) -> set[str]:
    codes = table["warning_codes"]
    names = codes.split("; ") if isinstance(codes, str) else codes
    # Points of many have the codes alone, or all texts in one.
    texts = given if isinstance(given := table.get("warnings"), list) else [""] * len(names)
    # The rating life of a duty cycle has the code of a rating life.
    of_points = [name for name, text in zip(names, texts, strict=True) if "duty cycle" not in text]
    return {name for name in of_points if name and not name.startswith(("duty", "columns", "probability"))}


def _alike(first: Any, second: Any) -> bool:
    if isinstance(first, list) and isinstance(second, list):
        return len(first) == len(second) and all(map(_alike, first, second))
    if isinstance(first, dict) and isinstance(second, dict):
        return all(
            key in second and (key.endswith(_NOT_COMPARED) or _alike(value, second[key]))
            for key, value in first.items()
        )
    if is_number(first) and is_number(second) and not isinstance(first, bool):
        return abs(first - second) <= max(1e-14, _ROUNDING * abs(first)) or (
            first != first and second != second
        )
    empty = (None, "", "nan")
    return first == second or (str(first) in map(str, empty) and str(second) in map(str, empty))


def main() -> int:
    """Ask for cases, and print what differs."""
    parser = argparse.ArgumentParser(prog="python -m tests.attack.agreement", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first case of each kind")
    parser.add_argument("--number", type=int, default=10, help="cases of each kind")
    parser.add_argument("--kinds", nargs="*", choices=tuple(KINDS_OF_CASES), default=tuple(KINDS_OF_CASES))
    given = parser.parse_args()
    wrong = 0
    for kind in given.kinds:
        outcomes: dict[str, int] = {}
        started = time.process_time()
        for number in range(given.first, given.first + given.number):
            with tempfile.TemporaryDirectory() as folder:
                found, outcome = differences(kind, given.seed, number, Path(folder))
            name = outcome[:70]
            outcomes[name] = outcomes.get(name, 0) + 1
            wrong += bool(found)
            for one in found[:6]:
                sys.stdout.write(f"{kind} {number}: {one}\n")
            sys.stdout.flush()
        seconds = time.process_time() - started
        sys.stdout.write(f"{kind}: {given.number} cases, {seconds:.0f} s, {outcomes}\n")
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
