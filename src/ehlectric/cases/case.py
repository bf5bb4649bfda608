"""Case of a line or point contact, read from TOML, written back, and changed.

A case is frozen and holds SI floats. Alternative inputs (two radii or the reduced radius, load or Hertz
pressure, entrainment speed or two speeds) are stored as the file gives them; ``ehlectric.contact.conditions``
computes the operating conditions from them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Required, Self, TypedDict, TypeVar, Unpack

from pydantic import PrivateAttr, model_validator

from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.changes import displace_alternatives, drop_geometry, flattened, set_keys
from ehlectric.cases.contact_inputs import Contact, LineKeys, PointKeys, geometry_of, warn_of
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.film_inputs import FilmPhysics, Inlet, check_film
from ehlectric.cases.grid_inputs import Electric, Grid, Motion, Solver, point_grid
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.keywords import Keys, split, takes
from ehlectric.cases.meter_inputs import Meter
from ehlectric.cases.roughness_inputs import Roughness, check_geometry, find_files
from ehlectric.cases.table import CaseFile, Title, read_toml
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.oil import Oil
from ehlectric.lubricant.python_laws import SampledLaws
from ehlectric.quantities.formats import amount
from ehlectric.runtime.values import headline

# Units of the numbers in the representation of a case, by their key in the table ``contact``.
_SHOWN = {"load_per_length": "N/m", "load": "N", "max_hertz_pressure": "Pa", "entrainment_speed": "m/s"}


class _Tables(TypedDict, total=False):
    """Keys and tables of a case besides its contact, as ``Case.line`` and ``Case.point`` take them."""

    lubricant: Required[Lubricant | Keys | str]
    title: str
    roughness: Sequence[Roughness | Keys]
    film: FilmPhysics | Keys | None
    electric: Electric | Keys | None
    discharge: Discharge | Keys | None
    meter: Meter | Keys | None
    inlet: Inlet | Keys | None
    grid: Grid | Keys | None
    solver: Solver | Keys | None


class _LineCaseKeys(_Tables, LineKeys, total=False):
    pass


class _PointCaseKeys(_Tables, PointKeys, total=False):
    pass


class Case(CaseFile, book="case_file"):
    """Charged line or point contact: all inputs on which film and electric field depend.

    A case is made from a file by ``from_toml``, from nested tables by ``from_dict`` or by keywords, and from
    the keys of its contact by ``Case.line`` or ``Case.point``. Wrong inputs raise an ``InputError`` that
    names their keys. A case is frozen; ``replace`` returns a changed copy. Numbers are in SI units.

    Parameters
    ----------
    contact : Contact or mapping
        Geometry, elasticity, load and speed.
    lubricant : Lubricant or mapping
        Laws of viscosity, density and permittivity, or ``base``, the name of a lubricant of the library.
    title : str, optional
        Title of tables and figures.
    roughness : sequence of mapping, optional
        Tables of the rough surfaces.
    film, electric, discharge, meter, inlet, motion, grid, solver : mapping, optional
        Further tables, as in a case file.
    """

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            contact: Contact | Keys,
            lubricant: Lubricant | Keys,
            title: str = ...,
            roughness: Sequence[Roughness | Keys] = ...,
            film: FilmPhysics | Keys | None = ...,
            electric: Electric | Keys = ...,
            discharge: Discharge | Keys | None = ...,
            meter: Meter | Keys | None = ...,
            inlet: Inlet | Keys | None = ...,
            motion: Motion | Keys | None = ...,
            grid: Grid | Keys = ...,
            solver: Solver | Keys = ...,
        ) -> None: ...

    _laws: SampledLaws | None = PrivateAttr(default=None)

    title: Title = ""
    contact: Contact
    lubricant: Lubricant
    roughness: tuple[Roughness, ...] = ()
    film: FilmPhysics | None = None
    electric: Electric = Electric()
    discharge: Discharge | None = None
    meter: Meter | None = None
    inlet: Inlet | None = None
    motion: Motion | None = None
    grid: Grid = Grid()
    solver: Solver = Solver()

    @model_validator(mode="before")
    @classmethod
    def _point_grid(cls, table: Any) -> Any:
        """Add the defaults of a point contact's grid for the keys that the case does not give."""
        if not isinstance(table, Mapping) or geometry_of(table.get("contact")) != "point":
            return table
        grid = table.get("grid", {})
        if isinstance(grid, Grid):
            grid = grid.model_dump(exclude_unset=True)
        return {**table, "grid": point_grid(grid)} if isinstance(grid, Mapping) else table

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = {name for name, table in self if table is not None}
        moves = "motion" in given
        self.grid.check_geometry(self.contact.geometry)
        self.lubricant.at(self.contact.temperature)
        check_geometry(self.roughness, self.contact.geometry)
        check_film(self.film, self.contact, self.lubricant)
        if self.discharge is not None:
            self.discharge.check_geometry(self.contact.geometry)
        if self.meter is not None:
            length = None if self.discharge is None else self.discharge.length
            self.meter.check(self.contact, length, rough=bool(self.roughness), moves=moves)
        if self.inlet is not None:
            self.inlet.check(self.contact, beside=[name for name, table in self if table is not None])
        if self.motion is not None:
            self.motion.check(self.grid, rough=bool(self.roughness))
            object.__setattr__(self, "grid", self.grid.fixed())
        return self

    @property
    def oil(self) -> Oil:
        """Oil at the temperature of the contact: its numbers and its laws over pressure."""
        oil = self.lubricant.at(self.contact.temperature)
        return oil if self._laws is None else self._laws.applied(oil)

    @property
    def first_grid(self) -> Grid:
        """Grid on which the film is solved first, with its number of nodes."""
        return self.grid.first(rough=bool(self.roughness))

    @property
    def own_laws(self) -> SampledLaws | None:
        """Laws of the user's own that replace those of the lubricant; None without any."""
        return self._laws

    def with_laws(self, laws: SampledLaws) -> Self:
        """Copy of the case whose oil has laws of the user's own; they are not part of its file."""
        case = self.model_copy()
        object.__setattr__(case, "__pydantic_private__", {"_laws": laws})
        return case

    def __eq__(self, other: object) -> bool:
        # A LineCase is equal to a Case with the same values, as a result has once it is loaded.
        return self.__dict__ == other.__dict__ if isinstance(other, Case) else NotImplemented

    def _headline(self) -> str:
        """Title, geometry, load and speed on one line."""
        given = [(key, self.contact.value(key), unit) for key, unit in _SHOWN.items()]
        numbers = [f"{key} {amount(value, unit)}" for key, value, unit in given if value is not None]
        motion = None if self.motion is None else "moving roughness"
        return headline(self.title, f"{self.contact.geometry} contact", *numbers, motion)

    @classmethod
    @takes(_LineCaseKeys)
    def line(cls, **keys: Unpack[_LineCaseKeys]) -> LineCase:
        """Make the case of a line contact from the keys of its table ``contact``.

        Its keys (``ehlectric.cases.contact_inputs.LineKeys``) are floats in SI units, texts with units, or
        quantities of pint; others are tables, ``lubricant`` also a name. Doubtful radii and moduli warn.

        >>> steel = {"reduced_radius": "14.1 mm", "reduced_modulus": 226e9}
        >>> Case.line(**steel, max_hertz_pressure="1 GPa", entrainment_speed=4.0, lubricant="paper")
        <LineCase line contact, max_hertz_pressure 1 GPa, entrainment_speed 4 m/s>
        """
        return _of_keys(LineCase, "line", keys)

    @classmethod
    @takes(_PointCaseKeys)
    def point(cls, **keys: Unpack[_PointCaseKeys]) -> PointCase:
        """Make the case of a point contact from the keys of its table ``contact``.

        Its keys (``ehlectric.cases.contact_inputs.PointKeys``) are floats in SI units, texts with units, or
        quantities of pint; others are tables, ``lubricant`` also a name. Doubtful radii and moduli warn.

        >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa"}
        >>> Case.point(**ball, load="20 N", entrainment_speed="2 m/s", lubricant="paper")
        <PointCase point contact, load 20 N, entrainment_speed 2 m/s>
        """
        return _of_keys(PointCase, "point", keys)

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a case from a TOML file; files that it names are looked for beside it."""
        table = read_toml(path)
        if "bearing" in table and "contact" not in table:
            raise InputError(
                path, "is the file of a bearing", takes="that of a contact; ehlectric bearing solves it"
            )
        find_files(table, Path(path).parent)
        return cls.from_written(table)

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case; the title stays unless a new one is given.

        A new key replaces its alternative: a Hertz pressure replaces the load, two radii replace the reduced
        radius, and a new ``lubricant.base`` replaces all values of the lubricant. A new geometry removes the
        keys that only the old geometry has, and the lengths, nodes and error of its grid.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"contact.entrainment_speed": "2 m/s"}``. The key of a rough
            surface has the number of its table, from 1, as in ``{"roughness.1.rescale_rq": "50 nm"}``.
        **tables
            New values by table, as in ``contact={"entrainment_speed": "2 m/s"}``, or by key of the case, as
            in ``title="A"``. Other keys of a table stay.
        """
        refuse_deep({**tables, "changes": changes})
        flat = {**flattened(tables), **(changes or {})}
        table = self.to_dict()
        geometry = flattened(flat).get("contact.geometry", self.contact.geometry)
        if geometry != self.contact.geometry:
            drop_geometry(table, self.contact.geometry)
        displace_alternatives(table, flat, geometry)
        set_keys(table, flat)
        return self.from_dict(table)


class LineCase(Case):
    """Case of a stationary line contact, as ``Case.line`` makes it; ``solve`` returns a ``Result``."""

    @model_validator(mode="after")
    def _check_kind(self) -> Self:
        return _of_kind(self, "line")


class PointCase(Case):
    """Case of a stationary point contact, as ``Case.point`` makes it; ``solve`` returns a ``PointResult``."""

    @model_validator(mode="after")
    def _check_kind(self) -> Self:
        return _of_kind(self, "point")


C = TypeVar("C", bound=Case)


def _of_keys(kind: type[C], geometry: str, keys: Mapping[str, Any]) -> C:
    """Case of a kind from the keys of its contact and its other tables; its doubtful values are warned of."""
    tables, contact = split(keys, _Tables)
    case = kind.from_dict({"contact": {"geometry": geometry, **contact}, **tables})
    # Two calls more are those of the constructor and of its decorator.
    warn_of(case.contact, level=4)
    return case


def _of_kind(case: C, geometry: str) -> C:
    """Case itself, if its contact has this geometry and does not move."""
    name = type(case).__name__
    if case.contact.geometry != geometry:
        got = shown(case.contact.geometry)
        raise InputError("contact.geometry", got=got, takes=f"{geometry!r} in a {name}")
    if case.motion is not None:
        raise InputError.worded("motion", f"is no table of a {name}; Case.from_dict takes it")
    return case
