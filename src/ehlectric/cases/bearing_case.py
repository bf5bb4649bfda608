"""Case of a rolling bearing, read from TOML, written back, and changed, with the ranges of its inputs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Required, Self, TypedDict, Unpack

import numpy as np
from pydantic import field_serializer, field_validator, model_validator

from ehlectric.arrays import Array
from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.bearing_inputs import (
    Bearing,
    BearingKeys,
    Motor,
    base_of,
    check_heat,
    class_of,
    is_of_another_class,
    typed_base,
)
from ehlectric.cases.case_oil import Lubricant, viscosity_follows
from ehlectric.cases.contact_inputs import Contact
from ehlectric.cases.defaults import DEFAULT_FILM, DEFAULT_SUMMITS, Contacts
from ehlectric.cases.discharge_inputs import BearingDischarge
from ehlectric.cases.duty_inputs import Duty
from ehlectric.cases.grid_inputs import Solver
from ehlectric.cases.input_ranges import (
    InputRange,
    check_ranges,
    drop_ranges,
    field_of_values,
    flat_changes,
    quantity_at,
    ranges_of,
    table_of_ranges,
)
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.keywords import Fields, Keys, keys_of, split, takes
from ehlectric.cases.library.bearing_catalogue import NORMAL_CLASS, with_class
from ehlectric.cases.measured_inputs import Measured
from ehlectric.cases.oil_inputs import displace_oil
from ehlectric.cases.roughness_inputs import find_files
from ehlectric.cases.stated_ranges import with_stated_ranges
from ehlectric.cases.table import (
    CaseFile,
    Table,
    Title,
    number_of,
    with_name_keys,
)
from ehlectric.cases.table_edits import displace, nested, set_keys
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.alternatives import ALTERNATIVES, DIMENSIONS
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.runtime.display import headline

# Tables and keys of a bearing file that a case of a contact does not have.
_TABLES = ("motor", "contacts", "ranges", "duty", "measured")


def bearing_key(table: Mapping[str, Any]) -> str | None:
    """Key at the top of a file that only a bearing file has, or only its table ``bearing``; None without one.

    Examples
    --------
    >>> bearing_key({"lubricant": {}, "motor": {}}), bearing_key({"radial_load": "1 kN"})
    ('motor', 'radial_load')
    >>> bearing_key({"contact": {}, "motor": {}})
    """
    if "contact" in table:
        return None
    only_bearing = Bearing.known_keys().keys() - Contact.known_keys().keys()
    return next((key for key in table if key in _TABLES or key in only_bearing), None)


def _array_of(key: str, values: Any, model: type[Table]) -> Array:
    """Numbers of a dotted key at many points, SI units, shape (n,), each within the bounds of the key."""
    takes = "an array, with a number for each point"
    quantity = number_of(field_of_values(key, model, takes))
    if not isinstance(quantity, Amount):
        raise InputError(key, got=takes, takes="one value for all points: it is no quantity of a point")
    try:
        given = values if isinstance(values, np.ndarray) else [] if isinstance(values, str) else list(values)
    except TypeError:
        given = []
    if getattr(given, "ndim", 1) != 1 or not len(given):
        raise InputError(key, got=shown(values), takes=f"{takes}: in SI units, or texts with units")
    numeric = given.dtype.kind in "fiu" if isinstance(given, np.ndarray) else set(map(type, given)) == {float}
    if numeric:
        array = np.array(given, dtype=float)
        # All numbers are allowed if the least and the largest one are; NaN is the least, and is not allowed.
        checked = (int(np.argmin(array)), int(np.argmax(array)))
        if all(_parsed(quantity, given[index]) is not None for index in checked):
            array.flags.writeable = False
            return array
    numbers = np.empty(len(given))
    for index, value in enumerate(given):
        with at_index(key, index):
            numbers[index] = quantity.parse(value)
    numbers.flags.writeable = False
    return numbers


def _parsed(quantity: Amount, value: object) -> float | None:
    """Value of an entry in SI units; None for one that is not allowed."""
    try:
        return quantity.parse(value)
    except InputError:
        return None


@contextmanager
def at_index(key: str, index: int) -> Iterator[None]:
    """Context in which an error names the place of its value in the arrays of many points."""
    try:
        yield
    except InputError as error:
        where = f"{error.text} (at index {index} of the arrays)"
        raise error.with_text(key if error.key is None else error.key, where) from None


def _far_points(arrays: Mapping[str, Array]) -> list[int]:
    """Places of the least and of the largest number of each key, without the first place."""
    ends = {int(end(array)) for array in arrays.values() for end in (np.argmin, np.argmax)}
    return sorted(ends - {0})


# Tables in which a key that changes replaces its alternatives.
_ALTERNATIVES = {table: ALTERNATIVES[table] for table in ("bearing", "lubricant", "discharge")}

# Keys of [discharge] that a bearing file may not have.
_NOT_OF_BEARINGS = ("length",)


class _Tables(TypedDict, total=False):
    """Keys and tables of a bearing file besides ``bearing``, as ``BearingCase.of`` takes them."""

    lubricant: Required[Lubricant | Keys | str]
    title: str
    contacts: Contacts
    discharge: BearingDischarge | Keys | None
    motor: Motor | Keys | None
    solver: Solver | Keys | None
    ranges: Keys | None
    duty: Duty | Keys | None
    measured: Measured | Keys | None


class _BearingCaseKeys(_Tables, BearingKeys, total=False):
    pass


# Fields of these keywords, by the names of their tables in the book of inputs.
_FIELDS: Fields = {"bearing": Bearing.model_fields, "bearing_file": dict.fromkeys(keys_of(_Tables))}


class BearingCase(CaseFile, book="bearing_file"):
    """Rolling bearing in its machine: all inputs on which its capacitance and breakdown voltage depend.

    A case is made from a file by ``from_toml``, from nested tables by ``from_dict`` or by keywords, and from
    the keys of its bearing by ``BearingCase.of``. Wrong inputs raise an ``InputError`` that names their keys.
    A case is frozen; ``replace`` returns a changed copy. Numbers are in SI units.

    Parameters
    ----------
    bearing : Bearing or mapping
        Geometry, load, speed, temperature and roughness.
    lubricant : Lubricant or mapping
        Laws of the oil, or ``base``, the name of a lubricant of the library.
    title : str, optional
        Title of tables and figures.
    contacts : str, optional
        "solved", "atlas" for contacts from the atlas of films, or "formula" for film-thickness formulas.
    discharge, motor, solver, ranges, duty, measured : mapping, optional
        Further tables, as in a bearing file.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> case.bearing.elements, case.replace({"bearing.radial_load": "2 kN"}).bearing.radial_load
    (9, 2000.0)
    """

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            bearing: Bearing | Keys,
            lubricant: Lubricant | Keys,
            title: str = ...,
            contacts: str = ...,
            discharge: BearingDischarge | Keys = ...,
            motor: Motor | Keys | None = ...,
            solver: Solver | Keys = ...,
            ranges: Keys | None = ...,
            duty: Duty | Keys | None = ...,
            measured: Measured | Keys | None = ...,
        ) -> None: ...

    title: Title = ""
    contacts: Contacts = "solved"
    bearing: Bearing
    lubricant: Lubricant
    discharge: BearingDischarge = BearingDischarge()
    motor: Motor | None = None
    solver: Solver = Solver()
    ranges: tuple[InputRange, ...] | None = None
    duty: Duty | None = None
    measured: Measured | None = None

    @classmethod
    def missing_table_hint(cls, key: str, given: Mapping[str, Any]) -> str:
        """Return the text with the key by which a file without the table of its bearing is a bearing file."""
        sign = bearing_key(given) if key == "bearing" else None
        return "" if sign is None else f", [bearing], as the file looks like a bearing file: it has {sign}"

    @model_validator(mode="before")
    @classmethod
    def _with_uncertainties(cls, tables: Any) -> Any:
        """Inputs that are written with their uncertainty have their middle, and ``ranges`` has their ends."""
        return (
            with_stated_ranges(tables, partial(quantity_at, cls)) if isinstance(tables, Mapping) else tables
        )

    def all_inputs(self) -> dict[str, Any]:
        """Return the tables in SI units, also with the Rq that follows from an Ra."""
        tables = self.to_dict()
        return {**tables, "bearing": {**tables["bearing"], "composite_rq": self.bearing.composite_rq}}

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the dotted keys that the bearing does not have."""
        return super().unused_keys(given) | {f"discharge.{key}" for key in _NOT_OF_BEARINGS}

    @field_validator("ranges", mode="plain")
    @classmethod
    def _parsed(cls, tables: Any) -> tuple[InputRange, ...] | None:
        """Ranges of inputs in SI units."""
        return None if tables is None else ranges_of(tables, cls) or None

    @field_serializer("ranges")
    def _as_table(self, ranges: tuple[InputRange, ...] | None) -> dict[str, list[int | float]] | None:
        return table_of_ranges(ranges)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in _NOT_OF_BEARINGS:
            if getattr(self.discharge, key) is not None:
                raise InputError.worded(f"discharge.{key}", "is not used by a bearing")
        self._check_connected()
        self._set_defaults()
        check_heat(self.bearing, self.lubricant)
        if (
            self.bearing.by_supply_rule
            and self.lubricant.temperature is None
            and self.lubricant.density is None
        ):
            raise InputError.worded(
                "lubricant.density",
                f"missing; supply {self.bearing.supply!r} needs it for the kinematic viscosity",
            )
        check_ranges(self.ranges, self.to_dict)
        return self

    def _set_defaults(self) -> None:
        """Set a film factor that is not given, the best estimate that the oil allows, and a height of the
        summits that is not given: 0 for an isothermal film, whose voltages are upper bounds.
        """
        given, bearing = self.bearing.model_fields_set, self.bearing.model_copy()
        # They are not among the given keys, so that ``replace`` sets them anew for another oil.
        if "film_factor" not in given:
            bearing.__dict__["film_factor"] = DEFAULT_FILM if viscosity_follows(self.lubricant) else "none"
        if "summit_height" not in given:
            bearing.__dict__["summit_height"] = 0.0 if bearing.isothermal else DEFAULT_SUMMITS
        self.__dict__["bearing"] = bearing

    def _check_connected(self) -> None:
        """Check that one table says what is connected to the shaft, where a pit needs it."""
        external = self.discharge.external_capacitance
        if external is not None and self.motor is not None:
            raise InputError(
                "discharge.external_capacitance",
                got=f"{external:g} F and [motor]",
                takes="one of the two: the capacitances of a motor also discharge",
            )
        if self.discharge.pit is not None and external is None and self.motor is None:
            raise InputError.worded(
                "discharge.external_capacitance",
                "missing; pit needs it or [motor]: a discharge also drains what is connected to the shaft; "
                "give 0 if nothing is connected",
            )

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the points: () of a single bearing, (n,) of a case from ``with_arrays``."""
        return next((array.shape for array in self.arrays().values()), ())

    def with_arrays(self, values: Mapping[str, Any]) -> Self:
        """Return a case of many points, whose named keys have a number for each point.

        Parameters
        ----------
        values : mapping
            Arrays or lists of equal length n by dotted key, as ``{"bearing.radial_load": [900.0, 1000.0]}``:
            numbers in SI units, or texts with their units.

        Returns
        -------
        BearingCase
            Case whose named keys are arrays of shape (n,). ``single(index)`` is the case of one point.

        Raises
        ------
        InputError
            If a key is unknown or is not a quantity, an array has another length than the first one, or a
            number is outside the bounds of its key; the message names its place.

        Notes
        -----
        A new key replaces its alternative, as in ``replace``. The bounds of each key are checked at all
        points. Rules between keys, such as that a bore is less than the inner raceway, are checked at the
        first point and at the points with the smallest and the largest number of each key, and that there is
        a load at all points. Rules that fail at other points only are not found here; where they matter to a
        result, such as two viscosities that do not fall with temperature, this point has NaN.

        Examples
        --------
        >>> case = BearingCase.of(
        ...     base="6208", radial_clearance="10 um", radial_load="1 kN", inner_speed="3000 rpm",
        ...     temperature="70 degC", composite_rq="0.03 um", lubricant={"base": "paper"},
        ... )
        >>> loads, temperatures = ["1 kN", "2 kN"], [333.15, 353.15]
        >>> many = case.with_arrays({"bearing.radial_load": loads, "bearing.temperature": temperatures})
        >>> many.shape, many.bearing.radial_load
        ((2,), array([1000., 2000.]))
        """
        if self.shape:
            raise InputError(next(iter(self.arrays())), got="an array", takes="a case of one point")
        arrays: dict[str, Array] = {}
        for key, given in values.items():
            array = arrays[key] = _array_of(key, given, type(self))
            first = next(iter(arrays))
            if array.shape != arrays[first].shape:
                takes = f"{arrays[first].size}, as many as {first}"
                raise InputError(key, got=f"{array.size} values", takes=takes)
        if not arrays:
            raise InputError(got="no arrays", takes="at least one key with an array")
        with at_index("", 0):
            case = self.replace({key: float(array[0]) for key, array in arrays.items()})
        _check_together(case, arrays)
        for index in _far_points(arrays):
            with at_index("", index):
                self.replace({key: float(array[index]) for key, array in arrays.items()})
        return case.with_values(arrays)

    def _headline(self) -> str:
        """Title, bearing, loads and speed on one line."""
        bearing = self.bearing
        if self.shape:
            return headline(self.title, bearing.name or bearing.kind, f"{self.shape[0]} points")
        loads = [("radial", bearing.radial_load), ("axial", bearing.axial_load)]
        return headline(
            self.title,
            bearing.name or bearing.kind,
            *(f"{way} load {amount(load, 'N')}" for way, load in loads if load),
            *operating_point(bearing.inner_speed, bearing.oil_temperature, "degC"),
        )

    @classmethod
    @takes(_BearingCaseKeys, _FIELDS)
    def of(cls, **keys: Unpack[_BearingCaseKeys]) -> BearingCase:
        """Make a bearing case from the keys of its table ``bearing``, and its other tables.

        A number is a float in the SI unit in brackets, a text with its unit, or a quantity of pint. Required
        are the bearing, by ``base`` or its dimensions, a load, ``inner_speed``, a temperature,
        ``composite_rq`` and ``lubricant``. Keys of the other tables are on the page "Bearings" of the
        documentation.

        Examples
        --------
        >>> BearingCase.of(
        ...     base="6208",
        ...     radial_clearance="10 um",
        ...     radial_load="1 kN",
        ...     inner_speed="3000 rpm",
        ...     temperature="70 degC",
        ...     composite_rq="0.03 um",
        ...     lubricant={"base": "paper", "viscosity": "20 mPa s"},
        ... )
        <BearingCase 6208, radial load 1 kN, 3000 rpm, 70 degC>
        """
        tables, bearing = split(keys, _Tables)
        return BearingCase.from_dict({"bearing": bearing, **tables})

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a bearing case from the tables of the file at a path."""
        if "contact" in table and "bearing" not in table:
            raise InputError(
                path, "is the file of a contact", takes="the file of a bearing; ehlectric run solves it"
            )
        find_files(table, path.parent)
        return cls.from_written(table)

    def _speeds(self, table: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
        yield table["bearing"], "inner_speed"

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case; the title stays unless a new one is given.

        A new key replaces its alternative. A new ``lubricant.base`` replaces all values of the lubricant, and
        a new ``bearing.base`` all dimensions of the bearing; ``lubricant="fva-3"`` and ``bearing="6209"`` are
        such bases. A new base or another clearance class removes the ``designation`` of the old bearing. A
        range of a replaced value is removed.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"bearing.radial_load": "1 kN"}``.
        **tables
            New values by table, as in ``bearing={"radial_load": "1 kN"}``, or by key of the case, as in
            ``title="A"``. Other keys of a table stay; ``ranges`` is replaced as a whole.
        """
        refuse_deep({**tables, "changes": changes})
        named = with_name_keys(flat_changes(tables) | dict(changes or {}), BearingCase)
        changes = _with_named_class(_with_class(_with_typed_base(named)))
        table = open_tables(self)
        clearance = changes.get("bearing.clearance_class")
        if "bearing.base" in changes or is_of_another_class(self.bearing.designation, clearance):
            table["bearing"].pop("designation", None)
        if "lubricant.base" in changes:
            table["lubricant"] = {}
        if changes.get("bearing.base") is not None:
            _drop_dimensions(table["bearing"])
        if changes.get("bearing.coating.base") is not None:
            _drop_coating(table["bearing"], changes["bearing.coating.base"])
        displace_oil(table["lubricant"], nested(changes, "lubricant"))
        displace(table, changes, _ALTERNATIVES)
        set_keys(table, changes)
        drop_ranges(table, changes)
        bearing = table["bearing"]
        classed = isinstance(bearing, Mapping) and bearing.get("clearance_class") is not None
        if classed and "bearing.radial_clearance" not in changes:
            # It follows from the class, and anew where the class or the bore changes.
            bearing.pop("radial_clearance", None)
        return self.from_dict(table)


def open_tables(case: BearingCase) -> dict[str, Any]:
    """Tables of a case to be changed, in which keys that follow from other inputs are left open."""
    table = case.to_dict()
    for key in ("film_factor", "summit_height"):
        if key not in case.bearing.model_fields_set:
            del table["bearing"][key]
    return table


def _check_together(case: BearingCase, arrays: Mapping[str, Array]) -> None:
    """Refuse arrays that rules between keys exclude at all points."""
    of_class = case.bearing.clearance_class
    if of_class is not None and "bearing.bore" in arrays:
        text = f"an array with clearance_class {of_class!r}"
        takes = "one bore, by which the class gives the clearance, or radial_clearance"
        raise InputError("bearing.bore", got=text, takes=takes)
    keys = ("bearing.radial_load", "bearing.axial_load")
    loads = [arrays.get(key, getattr(case.bearing, key.partition(".")[2])) for key in keys]
    idle = np.broadcast_to((loads[0] == 0.0) & (loads[1] == 0.0), next(iter(arrays.values())).shape)
    if np.any(idle):
        with at_index(keys[0], int(np.argmax(idle))):
            raise InputError.missing(keys[0], "a load, radial or axial")


def _with_class(changes: dict[str, Any]) -> dict[str, Any]:
    """Changes with a clearance class that is given as ``radial_clearance`` in its own key, together with
    fits.
    """
    key = "bearing.radial_clearance"
    named = with_class({"radial_clearance": changes.get(key)}).get("clearance_class")
    if named is None:
        return changes
    rest = {name: value for name, value in changes.items() if name != key}
    return rest | {"bearing.clearance_class": named}


def _with_typed_base(changes: dict[str, Any]) -> dict[str, Any]:
    """Changes with a new designation in the key of the base, which a designation stands for."""
    keys = ("base", "designation")
    with within("bearing"):
        typed = typed_base({key: changes.get(f"bearing.{key}") for key in keys})
    if changes.get("bearing.designation") is None:
        return changes
    rest = {key: value for key, value in changes.items() if key != "bearing.designation"}
    return rest | {"bearing.base": typed}


def _with_named_class(changes: dict[str, Any]) -> dict[str, Any]:
    """Changes with the class of clearance of a new designation, unless they contain a clearance."""
    keys = [f"bearing.{key}" for key in ("radial_clearance", "clearance_class", "fits.unmounted_clearance")]
    with within("bearing"):
        named = class_of(changes.get("bearing.base"))
    if named is None or any(changes.get(key) is not None for key in keys):
        return changes
    return changes | {"bearing.clearance_class": named}


def _drop_dimensions(bearing: dict[str, Any]) -> None:
    """Remove the dimensions of a bearing, and all else that its base in the library gives."""
    of_base = base_of(bearing)[1] if bearing.get("base") else {}
    keys = {*DIMENSIONS, *of_base}
    if bearing.get("clearance_class") == NORMAL_CLASS:
        # Both follow from the new designation.
        keys |= {"clearance_class", "radial_clearance"}
    for key in keys:
        bearing.pop(key, None)


def _drop_coating(bearing: dict[str, Any], base: Any) -> None:
    """Remove the values of a coating that its base or a new base in the library gives."""
    coating = bearing.get("coating", {})
    names = [name for name in (coating.get("base"), base) if name in library.coating_names()]
    keys = {key for name in names for key in library.coating(name)}
    # Both state when the coating breaks down.
    keys |= {"strength"} if "breakdown_voltage" in keys else set()
    for key in keys:
        coating.pop(key, None)
