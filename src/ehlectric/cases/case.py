"""Case of a line or point contact, read from TOML, written back, and changed.

A case is frozen and holds SI floats. Alternative inputs (two radii or the reduced radius, load or Hertz
pressure, entrainment speed or two speeds) are stored as the file gives them; ``ehlectric.contact.resolve``
computes the operating conditions from them.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

from pydantic import AfterValidator, model_validator

from ehlectric.cases.changes import displace, drop, flattened, set_keys
from ehlectric.cases.contact import CONTACT_ALTERNATIVES, ONLY, Contact
from ehlectric.cases.discharge import STRENGTHS, TABLES, Discharge
from ehlectric.cases.grid import POINT_GRID_KEYS, Electric, Grid, Solver, point_grid
from ehlectric.cases.lubricant import Lubricant
from ehlectric.cases.motion import Motion
from ehlectric.cases.roughness import Roughness, check_geometry
from ehlectric.cases.table import Table, read_toml
from ehlectric.errors import InputError, shown


def _title(text: str) -> str:
    if len(text) > 200 or any(unicodedata.category(letter) == "Cc" for letter in text):
        raise InputError(got=shown(text), takes="at most 200 printable characters on one line")
    return text


# Title of files and figures, on one line.
Title = Annotated[str, AfterValidator(_title)]


class Case(Table):
    """Charged line or point contact: all inputs on which film and electric field depend.

    Examples
    --------
    >>> case = Case.model_validate(
    ...     {
    ...         "contact": {
    ...             "reduced_radius": "14.1 mm",
    ...             "reduced_modulus": "226 GPa",
    ...             "max_hertz_pressure": "1 GPa",
    ...             "entrainment_speed": "4 m/s",
    ...         },
    ...         "lubricant": {"base": "paper"},
    ...     }
    ... )
    >>> case.replace({"contact.entrainment_speed": "2 m/s"}).contact.entrainment_speed
    2.0
    """

    ADVICE: ClassVar = {
        f"lubricant.{key}": "a contact expects the viscosity at its temperature, lubricant.viscosity"
        for key in ("temperature", "iso_vg", "viscosity_grade", "viscosity_index")
    }

    title: Title = ""
    contact: Contact
    lubricant: Lubricant
    roughness: tuple[Roughness, ...] = ()
    electric: Electric = Electric()
    discharge: Discharge | None = None
    motion: Motion | None = None
    grid: Grid = Grid()
    solver: Solver = Solver()

    @model_validator(mode="before")
    @classmethod
    def _point_grid(cls, table: Any) -> Any:
        """Add the defaults of a point contact's grid for the keys that the case does not give."""
        if not isinstance(table, Mapping) or _geometry(table.get("contact")) != "point":
            return table
        grid = table.get("grid", {})
        if isinstance(grid, Grid):
            grid = grid.model_dump(exclude_unset=True)
        return {**table, "grid": point_grid(grid)} if isinstance(grid, Mapping) else table

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.contact.geometry != "point":
            for key in POINT_GRID_KEYS:
                if getattr(self.grid, key) is not None:
                    raise InputError.worded(
                        f"grid.{key}", "is not used by a line contact, only where contact.geometry is 'point'"
                    )
        check_geometry(self.roughness, self.contact.geometry)
        if self.discharge is not None:
            self.discharge.check_geometry(self.contact.geometry)
        self._check_motion()
        return self

    def _check_motion(self) -> None:
        if self.motion is None:
            return
        if not self.roughness:
            raise InputError.worded(
                "motion", "needs a rough surface: roughness is what moves", takes="a rough surface"
            )
        if self.grid.wedge != "second-order":
            raise InputError("grid.wedge", got=f"{self.grid.wedge!r} beside motion", takes="'second-order'")
        if self.grid.refine is not None:
            raise InputError.worded(
                "grid.refine",
                "is not used with [motion], which has a single grid; give grid.nodes",
                takes="grid.nodes",
            )

    @classmethod
    def from_toml(cls, path: str | Path) -> Self:
        """Read a case from a TOML file.

        Parameters
        ----------
        path : str or Path
            TOML file.

        Returns
        -------
        Case
            Case with the values of the file, in SI units.

        Raises
        ------
        InputError
            If the file cannot be read, is not TOML, or is not a valid case.
        """
        table = read_toml(path)
        if "bearing" in table and "contact" not in table:
            raise InputError(
                path, "is the file of a bearing", takes="that of a contact; ehlectric bearing solves it"
            )
        find_files(table, Path(path).parent)
        return cls.from_written(table)

    def to_dict(self) -> dict[str, Any]:
        """Return all values that are set as nested tables, in SI units."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Return the case as TOML text, which ``from_toml`` reads back to an equal case."""
        import tomli_w

        return tomli_w.dumps(self.to_dict())

    def replace(self, changes: Mapping[str, Any] | None = None, /, **tables: Any) -> Self:
        """Return a changed copy of the case.

        A new key replaces its alternative: a Hertz pressure replaces the load, two radii replace the reduced
        radius, and a new ``lubricant.base`` replaces all values of the lubricant. A new geometry removes the
        keys that only the old geometry has, and the lengths and nodes of its grid.

        Parameters
        ----------
        changes : mapping, optional
            New values by dotted key, as in ``{"contact.entrainment_speed": "2 m/s"}``. The key of a rough
            surface has the number of its table, from 1, as in ``{"roughness.1.rescale_rq": "50 nm"}``.
        **tables
            New values by table, as in ``contact={"entrainment_speed": "2 m/s"}``, or by key of the case, as
            in ``title="A"``. Other keys of a table stay.

        Returns
        -------
        Case
            Case with the new values.

        Raises
        ------
        InputError
            If a key is unknown, or the changed case is not valid.
        """
        flat = {**flattened(tables), **(changes or {})}
        table = self.to_dict()
        geometry = flattened(flat).get("contact.geometry", self.contact.geometry)
        if geometry != self.contact.geometry:
            _drop_geometry(table, self.contact.geometry)
        _displace(table, flat, geometry)
        set_keys(table, flat)
        return self.from_dict(table)


def find_files(table: dict[str, Any], folder: Path) -> None:
    """Make the names of roughness files absolute; in a case file they are relative to its ``folder``.

    They then stay valid if the case is written to another folder.
    """
    rough = table.get("roughness")
    for surface in rough if isinstance(rough, list) else []:
        if isinstance(surface, dict) and isinstance(surface.get("file"), str):
            surface["file"] = str((folder / surface["file"]).absolute())


def _geometry(contact: Any) -> Any:
    if isinstance(contact, Mapping):
        return contact.get("geometry")
    return getattr(contact, "geometry", None)


# Keys of a grid that stay if the geometry changes. Lengths and numbers of nodes are removed, because the
# other geometry has other units of length and other defaults.
_GRID_OF_ANY = ("wedge", "field_degree", "refine")


def _drop_geometry(table: dict[str, Any], geometry: str) -> None:
    """Remove the keys of a case that only contacts of this geometry have."""
    for key in ONLY[geometry]:
        drop(table["contact"], key)
    drop(table, "discharge.length")
    table["grid"] = {key: value for key, value in table["grid"].items() if key in _GRID_OF_ANY}


def _displace(table: dict[str, Any], changes: Mapping[str, Any], geometry: object) -> None:
    """Remove from the tables of a case the keys that the changes replace."""
    if "lubricant.base" in changes:
        table["lubricant"] = {}
    alternatives = {
        "contact": (
            *CONTACT_ALTERNATIVES.get(str(geometry), ()),
            (("slide_to_roll_ratio",), ("speed_1", "speed_2")),
        ),
        "discharge": (STRENGTHS, TABLES),
        "motion": ((("passes",), ("duration",)),),
    }
    displace(table, changes, alternatives)
