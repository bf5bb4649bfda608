"""Case of a line or point contact, read from TOML, written back, and changed.

A case is frozen and holds SI floats. Alternative inputs (two radii or the reduced radius, load or Hertz
pressure, entrainment speed or two speeds) are stored as the file gives them; ``ehlectric.contact.conditions``
computes the operating conditions from them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Required, Self, TypedDict, TypeVar, Unpack

from pydantic import PrivateAttr, ValidationInfo, model_validator

from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.contact_inputs import Contact, LineKeys, PointKeys, geometry_of, warn_of
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.dry_contacts import hertz_pressure
from ehlectric.cases.film_inputs import FilmPhysics, Inlet, check_film
from ehlectric.cases.grid_inputs import POINT_GRID_KEYS, Electric, Grid, Motion, Solver, point_grid
from ehlectric.cases.key_names import refuse_deep
from ehlectric.cases.keywords import Fields, Keys, keys_of, split, takes
from ehlectric.cases.meter_inputs import Meter
from ehlectric.cases.replaced_keys import BASE, refuse_another_oil, refuse_replaced
from ehlectric.cases.roughness_inputs import Roughness, check_geometry, find_files, unused_of_surfaces
from ehlectric.cases.table import CaseFile, Title, as_mapping, with_name_keys
from ehlectric.cases.table_edits import displace_alternatives, drop_geometry, flattened, set_keys
from ehlectric.errors import InputError, short, shown
from ehlectric.lubricant.oil import Oil
from ehlectric.lubricant.python_laws import Laws, OwnLaws, SampledLaws
from ehlectric.quantities.alternatives import CONTACT_GROUPS
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import inputs
from ehlectric.runtime.display import headline

# Key of the laws of a user's own, in tables of Python and in the context of a validation.
LAWS = "laws"


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
    laws: OwnLaws | None


class _LineCaseKeys(_Tables, LineKeys, total=False):
    pass


class _PointCaseKeys(_Tables, PointKeys, total=False):
    pass


# Fields of the keywords of both, by the names of their tables in the book of inputs.
_FIELDS: Fields = {
    "contact": Contact.model_fields,
    "case_file": dict.fromkeys(key for key in keys_of(_Tables) if key != LAWS),
}


class Case(CaseFile, book="case_file"):
    """Charged line or point contact: all inputs on which film and electric field depend.

    A case is made from a file by ``from_toml``, from nested tables by ``from_dict`` or by keywords, and from
    the keys of its contact by ``Case.line`` or ``Case.point``. A case is frozen; ``replace`` returns a copy
    with changes. Numbers are in SI units. All methods but ``from_toml`` accept ``laws``, your own functions.

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

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> case.replace({"contact.entrainment_speed": "2 m/s"}).contact.entrainment_speed
    2.0
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

    # Laws of the user's own, their values in this contact, and ``discharge`` without their strength.
    _laws: OwnLaws | None = PrivateAttr(default=None)
    _sampled: SampledLaws | None = PrivateAttr(default=None)
    _given_discharge: Discharge | None = PrivateAttr(default=None)

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
        if isinstance(table, Mapping) and LAWS in table:
            raise _laws_in_table(table[LAWS])
        if not isinstance(table, Mapping) or geometry_of(table.get("contact")) != "point":
            return table
        grid = table.get("grid", {})
        if isinstance(grid, Grid):
            grid = grid.model_dump(exclude_unset=True)
        return {**table, "grid": point_grid(grid)} if isinstance(grid, Mapping) else table

    @model_validator(mode="after")
    def _check(self, info: ValidationInfo) -> Self:
        laws = info.context.get(LAWS) if info.context else None
        given = {name for name, table in self if table is not None}
        moves = "motion" in given
        self.grid.check_geometry(self.contact.geometry)
        self.lubricant.at(self.contact.temperature)
        check_geometry(self.roughness, self.contact.geometry)
        check_film(self.film, self.contact, self.lubricant, () if laws is None else laws.names)
        if self.discharge is not None:
            self.discharge.check_geometry(self.contact.geometry)
        if self.meter is not None:
            length = None if self.discharge is None else self.discharge.length
            self.meter.check(self.contact, length, rough=bool(self.roughness), moves=moves)
        if self.inlet is not None:
            self.inlet.check(self.contact, tables=[name for name, table in self if table is not None])
        if self.motion is not None:
            self.motion.check(self.grid, rough=bool(self.roughness))
            object.__setattr__(self, "grid", self.grid.fixed())
        if laws is not None:
            self._take(laws)
        return self

    def _take(self, laws: OwnLaws) -> None:
        """Take laws of the user's own, with their values in this contact, as the case is made."""
        if self.motion is not None:
            raise InputError.worded(
                LAWS, "are not used with moving roughness, whose file of the run cannot contain functions"
            )
        temperature, discharge = self.contact.temperature, self.discharge
        if temperature is None:
            text = "missing; a law of your own needs it"
            raise InputError.worded("contact.temperature", text, takes="a temperature")
        sampled = laws.at(temperature, hertz_pressure(self.contact))
        if strength := sampled.samples.get("strength"):
            values = {"pressure": strength.pressure.tolist(), "strength": strength.values.tolist()}
            table = {} if discharge is None else discharge.model_dump(mode="json", exclude_none=True)
            tables = {"discharge": table}
            displace_alternatives(tables, {"discharge.strength_table": values}, self.contact.geometry)
            tables.setdefault("discharge", {})["strength_table"] = values
            object.__setattr__(self, "discharge", Discharge.from_dict(tables["discharge"]))
        private = {"_laws": laws, "_sampled": sampled, "_given_discharge": discharge}
        object.__setattr__(self, "__pydantic_private__", private)

    @classmethod
    def unused_keys(cls, given: Mapping[str, Any]) -> set[str]:
        """Return the dotted keys that a contact of the given geometry and its rough surfaces cannot use."""
        geometry = as_mapping(given.get("contact")).get("geometry", "line")
        unused = super().unused_keys(given) | unused_of_surfaces(given.get("roughness"), geometry)
        if geometry == "line":
            return unused | {f"grid.{key}" for key in POINT_GRID_KEYS}
        return unused | {"discharge.length"}

    @property
    def oil(self) -> Oil:
        """Oil at the temperature of the contact: its numbers and its laws over pressure."""
        oil = self.lubricant.at(self.contact.temperature)
        return oil if self._sampled is None else self._sampled.applied(oil)

    @property
    def first_grid(self) -> Grid:
        """Grid on which the film is solved first, with its number of nodes."""
        return self.grid.first(rough=bool(self.roughness))

    @property
    def user_laws(self) -> OwnLaws | None:
        """Laws of the user's own that replace the laws of the lubricant; None without any."""
        return self._laws

    @property
    def law_values(self) -> SampledLaws | None:
        """Values of these laws in this contact; None without any."""
        return self._sampled

    def with_laws(self, laws: OwnLaws | None) -> Self:
        """Return the case with laws of the user's own for its oil, or without them for None."""
        return self._validated(self._without_laws() | {LAWS: laws}, written=False)

    def _without_laws(self) -> dict[str, Any]:
        """Tables of the case as they are without laws of the user's own."""
        table = self.plain_tables()
        if self._laws is not None:
            table.pop("discharge", None)
            if self._given_discharge is not None:
                table["discharge"] = self._given_discharge.model_dump(mode="json", exclude_none=True)
        return table

    def _check_file(self) -> None:
        if self._laws is not None:
            raise InputError.worded(
                LAWS,
                f"{_listed(self._laws)} cannot be contained in tables or in a file; replace(laws=None) "
                "returns the case with the laws of its lubricant",
            )

    def described_toml(self) -> str:
        """Return the TOML text of the case; it names user laws, so that no reader takes it for complete."""
        return self.toml_text(**({} if self._laws is None else {LAWS: self._laws.names}))

    @classmethod
    def _validated(
        cls, table: Mapping[str, Any], *, written: bool, context: Mapping[str, Any] | None = None
    ) -> Self:
        laws = table.get(LAWS)
        if laws is None or isinstance(laws, OwnLaws):
            table = {key: value for key, value in table.items() if key != LAWS}
            context = {**(context or {}), LAWS: laws if laws is not None and laws.names else None}
        return super()._validated(table, written=written, context=context)

    def __eq__(self, other: object) -> bool:
        # A LineCase is equal to a Case with the same values, as a result has once it is loaded.
        if not isinstance(other, Case):
            return NotImplemented
        return self.__dict__ == other.__dict__ and _same_laws(self, other)

    def _headline(self) -> str:
        """Title, geometry, load and speed on one line."""
        groups = CONTACT_GROUPS[self.contact.geometry]
        keys = [key for row in (*groups["load"], groups["speed"][0]) for key in row]
        given = [(key, self.contact.value(key), inputs()["contact"][key].unit) for key in keys]
        numbers = [f"{key} {amount(value, unit)}" for key, value, unit in given if value is not None]
        motion = None if self.motion is None else "moving roughness"
        laws = None if self._laws is None else f"own laws of {', '.join(self._laws.names)}"
        return headline(self.title, f"{self.contact.geometry} contact", *numbers, motion, laws)

    @classmethod
    @takes(_LineCaseKeys, _FIELDS)
    def line(cls, **keys: Unpack[_LineCaseKeys]) -> LineCase:
        """Make the case of a line contact from the keys of its table ``contact``, and its other tables.

        A number is a float in the SI unit in brackets, a text with its unit, or a quantity of pint. Required
        are a radius, the elasticity, a load, a speed and ``lubricant``. Doubtful radii and moduli warn. Keys
        of the other tables are on the page "Case files" of the documentation.

        Examples
        --------
        >>> steel = {"reduced_radius": "14.1 mm", "reduced_modulus": 226e9}
        >>> Case.line(**steel, max_hertz_pressure="1 GPa", entrainment_speed=4.0, lubricant="paper")
        <LineCase line contact, max_hertz_pressure 1 GPa, entrainment_speed 4 m/s>
        """
        return _of_keys(LineCase, "line", keys)

    @classmethod
    @takes(_PointCaseKeys, _FIELDS)
    def point(cls, **keys: Unpack[_PointCaseKeys]) -> PointCase:
        """Make the case of a point contact from the keys of its table ``contact``, and its other tables.

        A number is a float in the SI unit in brackets, a text with its unit, or a quantity of pint. Required
        are the radii, the elasticity, a load, a speed and ``lubricant``. Doubtful radii and moduli warn.

        Examples
        --------
        >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa"}
        >>> Case.point(**ball, load="20 N", entrainment_speed="2 m/s", lubricant="paper")
        <PointCase point contact, load 20 N, entrainment_speed 2 m/s>
        """
        return _of_keys(PointCase, "point", keys)

    @classmethod
    def of_file(cls, table: dict[str, Any], path: Path) -> Self:
        """Make a case from the tables of the file at a path."""
        if "bearing" in table and "contact" not in table:
            raise InputError(
                path, "is the file of a bearing", takes="the file of a contact; ehlectric bearing solves it"
            )
        find_files(table, path.parent)
        return cls.from_written(table)

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case; the title stays unless a new one is given.

        A new key replaces its alternative: a Hertz pressure replaces the load, and a new ``lubricant.base``
        replaces all values of the lubricant; ``lubricant="fva-3"`` is such a base. A new geometry removes the
        keys that only the old geometry has, and the lengths, nodes and error of its grid. ``laws`` replaces
        laws of your own; None removes them. If laws of your own give a property of the oil, a new base needs
        new ``laws``.

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
        flat = with_name_keys({**flattened(tables), **(changes or {})}, Case)
        new_laws = LAWS in flat
        laws = flat.pop(LAWS, self._laws)
        table = self._without_laws()
        geometry = flattened(flat).get("contact.geometry", self.contact.geometry)
        if geometry != self.contact.geometry:
            drop_geometry(table, self.contact.geometry)
        displace_alternatives(table, flat, geometry)
        set_keys(table, flat)
        changed = self.from_dict(table | {LAWS: laws})
        if changed.user_laws is not None:
            before = flattened(self._without_laws())
            others = {key: (before.get(key),) for key in flattened(flat) if key != BASE}
            check_changes(changed, others)
            if BASE in flat and not new_laws:
                refuse_another_oil(changed.lubricant, self.lubricant, changed.user_laws.names)
        return changed


class LineCase(Case):
    """Case of a stationary line contact, as ``Case.line`` makes it; ``solve`` returns a ``Result``.

    Examples
    --------
    >>> from ehlectric import Case, LineCase
    >>> case = Case.line(
    ...     reduced_radius="14.1 mm", reduced_modulus="226 GPa", max_hertz_pressure="1 GPa",
    ...     entrainment_speed="4 m/s", lubricant="paper",
    ... )
    >>> isinstance(case, LineCase)
    True
    """

    @model_validator(mode="after")
    def _check_kind(self) -> Self:
        return _of_kind(self, "line")


class PointCase(Case):
    """Case of a stationary point contact, as ``Case.point`` makes it; ``solve`` returns a ``PointResult``.

    Examples
    --------
    >>> from ehlectric import Case, PointCase
    >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
    >>> isinstance(Case.point(**ball, entrainment_speed="1 m/s", lubricant="paper"), PointCase)
    True
    """

    @model_validator(mode="after")
    def _check_kind(self) -> Self:
        return _of_kind(self, "point")


C = TypeVar("C", bound=Case)


def check_changes(case: Case, changes: Mapping[str, Iterable[Any]]) -> None:
    """Raise an InputError if one of the values of a key differs from the value in a case, and a law of the
    user's own replaces this value. Keys are dotted, and values in SI units.
    """
    if case.user_laws is not None:
        given = flattened(case._without_laws())
        refuse_replaced(case.lubricant, case.user_laws.names, given, changes)


def _of_keys(kind: type[C], geometry: str, keys: Mapping[str, Any]) -> C:
    """Case of a kind from the keys of its contact and its other tables; its doubtful values are warned of."""
    tables, contact = split(keys, _Tables)
    case = kind.from_dict({"contact": {"geometry": geometry, **contact}, **tables})
    # Two further calls are the constructor and its decorator.
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


def _same_laws(case: Case, other: Case) -> bool:
    """Whether two cases have the same laws of a user's own: equal functions, or equal values of a file."""
    if case.user_laws is None or other.user_laws is None:
        return case.user_laws is other.user_laws
    if isinstance(case.user_laws, Laws) and isinstance(other.user_laws, Laws):
        return case.user_laws == other.user_laws
    assert case.law_values is not None and other.law_values is not None
    return case.law_values.same_values(other.law_values)


def _listed(laws: OwnLaws) -> str:
    """Properties with their laws, for messages."""
    return "; ".join(f"{key}: {name}" for key, name in laws.names.items())


def _laws_in_table(given: object) -> InputError:
    """Error of laws in the tables of a case that are no functions, or stand in a file."""
    if isinstance(given, Mapping) and given and all(isinstance(name, str) for name in given.values()):
        named = "; ".join(f"{key}: {name}" for key, name in given.items())
        return InputError.worded(
            LAWS,
            f"a file cannot contain laws of your own ({short(named)}); give the functions in Python, as in "
            "Case.from_dict({..., 'laws': Laws(...)}), or remove the table [laws] to use the oil of the file",
            takes="Laws of functions",
        )
    return InputError(LAWS, got=shown(type(given).__name__), takes="Laws of functions, in Case.from_dict")
