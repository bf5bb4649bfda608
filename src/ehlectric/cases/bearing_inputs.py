"""Tables of a bearing file: bearing with fits, load and speed, lubricant over temperature, motor, heat,
summits and life.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from functools import partial
from typing import Annotated, Any, Literal, Self, TypedDict

from pydantic import BeforeValidator, SerializerFunctionWrapHandler, model_serializer, model_validator

from ehlectric.arrays import Numbers
from ehlectric.cases import library
from ehlectric.cases.amounts import amount_at
from ehlectric.cases.bearing_kinds import KEYS_OF_KINDS, KINDS_OF_BEARINGS
from ehlectric.cases.case_oil import Lubricant, viscosity_follows
from ehlectric.cases.coating_inputs import Coating
from ehlectric.cases.defaults import DEFAULT_FILM, DEFAULT_SUMMITS, FILM_FACTORS, ISOTHERMAL
from ehlectric.cases.film_inputs import check_thermal_oil
from ehlectric.cases.keywords import Keys, Value
from ehlectric.cases.library.bearing_catalogue import (
    CLASSES,
    NORMAL_CLASS,
    ClearanceClass,
    clearance_range,
    has_class,
    has_classes,
    with_class,
    with_clearance,
)
from ehlectric.cases.library.designation_types import no_such_bearing
from ehlectric.cases.library.designations import (
    Designation,
    as_typed,
    kind_and_series,
    known_bearings,
    read_designation,
)
from ehlectric.cases.library.estimated_bearings import estimated_bearing, series
from ehlectric.cases.mean_heights import FACTOR, rq_of, with_rq, without_rq
from ehlectric.cases.oil_inputs import library_choice
from ehlectric.cases.table import LONGEST, Table
from ehlectric.errors import InputError, shown, within
from ehlectric.formulas.inlet_supply import GEOMETRY_CONSTANTS, SUPPLY_CONSTANTS
from ehlectric.quantities.units import to_fraction
from ehlectric.runtime.display import is_number

# Full diametral play of a bearing.
PLAY = amount_at("bearing.radial_clearance")


_Solid = Annotated[str, library_choice(library.solid_names)]


class Fits(Table, book="bearing.fits"):
    """Clearance before mounting, fits on shaft and in housing, and their temperatures.

    The clearance in operation follows from them. All dimensions hold at ``reference_temperature``.
    """

    unmounted_clearance: float | None = None
    shaft_interference: float
    housing_interference: float
    shaft_bore: float = 0.0
    housing_diameter: float | None = None
    shaft_material: _Solid = "steel"
    housing_material: _Solid
    element_temperature: float | None = None
    shaft_temperature: float | None = None
    housing_temperature: float | None = None
    # Standard reference temperature of dimensions, ISO 1.
    reference_temperature: float = 293.15


class Motor(Table, book="motor"):
    """Common-mode voltage and capacitances of the motor around the bearing."""

    common_mode_voltage: float
    winding_rotor_capacitance: float
    rotor_frame_capacitance: float
    second_bearing_capacitance: float | None = None
    switching_frequency: float | None = None
    rise_time: float | None = None
    voltage_slope: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.switching_frequency is not None and self.rise_time is not None:
            period = 1.0 / self.switching_frequency
            if self.rise_time >= period:
                raise InputError(
                    "rise_time",
                    got=f"{self.rise_time:g} s",
                    takes=f"less than {period:.3g} s, a period of motor.switching_frequency",
                )
        return self


class Summits(Table, book="bearing.summits"):
    """Density, radius and heights of the summits of both surfaces together, at one sampling interval."""

    density: float
    radius: float
    height_deviation: float | None = None
    bandwidth: float | None = None
    highest: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        takes = "one of the two, as it follows from bandwidth"
        self.check_alternatives(("height_deviation", "bandwidth"), takes)
        return self


class Life(Table, book="bearing.life"):
    """Contamination, ratings and fatigue load limit of a bearing, for its rating life."""

    contamination_factor: float
    reliability: float = 0.9
    fatigue_load_limit: float | None = None
    dynamic_rating: float | None = None
    static_rating: float | None = None
    roughened_rq: float | None = None


class Pair(Table, book="bearing.pair"):
    """Second bearing that is alike and faces the first: arrangement, and preload or play of both."""

    arrangement: Literal["O", "X"]
    preload: float | None = None
    axial_clearance: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.preload is None) == (self.axial_clearance is None):
            both = None if self.preload is None else "it and axial_clearance together"
            raise InputError(
                "preload", got=both, takes="either preload or axial_clearance, the operating clearance"
            )
        return self


# Keys from which the radial clearance follows.
_OF_CLEARANCE = ("clearance_class", "fits")

# Relative error of a dimension that is rounding.
_ROUNDING = 1e-9

# Key of the temperature of a ring, by whether it is the inner one.
_RING_TEMPERATURE = {True: "inner_ring_temperature", False: "outer_ring_temperature"}

# What a message says of a needed key that is missing, where a few words help.
_CHOICES = {
    "profile": "'none' or 'logarithmic'",
    "radial_clearance": "the operating clearance, clearance_class with bore, or [bearing.fits]",
    "contact_angle": "the angle between the contacts and the radial plane",
}


def _word_or_part(words: Collection[str], value: Any) -> float | str:
    """One of some words, or a number above 0 and at most 1."""
    if isinstance(value, str) and value in words:
        return value
    if not is_number(value) or not 0.0 < value <= 1.0:
        names = ", ".join(map(repr, words))
        raise InputError(got=shown(value), takes=f"{names}, or a number above 0 and at most 1")
    return float(value)


def _fill(value: Any) -> float | str:
    """Filling of the gap around the films: "oil", "air", or the part of it that oil fills."""
    if value in ("oil", "air"):
        return str(value)
    part = value
    if isinstance(value, str):
        try:
            part = to_fraction(value)
        except ValueError:
            part = None
    if not is_number(part) or not 0.0 <= part <= 1.0:
        raise InputError(got=shown(value), takes="'oil' or 'air', or the part filled with oil, from 0 to 1")
    return float(part)


_Material = Annotated[str, library_choice(partial(library.solid_names, rolling=True))]


def _with_designation(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table whose ``base`` is a name of the library or of a series, where it is the designation of a maker,
    which then is in ``designation``.

    If the table contains no clearance, the class of clearance of the designation is used. A table with
    another class is refused.
    """
    base = typed_base(table)
    rest = {key: value for key, value in table.items() if key != "designation"}
    read = _read(base)
    if read is None:
        return {**rest, "base": base}
    named, given = read.clearance_class, table.get("clearance_class")
    kind = kind_and_series(read.name)[0]
    if named is not None and "radial_clearance" not in KINDS_OF_BEARINGS[kind].keys:
        takes = (
            f"the designation without {named!r}: bearings of kind {kind} have no class of radial clearance"
        )
        raise InputError("base", got=shown(base), takes=takes)
    if named is not None and given in CLASSES and given != named:
        takes = f"{named!r}, as in base, or base without its class"
        raise InputError("clearance_class", got=f"{given!r} with base {base!r}", takes=takes)
    rest |= {"base": read.name, **_kept(base, read.name)}
    return rest if named is None or _has_clearance(table) else rest | {"clearance_class": named}


def _read(base: Any, key: str = "base") -> Designation | None:
    """Bearing with a designation in a key; None for a name of the library or a series, or another value."""
    if not isinstance(base, str) or base in known_bearings():
        return None
    try:
        return read_designation(base, known_bearings())
    except InputError as error:
        raise error.with_text(key, error.text) from None


def _kept(text: str, name: str) -> dict[str, str]:
    """Key with a designation; none if the text contains no more than the name of its bearing."""
    typed = as_typed(text)
    if len(typed) > LONGEST:
        raise InputError("base", got=shown(text), takes=f"a designation of at most {LONGEST} characters")
    return {} if _named(typed) == name else {"designation": typed}


def _named(text: str) -> str:
    """Text as a name of the library or a series is written."""
    return "-".join(text.lower().split())


def typed_base(table: Mapping[str, Any]) -> Any:
    """Designation of a table ``bearing``, otherwise its ``base``. Raises InputError if both are given and are
    not the same bearing.

    Examples
    --------
    >>> typed_base({"base": "6208", "designation": "SKF 6208-2Z"})
    'SKF 6208-2Z'
    """
    base, typed = table.get("base"), table.get("designation")
    if typed is None:
        return base
    read = _read(typed, "designation")
    if read is None and not (isinstance(typed, str) and typed in known_bearings()):
        error = no_such_bearing(typed)
        raise error.with_text("designation", error.text)
    name = typed if read is None else read.name
    plain = as_typed(base) if isinstance(base, str) else base
    if (
        plain is not None
        and plain != as_typed(typed)
        and (not isinstance(plain, str) or _named(plain) != name)
    ):
        takes = f"one of the two, or base {name!r}, the bearing with this designation"
        raise InputError("designation", got=f"{shown(typed)} with base {shown(base)}", takes=takes)
    return typed


def _has_clearance(table: Mapping[str, Any]) -> bool:
    """Whether a table contains a clearance, of which ever kind, or the contact angle that replaces it."""
    fits = table.get("fits")
    unmounted = fits.get("unmounted_clearance") if isinstance(fits, Mapping) else None
    keys = ("radial_clearance", "clearance_class", "contact_angle")
    return unmounted is not None or any(table.get(key) is not None for key in keys)


def _with_normal_class(table: Mapping[str, Any]) -> Mapping[str, Any]:
    """Table with the class CN if it contains no clearance, and classes exist for its kind of bearing.

    A designation without a suffix stands for this class.
    """
    kind, given = KINDS_OF_BEARINGS.get(str(table.get("kind"))), table.get("bore")
    if kind is None or "radial_clearance" not in kind.keys or given is None:
        return table
    if table.get("inner_ring") is False or _has_clearance(table):
        return table
    with within("bore"):
        bore = amount_at("bearing.bore").parse(given)
    if not has_class(str(table["kind"]), NORMAL_CLASS, bore):
        return table
    return {**table, "clearance_class": NORMAL_CLASS}


def is_of_another_class(designation: Any, clearance_class: Any) -> bool:
    """Whether a class of clearance contradicts the class in a designation.

    Examples
    --------
    >>> is_of_another_class("6208-2Z/C3", "C4"), is_of_another_class("6208-2Z", "C4")
    (True, False)
    """
    named = class_of(designation)
    return None not in (named, clearance_class) and named != clearance_class


def class_of(base: Any) -> ClearanceClass | None:
    """Class of clearance that a designation names; None without one, and for a name of the library.

    Examples
    --------
    >>> class_of("6208-2RS1/C3"), class_of("6208"), class_of("own")
    ('C3', None, None)
    """
    read = _read(base)
    return None if read is None else read.clearance_class


def _base_table(table: Mapping[str, Any]) -> dict[str, Any]:
    """Table of the bearing that ``base`` names, of the library or estimated for its load ratings. Raises
    InputError for another name.
    """
    base = table["base"]
    if isinstance(base, str) and base in library.bearing_names():
        return library.bearing(base)
    if isinstance(base, str) and base in series():
        return estimated_bearing(base, *_given_ratings(table.get("life")))
    raise no_such_bearing(base)


def base_of(table: Mapping[str, Any]) -> tuple[Mapping[str, Any], dict[str, Any]]:
    """Table ``bearing`` with the name of its bearing instead of a designation, and the values of the bearing
    that ``base`` names. Raises InputError for an unknown one.

    Examples
    --------
    >>> table, base = base_of({"base": "NU 210 ECP/C3"})
    >>> table["base"], table["clearance_class"], base["elements"]
    ('nu-210', 'C3', 16)
    """
    named = _with_designation(table)
    return named, _base_table(named)


def _given_ratings(life: Any) -> Iterator[float | None]:
    """Dynamic and static load rating of a table ``life`` [N]; None for one that is not given."""
    for key in ("dynamic_rating", "static_rating"):
        value = life.get(key) if isinstance(life, Mapping) else getattr(life, key, None)
        with within(f"life.{key}"):
            yield None if value is None else amount_at(f"bearing.life.{key}").parse(value)


def _not_of_kind(kind: str) -> set[str]:
    """Keys that bearings of some other kinds have, and of this kind have not."""
    keys = KINDS_OF_BEARINGS[kind].keys
    clearance = () if "radial_clearance" in keys else _OF_CLEARANCE
    return {*(key for key in KEYS_OF_KINDS if key not in keys), *clearance}


class Bearing(Table, book="bearing", named_by="base"):
    """Internal geometry, materials, load, speed and temperature of a rolling bearing."""

    base: str | None = None
    designation: str | None = None
    kind: Literal[
        "deep-groove ball",
        "angular-contact ball",
        "four-point contact ball",
        "thrust ball",
        "cylindrical roller",
        "needle roller",
        "tapered roller",
        "thrust needle roller",
    ]
    elements: int
    bore: float | None = None
    outer_diameter: float | None = None
    width: float | None = None
    element_diameter: float
    pitch_diameter: float
    inner_groove: float | None = None
    outer_groove: float | None = None
    roller_length: float | None = None
    profile: Literal["none", "logarithmic"] | None = None
    shoulder_height: float | None = None
    radial_clearance: float | None = None
    clearance_class: ClearanceClass | None = None
    contact_angle: float | None = None
    inner_ring: bool | None = None
    pair: Pair | None = None
    element_material: _Material = "steel"
    ring_material: _Material = "steel"
    element_capacitance: float | None = None
    radial_load: float = 0.0
    axial_load: float = 0.0
    inner_speed: float
    temperature: float | None = None
    inner_ring_temperature: float | None = None
    outer_ring_temperature: float | None = None
    composite_rq: float
    composite_ra: float | None = None
    rq_over_ra: float | None = None
    summit_height: float = DEFAULT_SUMMITS
    summits: Summits | None = None
    contact_resistance: float | None = None
    fill: Annotated[float | str, BeforeValidator(_fill)] = "oil"
    parallel_capacitance: float | None = None
    coating: Coating | None = None
    film_factor: Annotated[float | str, BeforeValidator(partial(_word_or_part, FILM_FACTORS))] = DEFAULT_FILM
    supply: Annotated[float | str, BeforeValidator(partial(_word_or_part, SUPPLY_CONSTANTS))] = "flooded"
    fits: Fits | None = None
    life: Life | None = None

    @classmethod
    def of_name(cls, table: Any) -> Any:
        """Table instead of the name of a bearing; a designation without a base is also the base."""
        named = super().of_name(table)
        if (
            not isinstance(named, Mapping)
            or named.get("designation") is None
            or named.get("base") is not None
        ):
            return named
        return {**named, "base": named["designation"]}

    @model_validator(mode="before")
    @classmethod
    def _from_base(cls, table: Any) -> Any:
        """Values of the bearing that ``base`` names in the library, replaced by the values of the file."""
        table = with_rq(cls.of_name(table), "bearing", "composite_rq", "composite_ra")
        if not isinstance(table, Mapping):
            return table
        table = with_class(table)
        if table.get("base") is None:
            return with_clearance(table)
        table, base = base_of(table)
        if table.get("clearance_class") is not None or table.get("fits") is not None:
            base.pop("radial_clearance", None)
        return with_clearance(_with_normal_class({**base, **table}))

    @model_serializer(mode="wrap")
    def _of_ra(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return without_rq(handler(self), "composite_rq", "composite_ra")

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Copy with values that are not checked; a changed Ra or factor changes the Rq."""
        changed = super().with_values(values)
        if changed.composite_ra is None or not values.keys() & {"composite_ra", FACTOR}:
            return changed
        rq = rq_of(changed.composite_ra, changed.rq_over_ra)
        return changed.model_copy(update={"composite_rq": rq})

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the keys that bearings of the given kind, or of the kind of the given base, do not have."""
        kind = given.get("kind")
        if kind is None and (given.get("base") or given.get("designation")) is not None:
            with suppress(InputError):
                kind = base_of(given)[1].get("kind")
        unused = super().unused_keys(given)
        return unused | _not_of_kind(str(kind)) if kind in KINDS_OF_BEARINGS else unused

    @property
    def name(self) -> str | None:
        """Designation as typed, otherwise the name of the library; None for a geometry without a name."""
        return self.designation or self.base

    @property
    def oil_temperature(self) -> float:
        """Temperature of the oil outside the films [K]: the given one, or the only one of the rings."""
        return next(iter(self.temperatures().values()))

    def ring_temperature(self, *, inner: bool) -> float:
        """Temperature of a ring and of the oil in its contacts [K]: the given one, or the temperature of the
        oil.
        """
        return self.temperatures().get(_RING_TEMPERATURE[inner], self.oil_temperature)

    def temperature_key(self, *, inner: bool | None = None) -> str:
        """Dotted key of the temperature of a ring, or of the oil outside the films."""
        given = list(self.temperatures())
        key_of_ring = None if inner is None else _RING_TEMPERATURE[inner]
        return f"bearing.{key_of_ring if key_of_ring in given else given[0]}"

    def temperatures(self) -> dict[str, float]:
        """Given temperatures of oil and rings [K], by key; the temperature of the oil comes first."""
        keys = ("temperature", "inner_ring_temperature", "outer_ring_temperature")
        return {key: value for key in keys if (value := getattr(self, key)) is not None}

    def all_temperatures(self) -> dict[str, float]:
        """Temperatures that are given [K], also of elements, shaft and housing, by key."""
        parts = {f"fits.{part}_temperature": part for part in ("element", "shaft", "housing")}
        of_fits = {key: getattr(self.fits, f"{part}_temperature", None) for key, part in parts.items()}
        return self.temperatures() | {key: value for key, value in of_fits.items() if value is not None}

    @property
    def element_temperature(self) -> float:
        """Temperature of the elements [K]: the given one, or the mean of both rings."""
        given = None if self.fits is None else self.fits.element_temperature
        rings = [self.ring_temperature(inner=inner) for inner in (True, False)]
        return 0.5 * sum(rings) if given is None else given

    @property
    def heated(self) -> bool:
        """Whether the heat in the films is computed, by a formula or solved."""
        return self.film_factor in FILM_FACTORS[1:]

    @property
    def isothermal(self) -> bool:
        """Whether the films have no heat, neither computed nor in a given factor: they are upper bounds."""
        return self.film_factor in ISOTHERMAL

    @property
    def bounding(self) -> bool:
        """Whether the breakdown voltages are upper bounds: with isothermal or smooth films."""
        return self.isothermal or (is_number(self.summit_height) and self.summit_height == 0.0)

    @property
    def ceramic(self) -> bool:
        """Whether the elements insulate."""
        return not library.solid(self.element_material)["conducting"]

    @property
    def capacitance_is_bound(self) -> bool:
        """Whether the capacitance is an upper bound: ceramic elements without ``element_capacitance``."""
        return self.ceramic and self.element_capacitance is None

    @property
    def rows(self) -> int:
        """Number of bearings side by side: 2 of a pair."""
        return 1 if self.pair is None else 2

    @property
    def by_supply_rule(self) -> bool:
        """Whether a rule for the way of supply reduces the films."""
        return isinstance(self.supply, str) and SUPPLY_CONSTANTS[self.supply] > 0.0

    @property
    def unmounted_clearance(self) -> float | None:
        """Clearance before mounting [m], given or the middle of the class; None without ``fits``."""
        if self.fits is None or self.fits.unmounted_clearance is not None:
            return None if self.fits is None else self.fits.unmounted_clearance
        assert self.clearance_class is not None and self.bore is not None
        return clearance_range(self.kind, self.clearance_class, self.bore).middle

    @model_validator(mode="after")
    def _check(self) -> Self:
        self._check_kind()
        self._check_temperatures()
        if self.fits is not None:
            self._check_fits(self.fits)
        if self.radial_load == 0.0 and self.axial_load == 0.0:
            raise InputError.missing("radial_load", "a load, radial or axial")
        if self.by_supply_rule:
            self._check_diameters(f"supply {self.supply!r}")
            if self.kind not in GEOMETRY_CONSTANTS:
                takes = "'flooded' or a number: its rule has no constant for a needle roller bearing"
                raise InputError("supply", got=shown(self.supply), takes=takes)
        if self.element_capacitance is not None and not self.ceramic:
            raise InputError.worded(
                "element_capacitance",
                "is only for ceramic elements; the capacitance of steel elements is computed",
            )
        if not library.solid(self.ring_material)["conducting"]:
            raise InputError("ring_material", got=shown(self.ring_material), takes="one that conducts")
        self.coating_capacitance()
        if self.coating is not None and self.coating.over_moulded and self.fits is not None:
            raise InputError.worded(
                "fits",
                "is not computed for an over-moulded ring, whose seat is a polymer; give radial_clearance",
            )
        self._check_roughened()
        return self

    def _check_roughened(self) -> None:
        """Check that discharges roughen the raceways, and do not smooth them."""
        rough = None if self.life is None else self.life.roughened_rq
        if rough is not None and rough < self.composite_rq:
            raise InputError(
                "life.roughened_rq",
                got=f"{1e6 * rough:.4g} µm",
                takes=f"at least composite_rq, {1e6 * self.composite_rq:.4g} µm",
            )

    def coating_capacitance(self) -> Numbers:
        """Capacitance of the coating [F]; infinite without a coating. Raises InputError where a coating is
        given, and neither its area nor the dimensions of its ring.
        """
        if self.coating is None:
            return math.inf
        diameters = {"inner": self.bore, "outer": self.outer_diameter}
        return self.coating.capacitance_on(diameters, self.width)

    def _check_kind(self) -> None:
        kind = KINDS_OF_BEARINGS[self.kind]
        for key in kind.needed:
            if getattr(self, key) is None and not (key == "radial_clearance" and self.fits is not None):
                choice = _CHOICES.get(key)
                # Without an inner ring the shaft decides the clearance.
                if key == "radial_clearance" and (not has_classes(self.kind) or self.inner_ring is False):
                    choice = "the operating clearance as a length: no table has a class for this bearing"
                text = f"missing; a bearing of kind {self.kind!r} needs it"
                raise InputError.worded(key, text if choice is None else f"{text}: {choice}", takes=choice)
        for key in (*KEYS_OF_KINDS, *_OF_CLEARANCE):
            if key in _not_of_kind(self.kind) and getattr(self, key) is not None:
                raise InputError.worded(key, f"is not used by a bearing of kind {self.kind!r}")
        self._check_boundary()
        for key, carries in (("radial_load", kind.radial), ("axial_load", kind.axial)):
            load = getattr(self, key)
            if load and not carries:
                takes = f"0 in a {self.kind} bearing, whose raceways carry none"
                raise InputError(key, got=f"{load:g} N", takes=takes)
        if self.fits is not None and self.inner_ring is False:
            raise InputError.worded(
                "fits",
                "is not computed without an inner ring, as the shaft is the raceway; give radial_clearance",
            )

    def _check_temperatures(self) -> None:
        """A temperature is given; the oil needs one if both rings have their own."""
        given = len(self.temperatures())
        if self.temperature is None and given != 1:
            other = "; the temperatures of both rings do not give it" if given else ""
            raise InputError.missing("temperature", f"the temperature of the oil{other}")

    def _check_fits(self, fits: Fits) -> None:
        """The clearance before mounting is given once, and shaft and housing fit the bearing."""
        if self.radial_clearance is not None:
            raise InputError(
                "radial_clearance",
                got=f"{self.radial_clearance:g} m with [bearing.fits]",
                takes="fits.unmounted_clearance or clearance_class, the initial clearance",
            )
        if (fits.unmounted_clearance is None) == (self.clearance_class is None):
            both = None if self.clearance_class is None else "it and clearance_class together"
            raise InputError(
                "fits.unmounted_clearance", got=both, takes="either unmounted_clearance or clearance_class"
            )
        self._check_diameters("[bearing.fits]")
        assert self.bore is not None and self.outer_diameter is not None
        if fits.shaft_bore >= self.bore:
            takes = f"less than the bore of the bearing, {self.bore:g} m"
            raise InputError("fits.shaft_bore", got=f"{fits.shaft_bore:g} m", takes=takes)
        if fits.housing_diameter is not None and fits.housing_diameter <= self.outer_diameter:
            takes = f"more than the outside diameter of the bearing, {self.outer_diameter:g} m"
            raise InputError("fits.housing_diameter", got=f"{fits.housing_diameter:g} m", takes=takes)
        if self.clearance_class is not None:
            clearance_range(self.kind, self.clearance_class, self.bore)

    def _check_diameters(self, what: str) -> None:
        """Check that both diameters of the bearing are given, which something needs."""
        for key, name in (("bore", "bore"), ("outer_diameter", "outside diameter")):
            if getattr(self, key) is None:
                raise InputError.missing(key, f"the {name} of the bearing, which {what} needs")

    def _check_boundary(self) -> None:
        """Both rings have a thickness, and the element is not wider than the bearing."""
        inner = self.pitch_diameter - self.element_diameter
        outer = self.pitch_diameter + self.element_diameter
        thrust = not KINDS_OF_BEARINGS[self.kind].radial
        # Without an inner ring the shaft is the raceway, and the washers of a thrust bearing lie next to it.
        inner += _ROUNDING * inner if thrust or self.inner_ring is False else 0.0
        if self.bore is not None and self.bore >= inner:
            raise InputError(
                "bore", got=f"{self.bore:g} m", takes=f"less than the inner raceway, {inner:g} m"
            )
        if self.outer_diameter is not None and self.outer_diameter <= outer:
            raise InputError(
                "outer_diameter",
                got=f"{self.outer_diameter:g} m",
                takes=f"more than the outer raceway, {outer:g} m",
            )
        across = self.element_diameter if self.roller_length is None or thrust else self.roller_length
        if self.width is not None and self.width < across:
            raise InputError(
                "width", got=f"{self.width:g} m", takes=f"at least the width of an element, {across:g} m"
            )


class BearingKeys(TypedDict, total=False):
    """Keys of the table ``bearing``, as ``BearingCase.of`` takes them."""

    base: str
    designation: str
    kind: str
    elements: int
    bore: Value
    outer_diameter: Value
    width: Value
    element_diameter: Value
    pitch_diameter: Value
    inner_groove: Value
    outer_groove: Value
    roller_length: Value
    profile: str
    shoulder_height: Value
    radial_clearance: Value
    clearance_class: str
    contact_angle: Value
    inner_ring: bool
    pair: Keys
    element_material: str
    ring_material: str
    element_capacitance: Value
    radial_load: Value
    axial_load: Value
    inner_speed: Value
    temperature: Value
    inner_ring_temperature: Value
    outer_ring_temperature: Value
    composite_rq: Value
    composite_ra: Value
    rq_over_ra: Value
    summit_height: Value
    summits: Keys
    contact_resistance: Value
    fill: float | str
    film_factor: float | str
    supply: float | str
    fits: Keys
    parallel_capacitance: Value
    coating: Keys | str
    life: Keys


def check_heat(bearing: Bearing, oil: Lubricant) -> None:
    """Check that a bearing file has all that its film factor needs. Raises InputError where a property of the
    oil or of a material is missing.
    """
    if bearing.film_factor == "inlet-shear":
        _check_inlet(oil)
    elif bearing.film_factor == "solved":
        _check_solved(bearing, oil)


def _check_inlet(oil: Lubricant) -> None:
    """Check that the viscosity follows the temperature, without which shear heats no inlet."""
    if not viscosity_follows(oil):
        needs = "film_factor 'inlet-shear' needs a viscosity that follows the temperature"
        raise InputError.worded(
            "lubricant.viscosity", f"is one for all temperatures; {needs}", takes="a data sheet or a law"
        )


def _check_solved(bearing: Bearing, oil: Lubricant) -> None:
    """Check that the thermal properties of elements, rings and oil are known."""
    what, known = "film_factor 'solved'", library.solid_names(rolling=True, thermal=True)
    for key in ("element_material", "ring_material"):
        name = getattr(bearing, key)
        if name not in known:
            raise InputError.worded(
                f"bearing.{key}",
                f"{name!r} has no thermal properties in the library, and {what} needs them; use "
                f"{' or '.join(map(repr, known))} or another film_factor",
                takes=" or ".join(map(repr, known)),
            )
    for inner in (True, False):
        check_thermal_oil(oil, bearing.ring_temperature(inner=inner), what)
