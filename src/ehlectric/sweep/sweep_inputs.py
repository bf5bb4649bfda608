"""Input of a sweep: base case, varied keys with their values or ranges, and the design of its points."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike
from pydantic import ValidationInfo, field_validator, model_validator
from pydantic.fields import FieldInfo

from ehlectric.arrays import Array
from ehlectric.bearing import LEAST_SAMPLES, MOST_SAMPLES
from ehlectric.cases.amounts import INFINITE, WRITTEN, Amount, AmountOrWord, Count
from ehlectric.cases.axle_case import AxleCase, with_gear_files
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case, check_changes
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import input_field, is_of_axle, is_of_drive, key_of_names, kind_of
from ehlectric.cases.solved_case import SolvedCase, solved_case_of_dict, solved_case_of_file
from ehlectric.cases.table import (
    Table,
    Title,
    advice_for,
    annotation_of,
    any_of,
    leaf_of,
    meant,
    nearest_key,
    number_of,
    parser_of,
    read_toml,
    similar_keys,
)
from ehlectric.errors import InputError, for_all, printable, short, shown, within
from ehlectric.formulas.sobol import sobol_points
from ehlectric.quantities.inputs import BOTH, ENDS, REPLACED, end_and_key, key_of_drive
from ehlectric.quantities.sheets import BREAKDOWNS
from ehlectric.runtime.display import Tabled, headline
from ehlectric.sweep.points import Range
from ehlectric.sweep.result import SweepResults

# Keys of a bearing file that no sweep varies: they are not a part of the bearing.
_NOT_VARIED = ("title", "ranges")


def check_varied(key: str, case: SolvedCase, varied: Collection[str] = ()) -> None:
    """Check that a key is one of a case, and that varying it changes the case. Raises InputError if the case
    has no such key; the message names the nearest one.
    """
    if isinstance(case, DriveCase):
        _check_drive(key, case, varied)
        return
    if isinstance(case, AxleCase):
        _check_axle(key, case)
        return
    model: type[Table] = type(case)
    if is_of_drive(key) or key.partition(".")[0] == "duty":
        raise InputError.unknown(key, nearest_key(key, model, case.__dict__))
    try:
        input_field(key)
    except InputError as error:
        # The error of a rough surface has its number.
        advised = advice_for(key, model) is not None
        if "unknown key" in error.text and not key.startswith("roughness.") and not advised:
            raise InputError.unknown(key, nearest_key(key, model, case.__dict__)) from None
        raise
    if key.partition(".")[0] not in model.known_keys():
        raise InputError.unknown(key, nearest_key(key, model, case.__dict__))


def _check_drive(key: str, case: DriveCase, varied: Collection[str]) -> None:
    end, inner = end_and_key(key)
    if not is_of_drive(key) and key != "title":
        raise InputError.unknown(key, _nearest(key))
    if key == BOTH:
        raise InputError(key, "is a table", takes=f"one of its keys, as {BOTH}.bearing.radial_load")
    input_field(key)
    if end and inner.partition(".")[0] in _NOT_VARIED:
        raise InputError.worded(key, "cannot vary", takes="a key of the bearing")
    case.check_not_replaced(key)
    above = REPLACED.get(inner) if end else None
    if above is not None and (above in varied or inner in case.replaced):
        raise InputError.worded(key, f"has no effect, as {above} is given for both bearings", takes=above)
    both = f"{BOTH}.{inner}"
    if end in ENDS and both in varied:
        raise InputError.worded(
            key, f"varies together with {both}; vary one of them, or both ends", takes=both
        )


# Keys of a gear file that an axle replaces, with the keys of the axle.
_REPLACED_OF_MESHES = {
    "gear.operation.pinion_speed": "drive.speed",
    "gear.operation.pinion_torque": "drive.torque",
    "gear.operation.oil_temperature": "drive.temperature",
}


def _check_axle(key: str, case: AxleCase) -> None:
    case.check_shared(key)
    place, inner = end_and_key(key)
    kind, _, name = place.partition(".")
    if kind in ("bearing", "shaft", "mesh", "link", "force") and name != "*":
        case.places_of(key)
    elif not name and key in AxleCase.known_keys():
        raise InputError.worded(key, "cannot vary", takes="a key of the operating point, a bearing or a mesh")
    elif not name and not is_of_axle(key):
        raise InputError.unknown(key, nearest_key(key, AxleCase, case.__dict__))
    above = {"bearing": REPLACED, "mesh": _REPLACED_OF_MESHES}.get(kind, {}).get(inner)
    if above is None and kind == "mesh" and inner.partition(".")[0] != "gear":
        above = inner
    if above is not None:
        raise InputError.worded(key, f"has no effect, as {above} is given for the axle", takes=above)
    input_field(key_in_file(key, case))


def key_in_file(key: str, case: SolvedCase) -> str:
    """Dotted key with the name of the file before a key of an axle that drives also have, with other bounds.

    The speed of an axle has a sign.
    """
    return f"axle.{key}" if isinstance(case, AxleCase) and key.startswith("drive.") else key


def _nearest(key: str) -> str:
    """Return the drive key nearest to a key of another file kind; a bearing key stands for both bearings."""
    if key.partition(".")[0] not in BearingCase.known_keys():
        return nearest_key(key, DriveCase)
    return any_of([key_of_drive(meaning) for meaning in meant(key, BearingCase)])


@dataclass(frozen=True)
class Breakdown:
    """Keys and names of a breakdown voltage, the applied voltage and the margin between them.

    All keys are empty for a drive: its films are charged and discharged, and no single voltage is applied.
    """

    value: str  # dotted key of the breakdown voltage in the summary
    margin: str  # dotted key of the margin, breakdown voltage divided by applied voltage
    voltage: str  # dotted key of the applied voltage
    name: str = "breakdown voltage"
    voltage_name: str = "applied voltage"

    @property
    def keys(self) -> tuple[str, str]:
        """Dotted keys of the breakdown voltage and of the margin."""
        return self.value, self.margin

    def voltages(self, results: SweepResults) -> Array:
        """Applied voltage of every point of a sweep [V], shape (points,); NaN where a point has none."""
        return results.values(self.voltage) if self.voltage else np.full(len(results.points), np.nan)

    def margins(self, results: SweepResults) -> Array:
        """Breakdown voltage divided by applied voltage of every point of a sweep. Returns margin of each
        point, from its summary or, where that has none, from the two voltages; NaN where a point has no
        breakdown voltage, shape (points,).
        """
        if not self.margin:
            return np.full(len(results.points), np.nan)
        margin = results.values(self.margin)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = results.values(self.value) / results.values(self.voltage)
        return np.where(np.isfinite(margin), margin, ratio)


CONTACT, FIRST_BREAK, THROUGH, MESH, FIRST_ELEMENT = (
    Breakdown(**BREAKDOWNS[name]) for name in ("contact", "first", "through", "mesh", "element")
)

# With a coating on a ring, the breakdown voltages next to the shaft voltage are voltages of the shaft.
_COATED_FIRST = replace(FIRST_BREAK, value="bearing.shaft_first_break")
_COATED_THROUGH = replace(THROUGH, value="bearing.shaft_ring_to_ring_breakdown")


# For a drive no applied voltage stands next to the breakdown voltage of a film.
_NONE = Breakdown("", "", "")


def main_value(case: SolvedCase) -> str:
    """Key of the summary that figures of a sweep show first. Returns breakdown voltage of a contact or a gear
    pair, first breakdown of a bearing, discharges per second of a drive, margin of an axle, or lambda ratio
    of a gear pair whose oil has no strength.
    """
    if isinstance(case, AxleCase):
        return FIRST_ELEMENT.margin
    if isinstance(case, GearCase) and not case.discharge.has_strength:
        return "mesh.lambda_ratio"
    return breakdown_of(case).value or "drive.events_per_second"


def ranked_value(case: SolvedCase) -> str:
    """Key of the summary to whose spread the inputs of a Sobol design are ranked. Returns margin of a bearing
    with a motor, of which the breakdown voltage is only a part; else ``main_value``.
    """
    if isinstance(case, BearingCase) and case.motor is not None and case.discharge.has_strength:
        return breakdown_of(case).margin
    return main_value(case)


def breakdown_of(case: SolvedCase, value: str | None = None) -> Breakdown:
    """Breakdown voltage that a value of a summary belongs to."""
    if isinstance(case, DriveCase):
        return _NONE
    if isinstance(case, GearCase):
        return MESH
    if isinstance(case, AxleCase):
        return FIRST_ELEMENT
    if not isinstance(case, BearingCase):
        return CONTACT
    if case.bearing.coating is not None:
        through = value in (*THROUGH.keys, _COATED_THROUGH.value)
        return _COATED_THROUGH if through else _COATED_FIRST
    return THROUGH if value in THROUGH.keys else FIRST_BREAK


def grid(axes: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Points of a grid design: every combination of the values of all keys. Yields inputs of a point by key;
    the last key varies fastest.

    Examples
    --------
    >>> list(grid({"a": [1, 2], "b": [3, 4]}))
    [{'a': 1, 'b': 3}, {'a': 1, 'b': 4}, {'a': 2, 'b': 3}, {'a': 2, 'b': 4}]
    """
    for values in product(*axes.values()):
        yield dict(zip(axes, values, strict=True))


def paired(axes: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Points of a paired design: the first values of all keys, then the second values, and so on. Raises
    ValueError if the keys have different numbers of values.

    Examples
    --------
    >>> list(paired({"a": [1, 2], "b": [3, 4]}))
    [{'a': 1, 'b': 3}, {'a': 2, 'b': 4}]
    """
    for values in zip(*axes.values(), strict=True):
        yield dict(zip(axes, values, strict=True))


def sobol(
    ranges: Mapping[str, Range], samples: int, seed: int, whole: Collection[str] = ()
) -> Iterator[dict[str, Any]]:
    """Points of a Sobol design, from which first-order and total sensitivity indices are estimated. Yields
    inputs of a point by key, in SI units.

    A and B are the halves of a scrambled Sobol sequence in 2d dimensions. Saltelli et al., Comput. Phys.
    Commun. 181 (2010) 259, doi:10.1016/j.cpc.2009.09.018, table 2. The values computed at
    these points are f_A, f_B and f_AB of ``scipy.stats.sobol_indices``.

    Examples
    --------
    >>> points = list(sobol({"a": Range(0.0, 1.0), "b": Range(1.0, 100.0, "log")}, 4, seed=0))
    >>> len(points), points[8] == {"a": points[4]["a"], "b": points[0]["b"]}
    (16, True)
    """
    count = len(ranges)
    # The sequence is balanced only for a power of two of samples.
    number = 2 ** (samples.bit_length() - 1)
    unit = sobol_points(2 * count, number, np.random.SeedSequence(seed).spawn(1)[0])
    first, second = unit[:, :count], unit[:, count:]
    yield from _rows(ranges, first, whole)
    yield from _rows(ranges, second, whole)
    for k in range(count):
        mixed = first.copy()
        mixed[:, k] = second[:, k]
        yield from _rows(ranges, mixed, whole)


def _rows(ranges: Mapping[str, Range], unit: Array, whole: Collection[str]) -> Iterator[dict[str, Any]]:
    """Points of a design from rows of the unit cube, shape (n, keys)."""
    columns = [
        (shares if key in whole else between)(over, unit[:, k]).tolist()
        for k, (key, over) in enumerate(ranges.items())
    ]
    for values in zip(*columns, strict=True):
        yield dict(zip(ranges, values, strict=True))


def between(over: Range, unit: ArrayLike) -> Array:
    """Values at given fractions of a range. ``unit``, fraction of the range, from 0 at its start to 1 at its
    end, shape (...). Returns values in the unit of the range; at 0 and 1 its exact ends, shape (...).

    Examples
    --------
    >>> between(Range(1.0, 100.0, "log"), [0.0, 0.5, 1.0])
    array([  1.,  10., 100.])
    """
    unit = np.asarray(unit, dtype=float)
    if over.spacing == "log":
        values = over.start ** (1.0 - unit) * over.stop**unit
    else:
        values = (1.0 - unit) * over.start + unit * over.stop
    return np.clip(values, over.start, over.stop)


def shares(over: Range, unit: ArrayLike) -> Array:
    """Whole numbers at given fractions of a range. ``unit``, fraction of the range, from 0 to 1, shape (...).
    Returns whole numbers of the range, shape (...).

    Examples
    --------
    >>> shares(Range(1, 3), [0.0, 0.3, 0.4, 0.6, 0.7, 1.0])
    array([1, 1, 2, 2, 3, 3])
    """
    wider = Range(over.start - 0.5, over.stop + 0.5, over.spacing)
    rounded = np.floor(between(wider, unit) + 0.5)
    return np.clip(rounded, over.start, over.stop).astype(np.int64)


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
    case: SolvedCase
    design: Literal["grid", "paired", "sobol"] = "grid"
    vary: Mapping[str, Any]
    samples: Annotated[int, Count(2, 2**16, "rows of each matrix of a sobol design")] | None = None
    seed: Annotated[int, Count(0, 2**32, "of the random numbers of a sobol design")] = 0
    uncertainty_samples: (
        Annotated[int, Count(LEAST_SAMPLES, MOST_SAMPLES, "of the probability of breakdown at each point")]
        | None
    ) = None

    @field_validator("case")
    @classmethod
    def _alone(cls, case: SolvedCase) -> SolvedCase:
        """Case without remedies and duty cycle, which a sweep does not solve: what they change may vary."""
        if isinstance(case, AxleCase) and (case.remedies or case.duty is not None):
            return case.model_copy(update={"remedies": (), "duty": None})
        if isinstance(case, DriveCase) and (case.remedies or case.duty is not None):
            return case.model_copy(update={"remedies": (), "duty": None})
        return case

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
        for_all(lambda key: check_varied(key, case, flat), flat)

        def axis(key: str) -> tuple[str, Any]:
            field = input_field(key_in_file(key, case))
            return key, _axis(key, field, flat[key], design, written=written)

        return dict(for_all(axis, flat))

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
        if self.uncertainty_samples is not None:
            self._check_uncertainty(self.uncertainty_samples)
        check_user_laws(self)
        return self

    def _check_uncertainty(self, samples: int) -> None:
        """Check that points can have a probability of breakdown, and its number of samples."""
        key, case = "uncertainty_samples", self.case
        if not isinstance(case, BearingCase):
            raise InputError.worded(key, "is only for the sweep of a bearing, whose margin has a probability")
        for table, present in (("motor", case.motor is not None), ("discharge", case.discharge.has_strength)):
            if not present and not any(varied.startswith(f"{table}.") for varied in self.vary):
                what = "[motor]" if table == "motor" else "dielectric strength in [discharge]"
                text = f"needs a margin, and the bearing has no {what}"
                raise InputError.worded(key, text, takes="a bearing with [motor] and a dielectric strength")
        if samples & (samples - 1):
            raise InputError(key, got=samples, takes="a power of two, such as 256")

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
        return cls.of_file(read_toml(path), Path(path))

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a sweep from the tables of the file at a path."""
        folder = path.parent
        match table.get("case"):
            case str(name):
                table["case"] = str(folder / name)
            case dict(inner):
                table["case"] = with_gear_files(inner, folder)
        if isinstance(table.get("vary"), dict):
            _locate(table["vary"], folder)
        return cls.from_written(table)

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Create a sweep from nested tables.

        Parameters
        ----------
        table : mapping
            Tables of the sweep. Its ``case`` is a Case, BearingCase, DriveCase, AxleCase or GearCase, the
            tables of one, or the path of its file.

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
        """Return the inputs of every point by dotted key, in SI units, in the order of the design."""
        if self.design == "sobol":
            fields = {key: input_field(key_in_file(key, self.case)) for key in self.vary}
            whole = [key for key, field in fields.items() if isinstance(number_of(field), Count)]
            return sobol(self.ranges, self.samples or 0, self.seed, whole)
        return {"grid": grid, "paired": paired}[self.design](self.axes)


def check_user_laws(sweep: Sweep) -> None:
    """Raise an InputError if a varied value has no effect, because a law of the user's own replaces it."""
    if isinstance(sweep.case, Case):
        check_changes(
            sweep.case,
            {
                key: (axis.start, axis.stop) if isinstance(axis, Range) else axis
                for key, axis in sweep.vary.items()
            },
        )


def _with_case(table: Mapping[str, Any], *, written: bool) -> Mapping[str, Any]:
    """Tables of a sweep with its base case instead of the tables or the file of the case."""
    case = table.get("case")
    try:
        if isinstance(case, str | Path):
            return {**table, "case": solved_case_of_file(case)}
        if isinstance(case, Mapping):
            return {**table, "case": solved_case_of_dict(case, written=written)}
        if case is not None and not isinstance(case, SolvedCase):
            raise InputError("case", got=shown(case), takes="a table or the name of a file")
    except InputError as error:
        if error.key in ("case", printable(str(case)) if isinstance(case, str | Path) else None):
            raise
        if isinstance(case, str | Path):
            raise error.with_text(str(case), str(error)) from None
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
        name = key_of_names(f"{prefix}{key}", value)
        inner = _flattened(value, f"{name}.") if table else {name: value}
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


def _keys_of_range(key: str, name: str) -> list[str]:
    """Keys in the range of a varied key that an unknown name may mean."""
    similar = similar_keys(f"vary.{name}", ["vary", *(f"vary.{name}" for name in _RANGE_KEYS)])
    return [f"{key}.{name.removeprefix('vary.')}" for name in similar]


def _axis(key: str, field: FieldInfo, value: Any, design: str, *, written: bool) -> tuple[Any, ...] | Range:
    """Values of a varied key, in SI units, or its range in a sobol design."""
    if key.partition(".")[0] == "motion":
        raise InputError.worded(key, "cannot vary: the films of a sweep are stationary")
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Range):
        value, written = {"from": value.start, "to": value.stop, "spacing": value.spacing}, False
    if isinstance(value, Mapping):
        number = number_of(field)
        unknown = [str(name) for name in value if number is not None and name not in _RANGE_KEYS]
        if unknown:
            raise InputError.unknown(f"{key}.{unknown[0]}", any_of(_keys_of_range(key, unknown[0])))
        with within(key):
            return _range(value, number, design, written=written)
    if design == "sobol":
        raise InputError(key, got=shown(value), takes="a table with from and to in a sobol design")
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) == 0:
        raise InputError(key, got=shown(value), takes="a list of values or a table with from and to")
    return _different(key, field, value, design, written=written)


def _different(
    key: str, field: FieldInfo, value: Sequence[Any], design: str, *, written: bool
) -> tuple[Any, ...]:
    """Values of a list, in SI units, which differ in a grid design."""
    of_gears = [each for each in value if isinstance(each, list | tuple)] if number_of(field) else []
    if of_gears:
        takes = f"one value for each point; of a single gear as {key}.1 or {key}.2"
        raise InputError(key, got=f"the list {shown(of_gears[0])}", takes=takes)
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
    parse = stored_value(key, field)
    for each in values:
        yield parse(each, written=written)


def stored_value(key: str, field: FieldInfo) -> Callable[..., Any]:
    """Function that parses a value of a key, as a case stores it; numbers are in SI units."""
    annotation = annotation_of(field)
    if isinstance(annotation, Amount | AmountOrWord) and number_of(field) is not None:
        return _stored_amount(key, annotation, parser_of(field, key))
    return _stored_entry(key, field)


def _stored_amount(key: str, amount: Amount | AmountOrWord, parse: Callable[..., Any]) -> Callable[..., Any]:
    """Function that parses an amount in a tenth of the time of ``_stored_entry``."""

    def stored(entry: Any, *, written: bool) -> Any:
        if entry is None:
            return parse(entry, written=written).model_dump(mode="json")[leaf_of(key)]
        with within(key):
            return amount.parse(entry, written=written)

    return stored


def _stored_entry(key: str, field: FieldInfo) -> Callable[..., Any]:
    """Function that parses any value of a key."""
    parse, number = parser_of(field, key), number_of(field)

    def stored(entry: Any, *, written: bool) -> Any:
        value = entry.item() if isinstance(entry, np.generic) else entry
        parsed = parse(value, written=written).model_dump(mode="json")[leaf_of(key)]
        return math.inf if number is not None and parsed == INFINITE else parsed

    return stored


def _range(
    table: Mapping[str, Any], number: Amount | Count | None, design: str, *, written: bool
) -> tuple[Any, ...] | Range:
    """Values of a varied key between two ends, in SI units, or its range in a sobol design."""
    if number is None:
        raise InputError(got="a range", takes="a list of values, because the key is not a number")
    over = _over(table, number, written=written)
    if design == "sobol":
        if "count" in table:
            text = "is not used by a sobol design; samples gives the number for all keys"
            raise InputError.worded("count", text)
        return over
    count = table.get("count")
    if isinstance(count, bool) or not isinstance(count, int) or not 2 <= count <= MOST_POINTS:
        got = None if count is None else shown(count)
        raise InputError("count", got=got, takes=f"how many values, a whole number from 2 to {MOST_POINTS}")
    values = between(over, np.linspace(0.0, 1.0, count))
    if isinstance(number, Amount):
        return tuple(values.tolist())
    rounded = tuple(np.floor(values + 0.5).astype(int).tolist())
    if design == "grid" and len(set(rounded)) < count:
        takes = f"at most the whole numbers from {over.start:g} to {over.stop:g}"
        raise InputError("count", got=count, takes=takes)
    return rounded


def _over(table: Mapping[str, Any], number: Amount | Count, *, written: bool) -> Range:
    """Range of a varied key: its ends in SI units, and its spacing."""
    ends = []
    for name in ("from", "to"):
        if name not in table:
            raise InputError.missing(name, number.takes)
        with within(name):
            ends.append(number.parse(table[name], written=written))
    start, stop = ends
    if not all(map(math.isfinite, ends)):
        name = "from" if math.isinf(start) else "to"
        raise InputError(
            name, got=shown(table[name]), takes="a finite number; a list of values may have 'inf'"
        )
    spacing = table.get("spacing", "linear")
    if spacing not in _SPACINGS:
        raise InputError("spacing", got=shown(spacing), takes="'linear' or 'log'")
    if not start < stop:
        raise InputError("to", got=shown(table["to"]), takes=f"more than from, {shown(table['from'])}")
    if spacing == "log" and start <= 0.0:
        raise InputError("from", got=shown(table["from"]), takes="more than 0 with spacing 'log'")
    return Range(start, stop, spacing)
