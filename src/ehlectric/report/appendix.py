"""Appendix of a report: inputs with their origin, limits, sources, versions and the input file."""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from importlib.metadata import version
from itertools import groupby
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.amounts import INFINITE, Amount
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.axle_keys import LOADS
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import describe, input_field, input_of, kind_of, of_both_ends
from ehlectric.cases.library.estimated_bearings import estimated_file, is_estimated
from ehlectric.cases.library.library_oils import KINDS, Source, sources_of
from ehlectric.cases.oil_inputs import Properties
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import InputError, printable, shown
from ehlectric.figures.figure_names import with_units_kept
from ehlectric.quantities.inputs import BOTH, ENDS, REPLACED, end_and_key, input_at
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.rows import value_at
from ehlectric.readable import file_text
from ehlectric.report.report_content import DOI, Block, Cell, Link, Named, Section, Table, Text
from ehlectric.report.report_texts import SENTENCES, TEXTS, conditions_of, limits_of, references_of
from ehlectric.runtime.display import is_number
from ehlectric.tables.html_tables import input_row
from ehlectric.version import __version__

# Words for the origin of an input that is not a value of the library.
WORDS = ("given", "default", "varied")

# Kinds of sources that a reader may take for knowledge without a note.
_KNOWN = KINDS[: KINDS.index("by rule")]

# Tables that may name a base of the library: their dotted key, and the folder of the library.
_BASES = (("lubricant", "lubricant"), ("bearing", "bearing"), ("bearing.coating", "coating"))

# What stands before the keys of two equal bearings of a drive.
_BOTH = f"{BOTH}."


@dataclass(frozen=True)
class Input:
    """Input of a case with its origin."""

    key: str  # dotted key; the tables of rough surfaces are numbered from 1
    value: Any
    origin: str  # one of ``WORDS``, or the name of the file of the library
    source: Source | None = None  # source of a value of the library; None for others

    @property
    def assumed(self) -> bool:
        """Whether the library itself only assumes or estimates the value, or derives it by a rule."""
        return self.source is not None and self.source.kind not in _KNOWN


def inputs_of(case: SolvedCase, *, apart: bool = False) -> Iterator[Input]:
    """Inputs of a case in the order of its tables, without the title and the remedies of a drive.

    A value is a library value where it equals the value of the base that the case names, and a default
    where it equals the default of its key: a case does not keep whether somebody typed it.
    """
    tables = _tables(case, apart=apart)
    of_library = {
        f"{before}{key}": value
        for before, table in parts_of(case, apart=apart).items()
        for key, value in _library_values(table).items()
    }
    for key, value in flattened(numbered(tables)).items():
        if end_and_key(key)[1] == "title" or value == {}:
            continue
        name, source, theirs = of_library.get(key, ("", None, None))
        if name and _equal(value, theirs):
            yield Input(key, value, name, source)
        else:
            yield Input(key, value, "default" if _is_default(key, value) else "given")


def _tables(case: SolvedCase, *, apart: bool) -> dict[str, Any]:
    """Nested tables of the inputs that are set; two equal bearings of a drive are one."""
    tables = case.model_dump(mode="json", exclude_none=True, exclude_unset=True)
    tables.pop("remedies", None)
    for end in ENDS if isinstance(case, DriveCase) and case.rotor is not None else ():
        for load in LOADS if end in tables else ():
            # It follows from the rotor.
            tables[end]["bearing"].pop(load, None)
    if isinstance(case, AxleCase):
        tables["mesh"] = [_with_gear_keys(mesh) for mesh in tables.get("mesh", ())]
    if isinstance(case, DriveCase):
        bearings = {before[:-1]: tables[ENDS[0]] for before in parts_of(case, apart=apart) if before == _BOTH}
        if bearings:
            tables = {key: value for key, value in tables.items() if key not in ENDS} | bearings
    return tables


def parts_of(case: SolvedCase, *, apart: bool = False) -> dict[str, Case | BearingCase | GearCase]:
    """Cases of contacts, bearings or gear pairs in a case, by what stands before their keys."""
    if isinstance(case, AxleCase):
        return {**case.parts()}
    if not isinstance(case, DriveCase):
        return {"": case}
    if case.drive_end == case.non_drive_end and not apart:
        return {_BOTH: case.drive_end}
    return {f"{end}.": getattr(case, end) for end in ENDS}


def _with_gear_keys(mesh: Mapping[str, Any]) -> dict[str, Any]:
    """Table of a mesh with the keys of its gear file that the axle uses."""
    pair = {key: value for key, value in mesh["pair"].items() if key in ("contacts", "gear")}
    return {key: value for key, value in mesh.items() if key != "pair"} | pair


def input_text(case: SolvedCase, key: str, value: Any) -> str:
    """Value of an input as a report shows it, in a unit that suits it."""
    if value == INFINITE:
        return "infinite, a plane"
    if key.endswith(".file"):
        value = file_text(value)
    text = input_row(case, key, value).text
    return with_units_kept(printable(text.replace("ohm", "Ω") if is_number(value) else text))


def replaced_by(case: SolvedCase, key: str) -> str:
    """Key of a drive whose value replaces the value of its bearings; empty where none does."""
    end, inner = end_and_key(key)
    return REPLACED[inner] if end and isinstance(case, DriveCase) and inner in case.replaced else ""


def numbered(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Tables in which lists of tables, as of rough surfaces, are tables by their numbers from 1."""
    return {
        key: {str(number): item for number, item in enumerate(value, 1)}
        if isinstance(value, list) and all(isinstance(item, dict) for item in value)
        else value
        for key, value in tables.items()
    }


def _equal(value: Any, other: Any) -> bool:
    """Whether two values are equal, numbers within their rounding."""
    if isinstance(value, float | int) and isinstance(other, float | int):
        return abs(value - other) <= 1e-12 * abs(value)
    return bool(value == other)


def _is_default(key: str, value: Any) -> bool:
    if end_and_key(key)[1] == "contacts":
        return bool(value == BearingCase.known_keys()["contacts"].default)
    try:
        field = input_field(key)
    except InputError:
        # The key of a table or of a list has no single default.
        return False
    return not field.is_required() and _equal(value, field.default)


def _library_values(case: Case | BearingCase | GearCase) -> dict[str, tuple[str, Source | None, Any]]:
    """Values of the bases that a case names, by dotted key: name of the file, source, and value."""
    values: dict[str, tuple[str, Source | None, Any]] = {}
    given = case.model_dump(mode="json", exclude_none=True, exclude_unset=True)
    for table, folder in _BASES:
        base = value_at(given, f"{table}.base")
        if base is None:
            continue
        file = _file_of(folder, base, given)
        sources = _sources_of_inputs(file)
        # A single source may hold for the whole file; else each key has its own.
        whole = sources[0] if len(sources) == 1 and not sources[0].keys else None
        for key, value in _values(folder, base, file[folder]).items():
            if key == "base":
                continue
            source = next((candidate for candidate in sources if key in candidate.keys), whole)
            values[f"{table}.{key}"] = (base, source, value)
    return values


def _file_of(folder: str, base: str, given: Mapping[str, Any]) -> Mapping[str, Any]:
    """File of the library of a base, or the file of a bearing whose geometry is estimated."""
    if folder != "bearing" or not is_estimated(base):
        return library.tables(folder, base)
    ratings = (value_at(given, f"bearing.life.{name}_rating") for name in ("dynamic", "static"))
    return estimated_file(base, *ratings)


def _sources_of_inputs(file: Mapping[str, Any]) -> tuple[Source, ...]:
    """Sources of a file of the library; a file with a single source has it for all of its values."""
    source = file.get("source")
    if not isinstance(source, Mapping):
        return sources_of(file)
    return (
        Source(
            (), "published", source.get("citation", ""), source.get("doi", ""), source.get("assumption", "")
        ),
    )


def _values(folder: str, base: str, table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a file of the library in SI units, by dotted key."""
    if folder == "lubricant":
        oil = Properties.from_written({"base": base})
        return flattened(oil.model_dump(mode="json", exclude_none=True, exclude_unset=True))
    prefix = "bearing" if folder == "bearing" else "bearing.coating"
    values = {}
    for key, value in table.items():
        kind = kind_of(f"{prefix}.{key}")
        values[key] = kind.parse(value, written=True) if isinstance(kind, Amount) else value
    return values


def material_sources(case: SolvedCase) -> Iterator[tuple[str, Source]]:
    """Names and sources of the solids of the library that bearings, gears or a contact are made of."""
    for name in dict.fromkeys(name for part in parts_of(case).values() for name in _materials(part)):
        for source in _sources_of_inputs(library.tables("solid", name)):
            yield name, source


def _materials(case: Case | BearingCase | GearCase) -> Iterator[str]:
    """Solids of the library that a case names."""
    if isinstance(case, GearCase):
        yield case.gear.material
        return
    if isinstance(case, Case):
        bodies = (case.contact.body_1, case.contact.body_2)
        yield from (body.material for body in bodies if body is not None and body.material is not None)
        return
    table, known = case.to_dict()["bearing"], library.solid_names()
    values = {**table, **table.get("fits", {})}.items()
    yield from (value for key, value in values if key.endswith("_material") and value in known)


# Heads of the tables of inputs, and shares of their columns.
_HEADS, _SHARES = ("input", "value", "origin", "meaning"), (0.25, 0.19, 0.21, 0.35)
# Keys of the dielectric strength, which no measurement of films gives.
_STRENGTHS = tuple(f"discharge.{name}" for name in ("dielectric_strength", "weibull", "strength_table"))

# Names of the bearings of a drive by the first word of their keys.
_PLACES = {BOTH: "both bearings", **{end: f"bearing at the {name}" for end, name in NAMES_OF_ENDS.items()}}


def _place(end: str) -> str:
    """Words for the name before a key: a bearing of a drive, or a part of an axle.

    Examples
    --------
    >>> _place("drive_end"), _place("mesh.1"), _place("bearing.rotor"), _place("")
    ('bearing at the drive end', 'mesh 1', 'bearing rotor', '')
    """
    return _PLACES.get(end, end.replace(".", " ").replace("*", "of all"))


def varied_keys(varied: Sequence[str]) -> tuple[set[str], bool]:
    """Varied keys, with the keys of both bearings that one stands for; whether only one bearing varies."""
    keys = {either_end for key in varied for either_end in (key, *of_both_ends(key))}
    return keys, any(end_and_key(key)[0] in ENDS for key in varied)


def input_sections(
    case: SolvedCase, varied: Sequence[str] = (), rests: Sequence[Block] = ()
) -> Iterator[Section]:
    """Section of what a result rests on: ``rests`` and the inputs that are assumptions; and section of all
    inputs with their origin.
    """
    either, apart = varied_keys(varied)
    inputs = [
        replace(entry, origin="varied", source=None) if entry.key in either else entry
        for entry in inputs_of(case, apart=apart)
    ]
    yield Section("What it rests on", (*rests, *_assumptions(case, inputs)))
    numbers = {source: number for number, source in enumerate(_sources(inputs), 1)}
    blocks: list[Block] = [Text(SENTENCES["input_values"])]
    if either:
        blocks.append(Text(SENTENCES["varied_inputs"]))
    for name, group in groupby(inputs, key=lambda entry: entry.key.partition(".")[0]):
        rows = tuple(_input_cells(case, entry, numbers) for entry in group)
        blocks.append(Table(f"Inputs: {_PLACES.get(name, name)}", _HEADS, rows, shares=_SHARES))
    yield Section("Inputs", tuple(blocks))


def named(key: str) -> Named:
    """Name of an input by its dotted key, with the bearing of a drive that it belongs to.

    Examples
    --------
    >>> named("circuit.winding_rotor_capacitance").text, named("bearings.bearing.radial_load").text
    ('winding-rotor capacitance', 'radial load, both bearings')
    """
    end, inner = end_and_key(key)
    entry = input_of(inner)
    label = inner.rpartition(".")[2].replace("_", " ") if entry is None else entry.label
    return Named(", ".join(filter(None, [label, _place(end).removeprefix("bearing at the ")])), key)


def worded(text: str) -> str:
    """Text with the names of inputs instead of their keys.

    Examples
    --------
    >>> worded("instead of bearing.inner_speed, within V/h_min of events.csv")
    'instead of speed of the inner ring, within V/h_min of events.csv'
    >>> worded("summits of 2 times composite_rq")
    'summits of 2 times composite roughness Rq'
    """
    return _KEY.sub(_name_of_key, text)


# Words that are keys of files; symbols such as h_min are none. Tables of keys without one.
_KEY = re.compile(r"\b[a-z]{2,}(?:[._][a-z0-9]+)+\b")
_TABLES = (
    "bearing", "circuit", "breakdown", "source", "drive", "discharge", "lubricant", "lubricant.temperature",
    "contact", "grid", "film", "gear", "gear.operation", "gear.contact",
)  # fmt: skip


def _name_of_key(match: re.Match[str]) -> str:
    word = match[0]
    if word in NAMES_OF_ENDS:
        return NAMES_OF_ENDS[word]
    known = (input_at(key) for key in (word, *(f"{table}.{word}" for table in _TABLES)))
    return next((about.label for about in known if about is not None and about.label), word.replace("_", " "))


def given_inputs(case: SolvedCase, varied: Sequence[str] = ()) -> str:
    """Inputs with their values in a line, without defaults, values of the library, varied inputs, and inputs
    of bearings that a drive replaces.
    """
    left_out = varied_keys(varied)[0]
    given = [
        entry
        for entry in inputs_of(case)
        if entry.origin == "given" and entry.key not in left_out and _is_used(case, entry.key)
    ]
    groups = groupby(given, key=lambda entry: end_and_key(entry.key)[0])
    return "; ".join(
        (f"{_place(end)}: " if end else "") + "; ".join(_given(case, [*group])) for end, group in groups
    )


def _is_used(case: SolvedCase, key: str) -> bool:
    """Whether a drive uses an input of one of its bearings; their motor and their duty cycle are its own.

    Shafts, bearings and meshes of an axle have tables of their own.
    """
    end, inner = end_and_key(key)
    if isinstance(case, AxleCase):
        return not end
    return not (replaced_by(case, key) or (end and inner.startswith(("motor.", "duty."))))


def _given(case: SolvedCase, inputs: Sequence[Input]) -> Iterator[str]:
    """Names and values of inputs of one machine part."""
    from_data_sheet = any("lubricant.viscosity" in entry.key for entry in inputs)
    for entry in inputs:
        key = end_and_key(entry.key)[1]
        # The folder of a file belongs to one machine.
        value = input_text(case, entry.key, entry.value)
        if key == "lubricant.base" and from_data_sheet:
            value = f"from a data sheet, with what that lacks from {value} of the library"
        yield f"{named(key).text} =\xa0{value}"


def _sources(inputs: Iterable[Input]) -> list[Source]:
    """Sources of inputs, each once."""
    return list(dict.fromkeys(entry.source for entry in inputs if entry.source is not None))


def _input_cells(case: SolvedCase, entry: Input, numbers: Mapping[Source, int]) -> tuple[Cell, ...]:
    origin = entry.origin if entry.origin in WORDS else f"library {entry.origin}"
    if entry.source is not None:
        origin = f"{origin}: {entry.source.kind} [{numbers[entry.source]}]"
    name, other = named(end_and_key(entry.key)[1]), replaced_by(case, entry.key)
    meaning = _meaning(entry.key)
    if other:
        meaning = f"not used: the {named(other).text} of the drive takes its place"
    return name, input_text(case, entry.key, entry.value), origin, meaning


def _meaning(key: str) -> str:
    """Meaning of an input without its unit, which stands next to the value; empty for keys of tables."""
    try:
        text = describe(key)
    except InputError:
        return "how the contacts are computed" if end_and_key(key)[1] == "contacts" else ""
    return worded(re.split(r" \[|; |\. ", text)[0])


def _assumptions(case: SolvedCase, inputs: Iterable[Input]) -> Iterator[Block]:
    """Table of the inputs that are assumptions, estimates or follow by a rule, and of the given strength,
    which is seldom measured, grouped by their sources.
    """
    groups: dict[tuple[str, str], list[str]] = {}
    for entry in inputs:
        text = f"{named(entry.key).text} = {input_text(case, entry.key, entry.value)}"
        if entry.assumed and entry.source is not None:
            why = printable(entry.source.note or entry.source.citation)
            groups.setdefault((entry.source.kind, why), []).append(text)
        elif end_and_key(entry.key)[1].startswith(_STRENGTHS):
            groups.setdefault(("given", SENTENCES["no_strength_measured"]), []).append(text)
    rows = tuple(("; ".join(texts), kind, why) for (kind, why), texts in groups.items())
    if rows:
        yield Table(
            "Inputs to measure or to check", ("inputs", "kind", "why"), rows, shares=(0.42, 0.12, 0.46)
        )
    yield Text(SENTENCES["given_inputs"])


def limit_section(case: SolvedCase) -> Section:
    """Section of what the models behind a result neglect."""
    rows = tuple((limit.topic, limit.text) for limit in limits_of(case))
    return Section(
        "What the model neglects",
        (Table("Limits of the model", ("part", "limit"), rows, shares=(0.2, 0.8)),),
    )


def source_section(case: SolvedCase) -> Section:
    """Return the section with the sources of library values, materials, equations and standards."""
    blocks: list[Block] = []
    numbered = enumerate(_sources(inputs_of(case)), 1)
    values = tuple(
        (f"[{number}]", source.kind, _cited(source), printable(source.note)) for number, source in numbered
    )
    if values:
        heads = ("number", "kind", "source", "note")
        blocks.append(
            Table("Sources of values of the library", heads, values, shares=(0.09, 0.13, 0.41, 0.37))
        )
    solids = tuple((name, _cited(source)) for name, source in material_sources(case))
    if solids:
        blocks.append(Table("Sources of the materials", ("material", "source"), solids))
    equations = tuple(
        (
            reference.topic,
            Link(f"{reference.citation}, ", DOI + reference.doi) if reference.doi else reference.citation,
        )
        for reference in references_of(case)
    )
    blocks.append(
        Table("Literature behind the equations", ("for", "publication"), equations, shares=(0.35, 0.65))
    )
    if conditions_of(case).get("motor"):
        known, shares = TEXTS["standards"], (0.16, 0.27, 0.35, 0.22)
        caption = f"Standards on machines with inverters, as known on {known['date']}"
        rows = tuple(map(tuple, known["rows"]))
        blocks += [Table(caption, tuple(known["heads"]), rows, shares=shares), Text(SENTENCES["standards"])]
    return Section("Sources", tuple(blocks))


def _cited(source: Source) -> Cell:
    """Citation of a source, with a link to its DOI if it has one."""
    citation = printable(source.citation) or "none"
    return Link(f"{citation}, ", DOI + source.doi) if source.doi else citation


def version_section(details: Mapping[str, str]) -> Section:
    """Section of the versions of what computed the result and made the report."""
    versions = {
        "report made by": f"ehlectric {__version__}",
        "Python": platform.python_version(),
        "NumPy": version("numpy"),
        "SciPy": version("scipy"),
        "platform of the report": platform.platform(),
    }
    rows = tuple((name, printable(text)) for name, text in {**details, **versions}.items() if text)
    return Section("How it was computed", (Table("Result and versions", ("what", "value"), rows),))


def file_section(toml: str, command: str) -> Section:
    """Section with the whole input file, from which the result can be computed again."""
    text = f"Write these lines to a file and solve it again with: ehlectric {command} FILE"
    blocks: list[Block] = [Text(text)]
    if "\nfile = " in toml:
        blocks.append(Text(SENTENCES["files_named"]))
    return Section("Input file", (*blocks, Text(toml, "code")))


def date_of_report() -> str:
    """Date and time of a report in UTC; SOURCE_DATE_EPOCH sets it, for reports that are byte for byte equal.
    Raises InputError if SOURCE_DATE_EPOCH is no number of seconds.
    """
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given is None:
        return datetime.now(UTC).isoformat(timespec="seconds")
    try:
        return datetime.fromtimestamp(int(given), UTC).isoformat(timespec="seconds")
    except (ValueError, OverflowError, OSError):
        takes = "a number of seconds since 1970"
        raise InputError("SOURCE_DATE_EPOCH", got=shown(given), takes=takes) from None
