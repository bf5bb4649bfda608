"""Table ``lubricant`` of a case, and the laws of the lubricant with the parameters of the case."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Optional, Self

import numpy as np
from pydantic import (
    AfterValidator,
    ConfigDict,
    GetJsonSchemaHandler,
    ModelWrapValidatorHandler,
    SerializerFunctionWrapHandler,
    ValidationError,
    model_serializer,
    model_validator,
)
from pydantic.fields import FieldInfo
from pydantic_core import CoreSchema, InitErrorDetails

from ehlectric.cases import library
from ehlectric.cases.quantity import Quantity
from ehlectric.cases.table import Table, nearest
from ehlectric.errors import InputError, ResultWarning, shown
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.law import DensityRatioLaw, Law, Parameter, PressureLaw
from ehlectric.lubricant.permittivity import PERMITTIVITY_LAWS, RELATIVE_PERMITTIVITY
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

# Keys that choose a law by name, each with the table of its laws, in the order of the case file.
LAWS: dict[str, Mapping[str, Law]] = {
    "viscosity_law": VISCOSITY_LAWS,
    "density_law": DENSITY_LAWS,
    "permittivity_law": PERMITTIVITY_LAWS,
}


def law_parameters(*choices: str) -> dict[str, Parameter]:
    """Parameters of the laws of a lubricant, by name.

    Parameters
    ----------
    *choices : str
        Keys of ``LAWS``, such as "density_law"; all keys if none is given.

    Returns
    -------
    dict of str to Parameter
        Parameters of the laws that are in the tables at the time of the call.

    Examples
    --------
    >>> list(law_parameters("density_law"))
    ['density_c1', 'density_c2']
    """
    tables = [LAWS[key] for key in choices or LAWS]
    return {
        parameter.name: parameter for laws in tables for law in laws.values() for parameter in law.parameters
    }


def _bound(law: Law, lubricant: Lubricant) -> Callable[..., Any]:
    """Function of a law with the parameters of the case."""
    return partial(law.function, **_values(law, lubricant))


def _values(law: Law, lubricant: Lubricant) -> dict[str, float]:
    """Values of those parameters of a law that the case gives, by name, SI units."""
    values = {parameter.name: lubricant.parameter(parameter.name) for parameter in law.parameters}
    return {name: value for name, value in values.items() if value is not None}


def viscosity_law(lubricant: Lubricant) -> PressureLaw:
    """Viscosity law: ln(eta/eta0) and its slope [1/Pa] as functions of pressure [Pa] and temperature [K]."""
    return _bound(VISCOSITY_LAWS[lubricant.viscosity_law], lubricant)


def density_law(lubricant: Lubricant) -> PressureLaw:
    """Density law: rho/rho0 and its slope [1/Pa] as functions of pressure [Pa] and temperature [K]."""
    return _bound(DENSITY_LAWS[lubricant.density_law], lubricant)


def permittivity_law(lubricant: Lubricant) -> DensityRatioLaw:
    """Permittivity law: relative permittivity as a function of rho/rho0 and temperature [K]."""
    return _bound(PERMITTIVITY_LAWS[lubricant.permittivity_law], lubricant)


def effective_alpha(lubricant: Lubricant) -> float:
    """Pressure-viscosity coefficient for the film formulas: slope of ln(eta) at zero pressure [1/Pa].

    It is zero for a constant viscosity, and alpha for the laws of Barus and Roelands.
    """
    return float(viscosity_law(lubricant)(np.zeros(1))[1][0])


def law_warnings(lubricant: Lubricant, max_pressure: float) -> Iterator[ResultWarning]:
    """Warnings about the laws of a lubricant in a contact with this Hertz pressure [Pa]."""
    for key, laws in LAWS.items():
        law = laws[getattr(lubricant, key)]
        if law.warnings is not None:
            yield from law.warnings(max_pressure, lubricant.viscosity, **_values(law, lubricant))


def _law(laws: Mapping[str, object]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in laws:
            known_names = ", ".join(repr(law) for law in laws)
            raise InputError(
                got=shown(name), takes=f"one of {known_names}; nearest is {nearest(name, laws)!r}"
            )
        return name

    return AfterValidator(known)


def with_lubricant(table: Any) -> Any:
    """Add to a table the values of the lubricant that ``base`` names in the library.

    Values of the table itself replace those of the library.

    Raises
    ------
    InputError
        If the library has no lubricant of this name.
    """
    if not isinstance(table, Mapping) or table.get("base") is None:
        return table
    name = library_name(table["base"], library.lubricant_names())
    return {**library.lubricant(name), **table}


def library_name(base: Any, names: Sequence[str]) -> str:
    """Check that ``base`` is a name of the library, and return it; the number 6208 is not the name "6208".

    Raises
    ------
    InputError
        If the base is not a string, or not a name of the library.
    """
    if not isinstance(base, str):
        raise InputError(
            "base", got=shown(base), takes=f"a name of the library, as a string: {', '.join(names)}"
        )
    if base not in names:
        raise InputError("base", got=shown(base), takes=f"a name of the library: {', '.join(names)}")
    return base


def quantity_of(parameter: Parameter) -> Quantity:
    """Quantity with the unit and the bounds of a parameter, which parses its values."""
    return Quantity(
        parameter.unit,
        above=parameter.above,
        below=parameter.below,
        least=parameter.least,
        most=parameter.most,
        reason=parameter.reason,
    )


class Lubricant(Table):
    """Properties of a lubricant, and its laws of viscosity, density and permittivity.

    The parameters of the laws are keys of this table, but not fields of the class. Their names, units and
    bounds come from the tables of laws at the time a case is read (``known_keys``). A parameter that the case
    does not give is None. A case may give parameters of laws that it does not use, for example by its base.

    Examples
    --------
    >>> oil = Lubricant.from_dict({"base": "paper", "viscosity_law": "barus"})
    >>> oil.parameter("pressure_viscosity_coefficient")
    2.2e-08
    """

    model_config = ConfigDict(extra="allow")

    base: str | None = None
    viscosity: Annotated[float, Quantity("Pa*s", least=1e-7, most=1e6, reason="at ambient pressure")]
    viscosity_law: Annotated[str, _law(VISCOSITY_LAWS)]
    density_law: Annotated[str, _law(DENSITY_LAWS)]
    permittivity_law: Annotated[str, _law(PERMITTIVITY_LAWS)] = "clausius-mossotti"
    relative_permittivity: Annotated[float, quantity_of(RELATIVE_PERMITTIVITY)]
    ambient_pressure: Annotated[float, Quantity("Pa", least=0.0, most=1e8, reason="around the contact")] = 1e5

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
                quantity = quantity_of(parameter)
                schema["properties"][name] = quantity.__get_pydantic_json_schema__(core, handler)
        for name, laws in LAWS.items():
            schema["properties"][name]["enum"] = list(laws)
        return schema | {"additionalProperties": False}

    def parameter(self, name: str) -> float | None:
        """Value of a parameter of a law in SI units; None if the case does not give it."""
        value: float | None = getattr(self, name)
        return value

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

    @model_validator(mode="wrap")
    @classmethod
    def _parse(cls, source: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        """Add the values of the base, and validate fields and parameters.

        Errors of fields and of parameters are raised together, in the order of ``known_keys``.
        """
        table = cls._with_base(source)
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

    @classmethod
    def _with_base(cls, table: Any) -> Any:
        """Values of the lubricant that ``base`` names in the library, replaced by those of the case."""
        return with_lubricant(table)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, laws in LAWS.items():
            name = getattr(self, key)
            law, values = laws[name], _values(laws[name], self)
            missing = [parameter.name for parameter in law.parameters if parameter.name not in values]
            if missing:
                also = f" with {', '.join(missing[1:])}" if missing[1:] else ""
                hint = law.hint(self.viscosity, values) if law.hint else ""
                raise InputError.worded(missing[0], f"missing; {key} {name!r} needs it{also}{hint}")
        return self

    @model_serializer(mode="wrap")
    def _in_order(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Serialise the table with its keys in the order of ``known_keys``."""
        table = handler(self)
        return {name: table[name] for name in type(self).known_keys() if name in table}


def _parsed(
    model: type[Lubricant], table: Mapping[Any, Any]
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
