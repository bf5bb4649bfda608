"""Tables written from the code before every build: keys of a case, commands, variables, the paper's contacts.

What the code knows (units, bounds, defaults, options, the meaning of a law's parameter, keys of
summary.json, descriptions of the keys of a case) is read from it. A page that names a test that is not there
ends the build.
"""

from __future__ import annotations

import csv
import inspect
import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module, resources
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal, get_args, get_origin

import typer
from equation_pages import equation_pages
from oil_tables import oil_pages
from result_keys import summary_pages
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from warning_pages import warning_pages

import ehlectric
from ehlectric import Case, solve
from ehlectric.cases import contact_inputs, library, roughness_inputs
from ehlectric.cases import table as validation
from ehlectric.cases.amounts import Amount, Amounts, Count
from ehlectric.cases.gear_inputs import OfBothGears
from ehlectric.cases.input_keys import descriptions, tables_of_files
from ehlectric.cases.library.bearing_catalogue import CatalogueBearing, bearing_catalogue
from ehlectric.cases.library.library_oils import Grade, Source
from ehlectric.cases.oil_inputs import LAWS
from ehlectric.commands.command_line import app as commands
from ehlectric.formulas import load_ratings as ratings
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import read_motion
from ehlectric.quantities.lubrication_states import bands
from ehlectric.quantities.units import printed
from ehlectric.sweep import sweep_inputs

_TABLES = {**tables_of_files(), "sweep": sweep_inputs.Sweep}
# Keys that take a name, by what the names stand in.
_NAMES: dict[str, Iterable[str]] = {
    **LAWS,
    "generator": roughness_inputs.GENERATORS,
    "element_material": library.solid_names(rolling=True),
    "ring_material": [
        name for name in library.solid_names(rolling=True) if library.solid(name)["conducting"]
    ],
    "shaft_material": library.solid_names(),
    "housing_material": library.solid_names(),
}
# What a small contact of each kind has of its own, and units as they are printed.
_CONTACTS = {"line": {"reduced_radius": 0.01}, "point": {"radius_x": 0.01, "radius_y": 0.01}}
# A discharge whose summary has every source, and the length that only a line has.
_PIT = {"efficiency": 0.1, "melting_energy": 1e10}
_EVERYTHING = {"conductivity": 1e-12, "external_capacitance": 1e-9, "peak_current": 0.1, "pit": _PIT}
_LENGTHS = {"line": {"length": 0.01}, "point": {}}
_UNITS = {"1": "\N{EN DASH}", "F/m^2": "F/m\N{SUPERSCRIPT TWO}"}


def _row(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def table_text(head: list[str], rows: Iterable[list[str]]) -> str:
    return "\n".join([_row(head), _row(["---"] * len(head)), *map(_row, rows)]) + "\n"


def _number(value: float) -> str:
    if isinstance(value, int):
        return str(value)
    mantissa, _, exponent = f"{value:g}".partition("e")
    if mantissa.strip("-") == "100000" and not exponent:
        mantissa, exponent = mantissa[:-5], "5"
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _bounds(given: Amount | Count) -> str:
    low, high = given.least, given.most
    above, below = getattr(given, "above", low), getattr(given, "below", high)
    left = f"above {_number(above)}" if above > low else _number(low)
    right = f"below {_number(below)}" if below < high else _number(high)
    return f"{left} to {right}".replace("-", "\N{MINUS SIGN}")


def _find(annotation: Any, metadata: Iterable[Any]) -> Any:
    """The Amount, Amounts, Count, literal strings or table behind an annotation."""
    for item in metadata:
        if isinstance(item, Amount | Amounts | Count | Grade):
            return item
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    if get_origin(annotation) in (Mapping, dict):
        return validation.Table
    if isinstance(annotation, type) and issubclass(annotation, validation.Table):
        return annotation
    for part in get_args(annotation):
        found = _find(part, getattr(part, "__metadata__", ()))
        if found is not None:
            return found
    return None


def _takes(name: str, found: Any, *, pair: bool) -> str:
    """Values that a key accepts, with their unit and the reason for their bounds."""
    if name in _NAMES:
        return ", ".join(f'`"{name}"`' for name in _NAMES[name])
    if name == "film_factor":
        return '`"none"`, `"inlet-shear"`, `"solved"`, or a number above 0 and at most 1'
    if name == "bulk_temperature":
        return '`"iso"`, or 200 to 600 K'
    if name == "teeth":
        return "two whole numbers from 4; the second one negative for a ring"
    if name in ("column", "time_column"):
        return "a string, or a whole number from 1"
    if isinstance(found, Grade):
        return f'{found.takes}, as `46` or `"ISO VG 46"`'
    if isinstance(found, Amounts):
        several = found.several if isinstance(found, OfBothGears) else f"a list of {found.least} or more"
        return f"{several}, each {_takes(name, found.each, pair=False)}"
    if isinstance(found, Amount | Count):
        unit = f" {printed(found.unit)}" if isinstance(found, Amount) and found.unit else ""
        kind = "whole, " if isinstance(found, Count) else "two, each " if pair else ""
        return f"{kind}{_bounds(found)}{unit}: {found.reason}"
    if isinstance(found, tuple):
        return ", ".join(f'`"{v}"`' if isinstance(v, str) else f"`{v}`" for v in found)
    return "a table" if isinstance(found, type) else "a string"


def _default(field: Any) -> str:
    if field.is_required():
        return "required"
    value = field.default
    if value is None or isinstance(value, validation.Table):
        return "–"
    if isinstance(value, tuple):
        return f"`[{', '.join(map(_number, value))}]`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return f'`"{value}"`' if isinstance(value, str) else f"`{_number(value)}`"


def _keys(table: str, model: type[validation.Table]) -> Iterator[list[str]]:
    meanings = descriptions(table)
    for name, field in model.known_keys().items():
        found = _find(field.annotation, field.metadata)
        takes = _takes(name, found, pair=get_origin(field.annotation) is tuple)
        default = "–" if field.default_factory is not None else _default(field)
        yield [f"`{name}`", meanings[name], takes, default]


def _word(argument: Any) -> str:
    """Word that stands for an argument, as the command prints it."""
    return argument.metavar or argument.name.upper()


def _command(name: str, command: Any) -> Iterator[str]:
    """Usage, help, arguments and options of one command."""
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    options = [p for p in command.params if p.param_type_name == "option"]
    options = [p for p in options if not p.hidden]
    words = [_word(p) if p.required else f"[{_word(p)}]" for p in arguments]
    yield f"## ehlectric {name}\n"
    yield f"```text\nehlectric {name} {'[OPTIONS] ' if options else ''}{' '.join(words)}\n```\n"
    yield command.help.strip() + "\n"
    examples = (command.epilog or "").partition("Examples:\n")[2]
    yield f"```text\n{inspect.cleandoc(examples)}\n```\n"
    rows = []
    for p in [*arguments, *options]:
        written = (
            ", ".join(f"`{o}`" for o in [*p.opts, *p.secondary_opts]) if p in options else f"`{_word(p)}`"
        )
        default = "" if p.default in (None, False, "") or p.required else f"`{p.default}`"
        # Words in place of a default that the machine decides.
        default = p.show_default if isinstance(getattr(p, "show_default", None), str) else default
        rows.append([written, getattr(p, "help", None) or "", "on" if p.default is True else default])
    yield table_text(["argument or option", "what it does", "default"], rows)


def _write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "_generated"
    folder.mkdir(exist_ok=True)
    head = ["key", "meaning", "expected value", "default"]
    pages = {}
    for table, model in _TABLES.items():
        pages[f"keys_{table.replace('.', '_')}"] = "```{rst-class} keys\n```\n\n" + table_text(
            head, _keys(table, model)
        )
    pages["generators"] = table_text(
        ["generator", "required keys", "optional keys"],
        [
            [f'`"{name}"`', *(", ".join(f"`{key}`" for key in keys) or "–" for keys in rows)]
            for name, rows in roughness_inputs.GENERATORS.items()
        ],
    )
    for geometry, alternatives in contact_inputs.CONTACT_ALTERNATIVES.items():
        pages[f"alternatives_{geometry}"] = "\n".join(
            "- " + ", or ".join(" and ".join(f"`{key}`" for key in row) for row in rows)
            for rows in alternatives
        )
    group = typer.main.get_command(commands)
    pages["commands"] = "\n".join(
        text for name, command in group.commands.items() for text in _command(name, command)
    )
    pages |= {f"library_{kind}": _library(kind) for kind in ("solids", "coatings")}
    pages |= {"catalogue": _catalogue()}
    pages["catalogue_sources"] = _catalogue_sources()
    pages["estimated_bearings"] = _estimated_bearings(Path(app.srcdir) / "data" / "estimated_bearings.csv")
    for name, file in (("bearing", "bearing_6208"), ("motion", "moving_roughness")):
        pages[f"{name}_example"] = _example(Path(app.srcdir).parent / "examples" / f"{file}.toml")
    pages["lubrication_states"] = table_text(
        ["state", "lambda ratio for $k = 2$", "meaning"],
        [[state.name, text, state.meaning] for state, _, _, text in reversed([*bands(2.0)])],
    )
    for geometry in _CONTACTS:
        result = solve(_small(geometry))
        pages[f"variables_{geometry}"] = _variables(result.to_xarray())
    pages["variables_motion"] = _variables(_moved(_small("line")))
    pages |= summary_pages() | oil_pages() | warning_pages() | equation_pages(Path(app.srcdir))
    for name, text in pages.items():
        path = folder / f"{name}.md"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def _small(geometry: str) -> Case:
    """A small rough contact."""
    contact = {"geometry": geometry, "reduced_modulus": 2e11, "max_hertz_pressure": 1e9}
    contact |= {"entrainment_speed": 2.0} | _CONTACTS[geometry]
    rough = {"surface": 1, "generator": "sinusoid", "amplitude": 1e-9, "wavelength": 1e-4}
    grid = {"nodes": 401 if geometry == "line" else 65}
    case = {"contact": contact, "lubricant": {"base": "paper"}, "roughness": [rough], "grid": grid}
    return Case.from_dict(case | {"discharge": _EVERYTHING | _LENGTHS[geometry]})


def _moved(case: Case) -> Any:
    """A short motion that has everything: at its end the roughness lies as in the case."""
    changed = {"grid.nodes": 201, "motion": {"passes": 1.0, "record": 2}}
    with TemporaryDirectory() as folder:
        run_motion(case.replace(changed | {"discharge": {"dielectric_strength": 15e6}}), folder)
        return read_motion(folder)


def _variables(dataset: Any) -> str:
    """Variables of a dataset."""
    return table_text(
        ["variable", "over", "meaning", "unit"],
        [
            [
                f"`{name}`",
                ", ".join(f"`{d}`" for d in v.dims),
                v.attrs["long_name"],
                _UNITS.get(v.attrs["units"], v.attrs["units"]),
            ]
            for name, v in dataset.variables.items()
        ],
    )


def _example(path: Path) -> str:
    """A file without its comments."""
    lines = [line.partition("#")[0].rstrip() for line in path.read_text(encoding="utf-8").splitlines()]
    return "```toml\n" + "\n".join(filter(None, lines)).replace("\n[", "\n\n[") + "\n```\n"


def _library(kind: str) -> str:
    """Solids or coatings of the library, with where their numbers are from."""
    rows = []
    for name in getattr(library, f"{kind[:-1]}_names")():
        path = resources.files(library) / kind / f"{name}.toml"
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        values = ", ".join(f"{key.replace('_', ' ')} {_value(v)}" for key, v in table[kind[:-1]].items())
        source = table["source"]
        rows.append([f'`"{name}"`', values, source["citation"], source.get("assumption", "\N{EN DASH}")])
    return "```{rst-class} sources\n```\n\n" + table_text(["name", "values", "source", "assumption"], rows)


def _catalogue() -> str:
    """Bearings of the library: dimensions, and both load ratings, printed and computed."""
    rows = []
    for bearing in bearing_catalogue():
        lengths = (bearing.bore, bearing.outer_diameter, bearing.width)
        sizes = filter(None, (bearing.element_diameter, bearing.roller_length))
        elements = " × ".join([str(bearing.elements), *(f"{1e3 * size:.5g}" for size in sizes)])
        angle = f"{math.degrees(bearing.contact_angle):.4g}°" if bearing.contact_angle else ""
        cells = [f'`"{bearing.name}"`', *(f"{1e3 * size:.4g}" for size in lengths), elements]
        cells += [f"{1e3 * bearing.pitch_diameter:.5g}", angle]
        rows.append([*cells, *_ratings(bearing), bearing.internal_kind or ""])
    head = ["name", "bore", "outer", "width", "elements", "pitch", "angle", "$C$", "$C_0$", "elements are"]
    return table_text(head, rows)


def _ratings(bearing: CatalogueBearing) -> list[str]:
    """Printed ratings [kN], each with the deviation of the computed one."""
    if bearing.rating is None:
        return ["", ""]
    sizes = (bearing.elements, bearing.element_diameter, bearing.pitch_diameter)
    if bearing.roller_length is None:
        last, found = bearing.contact_angle, (ratings.ball_dynamic_rating, ratings.ball_static_rating)
    else:
        last, found = bearing.roller_length, (ratings.roller_dynamic_rating, ratings.roller_static_rating)
    printed = (bearing.rating.dynamic, bearing.rating.static)
    return [
        f"{1e-3 * force:.4g} ({_deviation(rate(*sizes, last) / force - 1)})"
        for force, rate in zip(printed, found, strict=True)
    ]


def _deviation(relative: float) -> str:
    """Deviation in per cent with its sign, or 0 where it is rounded to 0; it is not broken into two lines."""
    rounded = round(100.0 * relative, 1)
    text = f"{rounded:+.1f}".replace("-", "\N{MINUS SIGN}") if rounded else "0"
    return f"{text}\N{NO-BREAK SPACE}%"


def _estimated_bearings(path: Path) -> str:
    """Bearings of the library beside their estimates, with errors in per cent."""
    with path.open(encoding="utf-8") as file:
        found = list(csv.DictReader(file))
    head = ["bearing", "known elements", "source", "estimated", "pitch", "length", "capacitance", "breakdown"]
    errors = ("pitch_error", "length_error", "capacitance_error", "breakdown_error")
    return table_text(
        head,
        [
            [
                f"`{row['bearing']}`",
                f"{row['elements']} × {float(row['diameter']):.5g}",
                row["known"],
                f"{row['estimated_elements']} × {float(row['estimated_diameter']):.5g}",
                *(_deviation(0.01 * float(row[name])) if row[name] else "" for name in errors),
            ]
            for row in found
        ],
    )


def _catalogue_sources() -> str:
    """Sources of the values of the bearings; a source of several bearings is one row."""
    names: dict[Source, list[str]] = {}
    for bearing in bearing_catalogue():
        for source in bearing.sources:
            names.setdefault(source, []).append(f"`{bearing.name}`")
    rows = [
        [
            ", ".join(given),
            ", ".join(f"`{key}`" for key in source.keys),
            source.kind,
            " ".join(filter(None, (source.citation, source.doi and f"doi:{source.doi}"))),
            source.note,
        ]
        for source, given in sorted(names.items(), key=lambda item: -len(item[1]))
    ]
    return table_text(["bearings", "values", "kind", "source", "note"], rows)


def _value(value: Any) -> str:
    return (
        str(value).lower() if isinstance(value, bool) else str(value).replace("^3", "\N{SUPERSCRIPT THREE}")
    )


def _check_tests(app: Sphinx) -> None:
    """Tests that a page names must be there."""
    root = Path(app.srcdir)
    sources = "".join(path.read_text(encoding="utf-8") for path in (root.parent / "tests").rglob("*.py"))
    for page in root.glob("*.md"):
        for name in re.findall(r"`(test_\w+)`", page.read_text(encoding="utf-8")):
            if f"def {name}(" not in sources:
                raise ExtensionError(f"{page.name} names {name}, which is no test")


_PUBLIC = """# API

These names are imported from `ehlectric` itself, and are the stable public API. A script needs no others.
[From Python](../howto/python.md) shows their use. Everything else is in the [internal modules](internals.md),
which may change between versions.

{}
```{{toctree}}
:hidden:

internals
```
"""
_INTERNAL = """# Internal modules

A script does not need these modules: [API](index.md) has the public names. They may change between versions.
A package imports from packages below it on this page, never from packages above it;
[Architecture](../project/architecture.md) has the map.
"""

# Headings of the page of the public names, each with its names in the order of their use.
_GROUPS = {
    "Solve": (
        "solve",
        "solve_many",
        "solve_bearing",
        "solve_motion",
        "evaluate",
        "run_sweep",
        "run_motion",
        "film_factors",
        "calibrate",
    ),
    "Cases": ("Case", "LineCase", "PointCase", "BearingCase", "Sweep", "example"),
    "Without a solution": ("check", "film", "formulas", "surface"),
    "Oils and bearings of the library": ("oil", "oils", "bearings"),
    "Results": (
        "Result",
        "PointResult",
        "BearingResult",
        "MotionResult",
        "SweepResults",
        "Laws",
        "FilmFactors",
        "Calibration",
        "Solved",
    ),
    "Warnings and verdicts": ("ResultWarning", "Verdict"),
    "Files": ("save", "load", "read_sweep", "read_motion"),
    "Figures": ("figure", "figure_names", "save_figures"),
    "Reports": ("write_report", "export"),
    "Drives": ("solve_drive", "DriveCase", "DriveResult", "write_netlist", "write_drive_netlist"),
    "Gears": ("solve_gear", "GearCase", "GearResult"),
    "Axles": ("solve_axle", "AxleCase", "AxleResult", "write_axle_netlist"),
    "Errors": ("InputError", "ConvergenceError", "LostError"),
}


def _autosummary(names: Iterable[str]) -> str:
    rows = "".join(f"   {name}\n" for name in names)
    return f"```{{eval-rst}}\n.. autosummary::\n   :toctree: generated\n\n{rows}```\n"


def _public() -> str:
    """The page of the public names; every one of them is in a group."""
    grouped = [name for names in _GROUPS.values() for name in names]
    public = {name for name in ehlectric.__all__ if name[:2] != "__"}
    if len(grouped) != len(public) or set(grouped) != public:
        raise ExtensionError(f"names without a group: {sorted(set(grouped) ^ public)}")
    parts = []
    for head, names in _GROUPS.items():
        parts.append(f"## {head}\n\n{_autosummary(f'~ehlectric.{name}' for name in names)}")
    return _PUBLIC.format("\n".join(parts))


def _internal(root: Path) -> str:
    """The page of all modules by their package, in the order of the import contract."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    layers = project["tool"]["importlinter"]["contracts"][0]["layers"]
    page = _INTERNAL
    for name in (part.strip() for layer in layers for part in layer.split("|")):
        package = Path(ehlectric.__file__).parent / name
        if not package.is_dir():
            continue
        page += f"\n## {name}\n\n{import_module(f'ehlectric.{name}').__doc__}\n\n"
        paths = sorted(package.rglob("*.py"), key=lambda path: (len(path.parts), path))
        modules = [path.relative_to(package.parent).with_suffix("").parts for path in paths]
        page += _autosummary(
            "ehlectric." + ".".join(module[:-1] if module[-1] == "__init__" else module)
            for module in modules
            if module != (name, "__init__")
        )
    return page


def _write_api(folder: Path) -> None:
    """Pages of the API: the public names, and the internal modules apart."""
    for name, page in (("index", _public()), ("internals", _internal(folder.parents[1]))):
        target = folder / f"{name}.md"
        if not target.exists() or target.read_text(encoding="utf-8") != page:
            folder.mkdir(exist_ok=True)
            target.write_text(page, encoding="utf-8")


def _shortened(*event: Any) -> tuple[str, str | None] | None:
    """Signature without the values of default tables, which fill lines; the guide lists them."""
    *_, signature, returned = event
    if signature is None:
        return None
    return re.sub(r"=[A-Z]\w*\((?:[^()]|\([^()]*\))*\)", "=...", signature), returned


def setup(app: Sphinx) -> dict[str, Any]:
    """Pages are written before Sphinx looks for them, tables before they are read."""
    _write_api(Path(app.srcdir) / "api")
    for constructor in (ehlectric.Case.line, ehlectric.Case.point, ehlectric.BearingCase.of):
        # Sphinx looks up defaults in the source, where the keys of a TypedDict are not.
        del constructor.__func__.__signature__
    app.setup_extension("sphinx.ext.autodoc")  # it defines the event
    app.connect("autodoc-process-signature", _shortened)
    app.connect("builder-inited", _write, priority=100)
    app.connect("builder-inited", _check_tests, priority=50)  # before figures are drawn
    return {"parallel_read_safe": True}
