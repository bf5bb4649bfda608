"""Lubricant, potentials, grid and solver of a case: every input with its unit, its bounds and its default."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, model_validator

from ehlectric import library
from ehlectric.errors import shown
from ehlectric.lubricant import (
    DENSITY_LAWS,
    PERMITTIVITY_LAWS,
    ROELANDS_CONSTANT,
    VISCOSITY_LAWS,
    roelands_exponent,
)
from ehlectric.quantity import Count, Quantity
from ehlectric.validation import Table, nearest


def _law(laws: Mapping[str, object]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in laws:
            known_names = ", ".join(repr(law) for law in laws)
            raise ValueError(
                f"got {shown(name)}, takes one of {known_names}; nearest is {nearest(name, laws)!r}"
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
        raise ValueError(f"base: got {shown(base)}, takes a text, a name of the library: {', '.join(names)}")
    if base not in names:
        raise ValueError(f"base: got {shown(base)}, takes a name of the library: {', '.join(names)}")
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
                raise ValueError(
                    f"{missing[0]}: missing, {key} {law!r} takes it{also}{self._roelands_hint()}"
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


class Electric(Table):
    """Potentials of the two surfaces; surface 1 is the lower one."""

    potential_1: Annotated[float, Quantity("V", least=-1e7, most=1e7, reason="of the lower surface")] = -1.0
    potential_2: Annotated[float, Quantity("V", least=-1e7, most=1e7, reason="of the upper surface")] = 1.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.voltage < 1e-6:
            raise ValueError(
                f"potential_2: got {self.potential_2:g} V, which is potential_1; takes one that "
                "differs by at least 1 µV, as there is no field between equal potentials"
            )
        return self

    @property
    def voltage(self) -> float:
        """Between the surfaces [V], above 0."""
        return abs(self.potential_2 - self.potential_1)


# Columns of the field below which the film's own nodes do not resolve it.
_LEAST_COLUMNS = 16

_FieldEnd = Annotated[float, Quantity("", least=-100.0, most=100.0, reason="in half-widths")]

# What a grid of a point contact has where the case does not say; lengths in its semi-axes.
POINT_GRID: dict[str, Any] = {"nodes": 257, "inlet": -4.5, "outlet": 1.5, "field_side": 1.25}

# Keys of a point contact alone.
POINT_GRID_KEYS = ("nodes_y", "side", "field_side", "field_nodes_y")

# Nodes across a point contact's Hertz zone below which its film has no shape, and along an axis above which a
# film takes more memory than a workstation has.
LEAST_ACROSS = 16
_MOST_AXIS = 4097


class Grid(Table):
    """Discretisation of the film and of the field.

    Lengths are in half-widths of a line contact; of a point contact in the semi-axis along entrainment, but
    those of ``side`` and ``field_side`` in the semi-axis across.
    """

    nodes: Annotated[
        int,
        Count(65, 10_000_001, "fewer do not resolve the Hertz zone, more are atoms apart"),
    ] = 3201
    nodes_y: (
        Annotated[int, Count(33, _MOST_AXIS, "fewer do not resolve the Hertz zone, more fill the memory")]
        | None
    ) = None
    inlet: Annotated[float, Quantity("", least=-1000.0, below=-1.0, reason="ahead of the Hertz zone")] = -4.0
    outlet: Annotated[float, Quantity("", above=1.0, most=1000.0, reason="behind the Hertz zone")] = 2.0
    side: Annotated[float, Quantity("", above=1.0, most=100.0, reason="beside the Hertz zone")] | None = None
    wedge: Literal["second-order", "first-order"] = "second-order"
    field_range: tuple[_FieldEnd, _FieldEnd] = (-1.25, 1.25)
    field_side: (
        Annotated[float, Quantity("", least=1e-3, most=100.0, reason="in semi-axes across entrainment")]
        | None
    ) = None
    field_nodes: (
        Annotated[
            int,
            Count(17, 10_000_001, "fewer do not resolve the exit, more are atoms apart"),
        ]
        | None
    ) = None
    field_nodes_y: (
        Annotated[int, Count(17, _MOST_AXIS, "fewer do not resolve the sides, more fill the memory")] | None
    ) = None
    field_degree: Annotated[int, Count(2, 20, "the potential is nearly linear across the film")] = 6
    refine: (
        Annotated[
            float,
            Quantity("", least=1e-4, most=0.5, reason="error of the film to refine to", fraction=True),
        ]
        | None
    ) = None

    @property
    def of_point(self) -> bool:
        """Whether this is a point contact's grid: a case gives each of them a ``field_side``."""
        return self.field_side is not None

    @property
    def nodes_across(self) -> int:
        """Nodes across a point contact, as many as along it where the case does not say."""
        return self.nodes if self.nodes_y is None else self.nodes_y

    @model_validator(mode="after")
    def _check(self) -> Self:
        domain = self.outlet - self.inlet
        if self.nodes < 8.0 * domain:
            lengths = "semi-axes" if self.of_point else "half-widths"
            raise ValueError(
                f"nodes: got {self.nodes} over {domain:g} {lengths}, takes at least "
                f"{int(8.0 * domain) + 1} there: sixteen in the Hertz zone"
            )
        self._check_field_range(domain)
        if self.of_point:
            self._check_point()
        return self

    def _check_field_range(self, domain: float) -> None:
        start, stop = self.field_range
        default = "" if "field_range" in self.model_fields_set else ", its default"
        if not self.inlet <= start < stop <= self.outlet:
            raise ValueError(
                f"field_range: got [{start:g}, {stop:g}]{default}, takes two increasing numbers within inlet "
                f"and outlet, [{self.inlet:g}, {self.outlet:g}]"
            )
        columns = (stop - start) / domain * (self.nodes - 1)
        if self.field_nodes is None and columns < _LEAST_COLUMNS:
            raise ValueError(
                f"field_range: got [{start:g}, {stop:g}]{default}, which holds {int(columns)} nodes of the "
                f"film; takes a range with at least {_LEAST_COLUMNS}, or field_nodes"
            )
        if stop - start < 1e-3:
            raise ValueError(f"field_range: got [{start:g}, {stop:g}], takes a range of at least 0.001")

    def _check_point(self) -> None:
        for key in ("nodes", "field_nodes"):
            nodes = getattr(self, key)
            if nodes is not None and nodes > _MOST_AXIS:
                raise ValueError(
                    f"{key}: got {nodes} in a point contact, takes at most {_MOST_AXIS} along an axis: more "
                    "fill the memory"
                )
        if self.side is not None:
            self.check_across(self.side)

    def check_across(self, side: float) -> None:
        """Refuse a point contact's grid that is too coarse across entrainment, or less wide than its field.

        Parameters
        ----------
        side : float
            Half of the domain's width, in semi-axes across.

        Raises
        ------
        ValueError
            With the key, what it got and what it takes.
        """
        assert self.field_side is not None
        if self.field_side > side:
            raise ValueError(f"field_side: got {self.field_side:g}, takes at most side, {side:g}")
        nodes, key = self.nodes_across, "nodes" if self.nodes_y is None else "nodes_y"
        least = math.ceil(LEAST_ACROSS * side) + 1
        if nodes < least:
            raise ValueError(
                f"{key}: got {nodes} across {2.0 * side:g} semi-axes, takes at least {least} there: sixteen "
                "in the Hertz zone"
            )


class Solver(Table):
    """When the iteration of the film stops."""

    tolerance: Annotated[
        float, Quantity("", least=1e-11, most=1e-3, reason="of the largest scaled residual")
    ] = 1e-9
    max_iterations: Annotated[int, Count(1, 1000, "Newton steps on each grid")] = 30
