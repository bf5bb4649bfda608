"""Checks of the table ``lubricant``: its viscosity is given in one way, and no parameter is missing."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ehlectric.cases import library
from ehlectric.cases.oils.estimates import of_base_oil
from ehlectric.cases.oils.laws import LAWS
from ehlectric.cases.oils.properties import Properties
from ehlectric.errors import InputError
from ehlectric.lubricant.law import Law
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

# Ways to give the viscosity, for messages.
_WAYS = "viscosity, [lubricant.temperature] or atmospheric_law"


def refuse_missing(oil: Properties) -> None:
    """Check that a lubricant gives its values in one way, and that none is missing.

    Raises
    ------
    InputError
        If it does not; the message names all values that are missing.
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
    """Check that a lubricant has exactly one source of its viscosity at ambient pressure.

    Raises
    ------
    InputError
        If it has none, or more than one.
    """
    if VISCOSITY_LAWS[oil.viscosity_law].atmospheric is not None:
        for key in ("viscosity", "temperature", "atmospheric_law"):
            if getattr(oil, key) is not None:
                raise InputError.worded(
                    key, f"is not used: viscosity_law {oil.viscosity_law!r} gives the viscosity itself"
                )
        return
    ways = {
        "viscosity": oil.viscosity is not None and not _is_parameter(oil, "viscosity"),
        "temperature": oil.temperature is not None,
        "atmospheric_law": oil.atmospheric_law is not None,
    }
    given = [key for key, is_given in ways.items() if is_given]
    if len(given) != 1:
        together = f"{' and '.join(given)} together" if given else None
        raise InputError("viscosity", got=together, takes=f"either {_WAYS}")


def check_once(oil: Properties) -> None:
    """Check that no value is given twice, and that none is given which no law of the oil would use.

    Raises
    ------
    InputError
        For two conductivities or two densities, and for a value that lacks the key which gives it a meaning.
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
        raise InputError.missing("density", "it, with which heat_capacity is that of a volume")
    if oil.thermal_expansion is not None and oil.reference_temperature is None:
        raise InputError.missing(
            "reference_temperature", "the temperature at which there is no thermal_expansion"
        )


def _is_parameter(oil: Properties, name: str) -> bool:
    """Whether the law over temperature takes a key of the lubricant as a parameter."""
    if oil.atmospheric_law is None:
        return False
    law = LAWS["atmospheric_law"][oil.atmospheric_law]
    return any(parameter.name == name for parameter in law.parameters)


def check_parameters(oil: Properties, key: str, law: Law) -> None:
    """Check that a lubricant has all parameters of one of its laws.

    A parameter that follows from the viscosity at a temperature may be missing where the viscosity depends
    on the temperature, a coefficient where the type of base oil is given, and a permittivity with its table.

    Raises
    ------
    InputError
        If a parameter is missing; the message names the law, and all parameters that it lacks.
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
