"""Keys of the table ``lubricant`` of a case: its fields, and the parameters of the laws of an oil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Optional, Self

from pydantic import (
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

from ehlectric.cases.amounts import Amount, Amounts
from ehlectric.cases.oils.alternatives import with_base
from ehlectric.cases.oils.laws import LAWS, OPTIONAL_LAWS, is_parameter, law_name, law_parameters, quantity_of
from ehlectric.cases.oils.over_temperature import TEMPERATURE, ConductivityTable, PermittivityTable
from ehlectric.cases.oils.temperature import OilTemperature
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.atmospheric import ATMOSPHERIC_LAWS
from ehlectric.lubricant.conductivity import CONDUCTIVITY_LAWS
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.heat_capacity import HEAT_CAPACITY_LAWS
from ehlectric.lubricant.permittivity import PERMITTIVITY_LAWS, RELATIVE_PERMITTIVITY
from ehlectric.lubricant.thermal_conductivity import THERMAL_CONDUCTIVITY_LAWS
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS


class Properties(Table):
    """Keys of a lubricant: its properties, the names of its laws, and the parameters of these laws.

    The parameters of the laws are keys of this table, but not fields of the class. Their names, units and
    bounds come from the tables of laws at the time a case is read (``known_keys``). A parameter that the case
    does not give is None. A case may give parameters of laws that it does not use, for example by its base.
    """

    model_config = ConfigDict(extra="allow")

    base: str | None = None
    viscosity: Annotated[float, Amount("Pa*s", least=1e-7, most=1e6, reason="at ambient pressure")] | None = (
        None
    )
    atmospheric_law: Annotated[str, law_name(ATMOSPHERIC_LAWS)] | None = None
    viscosity_law: Annotated[str, law_name(VISCOSITY_LAWS)]
    density_law: Annotated[str, law_name(DENSITY_LAWS)]
    permittivity_law: Annotated[str, law_name(PERMITTIVITY_LAWS)] = "clausius-mossotti"
    relative_permittivity: Annotated[float, quantity_of(RELATIVE_PERMITTIVITY)] | None = None
    permittivity_table: PermittivityTable | None = None
    conductivity_law: Annotated[str, law_name(CONDUCTIVITY_LAWS)] | None = None
    conductivity_table: ConductivityTable | None = None
    thermal_conductivity_law: Annotated[str, law_name(THERMAL_CONDUCTIVITY_LAWS)] | None = None
    heat_capacity_law: Annotated[str, law_name(HEAT_CAPACITY_LAWS)] | None = None
    density: Annotated[float, Amount("kg/m**3", least=500.0, most=3000.0, reason="of an oil")] | None = None
    thermal_expansion: (
        Annotated[float, Amount("1/K", least=1e-5, most=2e-3, reason="of the volume of an oil")] | None
    ) = None
    reference_temperature: Annotated[float, TEMPERATURE] | None = None
    eyring_stress: (
        Annotated[float, Amount("Pa", least=1e4, most=1e9, reason="oils have 2 to 20 MPa")] | None
    ) = None
    carreau_stress: (
        Annotated[float, Amount("Pa", least=1e2, most=1e9, reason="10 kPa of thickened oils to 10 MPa")]
        | None
    ) = None
    carreau_exponent: (
        Annotated[float, Amount("", least=0.1, most=1.0, reason="1 is a Newtonian oil")] | None
    ) = None
    limiting_coefficient: (
        Annotated[float, Amount("", least=1e-3, most=0.5, reason="limiting shear stress over pressure")]
        | None
    ) = None
    temperature_range: Annotated[tuple[float, ...], Amounts(TEMPERATURE, least=2)] | None = None
    temperature: OilTemperature | None = None
    ambient_pressure: Annotated[float, Amount("Pa", least=0.0, most=1e8, reason="around the contact")] = 1e5

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
                if is_parameter(name):
                    return None
                raise

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Schema with the names of the laws and with their parameters, which are not fields of the class."""
        schema = super().__get_pydantic_json_schema__(core, handler)
        for name, parameter in law_parameters().items():
            if name not in schema["properties"]:
                quantity = quantity_of(parameter)
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

    def parameter(self, name: str) -> float | None:
        """Value of a parameter of a law in SI units; None if the case does not give it."""
        extra = self.__pydantic_extra__ or {}
        value: float | None = extra[name] if name in extra else getattr(self, name)
        return value

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
                    annotation = Annotated[float, quantity_of(parameter)]
                    known[parameter.name] = FieldInfo(annotation=Optional[annotation], default=None)  # noqa: UP045
        return known

    @field_validator("temperature", mode="before")
    @classmethod
    def _is_sheet(cls, value: Any) -> Any:
        """Refuse a temperature in place of the data sheet."""
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
        table = with_base(source)
        if not isinstance(table, Mapping):
            return handler(table)
        fields, errors = _parsed(cls, table)
        try:
            lubricant = handler(fields)
        except ValidationError as error:
            errors += [
                InitErrorDetails(
                    type=detail["type"],
                    loc=detail["loc"],
                    input=detail["input"],
                    ctx=detail.get("ctx", {}),
                )
                for detail in error.errors()
            ]
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
    known, fields = law_parameters(), dict(table)
    errors: list[InitErrorDetails] = []
    for name in [name for name in table if isinstance(name, str) and name not in model.model_fields]:
        value = fields.pop(name)
        try:
            if name not in known:
                errors.append(InitErrorDetails(type="extra_forbidden", loc=(name,), input=value))
            elif value is not None:
                fields[name] = quantity_of(known[name]).parse(value)
        except ValueError as error:
            errors.append(
                InitErrorDetails(type="value_error", loc=(name,), input=value, ctx={"error": error})
            )
    return fields, errors
