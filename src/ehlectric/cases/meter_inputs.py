"""Table `meter` of a case: the gap around the film, a coating, and what lies in parallel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.contact_inputs import Contact
from ehlectric.cases.mean_heights import StatedRa
from ehlectric.cases.table import Table
from ehlectric.errors import InputError

# Shares of the gap that have a name.
_NAMED = {"oil": 1.0, "air": 0.0}

# Relative difference of its two radii up to which a body is a ball.
_ROUND = 1e-3


@dataclass(frozen=True)
class _Share(Amount):
    """Share of a gap that oil fills: a fraction, "oil" or "air"."""

    def parse(self, entry: object, *, written: bool = False) -> float:
        """Share as a number from 0 to 1."""
        if isinstance(entry, str) and entry in _NAMED:
            return _NAMED[entry]
        return super().parse(entry, written=written)

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"'oil', 'air', or {super().takes}"


class Coating(Table, book="meter.coating"):
    """Insulating coating of one body, or of both bodies together, in series with the gap."""

    thickness: float
    relative_permittivity: float
    strength: float | None = None

    @property
    def thickness_in_vacuum(self) -> float:
        """Thickness of a gap in vacuum with the same capacitance [m]."""
        return self.thickness / self.relative_permittivity


class Meter(StatedRa, book="meter"):
    """Surroundings of the film that a capacitance meter at the two bodies also sees."""

    fill: (
        Annotated[
            float, _Share("", least=0.0, most=1.0, fraction=True, reason="share of the angle that oil fills")
        ]
        | None
    ) = None
    oil_radius: float | None = None
    length: float | None = None
    parallel_capacitance: float | None = None
    rq: float | None = None
    ra: float | None = None
    rq_over_ra: float | None = None
    coating: Coating | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.fill is None and self.oil_radius is None:
            raise InputError.missing("fill", "either fill, as 'oil', or oil_radius")
        self.check_alternatives(("fill", "oil_radius"), "either of them")
        return self

    def check(self, contact: Contact, length: float | None, *, rough: bool, moves: bool) -> None:
        """Check that the table fits the other tables of its case. ``length``, length of a line contact in the
        table of the discharge [m]. Raises InputError if the shape of the bodies is not known far enough, the
        roughness is given twice, or the contact is transient.
        """
        if moves:
            raise InputError.worded("meter", "is not used with [motion], only with a stationary contact")
        if rough and self.rq is not None:
            raise InputError.worded(
                "meter.rq", "is not used with [[roughness]], whose film includes the roughness"
            )
        if self.length is not None:
            if length is not None and length != self.length:
                raise InputError(
                    "meter.length", got=f"{self.length:g} m", takes="the value of discharge.length"
                )
            return
        if contact.geometry == "line":
            if length is None:
                raise InputError.missing("meter.length", "the length of the line contact")
        elif not _ball_on_open_body(contact):
            raise InputError.missing(
                "meter.length",
                "the width across entrainment over which both bodies face each other; it is known only for a "
                "ball on a body that is plane or convex across entrainment",
            )


def body_radii(contact: Contact) -> Iterator[tuple[float, float]]:
    """Radii along and across entrainment of both bodies [m], infinite where a body has no curvature.

    If the case gives reduced radii only, the first body has them, and the second one is a plane.

    Examples
    --------
    >>> given = {"geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm", "load": "20 N"}
    >>> given |= {"reduced_modulus": "226 GPa", "entrainment_speed": "1 m/s"}
    >>> list(body_radii(Contact.from_dict(given)))
    [(0.01, 0.01), (inf, inf)]
    """
    plane = float("inf")
    if contact.geometry == "line":
        if contact.reduced_radius is not None:
            yield from ((contact.reduced_radius, plane), (plane, plane))
        else:
            assert contact.radius_1 is not None and contact.radius_2 is not None
            yield from ((contact.radius_1, plane), (contact.radius_2, plane))
    elif contact.radius_x is not None and contact.radius_y is not None:
        yield from ((contact.radius_x, contact.radius_y), (plane, plane))
    else:
        for body in ("body_1", "body_2"):
            yield contact.value(f"{body}.radius_x"), contact.value(f"{body}.radius_y")


def _ball_on_open_body(contact: Contact) -> bool:
    """Whether the more curved body is a ball, and the other one is plane or convex across entrainment."""
    (along, across), (_, other) = sorted(body_radii(contact), key=lambda radii: -1.0 / radii[0])
    return along > 0.0 and abs(across - along) <= _ROUND * along and other > 0.0
