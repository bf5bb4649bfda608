"""The commands to start with: init and examples, which write files, and app, which serves the web app."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from filecmp import cmp
from pathlib import Path
from types import MappingProxyType

import tomli
import typer

from ehlectric.commands.options import TEXTS, chosen, command
from ehlectric.commands.terminal import echo_files, say, user_errors
from ehlectric.errors import InputError, shown
from ehlectric.quantities.inputs import ENDS
from ehlectric.runs.example_files import examples_folder

_HERE = Path(__file__).parent

# File of each kind of template. Kinds that an example shows in full have it as their template.
TEMPLATES: Mapping[str, str] = MappingProxyType(TEXTS["templates"])
_GEOMETRIES = ("line", "point")

# Measurements that belong to an example, by the name of its file.
_MEASUREMENTS = {
    "bearing_6208.toml": ("measurements/bearing_6208_capacitance.csv", "measurements/meter_log.csv"),
    "drive.toml": ("measurements/common_mode.csv",),
    "duty_wltc.toml": ("measurements/wltc_low_km_h.csv",),
    "measured_contact.toml": ("measurements/film_log.txt",),
}

# Folder of the examples that holds the surfaces of rough contacts.
_SURFACES = "surfaces"


def template(kind: str) -> Path:
    """File of a template. Raises InputError if there is no such kind."""
    folder, _, name = TEMPLATES[chosen("--kind", kind, tuple(TEMPLATES))].partition("/")
    return (examples_folder() if folder == "examples" else _HERE / folder) / name


@command("init", kind=tuple(TEMPLATES))
def init(
    path: Path = Path("case.toml"),
    kind: str = "line",
    geometry: str = "",
    force: bool = False,
    alone: bool = False,
    quiet: bool = False,
) -> None:
    """Write a commented file of any kind to start from.

    The file can be solved as it is. Its comments explain every key, and mark what is an assumption. The
    JSON Schema of its kind is written next to it: editors such as VS Code then complete and explain its keys.
    """
    with user_errors():
        if geometry and geometry not in _GEOMETRIES:
            takes = f"{' or '.join(_GEOMETRIES)}; other kinds are written with --kind"
            raise InputError("--geometry", got=shown(geometry), takes=takes)
        from ehlectric.runs.file_kinds import command_of_file
        from ehlectric.runtime.files import clear_left_behind, prepare, refuse_special

        source = template(geometry or kind)
        refuse_special(path)
        if path.exists() and not force:
            raise InputError(path, "already exists; use --force to overwrite")
        further = [file for file in _gear_files(source) if not (path.parent / file).exists() or force]
        clear_left_behind(prepare(path.parent))
        for file in further:
            refuse_special(path.parent / file)
            _copy(source.parent / file, path.parent / file)
        schema_file = None
        if alone:
            _copy(source, path)
        else:
            schema_file = _write_with_schema(source, path)
        solver = command_of_file(path)
    if not quiet:
        say(f"written: {', '.join(map(str, (path, *(path.parent / file for file in further))))}")
        if schema_file is not None:
            say(f"  editors complete its keys by: {schema_file}")
        say(f"  check it with: ehlectric check {path}")
        say(f"  solve it with: ehlectric {solver} {path}")


def _complete(begun: str) -> list[str]:
    """Names of examples that begin with some letters."""
    return [name for name in _names() if name.startswith(begun)]


@command("examples", names=_complete)
def examples(
    names: list[str] | None = None, output: Path | None = None, force: bool = False, quiet: bool = False
) -> None:
    """List the examples, or copy them with the files that belong to them.

    Without arguments, the examples are listed. With names or with --output they are copied.
    """
    if not names and output is None:
        for name in _names():
            typer.echo(f"{name:18}  {_about(name)}")
        typer.echo("copy all with: ehlectric examples -o DIR; one with: ehlectric examples NAME")
        return
    with user_errors():
        requested = [_known(name) for name in names] if names else _names()
        files = list(dict.fromkeys(file for name in requested for file in _needed(f"{name}.toml")))
        target = output or Path()

        from ehlectric.runtime.files import clear_left_behind, prepare, refuse_special
        from ehlectric.runtime.folders import alone_in

        for file in files:
            refuse_special(target / file)
            # Examples share files, such as a driving cycle.
            if (
                not force
                and (target / file).exists()
                and not cmp(examples_folder() / file, target / file, False)
            ):
                raise InputError(target / file, "already exists; use --force to overwrite")
        with alone_in(target, files):
            for file in files:
                clear_left_behind(prepare((target / file).parent))
                _copy(examples_folder() / file, target / file)
    if not quiet:
        echo_files(target / file for file in files)


@command("app")
def app(
    port: int | None = None,
    host: str = "127.0.0.1",
    browser: bool = True,
    jobs: int | None = None,
    memory: float | None = None,
    time_limit: float = 60.0,
) -> None:
    """Serve the web app on this machine, and open it in a browser.

    Ctrl-C ends it, with all that it computes. It needs the extra: pip install "ehlectric[app]".
    """
    with user_errors():
        from importlib.util import find_spec

        if find_spec("nicegui") is None:
            takes = 'an installation with: pip install "ehlectric[app]"'
            raise InputError("app", "NiceGUI is missing", takes=takes)
        from ehlectric.app.start import start
        from ehlectric.app.work import limits_of

        _finite(memory, "--memory")
        _finite(time_limit, "--time-limit")
        limits = limits_of(jobs=jobs, gigabytes=memory, minutes=time_limit)
        start(host, port, browser=browser, tell=say, limits=limits)


def _finite(value: float | None, option: str) -> None:
    """Refuse NaN and infinite numbers, which every comparison with a bound lets pass or not by chance."""
    if value is not None and not math.isfinite(value):
        raise InputError(option, got=value, takes="a finite number")


def _names() -> list[str]:
    """Names of the examples, without the suffix of their files."""
    return sorted(path.stem for path in examples_folder().glob("*.toml"))


def _known(name: str) -> str:
    """Name of an example, also where its suffix was typed. Raises InputError if there is no such example."""
    stem, names = name.removesuffix(".toml"), _names()
    if stem not in names:
        near = get_close_matches(stem, names, n=3, cutoff=0.3) or names[:3]
        takes = f"one of the list of: ehlectric examples, such as {', '.join(near)}"
        raise InputError("examples", got=shown(name), takes=takes)
    return stem


def _about(name: str) -> str:
    """One line about an example: its title."""
    table = tomli.loads((examples_folder() / f"{name}.toml").read_text(encoding="utf-8"))
    return str(table.get("title", ""))


def _gear_files(file: Path) -> list[str]:
    """Names of the gear files that the meshes of a file name."""
    meshes = tomli.loads(file.read_text(encoding="utf-8")).get("mesh", ())
    return [mesh["file"] for mesh in meshes]


def _needed(file: str) -> Iterator[str]:
    """File of an example and the files that it names, relative to the folder of the examples."""
    yield file
    table = tomli.loads((examples_folder() / file).read_text(encoding="utf-8"))
    yield from _MEASUREMENTS.get(file, ())
    if isinstance(table.get("case"), str):
        yield from _needed(table["case"])
    named = (table.get(name, {}) for name in ("source", "duty", "measured"))
    yield from (holder["file"] for holder in named if "file" in holder)
    if isinstance(record := table.get("measured", {}).get("shaft_record"), dict):
        yield record["file"]
    viscosities = table.get("lubricant", {}).get("viscosity_table")
    if isinstance(viscosities, str):
        yield viscosities
    for end in ENDS:
        if "file" in table.get(end, ()):
            yield from _needed(table[end]["file"])
    yield from _gear_files(examples_folder() / file)
    for surface in table.get("roughness", ()):
        if "file" in surface:
            yield surface["file"]
            yield f"{_SURFACES}/README.md"  # licence of the measured surfaces


def _write_with_schema(source: Path, path: Path) -> Path:
    """Write a template whose first line names the schema of its kind, and the schema in its folder."""
    from ehlectric.commands.write_commands import schema_text
    from ehlectric.runs.file_kinds import kind_of_tables
    from ehlectric.runtime.files import refuse_special, write

    text = source.read_text(encoding="utf-8")
    kind = kind_of_tables(tomli.loads(text)) or "contact"
    kind = "contact" if kind == "motion" else kind
    schema_file = path.parent / f"ehlectric-{kind}.schema.json"
    refuse_special(schema_file)
    write(schema_file, schema_text(kind).encode())
    write(path, f"#:schema ./{schema_file.name}\n{text}".encode())
    return schema_file


def _copy(source: Path, target: Path) -> None:
    from ehlectric.runtime.files import write

    write(target, source.read_bytes())
