"""Commands killed at random moments: what they leave, and what the next run makes of it."""

from __future__ import annotations

import csv
import json
import random
import shutil
import sqlite3
import time
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

import h5py
import numpy as np
from PIL import Image

from tests.attack.attack import Report
from tests.attack.judge import faults, hidden
from tests.attack.runner import Runner, workers_gone
from tests.attack.stock import CASES, DRIVE, SWEEPS, Stock, write_toml

# Kills of a command between two runs that may end.
_BETWEEN = 10

# Values of a result that differ from run to run: times, and where it was computed.
_OF_THE_RUN = ("time", "seconds", "date", "folder", "path", "file", "history")


@dataclass(frozen=True)
class Scenario:
    """A command to be killed.

    Attributes
    ----------
    words : tuple of str
        Its words; it writes into ``out``.
    prepare : callable
        ``prepare(stock, folder, title)`` writes its inputs into a folder, with a title in them.
    kills : int
        Number of kills in the attack of the tests.
    progress : callable, optional
        What is saved in a folder already, if the command resumes: it must never become less.
    """

    words: tuple[str, ...]
    prepare: Callable[[Stock, Path, str], None]
    kills: int = 100
    progress: Callable[[Path], frozenset[Any]] | None = None


def _titled(name: str, table: Mapping[str, Any]) -> Callable[[Stock, Path, str], None]:
    def prepare(_: Stock, folder: Path, title: str) -> None:
        write_toml(folder / name, {**table, "title": title})

    return prepare


def _linked(*names: str) -> Callable[[Stock, Path, str], None]:
    def prepare(stock: Stock, folder: Path, _: str) -> None:
        for name in names:
            source = stock.folder / name
            (shutil.copytree if source.is_dir() else shutil.copyfile)(source, folder / name)
        (folder / "out").mkdir(exist_ok=True)

    return prepare


def _swept(_: Stock, folder: Path, __: str) -> None:
    write_toml(folder / "line.toml", {**CASES["line"], "grid": {"nodes": 129}})
    speeds = {"from": "1 m/s", "to": "6 m/s", "count": 8}
    loads = {"from": "0.6 MN/m", "to": "1.4 MN/m", "count": 6}
    vary = {"contact.entrainment_speed": speeds, "contact.load_per_length": loads}
    write_toml(folder / "sweep.toml", {**SWEEPS["grid"], "title": "kept", "vary": vary})


def _saved_points(out: Path) -> frozenset[Any]:
    path = out / "sweep.sqlite"
    if not path.is_file():
        return frozenset()
    connection = sqlite3.connect(path)  # to be written: SQLite makes good what a kill interrupted
    try:
        return frozenset(connection.execute("select key, status, summary from results"))
    except sqlite3.OperationalError:
        return frozenset()  # its tables are not made yet
    finally:
        connection.close()


def _saved_steps(out: Path) -> frozenset[Any]:
    from ehlectric.motion.stored_run import saved_run

    return frozenset(range(saved_run(out)[0]))


SPEED = "contact.entrainment_speed"
_RUN = ("run", "case.toml", "-o", "out", "--no-plots")
_MOVING = {**CASES["moving"], "motion": {"passes": 0.3, "record": 15}}

SCENARIOS: Mapping[str, Scenario] = MappingProxyType(
    {
        "init": Scenario(("init", "out/case.toml", "--force"), _linked()),
        "examples": Scenario(("examples", "rough_contact", "-o", "out", "--force"), _linked()),
        "check": Scenario(("check", "line.toml"), _linked("line.toml")),
        "run": Scenario(_RUN, _titled("case.toml", CASES["line"])),
        "point": Scenario(_RUN, _titled("case.toml", CASES["point"])),
        "motion": Scenario(
            _RUN,
            lambda stock, folder, _: _titled("case.toml", _MOVING)(stock, folder, "kept"),
            kills=40, progress=_saved_steps,
        ),
        "bearing": Scenario(
            ("bearing", "bearing_6208.toml", "-o", "out", "--contacts", "formula", "--no-plots"),
            _linked("bearing_6208.toml"),
            kills=40,
        ),
        "drive": Scenario(
            ("drive", "drive.toml", "-o", "out", "--no-plots"), _titled("drive.toml", DRIVE), kills=40
        ),
        "sweep": Scenario(
            ("sweep", "sweep.toml", "-o", "out", "--workers", "1"), _swept, kills=25, progress=_saved_points
        ),
        "map": Scenario(
            ("map", "grid", "-o", "out", "--x", SPEED, "--y", "contact.load_per_length"),
            _linked("grid"),
        ),
        "sensitivity": Scenario(("sensitivity", "sobol", "-o", "out"), _linked("sobol")),
        "plot": Scenario(("plot", "line", "-o", "out"), _linked("line")),
        "animate": Scenario(("animate", "moving", "-o", "out/moving.gif"), _linked("moving")),
        "surface": Scenario(("surface", "profile.csv", "-o", "out/surface.png"), _linked("profile.csv")),
        "reproduce": Scenario(("reproduce", "-o", "out", "--figure", "2"), _linked()),
    }
)  # fmt: skip


def kill(name: str, kills: int, seed: int, stock: Stock, home: Path, runner: Runner) -> Report:
    """Kill a command at random moments of its work, and look at what is left.

    After each kill its workers are gone, and all files that can be seen are whole and of one run. What is
    saved never becomes less. After some kills the command runs to its end: then its folder has what one
    run alone writes there, value by value.

    Parameters
    ----------
    name : str
        A key of ``SCENARIOS``.
    kills : int
        Number of kills.
    seed : int
        Seed of the moments.
    stock : Stock
        Files that the command reads.
    home : Path
        Folder of the attack. Folders with faults stay in it.
    runner : Runner
        Where the command is run.

    Returns
    -------
    Report
        Counts and faults.
    """
    scenario, report, started = SCENARIOS[name], Report(seed, f"kills of {name}"), time.monotonic()
    draw = random.Random(f"{seed} {name}")
    whole = {title: _reference(scenario, stock, home / f"{name}-{title}", title, runner) for title in "AB"}
    # Moments are times on the processor: as far in the work on a busy machine as on an idle one.
    span = min(processor for _, processor in whole.values())
    # A run that ends before its kill does not count; there are four times as many runs at most.
    for turn in range(-(-4 * kills // _BETWEEN)):
        if report.inputs >= kills:
            break
        folder = home / f"kill-{name}-{seed}-{turn}"
        folder.mkdir(parents=True)
        wrong = list(_burst(scenario, _BETWEEN, span, folder, stock, draw, runner, report))
        wrong += _to_the_end(scenario, folder, stock, runner, whole, report)
        report.faults += [f"{folder}: {fault}" for fault in wrong]
        if not wrong:
            shutil.rmtree(folder)
    report.seconds = time.monotonic() - started
    return report


def _reference(
    scenario: Scenario, stock: Stock, folder: Path, title: str, runner: Runner
) -> tuple[dict[str, Any], float]:
    """What one run alone writes, and its time on the processor."""
    folder.mkdir(parents=True)
    scenario.prepare(stock, folder, title)
    outcome = runner.run(*scenario.words, folder=folder)
    assert outcome.status == 0, outcome.err
    return contents(folder / "out"), outcome.processor


def _burst(
    scenario: Scenario, kills: int, span: float, folder: Path, stock: Stock, draw: random.Random,
    runner: Runner, report: Report,
) -> Iterator[str]:  # fmt: skip
    """Kill a command some times in one folder."""
    saved: frozenset[Any] = frozenset()
    for _ in range(kills):
        title = draw.choice("AB")
        _prepare(scenario, stock, folder, title)
        outcome = runner.run(*scenario.words, folder=folder, processor=draw.uniform(0.0, span))
        report.inputs += not outcome.ended
        report.statuses["killed" if not outcome.ended else str(outcome.status)] += 1
        if not workers_gone(outcome.group):
            yield "a worker outlives its command"
        yield from seen_faults(folder / "out")
        if scenario.progress:
            now = scenario.progress(folder / "out")
            if not saved <= now:
                yield f"{len(saved)} saved parts became {len(now)}, or others"
            saved = now
            if outcome.status == 0 or (folder / "out" / "summary.json").is_file():
                # It came to its end before the kill: the next run begins anew.
                shutil.rmtree(folder / "out")
                saved = frozenset()


def _prepare(scenario: Scenario, stock: Stock, folder: Path, title: str) -> None:
    """Write the inputs, if they are not there or have a title of another run."""
    for path in folder.iterdir():
        if path.name != "out":
            (shutil.rmtree if path.is_dir() else Path.unlink)(path)
    scenario.prepare(stock, folder, title)


def _to_the_end(
    scenario: Scenario, folder: Path, stock: Stock, runner: Runner, whole: Mapping[str, tuple[Any, float]],
    report: Report,
) -> Iterator[str]:  # fmt: skip
    """Run the command without a kill: nothing of earlier runs is lost, mixed in or left behind."""
    _prepare(scenario, stock, folder, "A")
    outcome = runner.run(*scenario.words, folder=folder)
    report.statuses[str(outcome.status)] += 1
    yield from faults(outcome, folder, runner.temporary)
    if outcome.status != 0:
        yield f"the run after the kills ends with {outcome.status}: {outcome.err[-300:]}"
        return
    yield from seen_faults(folder / "out")
    if left := hidden(folder / "out"):
        yield f"{left[0].name} is left"
    found, expected = contents(folder / "out"), whole["A"][0]
    if found.keys() != expected.keys():
        yield f"has {sorted(found.keys() ^ expected.keys())} more or less than one run alone"
    yield from (
        f"{name} differs from one run alone" for name in expected if found.get(name) != expected[name]
    )


def seen_faults(out: Path) -> Iterator[str]:
    """Files in a folder that are not whole, or that are of different runs."""
    titles = set()
    for path in sorted(out.rglob("*")) if out.is_dir() else ():
        if path.is_file() and not path.name.startswith("."):
            try:
                values = value_of(path)
            except Exception as error:
                yield f"{path.name} is not whole: {error!r}"[:300]
                continue
            # The title of a schema is that of a kind of file, and not of a run.
            if isinstance(values, dict) and "$schema" not in values and isinstance(values.get("title"), str):
                titles.add(values["title"])
    if len(titles) > 1:
        yield f"holds files of {sorted(titles)}"


def contents(out: Path) -> dict[str, Any]:
    """Values of all files of a folder that can be seen, by name; without what differs from run to run."""
    paths = sorted(path for path in out.rglob("*") if path.is_file() and not path.name.startswith("."))
    return {str(path.relative_to(out)): value_of(path) for path in paths}


def value_of(path: Path) -> Any:
    """Value of a file that can be compared; an exception where the file is not whole."""
    return _READERS.get(path.suffix, Path.read_bytes)(path)


def _timeless(value: Any) -> Any:
    if isinstance(value, dict):
        return {
            key: _timeless(item)
            for key, item in value.items()
            if not any(word in str(key) for word in _OF_THE_RUN)
        }
    if isinstance(value, list):
        return [_timeless(item) for item in value]
    return value


def _json(path: Path) -> Any:
    return _timeless(json.loads(path.read_text(encoding="utf-8")))


def _toml(path: Path) -> Any:
    return tomllib.loads(path.read_text(encoding="utf-8"))


def _csv(path: Path) -> Any:
    text = path.read_text(encoding="latin-1")  # as instruments write it, and ASCII is part of it
    assert text.endswith("\n"), "its last line has no end"
    rows = list(csv.DictReader(text.splitlines()))
    return [_timeless(row) for row in rows]


def _netcdf(path: Path) -> Any:
    values: dict[str, Any] = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: values.update({name: _plain(item)}) if isinstance(item, h5py.Dataset) else None
        )
        values |= {name: _plain(value) for name, value in file.attrs.items()}
    return _timeless(values)


def _parquet(path: Path) -> Any:
    import pyarrow.parquet

    columns = pyarrow.parquet.read_table(path).to_pydict()
    return {name: repr(column) for name, column in _timeless(columns).items()}


def _plain(item: Any) -> Any:
    value = np.asarray(item[()] if isinstance(item, h5py.Dataset) else item)
    if value.dtype.kind == "O":
        texts = [part.decode() if isinstance(part, bytes) else str(part) for part in value.flat]
        value = np.array(texts).reshape(value.shape)
    text = str(value) if value.ndim == 0 else repr((value.shape, value.tobytes()))
    try:
        return json.dumps(_timeless(json.loads(text)), sort_keys=True)
    except ValueError:
        return text


def _picture(path: Path) -> Any:
    with Image.open(path) as picture:
        frames = getattr(picture, "n_frames", 1)
        picture.seek(frames - 1)
        return frames, picture.size, hash(picture.convert("RGB").tobytes())


def _database(path: Path) -> Any:
    connection = sqlite3.connect(path)
    try:
        assert connection.execute("pragma integrity_check").fetchone() == ("ok",)
        tables = {row[0] for row in connection.execute("select name from sqlite_master where type = 'table'")}
        rows = connection.execute("select key, status from results").fetchall() if "results" in tables else []
    finally:
        connection.close()
    return sorted(rows)


_READERS: dict[str, Callable[[Path], Any]] = {
    ".json": _json, ".toml": _toml, ".csv": _csv, ".nc": _netcdf, ".png": _picture, ".gif": _picture,
    ".sqlite": _database, ".parquet": _parquet,
}  # fmt: skip
