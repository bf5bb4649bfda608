"""Files that come into a page, and files of results that a page offers, as the command writes them."""

from __future__ import annotations

import re
import shutil
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from itertools import count, islice, takewhile
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from ehlectric.app.compute.answer_parts import (
    kind_of,
    names_in,
    page_warnings_of,
    run_case_of,
    sweep_of,
    with_names,
)
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.session import MOST_TOGETHER, SURFACES
from ehlectric.app.view_models import MOST_CASE, MOST_FILES, MOST_SURFACE, Download, Uploaded, Written
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.table import Table, opened_names, tables_of_text
from ehlectric.errors import InputError, shown
from ehlectric.motion.stored_run import read_motion
from ehlectric.quantities.inputs import ENDS
from ehlectric.runs.by_kind import RUNS
from ehlectric.runs.result_folders import stored_result
from ehlectric.runs.solve import load
from ehlectric.runtime.progress import Progress
from ehlectric.runtime.result_names import MOTION
from ehlectric.runtime.worker_processes import cores

# Folders in the folder of a session: of results and of what is made from them.
OUT, PACKED = "out", "packed"

# Names that an uploaded file may keep: those that no file system reads in another way.
_NAME = re.compile(r"[\w(][\w .()+,-]{0,99}", re.UNICODE)

# Endings of reports.
_REPORTS = ("pdf", "html")

# Formats of figures.
_FORMATS = ("svg", "png")

# Endings of the files of each download.
_ENDINGS: Mapping[Download, tuple[str, ...]] = {
    "csv": (".csv",),
    "netcdf": (".nc",),
    "summary": ("summary.json",),
    "figures": (".svg", ".png"),
    "all": ("",),
}


def uploaded(contents: Mapping[str, bytes], folder: Path) -> Uploaded:
    """Case or sweep of uploaded files. Returns checked tables, or the names of files that are still missing.
    Raises InputError if a file is too large or cannot be used, or the case is not valid.
    """
    _refuse_too_much(contents, folder)
    name, table = _main(contents)
    missing = []
    if isinstance(table.get("case"), str):
        inner = _plain("case", table["case"])
        if inner in contents:
            table["case"] = _tables(inner, contents[inner])
        else:
            missing.append(inner)
    kind = kind_of(table)
    table = _with_opened_names(table)
    missing += [*_with_bearings(table, contents), *_with_gear_files(table, contents)]
    missing += _missing(table, contents, folder)
    if missing:
        return Uploaded(name, kind, table, tuple(dict.fromkeys(missing)))
    names = {_plain(key, path) for key, path in names_in(table)}
    kept = {name: _keep(name, contents, folder) for name in names}
    table = with_names(table, lambda key, path: f"{SURFACES}/{kept[_plain(key, path)][0]}")
    try:
        if kind == "sweep":
            sweep_of(table, folder)
        else:
            run_case_of(table, folder)
    except InputError:
        # Surfaces of a case that is not opened do not stay.
        for stored, new in kept.values():
            if new:
                (folder / SURFACES / stored).unlink(missing_ok=True)
        raise
    return Uploaded(name, kind, table)


def _with_opened_names(table: Mapping[str, Any]) -> dict[str, Any]:
    """Tables in which a name of the library that stands for a table is a key of this table."""
    if isinstance(table.get("case"), Mapping):
        return {**table, "case": _with_opened_names(table["case"])}
    kinds: dict[str, type[Table]] = {
        "drive": DriveCase,
        "bearing": BearingCase,
        "gear": GearCase,
        "axle": AxleCase,
    }
    return opened_names(table, kinds.get(kind_of(table), Case))


def _with_bearings(table: dict[str, Any], contents: Mapping[str, bytes]) -> list[str]:
    """Put the tables of the bearing files that a drive names into its own, and return the missing files."""
    missing = []
    for end in ENDS:
        file = _file_at(table, end)
        if not isinstance(file, str):
            continue
        name = _plain(f"{end}.file", file)
        if name not in contents:
            missing.append(name)
            continue
        further = Inputs({key: value for key, value in table[end].items() if key != "file"}).flat()
        table[end] = dict(changed(Inputs(_tables(name, contents[name])), further).table)
    return missing


def _with_gear_files(table: dict[str, Any], contents: Mapping[str, bytes]) -> list[str]:
    """Put the tables of the gear files that an axle names into its meshes, and return the missing files."""
    missing = []
    meshes = table.get("mesh") if kind_of(table) == "axle" else None
    for mesh in meshes if isinstance(meshes, list) else []:
        file = mesh.get("file") if isinstance(mesh, dict) else None
        if not isinstance(file, str):
            continue
        name = _plain("mesh.file", file)
        if name not in contents:
            missing.append(name)
            continue
        mesh["pair"] = _tables(name, contents[name])
        del mesh["file"]
    return missing


def _refuse_too_much(contents: Mapping[str, bytes], folder: Path) -> None:
    """Raise InputError for too many files at once, and for more than the folder of a session may hold."""
    if len(contents) > MOST_FILES:
        raise InputError("files", got=f"{len(contents)} files", takes=f"at most {MOST_FILES} at once")
    there = sum(path.stat().st_size for path in folder.glob(f"{SURFACES}/*"))
    if there + sum(map(len, contents.values())) > MOST_TOGETHER:
        takes = f"at most {MOST_TOGETHER // 1_000_000} MB in all files of a tab; open a new tab"
        raise InputError("files", got="more", takes=takes)


def _main(contents: Mapping[str, bytes]) -> tuple[str, dict[str, Any]]:
    """Name and tables of the case among uploaded files, which may name the other files."""
    cases = [(name, _tables(name, contents[name])) for name in contents if name.lower().endswith(".toml")]
    if not cases:
        raise InputError("files", got=shown(", ".join(contents)), takes="a case in a .toml file")
    # A sweep names its case, a drive its bearings, and an axle its gear pairs.
    order = ("sweep", "drive", "axle")
    return min(
        cases, key=lambda case: order.index(kind) if (kind := kind_of(case[1])) in order else len(order)
    )


def _tables(name: str, content: bytes) -> dict[str, Any]:
    """Tables of an uploaded file in TOML."""
    if len(content) > MOST_CASE:
        raise InputError(name, f"has {len(content)} bytes", takes=f"a case of at most {MOST_CASE} bytes")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(name, "is not a text file in UTF-8") from None
    return tables_of_text(text.replace("\r\n", "\n").replace("\r", "\n"), name)


def _missing(table: Mapping[str, Any], contents: Mapping[str, bytes], folder: Path) -> tuple[str, ...]:
    """Names of files that tables name and that neither are uploaded nor were before."""
    paths: dict[str, str] = {}
    for key, path in names_in(table):
        name = _plain(key, path)
        if paths.setdefault(name, path) != path:
            raise InputError(key, got=shown(path), takes=f"one file of the name {name}")
    inner = [table.get("case"), *(_file_at(table, end) for end in ENDS)]
    return tuple(
        name
        for name, path in paths.items()
        if path not in inner and name not in contents and not (folder / SURFACES / name).is_file()
    )


def _file_at(table: Mapping[str, Any], end: str) -> Any:
    """Name of the bearing file at an end of a drive; None where it has the tables."""
    bearing = table.get(end)
    return bearing.get("file") if isinstance(bearing, Mapping) else None


def _plain(key: str, path: str) -> str:
    """Name of a file without its folders. Raises InputError if it is no name that a file of the session may
    have.
    """
    name = PureWindowsPath(PurePosixPath(path).name).name
    if not _NAME.fullmatch(name) or name.endswith((" ", ".")):
        raise InputError(key, got=shown(path), takes="a file with a name of letters, digits, - and _")
    return name


def _keep(name: str, contents: Mapping[str, bytes], folder: Path) -> tuple[str, bool]:
    """Store an uploaded surface in the folder of the session; its name there, and whether it is new.

    A stored file never changes, because answers are kept by the inputs that name it: another content of the
    same name gets a name of its own. A name that is not uploaded means its last content.
    """
    place = folder / SURFACES
    stored = list(takewhile(lambda other: (place / other).exists(), _names_like(name)))
    if name not in contents:
        return stored[-1], False
    content = contents[name]
    if len(content) > MOST_SURFACE:
        takes = f"a surface of at most {MOST_SURFACE} bytes"
        raise InputError(name, f"has {len(content)} bytes", takes=takes)
    if stored and (place / stored[-1]).read_bytes() == content:
        return stored[-1], False
    place.mkdir(exist_ok=True)
    new = next(islice(_names_like(name), len(stored), None))
    (place / new).write_bytes(content)
    return new, True


def _names_like(name: str) -> Iterator[str]:
    """Names of the contents of a file, from the first: a.csv, a (2).csv, a (3).csv."""
    path = PurePosixPath(name)
    yield name
    yield from (f"{path.stem} ({number}){path.suffix}" for number in count(2))


def write(table: Mapping[str, Any], contacts: str, folder: Path, progress: Progress) -> Written:
    """Solve a case as the command does, and write its files but the figures, which ``drawn`` adds.

    ``contacts``, "atlas", "formula" or "solved" for a bearing or a gear pair; empty where the case decides.
    Returns files in a folder of the session, which earlier files leave. Raises InputError, ConvergenceError,
    LostError as the command raises them.
    """
    kind, case = kind_of(table), run_case_of(table, folder)
    options: dict[str, Any] = {"contacts": contacts} if contacts else {}
    if kind == "bearing":
        # As many jobs run at once as there are pairs of cores.
        options["workers"] = min(2, cores())
    out = folder / OUT
    shutil.rmtree(out, ignore_errors=True)
    outcome = RUNS[kind].run(case, out, progress, **options)
    names = tuple(path.name for path in outcome.files)
    return Written(str(out), names, outcome.failure or "", page_warnings_of(outcome.warnings))


def packed(out: Path, what: Download, table: Mapping[str, Any], title: str, folder: Path) -> str:
    """File to download: the only file of a kind, or an archive of all. Raises InputError if the result has no
    such file.
    """
    files = [path for path in sorted(out.iterdir()) if _offered(path, _ENDINGS[what])]
    if not files:
        raise InputError.worded(what, "is not among the files of this result")
    if len(files) == 1 and what != "all":
        return str(files[0])
    (folder / PACKED).mkdir(exist_ok=True)
    target = folder / PACKED / f"{title}-{what}.zip"
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in files:
            archive.write(path, path.name)
        if what == "all":
            archive.writestr(f"{title}.toml", Inputs(table).toml())
            for name in _surfaces(table, folder):
                archive.write(folder / name, name)
    return str(target)


def drawn(
    out: Path, what: Download, table: Mapping[str, Any], title: str, folder: Path, progress: Progress
) -> str:
    """File to download as ``packed`` makes it, after the figures of a result without any are drawn."""
    from ehlectric.figures.result_figures import draw_figures

    progress(0, 0, "drawing figures")
    path = stored_result(out)
    draw_figures(read_motion(path) if path.name == MOTION else load(path), out, formats=_FORMATS)
    return packed(out, what, table, title, folder)


def _offered(path: Path, endings: Iterable[str]) -> bool:
    """Whether a file of a result is offered: no link, no folder and no hidden file."""
    named = any(path.name.endswith(ending) for ending in endings)
    return named and path.is_file() and not path.is_symlink() and not path.name.startswith(".")


def _surfaces(table: Mapping[str, Any], folder: Path) -> list[str]:
    """Names of the files that a case names, relative to the folder of its session."""
    run_case_of(table, folder) if kind_of(table) != "sweep" else sweep_of(table, folder)
    return sorted({name for _, name in names_in(table) if not Path(name).is_absolute()})


def converted(out: Path, ending: str, title: str, folder: Path, progress: Progress) -> str:
    """Report on a result, or its file for another program, and the path of it. Raises InputError if the
    result has no such form, or a package is missing.
    """
    of_report = ending in _REPORTS
    progress(0, 0, "writing the report" if of_report else "converting the result")
    (folder / PACKED).mkdir(exist_ok=True)
    target = folder / PACKED / f"{title}.{ending}"
    if of_report:
        import_module("ehlectric.report.written_report").write_report(out, target)
    else:
        import_module("ehlectric.runs.exports").export(out, target)
    return str(target)
