"""Inputs of the attack: each kind writes mutated files into a folder, and names commands that read them."""

from __future__ import annotations

import json
import random
import shutil
import sqlite3
import zipfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

import h5py
import numpy as np
import tomli_w

from ehlectric import Case
from ehlectric.runs.file_kinds import read_input
from tests.attack.mutations import hostile, mutated_bytes, mutated_table, mutated_text, near, places
from tests.attack.stock import BEARINGS, CASES, SWEEPS, Stock

Words = tuple[str, ...]
Draw = Callable[[Stock, Path, random.Random], Iterator[Words]]


@dataclass(frozen=True)
class Kind:
    """A kind of input.

    Attributes
    ----------
    draw : callable
        ``draw(stock, folder, random)`` writes files into a folder, and yields commands to be run there, each
        only after the one before has ended with status 0.
    count : int
        Number of inputs in the attack of the tests.
    """

    draw: Draw
    count: int


def _write(path: Path, table: Mapping[str, Any], draw: random.Random) -> None:
    """Write a table as TOML, in one of four cases with the text or its bytes mutated too."""
    try:
        data = tomli_w.dumps(table).encode("utf-8", "surrogatepass")
    except (TypeError, ValueError, RecursionError):
        data = repr(table).encode("utf-8", "surrogatepass")
    choice = draw.random()
    if choice < 0.15:
        data = mutated_text(data.decode("utf-8", "replace"), draw).encode("utf-8", "surrogatepass")
    elif choice < 0.25:
        data = mutated_bytes(data, draw)
    path.write_bytes(data)


def _link(stock: Stock, folder: Path, *names: str) -> None:
    for name in names:
        shutil.copyfile(stock.folder / name, folder / name)


def case(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A case of a contact: checked, and solved if its grid is small."""
    name = draw.choice(tuple(CASES))
    _link(stock, folder, "profile.csv")
    _write(folder / "case.toml", mutated_table(CASES[name], draw, tuple(CASES.values())), draw)
    yield ("check", "case.toml")
    if _small(folder / "case.toml"):
        yield ("run", "case.toml", "-o", "out", "--no-plots")


def _small(path: Path) -> bool:
    """Whether a valid file is a contact at rest that is solved in a few seconds."""
    if read_input(path).kind != "contact":
        return False
    case = Case.from_toml(path)
    most = 600 if case.contact.geometry == "line" else 65
    return not case.grid.refine and case.first_grid.nodes_along <= most and (case.grid.nodes_y or 0) <= most


def bearing(_: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A bearing: checked, or solved by formula."""
    table = BEARINGS[draw.choice(tuple(BEARINGS))]
    _write(folder / "bearing.toml", mutated_table(table, draw, tuple(BEARINGS.values())), draw)
    if draw.random() < 0.5:
        yield ("check", "bearing.toml")
    else:
        yield ("bearing", "bearing.toml", "-o", "out", "--contacts", "formula", "--no-plots")


def sweep(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A sweep: the sweep file or its case is mutated; it is checked."""
    _link(stock, folder, "profile.csv")
    which = draw.random()
    line = CASES["line"] if which < 0.7 else mutated_table(CASES["line"], draw, tuple(CASES.values()))
    plan = SWEEPS[draw.choice(tuple(SWEEPS))]
    if which < 0.9:
        plan = mutated_table(plan, draw, (*SWEEPS.values(), *CASES.values()))
    _write(folder / "line.toml", line, draw)
    _write(folder / "sweep.toml", plan, draw)
    yield ("check", "sweep.toml")


def cluster(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A sweep on a Dask cluster whose workers lack the package: half of the sweep files are mutated."""
    plan = SWEEPS[draw.choice(tuple(SWEEPS))]
    if draw.random() < 0.5:
        plan = mutated_table(plan, draw, (*SWEEPS.values(), *CASES.values()))
    _link(stock, folder, "profile.csv", "line.toml")
    _write(folder / "sweep.toml", plan, draw)
    yield ("sweep", "sweep.toml", "-o", "out", "--scheduler", stock.scheduler())


_SURFACE_OPTIONS = (
    "--x-unit", "--z-unit", "--line", "--along", "--form", "--cutoff-long", "--cutoff-short", "--trim",
    "--rescale-rq", "--truncate",
)  # fmt: skip
_SURFACE_VALUES = (
    "um",
    "nm",
    "0",
    "3",
    "-1",
    "row",
    "column",
    "none",
    "parabola",
    "8 um",
    "80 um",
    "1 nm",
    "1 km",
)


def surface(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A surface of an instrument: mutated bytes, text, or members of its archive; options of any value."""
    source = draw.choice(stock.surfaces)
    target = folder / f"surface{source.suffix}"
    choice = draw.random()
    if source.suffix == ".x3p" and choice < 0.6:
        _repack(source, target, draw)
    elif source.suffix in (".csv", ".txt") and choice < 0.7:
        text = mutated_text(source.read_text(encoding="utf-8"), draw)
        target.write_bytes(text.encode("utf-8", "surrogatepass"))
    else:
        others = [path.read_bytes() for path in stock.surfaces]
        target.write_bytes(mutated_bytes(source.read_bytes(), draw, others))
    words = ["surface", target.name]
    for _ in range(draw.choice((0, 0, 0, 1, 2))):
        value = draw.choice(_SURFACE_VALUES) if draw.random() < 0.7 else _word(draw)
        words += [draw.choice(_SURFACE_OPTIONS), value]
    yield tuple(words)


def _repack(source: Path, target: Path, draw: random.Random) -> None:
    """Write an archive again with one of its members mutated, lost, doubled or renamed."""
    with zipfile.ZipFile(source) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    name = draw.choice(tuple(members))
    choice = draw.random()
    if choice < 0.7 and name.endswith(".xml"):
        members[name] = mutated_text(members[name].decode(), draw).encode("utf-8", "surrogatepass")
    elif choice < 0.8:
        members[name] = mutated_bytes(members[name], draw)
    elif choice < 0.9:
        del members[name]
    else:
        members["../" + name] = members.pop(name)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for member, data in members.items():
            archive.writestr(member, data)


def result(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A stored result: mutated bytes, or values, shapes, names and attributes changed by HDF5."""
    source = draw.choice(stock.results)
    target = folder / source.name
    if draw.random() < 0.5:
        target.write_bytes(mutated_bytes(source.read_bytes(), draw))
    else:
        shutil.copyfile(source, target)
        with h5py.File(target, "r+") as file:
            for _ in range(draw.choice((1, 1, 2))):
                _edit(file, draw)
    yield ("plot", target.name, "-o", "out")


def _edit(file: h5py.File, draw: random.Random) -> None:
    names: list[str] = []
    file.visit(names.append)
    name = draw.choice([name for name in names if isinstance(file[name], h5py.Dataset)])
    data, choice = file[name], draw.random()
    if choice < 0.35:
        _edit_attribute(draw.choice((file, file, data)), draw)
    elif choice < 0.65 and data.dtype.kind in "fiu" and data.size:
        values = np.array(data[()])
        which = draw.randrange(values.size)
        with np.errstate(over="ignore"):
            values.flat[which] = _fitting(values.dtype, draw)
        data[()] = values if draw.random() < 0.6 else np.zeros_like(values)
    elif choice < 0.75:
        del file[name]
    elif choice < 0.85:
        file.move(name, f"{name}_{draw.randrange(9)}")
    else:
        del file[name]
        shape = draw.choice(((), (1,), (0,), (3, 2), (7,), (10**9,)))
        kind = draw.choice(("f8", "i4", "S3", "f4"))
        file.create_dataset(name, shape, kind, chunks=(1000,) if shape == (10**9,) else None)


def _fitting(kind: np.dtype[Any], draw: random.Random) -> Any:
    if kind.kind == "f":
        return draw.choice((np.nan, np.inf, -1.0, 0.0, 1e300, -1e300, 5e-324))
    return draw.choice((0, 1, np.iinfo(kind).max, np.iinfo(kind).min))


def _edit_attribute(owner: Any, draw: random.Random) -> None:
    names = list(owner.attrs)
    if not names:
        return
    name = draw.choice(names)
    value = owner.attrs[name]
    if draw.random() < 0.3:
        del owner.attrs[name]
    elif isinstance(value, str) and draw.random() < 0.6:
        text = mutated_json(value, draw)
        owner.attrs[name] = text.encode("utf-8", "replace").decode().replace("\0", "")
    else:
        try:
            owner.attrs[name] = hostile(draw)
        except (TypeError, ValueError, OverflowError, OSError, UnicodeEncodeError):
            owner.attrs[name] = "x"


def mutated_json(text: str, draw: random.Random) -> str:
    """Text with a value of its JSON changed, or a part of the text if it is no JSON."""
    try:
        value = json.loads(text)
    except ValueError:
        return mutated_text(text, draw)
    if not isinstance(value, dict | list) or not (found := list(places(value))):
        return mutated_text(text, draw)
    inside, key = draw.choice(found)
    inside[key] = hostile(draw) if draw.random() < 0.6 else near(inside[key], draw)
    return json.dumps(value, default=str)


_VARIED = {
    "grid": ("contact.entrainment_speed", "contact.load_per_length"),
    "sobol": ("contact.entrainment_speed", "discharge.dielectric_strength"),
}


def database(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """A database of a sweep: mutated bytes, or cells, rows, columns and tables changed by SQL."""
    grid, sobol = stock.databases
    ranks = draw.random() < 0.5
    source = sobol if ranks == (draw.random() < 0.9) else grid
    home = folder / "home"
    home.mkdir()
    target = home / source.name
    if draw.random() < 0.4:
        target.write_bytes(mutated_bytes(source.read_bytes(), draw))
    else:
        shutil.copyfile(source, target)
        with sqlite3.connect(target) as connection:
            for _ in range(draw.choice((1, 1, 2))):
                _alter(connection, draw)
        connection.close()
    if ranks:
        yield ("sensitivity", "home", "-o", "out", "-q")
    else:
        x, y = _VARIED[source.parent.name]
        beyond = ("--y", y) if draw.random() < 0.5 else ("--at", f"{y}=1 MN/m")
        yield ("map", "home", "-o", "out", "-q", "--x", x, *beyond)


def _alter(connection: sqlite3.Connection, draw: random.Random) -> None:
    tables = [row[0] for row in connection.execute("select name from sqlite_master where type = 'table'")]
    if not tables:
        return
    table = draw.choice(tables)
    columns = [row[1] for row in connection.execute(f'pragma table_info("{table}")')]
    column, choice = draw.choice(columns), draw.random()
    try:
        if choice < 0.7:
            rows = connection.execute(f'select rowid, "{column}" from "{table}"').fetchall()
            number, value = draw.choice(rows)
            new = (
                mutated_json(value, draw) if isinstance(value, str) and draw.random() < 0.7 else hostile(draw)
            )
            if not isinstance(new, str | int | float):
                new = json.dumps(new, default=str)
            connection.execute(f'update "{table}" set "{column}" = ? where rowid = ?', (new, number))
        elif choice < 0.8:
            connection.execute(f'delete from "{table}" where rowid % {draw.randrange(1, 4)} = 0')
        elif choice < 0.9:
            connection.execute(f'alter table "{table}" rename column "{column}" to "{column}_"')
        else:
            connection.execute(f'drop table "{table}"')
    except (sqlite3.Error, OverflowError, IndexError, UnicodeEncodeError):
        pass  # such a change cannot be made in this database


_COMMANDS: tuple[Words, ...] = (
    ("run", "line.toml", "-o", "out", "--no-plots"),
    ("check", "line.toml", "--json"),
    ("bearing", "bearing_6208.toml", "-o", "out", "--contacts", "formula", "--no-plots"),
    ("sweep", "grid.toml", "-o", "out", "--workers", "1"),
    ("map", "grid", "-o", "out", "--x", "contact.entrainment_speed", "--value", "film.minimum_thickness"),
    ("sensitivity", "sobol", "-o", "out", "--value", "film.minimum_thickness"),
    ("plot", "line", "-o", "out", "--format", "png"),
    ("animate", "moving", "-o", "out/a.gif", "--fps", "5"),
    ("surface", "profile.csv", "--form", "line", "--cutoff-long", "80 um"),
    ("reproduce", "-o", "out", "--table", "3"),
    ("init", "out/case.toml", "--kind", "line"),
    ("examples", "bearing_6208", "-o", "out"),
)


_FILES = ("line.toml", "grid.toml", "bearing_6208.toml", "profile.csv")


def words(stock: Stock, folder: Path, draw: random.Random) -> Iterator[Words]:
    """The words of a command: one is replaced, left out, doubled or put elsewhere."""
    (folder / "out").mkdir()
    for name in (
        "line.toml",
        "grid.toml",
        "bearing_6208.toml",
        "profile.csv",
        "line",
        "moving",
        "grid",
        "sobol",
    ):
        (folder / name).symlink_to(stock.folder / name)
    command = list(draw.choice(_COMMANDS))
    # Such a change may leave a command that is right, which then does what it does.
    for _ in range(draw.choice((1, 1, 2))):
        at, choice = draw.randrange(1, len(command)), draw.random()
        if command[at] == "-o" or command[at].startswith("out") or command[at] == "--workers":
            continue  # it must go on writing where it is told to
        if choice < 0.6:
            command[at] = _word(draw)
        elif choice < 0.8:
            del command[at]
        else:
            command.insert(at, draw.choice(draw.choice(_COMMANDS)))
    if command[0] == "bearing" and "formula" not in command:
        return  # solved contacts take a minute
    if command.count("-o") == 1 or command[0] in ("check", "surface", "init"):
        yield tuple(command)


def _word(draw: random.Random) -> str:
    """A word that can be given to a process: without a null, and not too long."""
    return str(hostile(draw)).replace("\0", "")[:100_000].encode("utf-8", "replace").decode()


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "case": Kind(case, 2000),
        "bearing": Kind(bearing, 100),
        "sweep": Kind(sweep, 1280),
        "cluster": Kind(cluster, 20),
        "surface": Kind(surface, 1150),
        "result": Kind(result, 150),
        "database": Kind(database, 200),
        "words": Kind(words, 100),
    }
)
