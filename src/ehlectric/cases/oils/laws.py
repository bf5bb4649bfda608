"""Choices of laws in the table ``lubricant``, and the names of the library as values of its key ``base``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import AfterValidator

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.table import nearest
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.atmospheric import ATMOSPHERIC_LAWS
from ehlectric.lubricant.conductivity import CONDUCTIVITY_LAWS
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.heat_capacity import HEAT_CAPACITY_LAWS
from ehlectric.lubricant.law import Law, Parameter
from ehlectric.lubricant.permittivity import PERMITTIVITY_LAWS
from ehlectric.lubricant.thermal_conductivity import THERMAL_CONDUCTIVITY_LAWS
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

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

# Laws that an oil may lack. Where it gives no name but the parameters of the law "constant", it has that law.
OPTIONAL_LAWS = ("conductivity_law", "thermal_conductivity_law", "heat_capacity_law")


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
    >>> law_parameters("density_law")["density_c1"].unit
    'Pa'
    """
    tables = [LAWS[key] for key in choices or LAWS]
    return {
        parameter.name: parameter for laws in tables for law in laws.values() for parameter in law.parameters
    }


def is_parameter(name: str) -> bool:
    """Whether a law of a lubricant has a parameter of this name.

    Examples
    --------
    >>> is_parameter("roelands_z"), is_parameter("roelands_x")
    (True, False)
    """
    return any(
        parameter.name == name
        for laws in LAWS.values()
        for law in laws.values()
        for parameter in law.parameters
    )


@dataclass(frozen=True)
class Named(AfterValidator):
    """Pydantic annotation of a name, with the names that are allowed.

    Attributes
    ----------
    takes : str
        Description of the allowed names, for messages.
    """

    takes: str = ""


def law_name(laws: Mapping[str, object]) -> Named:
    """Pydantic annotation of the name of a law of this table."""

    def known(name: str) -> str:
        if name not in laws:
            known_names = ", ".join(repr(law) for law in laws)
            raise InputError(
                got=shown(name), takes=f"one of {known_names}; nearest is {nearest(name, laws)!r}"
            )
        return name

    return Named(known, f"one of {', '.join(map(repr, laws))}")


def quantity_of(parameter: Parameter) -> Amount:
    """Quantity with the unit and the bounds of a parameter, which parses its values."""
    return Amount(
        parameter.unit,
        above=parameter.above,
        below=parameter.below,
        least=parameter.least,
        most=parameter.most,
        reason=parameter.reason,
        difference=parameter.difference,
    )


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


def base_values(table: Any) -> dict[str, Any]:
    """Values of the lubricant that ``base`` names in the library; none without a base.

    Raises
    ------
    InputError
        If the library has no lubricant of this name.
    """
    if not isinstance(table, Mapping) or table.get("base") is None:
        return {}
    return library.lubricant(library_name(table["base"], library.lubricant_names()))
