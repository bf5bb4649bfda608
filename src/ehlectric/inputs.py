"""The parts of a case: every input with its unit, its bounds with their reason, and its default."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, ValidationError, model_validator

from ehlectric import library
from ehlectric.errors import InputError, shown
from ehlectric.lubricant import (
    DENSITY_LAWS,
    PERMITTIVITY_LAWS,
    ROELANDS_CONSTANT,
    VISCOSITY_LAWS,
    roelands_exponent,
)
from ehlectric.quantity import Count, Quantity, length_unit
from ehlectric.validation import first_message, nearest


class Table(BaseModel):
    """A frozen table of a case file that refuses unknown keys."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Validated input of nested tables, as a TOML parser gives them.

        Raises
        ------
        InputError
            One line with the key, what it got and what it takes.
        """
        try:
            return cls.model_validate(dict(table))
        except ValidationError as error:
            raise InputError(first_message(error, cls)) from None


_Radius = Annotated[float, Quantity("m", least=1e-6, most=1e3, reason="larger bodies are planes to a film")]
_SignedRadius = Annotated[float, Quantity("m", least=-1e3, most=1e3, reason="negative for a concave body")]
_Modulus = Annotated[float, Quantity("Pa", least=1e5, most=2e12, reason="from soft rubber to diamond")]
_Speed = Annotated[float, Quantity("m/s", least=-1e4, most=1e4, reason="surface speeds of machines")]


class Body(Table):
    """Elastic constants of one body."""

    youngs_modulus: _Modulus
    poissons_ratio: Annotated[
        float, Quantity("", above=-1.0, most=0.5, reason="0.5 is an incompressible body")
    ]


# Alternatives: exactly one row of each group is given, whole.
CONTACT_ALTERNATIVES: tuple[tuple[tuple[str, ...], ...], ...] = (
    (("reduced_radius",), ("radius_1", "radius_2")),
    (("reduced_modulus",), ("body_1", "body_2")),
    (("load_per_length",), ("max_hertz_pressure",)),
    (("entrainment_speed",), ("speed_1", "speed_2")),
)


class Contact(Table):
    """Geometry, elasticity, load and speed of the contact."""

    geometry: Literal["line"] = "line"
    reduced_radius: _Radius | None = None
    radius_1: _SignedRadius | None = None
    radius_2: _SignedRadius | None = None
    reduced_modulus: _Modulus | None = None
    body_1: Body | None = None
    body_2: Body | None = None
    load_per_length: (
        Annotated[float, Quantity("N/m", least=1e-2, most=1e9, reason="a contact carries some load")] | None
    ) = None
    max_hertz_pressure: (
        Annotated[float, Quantity("Pa", least=1e4, most=2e10, reason="twice what any solid carries")] | None
    ) = None
    entrainment_speed: (
        Annotated[
            float,
            Quantity("m/s", least=1e-9, most=1e4, reason="(u1 + u2)/2, positive along x"),
        ]
        | None
    ) = None
    slide_to_roll_ratio: (
        Annotated[float, Quantity("", least=-1e3, most=1e3, reason="(u1 - u2)/entrainment_speed")] | None
    ) = None
    speed_1: _Speed | None = None
    speed_2: _Speed | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        for group in CONTACT_ALTERNATIVES:
            self._check_alternatives(group)
        for name in ("radius_1", "radius_2"):
            radius = getattr(self, name)
            if radius is not None and abs(radius) < 1e-6:
                raise ValueError(
                    f"{name}: got {radius:g} m, takes at least 1e-06 m, negative for a concave body"
                )
        if self.speed_1 is not None and self.speed_2 is not None:
            if self.slide_to_roll_ratio is not None:
                raise ValueError(
                    "slide_to_roll_ratio: got it beside speed_1 and speed_2, which fix it; takes one "
                    "of the two"
                )
            if self.speed_1 + self.speed_2 <= 0.0:
                raise ValueError(
                    f"speed_1, speed_2: got {self.speed_1:g} and {self.speed_2:g} m/s, takes speeds "
                    "whose mean is positive: x runs along entrainment"
                )
        return self

    def _check_alternatives(self, group: tuple[tuple[str, ...], ...]) -> None:
        given = [[name for name in row if getattr(self, name) is not None] for row in group]
        choices = " or ".join(" and ".join(row) for row in group)
        used = [k for k, names in enumerate(given) if names]
        if len(used) > 1:
            both = ", ".join(name for names in given for name in names)
            raise ValueError(f"{given[0][0]}: got {both} together, takes either {choices}")
        if not used:
            raise ValueError(f"{group[0][0]}: missing, takes either {choices}")
        for name in group[used[0]]:
            if name not in given[used[0]]:
                raise ValueError(f"{name}: missing, takes either {choices}")


def _law(laws: Mapping[str, object]) -> AfterValidator:
    def known(name: str) -> str:
        if name not in laws:
            known_names = ", ".join(repr(law) for law in laws)
            raise ValueError(
                f"got {shown(name)}, takes one of {known_names}; nearest is {nearest(name, laws)!r}"
            )
        return name

    return AfterValidator(known)


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
        if not isinstance(table, Mapping) or not isinstance(table.get("base"), str):
            return table
        name, names = table["base"], library.lubricant_names()
        if name not in names:
            raise ValueError(f"base: got {shown(name)}, takes a name of the library: {', '.join(names)}")
        return {**library.lubricant(name), **table}

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


_Height = Annotated[float, Quantity("m", least=1e-12, most=1e-3, reason="of a surface, not of a body")]
_Length = Annotated[float, Quantity("m", least=1e-9, most=1.0, reason="of waves and features on a surface")]
_LengthUnit = Annotated[str, AfterValidator(length_unit)]
_Place = Annotated[float, Quantity("m", least=-1.0, most=1.0, reason="along entrainment, 0 at the centre")]

# What each generator needs, and what it may have beside that.
GENERATORS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "sinusoid": (("amplitude", "wavelength"), ("phase",)),
    "gaussian": (("rq", "correlation_length", "seed"), ()),
    "self-affine": (("rq", "hurst", "rolloff_wavelength", "seed"), ("shortest_wavelength",)),
    "pit": (("depth", "width"), ("rim", "position")),
    "asperity": (("height", "width"), ("position",)),
}
_FILE_KEYS = ("x_unit", "z_unit", "line", "along", "direction", "assume_transverse")
SHAPES = ("sinusoid", "pit", "asperity")
_STEPS = ("form", "cutoff_long", "cutoff_short", "trim", "rescale_rq", "truncate", "extend")


class Roughness(Table):
    """One rough surface: from a file or made, and what is done to it."""

    surface: Literal[1, 2]
    file: str | None = None
    x_unit: _LengthUnit | None = None
    z_unit: _LengthUnit | None = None
    line: Annotated[int, Count(0, 1_000_000, "of a map, from 0")] = 0
    along: Literal["row", "column"] = "row"
    direction: Literal["x", "y"] = "x"
    assume_transverse: bool = False
    generator: str | None = None
    amplitude: _Height | None = None
    wavelength: _Length | None = None
    phase: Annotated[float, Quantity("", least=-1e3, most=1e3, reason="in rad")] | None = None
    rq: _Height | None = None
    correlation_length: _Length | None = None
    hurst: Annotated[float, Quantity("", least=0.0, most=1.0, reason="1 is the smoothest")] | None = None
    rolloff_wavelength: _Length | None = None
    shortest_wavelength: _Length | None = None
    seed: Annotated[int, Count(0, 2**32, "of the random numbers")] | None = None
    depth: _Height | None = None
    height: _Height | None = None
    width: _Length | None = None
    rim: Annotated[float, Quantity("m", least=0.0, most=1e-3, reason="height of the rim")] | None = None
    position: _Place | None = None
    form: Literal["none", "mean", "line", "parabola"] = "none"
    cutoff_long: _Length | None = None
    cutoff_short: _Length | None = None
    trim: Annotated[float, Quantity("m", least=0.0, most=1.0, reason="taken off each end")] | None = None
    rescale_rq: _Height | None = None
    truncate: _Height | None = None
    shift: _Place = 0.0
    extend: Literal["mirror", "repeat", "flat"] = "mirror"

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.file is None) == (self.generator is None):
            state = "missing" if self.file is None else "got file and generator together"
            raise ValueError(f"file: {state}, takes either file or generator")
        allowed = {"surface", "shift"}
        if self.generator is None:
            allowed |= {"file", *_FILE_KEYS, *_STEPS}
        else:
            if self.generator not in GENERATORS:
                raise ValueError(
                    f"generator: got {shown(self.generator)}, takes one of {', '.join(map(repr, GENERATORS))}"
                )
            needed, optional = GENERATORS[self.generator]
            for name in needed:
                if getattr(self, name) is None:
                    raise ValueError(f"{name}: missing, the generator {self.generator!r} takes it")
            allowed |= {"generator", *needed, *optional}
            allowed |= set() if self.generator in SHAPES else set(_STEPS)
        given = {
            name for name, field in type(self).model_fields.items() if getattr(self, name) != field.default
        }
        for name in sorted(given - allowed - {"surface"}):
            what = f"the generator {self.generator!r}" if self.generator else "a file"
            raise ValueError(f"{name}: got it with {what}, which has no use for it")
        rolloff, shortest = self.rolloff_wavelength, self.shortest_wavelength
        if rolloff is not None and shortest is not None and shortest >= rolloff:
            raise ValueError(
                f"shortest_wavelength: got {shortest:g} m, takes less than rolloff_wavelength, {rolloff:g} m"
            )
        if self.direction == "y" and not self.assume_transverse:
            raise ValueError(
                "direction: got 'y', measured across entrainment; a line contact sees every profile as "
                "ridges across it, takes assume_transverse = true to use it so all the same"
            )
        return self


class Electric(Table):
    """Potentials of the two surfaces; surface 1 is the lower one."""

    potential_1: Annotated[float, Quantity("V", least=-1e7, most=1e7, reason="of the lower surface")] = -1.0
    potential_2: Annotated[float, Quantity("V", least=-1e7, most=1e7, reason="of the upper surface")] = 1.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        if abs(self.potential_2 - self.potential_1) < 1e-6:
            raise ValueError(
                f"potential_2: got {self.potential_2:g} V, which is potential_1; takes one that "
                "differs by at least 1 µV, as there is no field between equal potentials"
            )
        return self


# Columns of the field below which the film's own nodes do not resolve it.
_LEAST_COLUMNS = 16

_FieldEnd = Annotated[float, Quantity("", least=-100.0, most=100.0, reason="in half-widths")]


class Grid(Table):
    """Discretisation of the film and of the field; lengths in half-widths."""

    nodes: Annotated[
        int,
        Count(65, 10_000_001, "fewer do not resolve the Hertz zone, more are atoms apart"),
    ] = 3201
    inlet: Annotated[float, Quantity("", least=-100.0, below=-1.0, reason="ahead of the Hertz zone")] = -4.0
    outlet: Annotated[float, Quantity("", above=1.0, most=100.0, reason="behind the Hertz zone")] = 2.0
    wedge: Literal["second-order", "first-order"] = "second-order"
    field_range: tuple[_FieldEnd, _FieldEnd] = (-1.25, 1.25)
    field_nodes: (
        Annotated[
            int,
            Count(17, 10_000_001, "fewer do not resolve the exit, more are atoms apart"),
        ]
        | None
    ) = None
    field_degree: Annotated[int, Count(2, 20, "the potential is nearly linear across the film")] = 6

    @model_validator(mode="after")
    def _check(self) -> Self:
        domain = self.outlet - self.inlet
        if self.nodes < 8.0 * domain:
            raise ValueError(
                f"nodes: got {self.nodes} over {domain:g} half-widths, takes at least "
                f"{int(8.0 * domain) + 1} there: sixteen in the Hertz zone"
            )
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
        return self


class Solver(Table):
    """When the iteration of the film stops."""

    tolerance: Annotated[
        float, Quantity("", least=1e-11, most=1e-3, reason="of the largest scaled residual")
    ] = 1e-9
    max_iterations: Annotated[int, Count(1, 1000, "Newton steps on each grid")] = 30
