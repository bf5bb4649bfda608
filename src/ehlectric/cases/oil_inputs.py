"""Table `lubricant` of a case: its keys, laws and data sheet, the library's values under them, and their
checks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Annotated, Any, Literal, Optional, Self

from pydantic import (
    AfterValidator,
    ConfigDict,
    GetJsonSchemaHandler,
    ModelWrapValidatorHandler,
    SerializerFunctionWrapHandler,
    ValidationError,
    field_validator,
    model_serializer,
    model_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, InitErrorDetails

from ehlectric.arrays import Numbers
from ehlectric.cases import library
from ehlectric.cases.amounts import Amount, Amounts, amount_at, with_bounds
from ehlectric.cases.library.library_oils import Grade
from ehlectric.cases.table import Table, details_of, nearest
from ehlectric.cases.viscosity_tables import KEY, ViscosityTable, fitted_values, with_rows
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.data_sheet import Estimate, alpha_estimate, grade_middle, viscosity_at_100
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.electrical_laws import (
    CONDUCTIVITY,
    CONDUCTIVITY_LAWS,
    PERMITTIVITY_LAWS,
    RELATIVE_PERMITTIVITY,
)
from ehlectric.lubricant.heat_laws import HEAT_CAPACITY_LAWS, THERMAL_CONDUCTIVITY_LAWS
from ehlectric.lubricant.law import Law, Parameter, is_many, same
from ehlectric.lubricant.properties_over_temperature import density
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS, roelands_exponent
from ehlectric.lubricant.viscosity_over_temperature import ATMOSPHERIC_LAWS, COLD, HOT, Walther

# Keys that choose a law by name, each with the table of its laws, in the order of the case file.
LAWS: dict[str, Mapping[str, Law]] = {
    "atmospheric_law": ATMOSPHERIC_LAWS,
    "viscosity_law": VISCOSITY_LAWS,
    "density_law": DENSITY_LAWS,
    "permittivity_law": PERMITTIVITY_LAWS,
    "conductivity_law": CONDUCTIVITY_LAWS,
    "thermal_conductivity_law": THERMAL_CONDUCTIVITY_LAWS,
    "heat_capacity_law": HEAT_CAPACITY_LAWS,
}

# Laws that an oil may lack. If it gives no name but the parameters of the law "constant", it has that law.
OPTIONAL_LAWS = ("conductivity_law", "thermal_conductivity_law", "heat_capacity_law")


def law_parameters(*choices: str) -> dict[str, Parameter]:
    """Return the parameters of lubricant laws by name, from the law tables at the time of the call.

    ``choices`` are keys of ``LAWS``, such as "density_law"; without any, the laws of all keys count.

    Examples
    --------
    >>> law_parameters("density_law")["density_c1"].unit
    'Pa'
    """
    laws = (law for key in choices or LAWS for law in LAWS[key].values())
    return {parameter.name: parameter for law in laws for parameter in law.parameters}


@lru_cache(maxsize=256)
def _field_of(parameter: Parameter) -> FieldInfo:
    """Field of a parameter of a law, which is made once."""
    annotation = Annotated[float, with_bounds(Amount, parameter)]
    return FieldInfo(annotation=Optional[annotation], default=None)  # noqa: UP045


@dataclass(frozen=True)
class Named(AfterValidator):
    """Pydantic annotation of a name, with the names that are allowed."""

    takes: str = ""  # description of the allowed names, for messages


def law_name(laws: Mapping[str, object]) -> Named:
    """Pydantic annotation of the name of a law of this table."""

    def takes() -> str:
        return f"one of {', '.join(map(repr, laws))}"

    def known(name: str) -> str:
        if name not in laws:
            raise InputError(got=shown(name), takes=f"{takes()}; nearest is {nearest(name, laws)!r}")
        return name

    return Named(known, takes())


def library_choice(names: Callable[[], Sequence[str]], what: str = "one of the library") -> AfterValidator:
    """Pydantic annotation of a text that is one of the names of the library."""

    def known(name: str) -> str:
        if name not in names():
            raise InputError(got=shown(name), takes=f"{what}: {', '.join(names())}")
        return name

    return AfterValidator(known)


def library_name(base: Any, names: Sequence[str], *, otherwise: str = "") -> str:
    """Check that ``base`` is a name of the library, and return it; the number 6208 is not the name "6208".
    Raises InputError if the base is not a string, or not a name of the library; ``otherwise``, what its text
    proposes instead of a name.
    """
    if isinstance(base, str) and base in names:
        return base
    as_text = "" if isinstance(base, str) else ", as a string"
    raise InputError(
        "base", got=shown(base), takes=f"a name of the library{as_text}: {', '.join(names)}{otherwise}"
    )


def base_values(table: Any) -> dict[str, Any]:
    """Values of the lubricant that ``base`` names in the library; none without a base. Raises InputError if
    the library has no lubricant of this name.
    """
    if not isinstance(table, Mapping) or table.get("base") is None:
        return {}
    otherwise = "; for another grade of a base, add iso_vg and viscosity_index in [lubricant.temperature]"
    return library.lubricant(library_name(table["base"], library.lubricant_names(), otherwise=otherwise))


TEMPERATURE = amount_at("lubricant.reference_temperature")


class PermittivityTable(Table, book="lubricant.permittivity_table"):
    """Measured relative permittivity over temperature at ambient pressure, interpolated linearly."""

    temperature: tuple[float, ...]
    relative_permittivity: Annotated[
        tuple[float, ...], Amounts(with_bounds(Amount, RELATIVE_PERMITTIVITY), least=2)
    ]

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.check_over("temperature", "relative_permittivity")


class ConductivityTable(Table, book="lubricant.conductivity_table"):
    """Measured electrical conductivity over temperature; its logarithm is interpolated over 1/T."""

    temperature: tuple[float, ...]
    conductivity: Annotated[tuple[float, ...], Amounts(with_bounds(Amount, CONDUCTIVITY), least=2)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.check_over("temperature", "conductivity")


# Keys that give the viscosity.
SHEET_VISCOSITY = (
    *("kinematic_viscosity_40", "iso_vg", "kinematic_viscosity_1", "dynamic_viscosity_1", "temperature_1"),
    *("kinematic_viscosity_100", "viscosity_index"),
    *("kinematic_viscosity_2", "dynamic_viscosity_2", "temperature_2"),
)

# Smallest difference of the two temperatures of a data sheet [K]. A line through nearer points is uncertain.
_LEAST_APART = 5.0

# A root is found for each oil, and a case asks for it many times.
_at_100 = lru_cache(maxsize=64)(viscosity_at_100)


def _of_index(at_40: Numbers, index: Numbers) -> Numbers:
    """Kinematic viscosity at 100 degC [m^2/s] of an oil, or of many, with a viscosity index."""
    if not is_many(at_40, index):
        return _at_100(float(at_40), float(index))
    # One look at the list: another thread may replace its content at any time.
    latest = _latest[0] if _latest else None
    if latest is None or not (same(latest[0], at_40) and same(latest[1], index)):
        latest = (at_40, index, viscosity_at_100(at_40, index))
        _latest[:] = [latest]
    return latest[2]


# Roots of many oils that were found last, with their arguments.
_latest: list[tuple[Numbers, Numbers, Numbers]] = []


class OilTemperature(Table, book="lubricant.temperature"):
    """Viscosity, density, thermal expansion and thermal conductivity of an oil over temperature."""

    kinematic_viscosity_40: float | None = None
    iso_vg: Annotated[int, Grade()] | None = None
    kinematic_viscosity_1: float | None = None
    dynamic_viscosity_1: float | None = None
    temperature_1: float | None = None
    kinematic_viscosity_100: float | None = None
    viscosity_index: float | None = None
    kinematic_viscosity_2: float | None = None
    dynamic_viscosity_2: float | None = None
    temperature_2: float | None = None
    density_15: float
    # D. Dowson and G. R. Higginson, Elasto-Hydrodynamic Lubrication, Pergamon, 1966, as later works quote it.
    expansion: float = 6.5e-4
    base_oil: Literal["mineral-paraffinic", "mineral-naphthenic", "pao", "ester", "polyglycol"] | None = None
    thermal_conductivity: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        hint = "; an index of 95 to 100 is usual for mineral oils"
        for number, (first, second, more) in enumerate(
            (("kinematic_viscosity_40", "iso_vg", ""), ("kinematic_viscosity_100", "viscosity_index", hint)),
            1,
        ):
            typed = [f"{name}_{number}" for name in ("kinematic_viscosity", "dynamic_viscosity")]
            keys = (first, second, *typed)
            self.check_alternatives(keys, "one of them")
            takes = f"either {first} or {second}{more}; or {typed[0]} or {typed[1]} with temperature_{number}"
            self.check_alternatives(keys, takes, needed=True)
            self._check_temperature(number, typed, takes)
        if self.viscosity_index is not None and self._given("kinematic_viscosity_40", "iso_vg") is None:
            got = "it with a viscosity at another temperature than 40 °C"
            takes = "kinematic_viscosity_100, or a viscosity with temperature_2: the index needs 40 °C"
            raise InputError("viscosity_index", got=got, takes=takes)
        self.walther()
        return self

    def _given(self, *keys: str) -> Numbers | None:
        """Value of the first of some keys that the table gives; None if it gives none of them."""
        values: Iterator[Numbers] = (value for key in keys if (value := getattr(self, key)) is not None)
        return next(values, None)

    def _check_temperature(self, number: int, viscosities: Sequence[str], takes: str) -> None:
        """Check that a viscosity has a temperature, which differs from the temperature of the other one."""
        key = f"temperature_{number}"
        at, viscous = self._given(key), self._given(*viscosities)
        if viscous is not None and at is None:
            raise InputError.missing(key, "the temperature of this viscosity")
        if viscous is None and at is not None:
            raise InputError(key, got="a temperature without a viscosity", takes=takes)
        usual, elsewhere = (HOT, self.temperature_2) if number == 1 else (COLD, self.temperature_1)
        other = usual if elsewhere is None else elsewhere
        if at is not None and abs(float(at) - float(other)) < _LEAST_APART:
            takes = f"one that differs by {_LEAST_APART:g} K or more from the other one, {other:g} K"
            raise InputError(key, got=f"{at:g} K", takes=takes)

    def walther(self) -> Walther:
        """Kinematic viscosity over temperature, through the two given points. Raises InputError if the oil is
        too thin for ASTM D341 or, with an index, for ASTM D2270; of many oils, those have NaN.
        """
        of = ("kinematic_viscosity_2", "dynamic_viscosity_2", "kinematic_viscosity_100", "viscosity_index")
        key = next(key for key in of if getattr(self, key) is not None)
        return Walther.through(self._first(), self._second(), key)

    def _first(self) -> tuple[Numbers, Numbers]:
        """Temperature [K] and kinematic viscosity [m^2/s] of the first point."""
        if self.temperature_1 is not None:
            return self.temperature_1, self._kinematic("1", self.temperature_1)
        given = self.kinematic_viscosity_40
        assert given is not None or self.iso_vg is not None
        return COLD, grade_middle(int(self.iso_vg or 0)) if given is None else given

    def _second(self) -> tuple[Numbers, Numbers]:
        """Temperature [K] and kinematic viscosity [m^2/s] of the second point."""
        if self.temperature_2 is not None:
            return self.temperature_2, self._kinematic("2", self.temperature_2)
        if self.kinematic_viscosity_100 is not None:
            return HOT, self.kinematic_viscosity_100
        assert self.viscosity_index is not None
        try:
            return HOT, _of_index(self._first()[1], self.viscosity_index)
        except ValueError as error:
            got = f"{self.viscosity_index:g} ({error})"
            raise InputError("viscosity_index", got=got, takes="kinematic_viscosity_100 instead") from None

    def _kinematic(self, number: str, temperature: Numbers) -> Numbers:
        """Kinematic viscosity [m^2/s] of a point; a dynamic one is divided by the density there."""
        kinematic: Numbers | None = getattr(self, f"kinematic_viscosity_{number}")
        if kinematic is not None:
            return kinematic
        dynamic: Numbers = getattr(self, f"dynamic_viscosity_{number}")
        return dynamic / density(self.density_15, self.expansion, temperature)

    def at_40(self) -> Numbers:
        """Kinematic viscosity at 40 degC [m^2/s]: the given one, the middle of the ISO viscosity grade, or
        the value between or beyond the given points.
        """
        return self._first()[1] if self.temperature_1 is None else self.walther().viscosity(COLD)

    def at_100(self) -> Numbers:
        """Kinematic viscosity at 100 degC [m^2/s]: the given one, the value of the viscosity index, or the
        value between or beyond the given points. Raises InputError if an oil with this index is too thin for
        ASTM D2270; of many oils, those have NaN.
        """
        return self._second()[1] if self.temperature_2 is None else self.walther().viscosity(HOT)


ALPHA, EXPONENT = "pressure_viscosity_coefficient", "roelands_z"


def of_base_oil(oil: Properties) -> frozenset[str]:
    """Names of the parameters that follow from ``temperature.base_oil``, because the table lacks them.

    Where neither the coefficient nor Roelands' exponent is given, the coefficient is estimated. The exponent
    follows from the coefficient by Roelands' relation. A given exponent leaves nothing to estimate.
    """
    if oil.temperature is None or oil.temperature.base_oil is None or oil.parameter(EXPONENT) is not None:
        return frozenset()
    return frozenset({EXPONENT} if oil.parameter(ALPHA) is not None else {ALPHA, EXPONENT})


def estimated_alpha(oil: Properties, temperature: Numbers | None) -> Estimate | None:
    """Estimate of the coefficient at a temperature [K]; None where the table says what it is. Raises
    InputError if the viscosity is outside the range in which the estimate holds; of many points, those have
    NaN.
    """
    sheet = oil.temperature
    if sheet is None or sheet.base_oil is None or temperature is None or ALPHA not in of_base_oil(oil):
        return None
    walther = sheet.walther()
    return alpha_estimate(
        sheet.base_oil,
        walther.viscosity(temperature),
        slope=walther.b,
        density=density(sheet.density_15, sheet.expansion, temperature),
    )


def base_oil_values(oil: Properties, viscosity: Numbers, temperature: Numbers | None) -> dict[str, Numbers]:
    """Values of the parameters that follow from the type of base oil, at a viscosity [Pa s]."""
    names = of_base_oil(oil)
    estimate = estimated_alpha(oil, temperature)
    alpha = oil.parameter(ALPHA) if estimate is None else estimate.value
    if alpha is None:
        return {}
    values = {ALPHA: alpha}
    constant = oil.parameter("roelands_pressure")
    if constant is not None:
        values[EXPONENT] = roelands_exponent(viscosity, alpha, constant)
    return {name: values[name] for name in names if name in values}


# Keys of a base that are dropped where the case gives one of the keys before them.
_REPLACED: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...] = (
    (("relative_permittivity", "permittivity_table"), ("relative_permittivity", "permittivity_table")),
    (("conductivity", "conductivity_table"), ("conductivity", "conductivity_law", "conductivity_table")),
)


# Keys that give the viscosity at ambient pressure.
_AMBIENT = frozenset({"viscosity", "temperature", "atmospheric_law"})


def with_base(table: Any) -> Any:
    """Add to a table the values of the lubricant that ``base`` names in the library.

    Values of the table replace the values of the library. If the table states in another way how viscous the
    oil is, the library's way is dropped: a viscosity, a law over temperature, or a data sheet. With a data
    sheet or a law over temperature that has no viscosity as its parameter, the parameters that follow from
    the viscosity are also dropped. The density of a data sheet takes the place of the library's.

    Values of the library's data sheet stay unless the table replaces them: those whose keys a data sheet of
    the table does not give, and the thermal conductivity, whichever way gives the viscosity.

    Raises InputError if the library has no lubricant of this name.
    """
    if not isinstance(table, Mapping):
        return table
    table = with_rows(table)
    base = base_values(table)
    fitted = fitted_values(table, base)
    if fitted:
        base = {key: value for key, value in base.items() if key not in _AMBIENT | _other_viscosity(fitted)}
        base |= fitted
    if not base:
        return table
    left_out = _replaced(table) | _other_viscosity(table)
    kept = {key: value for key, value in base.items() if key not in left_out}
    sheet, given_temperature = base.get("temperature"), table.get("temperature")
    if isinstance(sheet, Mapping) and isinstance(given_temperature, Mapping):
        return kept | {**table, "temperature": _with_sheet(sheet, given_temperature)}
    if isinstance(sheet, Mapping) and "temperature" in left_out and "thermal_conductivity" in sheet:
        kept["thermal_conductivity"] = sheet["thermal_conductivity"]
    return kept | dict(table)


def _with_sheet(sheet: Mapping[str, Any], given_temperature: Mapping[Any, Any]) -> dict[Any, Any]:
    """Data sheet of a table, with those values of the library's sheet that it does not replace."""
    given = {key for key, value in given_temperature.items() if value is not None}
    # The viscosities of two oils are not mixed.
    left_out = given.union(SHEET_VISCOSITY) if given.intersection(SHEET_VISCOSITY) else given
    return {key: value for key, value in sheet.items() if key not in left_out} | dict(given_temperature)


def displace_oil(table: dict[str, Any], changes: Mapping[str, Any]) -> None:
    """Remove from the table of an oil the keys that changed keys replace, as ``with_base`` drops them.

    Examples
    --------
    >>> table = {"atmospheric_law": "vogel", "viscosity_law": "modulus"}
    >>> displace_oil(table, {"viscosity": 0.05})
    >>> table
    {'viscosity_law': 'modulus'}
    """
    displaced = _replaced(changes)
    if changes.get("conductivity_table") is None:
        # A conductivity is a parameter of its law.
        displaced -= {"conductivity_law"}
    ways = [key for key in ("temperature", "atmospheric_law") if changes.get(key) is not None]
    # A change within the same way, such as a grade of the same data sheet, replaces nothing.
    if not any(table.get(key) is not None for key in ways):
        displaced |= _other_viscosity(changes)
    if not ways and _has_viscosity(table.get("atmospheric_law")):
        displaced -= {"atmospheric_law"}
    if changes.get(KEY) is not None:
        before = table.get(KEY)
        displaced |= {*law_parameters("atmospheric_law"), *_AMBIENT, "temperature_range"}
        if before is None or before.get("pressure") is not None:
            # A table without pressures leaves the law over pressure to the file.
            displaced |= {*law_parameters("viscosity_law")}
            displaced |= {"viscosity_law"} if before is not None else set()
    for key in displaced - changes.keys():
        table.pop(key, None)


def _replaced(table: Mapping[Any, Any]) -> set[str]:
    """Keys that alternatives in a table take the place of, permittivity and conductivity."""
    pairs = [keys for given, keys in _REPLACED if any(table.get(key) is not None for key in given)]
    return {key for keys in pairs for key in keys}


def _other_viscosity(table: Mapping[Any, Any]) -> set[str]:
    """Keys of a base that give the viscosity in another way than the table does."""
    sheet = table.get("temperature")
    derived = {name for name, parameter in law_parameters().items() if parameter.derivation}
    if sheet is not None:
        if isinstance(sheet, Mapping) and sheet.get("base_oil") is not None:
            # The type of base oil gives the coefficient instead of the exponent of another oil.
            derived.add("roelands_z")
        return {"viscosity", "atmospheric_law", "density", *derived}
    name = table.get("atmospheric_law")
    if name is not None:
        # The coefficient of a base belongs to its viscosity, which such a law has at a reference temperature.
        return {"temperature"} if _has_viscosity(name) else {"viscosity", "temperature", *derived}
    if table.get("viscosity") is not None:
        return {"atmospheric_law", "temperature"}
    return set()


def _has_viscosity(name: Any) -> bool:
    """Whether a law over temperature has the viscosity at a reference temperature as a parameter."""
    law = ATMOSPHERIC_LAWS.get(name) if isinstance(name, str) else None
    return law is not None and any(parameter.name == "viscosity" for parameter in law.parameters)


class Properties(Table, book="lubricant", named_by="base"):
    """Keys of a lubricant: its properties, the names of its laws, and the parameters of these laws.

    The parameters of the laws are keys of this table, but not fields of the class. Their names, units and
    bounds come from the tables of laws at the time a case is read (``known_keys``). A parameter that the case
    does not give is None. A case may give parameters of laws that it does not use, for example by its base.
    """

    model_config = ConfigDict(extra="allow")

    base: str | None = None
    viscosity: float | None = None
    atmospheric_law: Annotated[str, law_name(ATMOSPHERIC_LAWS)] | None = None
    viscosity_table: ViscosityTable | None = None
    viscosity_law: Annotated[str, law_name(VISCOSITY_LAWS)]
    density_law: Annotated[str, law_name(DENSITY_LAWS)]
    permittivity_law: Annotated[str, law_name(PERMITTIVITY_LAWS)] = "clausius-mossotti"
    relative_permittivity: Annotated[float, with_bounds(Amount, RELATIVE_PERMITTIVITY)] | None = None
    permittivity_table: PermittivityTable | None = None
    conductivity_law: Annotated[str, law_name(CONDUCTIVITY_LAWS)] | None = None
    conductivity_table: ConductivityTable | None = None
    thermal_conductivity_law: Annotated[str, law_name(THERMAL_CONDUCTIVITY_LAWS)] | None = None
    heat_capacity_law: Annotated[str, law_name(HEAT_CAPACITY_LAWS)] | None = None
    density: float | None = None
    thermal_expansion: float | None = None
    reference_temperature: float | None = None
    eyring_stress: float | None = None
    carreau_stress: float | None = None
    carreau_exponent: float | None = None
    limiting_coefficient: float | None = None
    temperature_range: tuple[float, ...] | None = None
    temperature: OilTemperature | None = None
    ambient_pressure: float = 1e5

    if TYPE_CHECKING:
        # Parameters that users and other packages read as attributes.
        pressure_viscosity_coefficient: float | None = None
        roelands_z: float | None = None
        roelands_pressure: float | None = None
    else:

        def __getattr__(self, name: str) -> Any:
            try:
                return super().__getattr__(name)
            except AttributeError:
                if name in law_parameters():
                    return None
                raise

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Schema with the names of the laws and with their parameters, which are not fields of the class."""
        schema = super().__get_pydantic_json_schema__(core, handler)
        for name, parameter in law_parameters().items():
            if name not in schema["properties"]:
                quantity = with_bounds(Amount, parameter)
                schema["properties"][name] = quantity.__get_pydantic_json_schema__(core, handler)
        for name, laws in LAWS.items():
            schema["properties"][name]["enum"] = list(laws)
        return schema | {"additionalProperties": False}

    @property
    def over_temperature(self) -> bool:
        """Whether the viscosity at ambient pressure follows from the temperature."""
        return self.temperature is not None or self.atmospheric_law is not None

    def law(self, key: str) -> str | None:
        """Name of the law that the lubricant has for a key of ``LAWS``; None if it has none."""
        name: str | None = getattr(self, key)
        if name is None and key in OPTIONAL_LAWS:
            needed = LAWS[key]["constant"].parameters
            if all(self.knows(parameter.name) for parameter in needed):
                return "constant"
        return name

    def knows(self, name: str) -> bool:
        """Whether the case gives a parameter of a law, or its data sheet the density."""
        return self.parameter(name) is not None or (name == "density" and self.temperature is not None)

    def parameter(self, name: str) -> Numbers | None:
        """Value of a parameter of a law in SI units; None if the case does not give it."""
        given: Numbers | None = (self.__pydantic_extra__ or {}).get(name)
        return self.__dict__.get(name) if given is None else given

    @classmethod
    def key_names(cls) -> Iterator[str]:
        """Names of the keys of the table, in the order of ``known_keys``; a name may come twice."""
        for name in cls.model_fields:
            yield name
            for law in LAWS.get(name, {}).values():
                yield from (parameter.name for parameter in law.parameters)

    @classmethod
    def known_keys(cls) -> dict[str, FieldInfo]:
        """Keys of the table: its fields, and behind each choice of a law the parameters of these laws."""
        known: dict[str, FieldInfo] = {}
        for name, field in cls.model_fields.items():
            known[name] = field
            for parameter in law_parameters(name).values() if name in LAWS else ():
                if parameter.name not in cls.model_fields:
                    known[parameter.name] = _field_of(parameter)
        return known

    @field_validator("temperature", mode="before")
    @classmethod
    def _is_sheet(cls, value: Any) -> Any:
        """Refuse a temperature instead of the data sheet."""
        if isinstance(value, str | int | float):
            raise InputError(
                got=shown(value),
                takes="a table, the data sheet of the oil; the temperature of a contact is "
                "contact.temperature",
            )
        return value

    @model_validator(mode="wrap")
    @classmethod
    def _parse(cls, source: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        """Add the values of the base, and validate fields and parameters.

        Errors of fields and of parameters are raised together, in the order of ``known_keys``.
        """
        table = with_base(cls.of_name(source))
        if not isinstance(table, Mapping):
            return handler(table)
        parsed, errors = _parsed(cls, table)
        try:
            lubricant = handler(parsed)
        except ValidationError as error:
            errors += details_of(error)
        if errors:
            place = {name: k for k, name in enumerate(cls.known_keys())}
            errors.sort(key=lambda error: place.get(str(*error["loc"][:1]), len(place)))
            raise ValidationError.from_exception_data(cls.__name__, errors)
        return lubricant

    @model_serializer(mode="wrap")
    def _in_order(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Serialise the table with its keys in the order of ``known_keys``."""
        table = handler(self)
        return {name: table[name] for name in type(self).key_names() if name in table}


def _parsed(
    model: type[Properties], table: Mapping[Any, Any]
) -> tuple[dict[Any, Any], list[InitErrorDetails]]:
    """Parse the parameters of a table to SI units.

    Returns the table with parsed parameters, and the errors of parameters and of unknown keys.
    """
    known, parsed = law_parameters(), dict(table)
    errors: list[InitErrorDetails] = []
    for name in [name for name in table if isinstance(name, str) and name not in model.model_fields]:
        value = parsed.pop(name)
        try:
            if name not in known:
                errors.append(InitErrorDetails(type="extra_forbidden", loc=(name,), input=value))
            elif value is not None:
                parsed[name] = with_bounds(Amount, known[name]).parse(value)
        except ValueError as error:
            errors.append(
                InitErrorDetails(type="value_error", loc=(name,), input=value, ctx={"error": error})
            )
    return parsed, errors


# Ways to give the viscosity, for messages.
_WAYS = "viscosity, [lubricant.temperature] or atmospheric_law"


def refuse_missing(oil: Properties) -> None:
    """Check that a lubricant gives its values in one way, and that none is missing. Raises InputError if it
    does not; the message names all values that are missing.
    """
    checks: list[Callable[[], None]] = [partial(check_viscosity, oil), partial(check_once, oil)]
    for key, laws in LAWS.items():
        name = oil.law(key)
        if name is not None:
            checks.append(partial(check_parameters, oil, key, laws[name]))
    checks.append(partial(_check_permittivity, oil))
    missing: dict[str | None, InputError] = {}
    for check in checks:
        try:
            check()
        except InputError as error:
            if not error.is_missing:
                raise
            missing.setdefault(error.key, error)
    if missing:
        raise InputError.together(list(missing.values()))


def _check_permittivity(oil: Properties) -> None:
    """Check that a lubricant has a permittivity."""
    if oil.relative_permittivity is None and oil.permittivity_table is None:
        raise InputError.missing(
            "relative_permittivity", "either relative_permittivity or permittivity_table"
        )


def check_viscosity(oil: Properties) -> None:
    """Check that a lubricant has exactly one source of its viscosity at ambient pressure. Raises InputError
    if it has none, or more than one.
    """
    if VISCOSITY_LAWS[oil.viscosity_law].atmospheric is not None:
        for key in ("viscosity", "temperature", "atmospheric_law"):
            if getattr(oil, key) is not None:
                raise InputError.worded(
                    key, f"is not used: viscosity_law {oil.viscosity_law!r} gives the viscosity itself"
                )
        return
    ways = {
        "viscosity": oil.viscosity is not None and not _has_viscosity(oil.atmospheric_law),
        "temperature": oil.temperature is not None,
        "atmospheric_law": oil.atmospheric_law is not None,
    }
    given = [key for key, is_given in ways.items() if is_given]
    if len(given) != 1:
        together = f"{' and '.join(given)} together" if given else None
        raise InputError("viscosity", got=together, takes=f"either {_WAYS}")


def check_once(oil: Properties) -> None:
    """Check that no value is given twice, and that none is given which no law of the oil would use. Raises
    InputError for two conductivities or two densities, and for a value that lacks the key which gives it a
    meaning.
    """
    conductivities = [key for key in ("conductivity", "conductivity_law") if getattr(oil, key) is not None]
    if oil.conductivity_table is not None and conductivities:
        both = f"{conductivities[0]} and conductivity_table together"
        raise InputError(conductivities[0], got=both, takes="either of them")
    if oil.parameter("conductivity_activation") is not None and oil.conductivity_law is None:
        raise InputError.missing("conductivity_law", "'arrhenius', which uses conductivity_activation")
    if oil.density is not None and oil.temperature is not None:
        raise InputError("density", got="density and temperature.density_15 together", takes="either of them")
    if oil.parameter("heat_capacity") is not None and oil.law("heat_capacity_law") is None:
        raise InputError.missing("density", "the density, with which heat_capacity refers to a volume")
    if oil.thermal_expansion is not None and oil.reference_temperature is None:
        raise InputError.missing(
            "reference_temperature", "the temperature at which there is no thermal_expansion"
        )


def check_parameters(oil: Properties, key: str, law: Law) -> None:
    """Check that a lubricant has all parameters of one of its laws.

    A parameter that follows from the viscosity at a temperature may be missing where the viscosity depends
    on the temperature, a coefficient where the type of base oil is given, and a permittivity with its table.

    Raises InputError if a parameter is missing; the message names the law, and all parameters that it lacks.
    """
    given = {p.name: oil.parameter(p.name) for p in law.parameters}
    values = {name: value for name, value in given.items() if value is not None}
    missing, follows = [], of_base_oil(oil)
    if oil.permittivity_table is not None:
        follows |= {"relative_permittivity"}
    for parameter in law.parameters:
        rule = parameter.derivation
        if oil.knows(parameter.name) or parameter.name in follows:
            continue
        if rule is None or not oil.over_temperature:
            missing.append(parameter.name)
        elif any(oil.parameter(name) is None for name in rule.parameters):
            also = ", or temperature.base_oil for an estimate" if oil.temperature is not None else ""
            raise InputError.missing(
                parameter.name,
                f"it, or {' and '.join(rule.parameters)}, from which it follows at the temperature{also}",
            )
    if missing:
        also = f" with {', '.join(missing[1:])}" if missing[1:] else ""
        hint = law.hint(oil.viscosity, values) if law.hint and oil.viscosity else ""
        name = getattr(oil, key)
        source = _without_source(oil, missing[0])
        raise InputError.worded(missing[0], f"missing; {key} {name!r} needs it{also}{source}{hint}")


def _without_source(oil: Properties, name: str) -> str:
    """Text that the library has no source of a parameter, if its lubricant lacks it."""
    needs = library.tables("lubricant", oil.base).get("needs", ()) if oil.base else ()
    return f"; the library has no source of it for {oil.base!r}" if name in needs else ""
