"""Table `contact` of a case: geometry, elasticity, load and speed, and values that no machine has."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Annotated, Any, Literal, Self, TypedDict

from pydantic import model_validator

from ehlectric.cases import library
from ehlectric.cases.defaults import BOUNDARY_FILM
from ehlectric.cases.keywords import Keys, Value
from ehlectric.cases.oil_inputs import library_choice
from ehlectric.cases.plausibility import PLAUSIBLE, modulus_of_steel, unusual
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import CONTACT_ALTERNATIVES, ONLY
from ehlectric.quantities.result_warnings import ResultWarning, active


def radius_doubt(key: str, radius: float) -> Iterator[ResultWarning]:
    """Warning about a reduced radius [m], with its key, that no machine part has.

    Examples
    --------
    >>> print(*radius_doubt("reduced_radius", 14.1))
    reduced_radius is 14.1 m; machine parts have at most 1 m. Check the unit of the radii.
    """
    if radius > PLAUSIBLE["radius"].high:
        yield ResultWarning.of("radius-large", key=key, radius=radius)
    else:
        yield from active(unusual("radius", radius))


def modulus_doubt(modulus: float) -> Iterator[ResultWarning]:
    """Warning about a reduced modulus [Pa] of rubber, above the modulus of diamond, or without the factor 2.

    Examples
    --------
    >>> print(*modulus_doubt(226e6))
    the reduced modulus is 226 MPa, a value of rubber; steel has 226 GPa. Check the unit of the moduli.
    """
    if modulus < PLAUSIBLE["modulus"].low:
        yield ResultWarning.of("modulus-low", modulus=modulus / 1e6)
    else:
        yield from active(unusual("modulus", modulus))
    yield from active(modulus_of_steel(modulus))


def warn_of(contact: Contact, *, level: int) -> None:
    """Warn in Python of doubtful radii and moduli of a contact; ``level`` counts calls up to the user's."""
    doubts: list[ResultWarning] = []
    for key in ("reduced_radius", "radius_x"):
        radius = contact.value(key)
        doubts += [] if radius is None else radius_doubt(f"contact.{key}", radius)
    if contact.reduced_modulus is not None:
        doubts += modulus_doubt(contact.reduced_modulus)
    for warning in doubts:
        warnings.warn(warning.text, stacklevel=level + 1)


_THERMAL = library_choice(
    partial(library.solid_names, thermal=True), "a solid with thermal properties in the library"
)


class Body(Table, book="contact.body", named_by="material"):
    """Elastic and thermal properties of one body and, for a point contact, its radii in both planes."""

    youngs_modulus: float | None = None
    poissons_ratio: float | None = None
    radius_x: float | None = None
    radius_y: float | None = None
    material: Annotated[str, _THERMAL] | None = None
    thermal_conductivity: float | None = None
    heat_capacity: float | None = None
    density: float | None = None

    @model_validator(mode="before")
    @classmethod
    def _named(cls, table: Any) -> Any:
        return cls.of_name(table)


# Gap at which surfaces without a boundary film touch [m]. The oil needs some gap for its flow.
_ATOM = 5e-11

OTHER = {"line": "point", "point": "line"}


class Contact(Table, book="contact"):
    """Geometry, elasticity, load and speed of a contact."""

    geometry: Literal["line", "point"] = "line"
    radius_x: float | None = None
    radius_y: float | None = None
    reduced_radius: float | None = None
    radius_1: float | None = None
    radius_2: float | None = None
    reduced_modulus: float | None = None
    body_1: Body | None = None
    body_2: Body | None = None
    load: float | None = None
    load_per_length: float | None = None
    max_hertz_pressure: float | None = None
    entrainment_speed: float | None = None
    temperature: float | None = None
    temperature_1: float | None = None
    temperature_2: float | None = None
    slide_to_roll_ratio: float | None = None
    speed_1: float | None = None
    speed_2: float | None = None
    boundary_film: float | None = None
    boundary_friction: float | None = None

    hardness: float | None = None

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the keys that only contacts of the other geometry have."""
        other = OTHER.get(str(given.get("geometry", "line")))
        return set() if other is None else set(ONLY[other])

    @property
    def touching_gap(self) -> float:
        """Gap [m] at which the surfaces touch: the boundary film, or a thinner one than an atom for none."""
        return max(BOUNDARY_FILM if self.boundary_film is None else self.boundary_film, _ATOM)

    @property
    def opposed(self) -> bool:
        """Whether the surfaces move in opposite directions."""
        if self.speed_1 is not None and self.speed_2 is not None:
            return self.speed_1 * self.speed_2 < 0.0
        return abs(self.slide_to_roll_ratio or 0.0) > 2.0

    @model_validator(mode="after")
    def _check(self) -> Self:
        self._check_geometry()
        for group in CONTACT_ALTERNATIVES[self.geometry]:
            self._check_alternatives(group)
        self._check_radii()
        self._check_speeds()
        return self

    def value(self, key: str) -> Any:
        """Value of a dotted key of this table; None if the case does not give it."""
        table, _, leaf = key.rpartition(".")
        part = getattr(self, table) if table else self
        return None if part is None else getattr(part, leaf)

    def _check_geometry(self) -> None:
        """Raise an InputError for keys of the other geometry."""
        for key in ONLY[OTHER[self.geometry]]:
            if self.value(key) is not None:
                radii, _, load, _ = CONTACT_ALTERNATIVES[self.geometry]
                takes = " or ".join(" and ".join(row) for row in (load if "load" in key else radii))
                raise InputError.worded(
                    key, f"is not used by a {self.geometry} contact; expected {takes}", takes=takes
                )

    def _check_radii(self) -> None:
        names = ("radius_1", "radius_2", *ONLY["point"][3:])
        for name in names:
            radius = self.value(name)
            if radius is not None and abs(radius) < 1e-6:
                raise InputError(
                    name, got=f"{radius:g} m", takes="at least 1e-06 m, negative for a concave body"
                )

    def _check_speeds(self) -> None:
        if self.speed_1 is not None and self.speed_2 is not None:
            if self.slide_to_roll_ratio is not None:
                raise InputError.worded(
                    "slide_to_roll_ratio",
                    "follows from speed_1 and speed_2; give either the ratio or the speeds",
                )
            if self.speed_1 + self.speed_2 <= 0.0:
                raise InputError(
                    "speed_1, speed_2",
                    got=f"{self.speed_1:g} and {self.speed_2:g} m/s",
                    takes="speeds whose mean is positive: x runs along entrainment",
                )

    def _check_alternatives(self, group: tuple[tuple[str, ...], ...]) -> None:
        present = [[name for name in row if self.value(name) is not None] for row in group]
        choices = " or ".join(" and ".join(row) for row in group)
        used = [k for k, names in enumerate(present) if names]
        if len(used) > 1:
            both = ", ".join(name for names in present for name in names)
            raise InputError(present[0][0], got=f"{both} together", takes=f"either {choices}")
        if not used:
            raise InputError.missing(group[0][0], f"either {choices}")
        for name in group[used[0]]:
            if name not in present[used[0]]:
                raise InputError.missing(name, f"either {choices}")


class _ContactKeys(TypedDict, total=False):
    """Keys that the constructors of line and point contacts share."""

    reduced_modulus: Value
    body_1: Keys | str
    body_2: Keys | str
    max_hertz_pressure: Value
    entrainment_speed: Value
    temperature: Value
    temperature_1: Value
    temperature_2: Value
    slide_to_roll_ratio: Value
    speed_1: Value
    speed_2: Value
    boundary_film: Value
    hardness: Value
    boundary_friction: Value


class LineKeys(_ContactKeys, total=False):
    """Keys of the table ``contact`` of a line contact, as ``Case.line`` takes them."""

    reduced_radius: Value
    radius_1: Value
    radius_2: Value
    load_per_length: Value


class PointKeys(_ContactKeys, total=False):
    """Keys of the table ``contact`` of a point contact, as ``Case.point`` takes them."""

    radius_x: Value
    radius_y: Value
    load: Value


def geometry_of(contact: Any) -> Any:
    """Geometry of a table ``contact`` that may be a mapping; None if it says none.

    Examples
    --------
    >>> geometry_of({"geometry": "point"}), geometry_of({})
    ('point', None)
    """
    return contact.get("geometry") if isinstance(contact, Mapping) else getattr(contact, "geometry", None)
