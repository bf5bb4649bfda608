"""The lubricant of a case, and its laws with its values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Annotated, Any, Self

from pydantic import AfterValidator, model_validator

from ehlectric.arrays import Array
from ehlectric.cases import library
from ehlectric.cases.quantity import Quantity
from ehlectric.cases.table import Table, nearest
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.law import Law
from ehlectric.lubricant.permittivity import PERMITTIVITY_LAWS
from ehlectric.lubricant.viscosity import ROELANDS_CONSTANT, VISCOSITY_LAWS, roelands_exponent


def effective_alpha(lubricant: Lubricant) -> float:
    """Pressure-viscosity coefficient [1/Pa] that the film formulas see: zero for a constant viscosity."""
    if lubricant.viscosity_law == "constant":
        return 0.0
    assert lubricant.pressure_viscosity_coefficient is not None
    return lubricant.pressure_viscosity_coefficient


def _bound(law: Law, lubricant: Lubricant) -> Callable[..., Any]:
    """A law with its parameters from the case."""
    return partial(law.function, **{name: getattr(lubricant, name) for name in law.parameters})


def viscosity_law(lubricant: Lubricant) -> Callable[[Array], tuple[Array, Array]]:
    """ln(eta/eta0) and its derivative [1/Pa] over pressure [Pa]."""
    return _bound(VISCOSITY_LAWS[lubricant.viscosity_law], lubricant)


def density_law(lubricant: Lubricant) -> Callable[[Array], tuple[Array, Array]]:
    """rho/rho0 and its derivative [1/Pa] over pressure [Pa]."""
    return _bound(DENSITY_LAWS[lubricant.density_law], lubricant)


def permittivity_law(lubricant: Lubricant) -> Callable[[Array], Array]:
    """Relative permittivity over rho/rho0."""
    return _bound(PERMITTIVITY_LAWS[lubricant.permittivity_law], lubricant)


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
    """A table with the values of the lubricant that it names, where it gives none itself.

    Raises
    ------
    ValueError
        Where the library has none of that name.
    """
    if not isinstance(table, Mapping) or table.get("base") is None:
        return table
    name = library_name(table["base"], library.lubricant_names())
    return {**library.lubricant(name), **table}


def library_name(base: Any, names: Sequence[str]) -> str:
    """A base, where the library has one of that name; a number is none, whatever its digits.

    Raises
    ------
    ValueError
        Where the library has none of that name.
    """
    if not isinstance(base, str):
        raise InputError("base", got=shown(base), takes=f"a text, a name of the library: {', '.join(names)}")
    if base not in names:
        raise InputError("base", got=shown(base), takes=f"a name of the library: {', '.join(names)}")
    return base


class Lubricant(Table):
    """Properties of the lubricant and the laws they enter."""

    base: str | None = None
    viscosity: Annotated[float, Quantity("Pa*s", least=1e-7, most=1e6, reason="at ambient pressure")]
    viscosity_law: Annotated[str, _law(VISCOSITY_LAWS)]
    pressure_viscosity_coefficient: (
        Annotated[float, Quantity("1/Pa", least=1e-11, most=2e-7, reason="an oil has 5 to 40 1/GPa")] | None
    ) = None
    roelands_z: Annotated[float, Quantity("", least=0.01, most=2.0, reason="an oil has 0.3 to 1")] | None = (
        None
    )
    roelands_pressure: (
        Annotated[float, Quantity("Pa", least=1e7, most=1e10, reason="Roelands' constant is 0.196 GPa")]
        | None
    ) = None
    density_law: Annotated[str, _law(DENSITY_LAWS)]
    density_c1: (
        Annotated[float, Quantity("Pa", least=1e7, most=1e11, reason="an oil has 0.59 GPa")] | None
    ) = None
    density_c2: (
        Annotated[
            float,
            Quantity("", least=1.0, most=3.0, reason="the density ratio at unlimited pressure"),
        ]
        | None
    ) = None
    permittivity_law: Annotated[str, _law(PERMITTIVITY_LAWS)] = "clausius-mossotti"
    relative_permittivity: Annotated[
        float, Quantity("", least=1.0, most=1e3, reason="vacuum has 1, oils 2 to 5, water 80")
    ]
    ambient_pressure: Annotated[float, Quantity("Pa", least=0.0, most=1e8, reason="around the contact")] = 1e5

    @model_validator(mode="before")
    @classmethod
    def _from_base(cls, table: Any) -> Any:
        """The named lubricant of the library, with what the case gives in place of its values."""
        return with_lubricant(table)

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, laws in (("viscosity_law", VISCOSITY_LAWS), ("density_law", DENSITY_LAWS)):
            law = getattr(self, key)
            missing = [name for name in laws[law].parameters if getattr(self, name) is None]
            if missing:
                also = f" with {', '.join(missing[1:])}" if missing[1:] else ""
                raise InputError.worded(
                    missing[0], f"missing, {key} {law!r} takes it{also}{self._roelands_hint()}"
                )
        return self

    def _roelands_hint(self) -> str:
        """The exponent of Roelands' own relation, where it alone is missing."""
        alpha, p0 = self.pressure_viscosity_coefficient, self.roelands_pressure
        if self.roelands_z is not None or alpha is None or p0 is None:
            return ""
        z = roelands_exponent(self.viscosity, alpha, p0)
        if not math.isfinite(z):
            return ""
        return (
            "; Roelands' relation pressure_viscosity_coefficient roelands_pressure/(ln viscosity + "
            f"{ROELANDS_CONSTANT}) gives {z:.3g}"
        )
