"""Input of a sweep: base case, varied keys with their values or ranges, and design of the points."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import ValidationInfo, create_model, field_validator, model_validator
from pydantic.fields import FieldInfo

from ehlectric.cases.amounts import WRITTEN, Amount, Count
from ehlectric.cases.case import Case
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.drives.swept import (
    SweptCase,
    swept_case_of_dict,
    swept_case_of_file,
    with_found_files,
)
from ehlectric.cases.input_keys import input_field, kind_of, number_of
from ehlectric.cases.table import Table, nearest, read_toml
from ehlectric.cases.title import Title
from ehlectric.errors import InputError, printable, short, shown
from ehlectric.runtime.display import Tabled, headline
from ehlectric.sweep import design as sweep_design
from ehlectric.sweep.results import Range
from ehlectric.sweep.varied import check_varied

# Summaries and tables take about 20 kB of memory per point, thus 4 GB for this number of points.
MOST_POINTS = 200_000
_RANGE_KEYS = ("from", "to", "count", "spacing")
_SPACINGS = ("linear", "log")
_RANGE = "a list of values, or a table of from, to, count and optionally spacing"


class Sweep(Tabled, Table):
    """Sweep over many cases: a base case, and the keys of it that vary.

    ``vary`` maps dotted keys of the case to their values in SI units or, in a "sobol" design, to a ``Range``.
    It is made from lists, arrays, or tables of ``from``, ``to``, ``count`` and optionally ``spacing``.
    Rough surfaces are numbered from 1, as in "roughness.1.rescale_rq". A varied key replaces its alternative
    in the base case, as a load replaces a Hertz pressure. In a drive "bearings" before a key of a bearing
    file stands for both bearings, as in "bearings.bearing.radial_load".

    Examples
    --------
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> vary = {"contact.entrainment_speed": ["1 m/s", "2 m/s"], "grid.nodes": [1601, 3201]}
    >>> sweep = Sweep.from_dict({"case": case, "vary": vary})
    >>> sweep.size, list(sweep.points())[1]
    (4, {'contact.entrainment_speed': 1.0, 'grid.nodes': 3201})
    """

    title: Title = ""
    case: SweptCase
    design: Literal["grid", "paired", "sobol"] = "grid"
    vary: Mapping[str, Any]
    samples: Annotated[int, Count(2, 2**16, "rows of each matrix of a sobol design")] | None = None
    seed: Annotated[int, Count(0, 2**32, "of the random numbers of a sobol design")] = 0

    @field_validator("case")
    @classmethod
    def _alone(cls, case: SweptCase) -> SweptCase:
        """Case without remedies, which a sweep does not solve: what they change may vary."""
        remedied = isinstance(case, DriveCase) and case.remedies
        return case.replace(remedies=()) if remedied else case

    @field_validator("vary", mode="before")
    @classmethod
    def _parsed(cls, tables: Any, info: ValidationInfo) -> Any:
        """Varied values in SI units; unchanged if the case or the design is already invalid."""
        case, design = info.data.get("case"), info.data.get("design")
        if not isinstance(tables, Mapping) or case is None or design is None:
            return tables
        flat = _flattened(tables)
        if not flat:
            raise InputError(got="no key", takes="at least one key of the case with its values or its range")
        written = bool(info.context and info.context.get(WRITTEN))
        for key in flat:
            check_varied(key, case, flat)
        return {key: _axis(key, value, design, written=written) for key, value in flat.items()}

    @model_validator(mode="after")
    def _check(self) -> Self:
        if isinstance(self.case, Case) and self.case.motion is not None:
            raise InputError(
                "case.motion",
                got="[motion] in a sweep, whose films are stationary",
                takes="a case without it",
            )
        if self.design == "sobol":
            if self.samples is None:
                raise InputError.worded("samples", "missing; a sobol design needs it: a power of two")
            if self.samples & (self.samples - 1):
                raise InputError("samples", got=self.samples, takes="a power of two, such as 64 or 1024")
        for name in ("samples", "seed") if self.design != "sobol" else ():
            if name in self.model_fields_set:
                raise InputError.worded(
                    name, f"is not used by a {self.design} design; only a sobol design needs it"
                )
        lengths = {key: len(axis) for key, axis in self.axes.items()}
        if self.design == "paired" and len(set(lengths.values())) > 1:
            counts = ", ".join(f"{length} of {key}" for key, length in lengths.items())
            raise InputError("vary", got=counts, takes="as many of each in a paired design")
        if self.size > MOST_POINTS:
            raise InputError("vary", got=f"{self.size} points", takes=f"at most {MOST_POINTS}")
        return self

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a sweep from a TOML file; file names in it are relative to its folder.

        Parameters
        ----------
        path : str or Path
            TOML file.

        Returns
        -------
        Sweep
            Sweep with its base case and its varied keys.

        Raises
        ------
        InputError
            If the file or its case file cannot be read or is not TOML, or if the sweep is not valid.
        """
        table, folder = read_toml(path), Path(path).parent
        match table.get("case"):
            case str(name):
                table["case"] = str(folder / name)
            case dict(inner):
                table["case"] = with_found_files(inner, folder)
        if isinstance(table.get("vary"), dict):
            _locate(table["vary"], folder)
        return cls.from_written(table)

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Create a sweep from nested tables.

        Parameters
        ----------
        table : mapping
            Tables of the sweep. Its ``case`` is a Case, BearingCase or DriveCase, the tables of one, or the
            path of its file.

        Returns
        -------
        Sweep
            Sweep with its base case and its varied keys.

        Raises
        ------
        InputError
            If a key or value is invalid. The message is one line: the key, its value, and what is allowed.
        """
        return super().from_dict(_with_case(table, written=False))

    @classmethod
    def from_written(cls, table: Mapping[str, Any]) -> Self:
        """Create a sweep from tables that a person wrote into a file; rotational speeds must have their unit.

        Parameters
        ----------
        table : mapping
            Tables of the sweep, as for ``from_dict``.

        Returns
        -------
        Sweep
            Sweep with its base case and its varied keys.

        Raises
        ------
        InputError
            If a key or value is invalid. The message is one line: the key, its value, and what is allowed.
        """
        return super().from_written(_with_case(table, written=True))

    def _headline(self) -> str:
        """Title, number of points and varied keys on one line."""
        title = self.title or self.case.title
        return headline(title, f"{self.design} of {self.size} points over {', '.join(self.vary)}")

    @property
    def axes(self) -> dict[str, tuple[Any, ...]]:
        """Values of each varied key, in SI units; empty for a "sobol" design."""
        return {} if self.design == "sobol" else dict(self.vary)

    @property
    def ranges(self) -> dict[str, Range]:
        """Range of each varied key of a "sobol" design, in SI units; empty for other designs."""
        return dict(self.vary) if self.design == "sobol" else {}

    @property
    def size(self) -> int:
        """Number of points of the design."""
        if self.design == "sobol":
            return (self.samples or 0) * (len(self.vary) + 2)
        lengths = [len(axis) for axis in self.axes.values()]
        return math.prod(lengths) if self.design == "grid" else lengths[0]

    def points(self) -> Iterator[dict[str, Any]]:
        """Inputs of every point by dotted key of the case, in SI units, in the order of the design."""
        if self.design == "sobol":
            whole = [key for key in self.vary if isinstance(number_of(input_field(key)), Count)]
            return sweep_design.sobol(self.ranges, self.samples or 0, self.seed, whole)
        return {"grid": sweep_design.grid, "paired": sweep_design.paired}[self.design](self.axes)


def _with_case(table: Mapping[str, Any], *, written: bool) -> Mapping[str, Any]:
    """Tables of a sweep with its base case in place of the tables or the file of the case."""
    case = table.get("case")
    try:
        if isinstance(case, str | Path):
            return {**table, "case": swept_case_of_file(case)}
        if isinstance(case, Mapping):
            return {**table, "case": swept_case_of_dict(case, written=written)}
        if case is not None and not isinstance(case, SweptCase):
            raise InputError("case", got=shown(case), takes="a table or the name of a file")
    except InputError as error:
        if error.key in ("case", printable(str(case)) if isinstance(case, str | Path) else None):
            raise
        if isinstance(case, str | Path):
            raise error.retold(str(case), str(error)) from None
        raise error.under("case") from None
    return table


def _flattened(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Values and ranges by dotted key, from dotted keys and nested tables in any mixture."""
    flat: dict[str, Any] = {}
    for key, value in tables.items():
        table = isinstance(value, Mapping) and not {"from", "to"} & set(value)
        if table and kind_of(f"{prefix}{key}") is not None:
            raise InputError(
                f"{prefix}{key}",
                got=f"a table of {short(', '.join(map(str, value))) or 'nothing'}",
                takes=_RANGE,
            )
        inner = _flattened(value, f"{prefix}{key}.") if table else {f"{prefix}{key}": value}
        for name in inner.keys() & flat.keys():
            raise InputError.worded(name, "is given twice")
        flat |= inner
    return flat


def _locate(tables: dict[str, Any], folder: Path, prefix: str = "") -> None:
    """Make file names among the varied values absolute; in the sweep file they are relative to its folder."""
    for name, value in tables.items():
        key = prefix + name
        if isinstance(value, dict):
            _locate(value, folder, f"{key}.")
        elif isinstance(value, list) and _names_a_file(key):
            tables[name] = [str((folder / v).absolute()) if isinstance(v, str) else v for v in value]


def _names_a_file(key: str) -> bool:
    """Whether the values of a key are names of files."""
    return key == "source.file" or (key.startswith("roughness.") and key.endswith(".file"))


def _axis(key: str, value: Any, design: str, *, written: bool) -> tuple[Any, ...] | Range:
    """Values of a varied key, in SI units, or its range in a sobol design."""
    if key.partition(".")[0] == "motion":
        raise InputError.worded(key, "cannot vary: the films of a sweep are stationary")
    field = input_field(key)
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Mapping):
        return _range(key, value, number_of(field), design, written=written)
    if isinstance(value, Range):
        value = {"from": value.start, "to": value.stop, "spacing": value.spacing}
        return _range(key, value, number_of(field), design)
    if design == "sobol":
        raise InputError(key, got=shown(value), takes="a table with from and to in a sobol design")
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) == 0:
        raise InputError(key, got=shown(value), takes="a list of values or a table with from and to")
    values = tuple(_values(key, field, value, written=written))
    known: set[str] = set()
    for each in values if design == "grid" else ():
        text = json.dumps(each)
        if text in known:
            raise InputError(key, got=f"{shown(each)} twice", takes="values that differ in a grid design")
        known.add(text)
    return values


def _values(key: str, field: FieldInfo, values: Sequence[Any], *, written: bool) -> Iterator[Any]:
    """Values of a varied key as a case stores them; numbers are in SI units."""
    table, _, leaf = key.rpartition(".")
    annotation = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    keys: Any = {leaf: (annotation, ...)}
    value_of: type[Table] = create_model("Value", __base__=Table, **keys)
    for each in values:
        value = each.item() if isinstance(each, np.generic) else each
        try:
            made = value_of.from_written({leaf: value}) if written else value_of.from_dict({leaf: value})
            parsed = made.model_dump(mode="json")[leaf]
        except InputError as error:
            raise error.under(table) from None
        yield parsed


def _range(
    key: str, table: Mapping[str, Any], number: Amount | Count | None, design: str, *, written: bool = False
) -> tuple[Any, ...] | Range:
    """Values of a varied key between two ends, in SI units, or its range in a sobol design."""
    if number is None:
        raise InputError(key, got="a range", takes="a list of values, because the key is not a number")
    for name in table:
        if name not in _RANGE_KEYS:
            near = nearest(str(name), _RANGE_KEYS)
            raise InputError.unknown(f"{key}.{name}", f"{key}.{near}")
    over = _over(key, table, number, written=written)
    if design == "sobol":
        if "count" in table:
            raise InputError.worded(
                f"{key}.count", "is not used by a sobol design; samples gives the number for all keys"
            )
        return over
    count = table.get("count")
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_POINTS:
        got = None if count is None else shown(count)
        raise InputError(
            f"{key}.count", got=got, takes=f"how many values, a whole number from 2 to {MOST_POINTS}"
        )
    values = sweep_design.between(over, np.linspace(0.0, 1.0, count))
    if isinstance(number, Amount):
        return tuple(values.tolist())
    rounded = tuple(np.floor(values + 0.5).astype(int).tolist())
    if design == "grid" and len(set(rounded)) < count:
        raise InputError(
            f"{key}.count", got=count, takes=f"at most the whole numbers from {over.start:g} to {over.stop:g}"
        )
    return rounded


def _over(key: str, table: Mapping[str, Any], number: Amount | Count, *, written: bool) -> Range:
    """Range of a varied key: its ends in SI units, and its spacing."""
    ends = []
    for name in ("from", "to"):
        if name not in table:
            raise InputError.missing(f"{key}.{name}", number.takes)
        try:
            end = table[name]
            ends.append(
                number.parse(end, written=written) if isinstance(number, Amount) else number.parse(end)
            )
        except InputError as error:
            raise error.under(f"{key}.{name}") from None
    start, stop = ends
    spacing = table.get("spacing", "linear")
    if spacing not in _SPACINGS:
        raise InputError(f"{key}.spacing", got=shown(spacing), takes="'linear' or 'log'")
    if not start < stop:
        raise InputError(f"{key}.to", got=shown(table["to"]), takes=f"more than from, {shown(table['from'])}")
    if spacing == "log" and start <= 0.0:
        raise InputError(f"{key}.from", got=shown(table["from"]), takes="more than 0 with spacing 'log'")
    return Range(start, stop, spacing)
