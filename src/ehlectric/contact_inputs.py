"""The contact of a case: geometry, elasticity, load and speed, each with its unit and its bounds."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import model_validator

from ehlectric.quantity import Quantity
from ehlectric.validation import Table

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
