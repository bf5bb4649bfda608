"""Keys of a case that only laws use which functions of a user's own replace: another value would have no
effect, so that it is refused.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from ehlectric.cases.oil_inputs import LAWS, OilTemperature, Properties
from ehlectric.errors import InputError
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.quantities.alternatives import ALTERNATIVES

# Keys of the data sheet of an oil that its viscosity does not use, and those that its density uses also.
_NOT_VISCOUS, _OF_DENSITY = {"thermal_conductivity"}, ("density_15", "expansion")

# Key of the oil of the library, which a change of the whole oil changes.
BASE = "lubricant.base"


def replaced_keys(oil: Properties, replaced: Collection[str]) -> dict[str, str]:
    """Dotted keys that only properties with laws of the user's own use, each with one of these properties.

    ``replaced``, names of these properties. Parameters that another law of the oil also has are omitted.

    Examples
    --------
    >>> found = replaced_keys(Properties.from_dict({"base": "paper"}), ["viscosity"])
    >>> found["lubricant.roelands_z"], "lubricant.density" in found
    ('viscosity', False)
    """
    users = {f"lubricant.{key}": properties for key, properties in _users(oil, replaced).items()}
    for rows in ALTERNATIVES["discharge"]:
        names = {key for row in rows for key in row}
        if "strength_table" in names:
            users |= {f"discharge.{key}": {"strength"} for key in names}
    return {
        key: next(name for name in replaced if name in properties)
        for key, properties in users.items()
        if properties <= set(replaced)
    }


def _users(oil: Properties, replaced: Collection[str]) -> dict[str, set[str]]:
    """Properties that use a key of the oil, by its key."""
    users: dict[str, set[str]] = defaultdict(set)
    for choice, laws in LAWS.items():
        of = "viscosity" if choice == "atmospheric_law" else choice.removesuffix("_law")
        name = oil.law(choice)
        users[choice].add(of)
        for law in laws.values() if of in replaced else () if name is None else (laws[name],):
            for parameter in law.parameters:
                # A law of heat gets the density of the user's own law.
                if parameter.name not in replaced:
                    users[parameter.name].add(of)
    users["viscosity"].add("viscosity")
    users["density"].add("density")
    users["permittivity_table"].add("permittivity")
    for key in OilTemperature.model_fields.keys() - _NOT_VISCOUS:
        users[f"temperature.{key}"].add("viscosity")
    for key in _OF_DENSITY:
        users[f"temperature.{key}"].add("density")
    # The permittivity changes with temperature as the density of the oil does.
    expansion = DENSITY_LAWS[oil.density_law].thermal_expansion or "thermal_expansion"
    if oil.reference_temperature is not None and oil.parameter(expansion) is not None:
        for key in ("density_law", expansion, "reference_temperature"):
            users[key] |= {"density", "permittivity"}
    return users


def refuse_replaced(
    oil: Properties,
    names: Mapping[str, str],
    given: Mapping[str, Any],
    changes: Mapping[str, Iterable[Any]],
) -> None:
    """Raise an InputError for another value of a key that only replaced laws use, or for another oil of the
    library that differs in such a key.

    ``names``, names of the user's own laws by property; ``given``, values of the case by dotted key;
    ``changes``, the other values of some keys. All values are in SI units.
    """
    replaced = replaced_keys(oil, names)
    for key, values in changes.items():
        table = next((name for name in replaced if f"{key}.".startswith(f"{name}.")), None)
        if table is not None and any(value != given.get(key) for value in values):
            of = replaced[table]
            raise InputError.worded(
                key,
                f"has no effect, as {names[of]} gives the {of}; change the function, or remove it from laws",
                takes="the value of the case",
            )
    for name in changes.get(BASE, ()):
        if name is not None and name != given.get(BASE):
            refuse_another_oil(oil, Properties.from_dict({"base": name}), names)


def refuse_another_oil(oil: Properties, other: Properties, names: Mapping[str, str]) -> None:
    """Raise an InputError if another oil differs in a property that laws of the user's own replace.

    ``names``, names of these laws by property.
    """
    replaced = replaced_keys(oil, names) | replaced_keys(other, names)
    for key, of in replaced.items():
        table, _, path = key.partition(".")
        if table == "lubricant" and _value(oil, path) != _value(other, path):
            raise InputError.worded(
                BASE,
                f"another oil does not change the {of}, as {names[of]} gives it; give the laws of the new "
                "oil with it, as in case.replace(lubricant=..., laws=Laws(...)), or use the case without "
                "laws, case.replace(laws=None)",
                takes="the oil of the case",
            )


def _value(oil: Properties, path: str) -> Any:
    """Return the value of a key in an oil or in its data sheet; None if the oil does not give it."""
    value: Any = oil
    for name in path.split("."):
        value = getattr(value, name, None)
    return value
