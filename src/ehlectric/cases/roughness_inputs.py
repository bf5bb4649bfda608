"""Tables `roughness` of a case: rough surfaces from files or generators, and their processing steps."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, model_validator

from ehlectric.cases.mean_heights import FACTOR, StatedRa
from ehlectric.cases.surface_heights import Heights
from ehlectric.cases.table import as_mapping
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.units import length_unit

_LengthUnit = Annotated[str, AfterValidator(length_unit)]

# Required keys and optional keys of each generator.
GENERATORS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "sinusoid": (("amplitude", "wavelength"), ("phase", "orientation")),
    "gaussian": (("rq", "correlation_length", "seed"), ("correlation_length_y", "orientation")),
    "self-affine": (("rq", "hurst", "rolloff_wavelength", "seed"), ("shortest_wavelength",)),
    "pit": (("depth", "width"), ("rim", "position", "position_y")),
    "asperity": (("height", "width"), ("position", "position_y")),
}
_HEIGHTS_KEYS = ("spacing", "spacing_y", "line", "along", "direction", "assume_transverse")
_FILE_KEYS = ("x_unit", "z_unit", *_HEIGHTS_KEYS)
SHAPES = ("sinusoid", "pit", "asperity")
_POINT_KEYS = ("correlation_length_y", "orientation", "position_y", "shift_y")
_STEPS = ("form", "cutoff_long", "cutoff_short", "trim", "rescale_rq", "truncate", "extend")


class Roughness(StatedRa, book="roughness"):
    """One rough surface, read from a file or generated, and its processing steps."""

    surface: Literal[1, 2]
    file: str | None = None
    heights: Heights | None = None
    x_unit: _LengthUnit | None = None
    z_unit: _LengthUnit | None = None
    spacing: float | None = None
    spacing_y: float | None = None
    line: int | None = None
    along: Literal["row", "column"] = "row"
    direction: Literal["x", "y"] = "x"
    assume_transverse: bool = False
    generator: str | None = None
    amplitude: float | None = None
    wavelength: float | None = None
    phase: float | None = None
    rq: float | None = None
    ra: float | None = None
    rq_over_ra: float | None = None
    correlation_length: float | None = None
    correlation_length_y: float | None = None
    orientation: float | None = None
    hurst: float | None = None
    rolloff_wavelength: float | None = None
    shortest_wavelength: float | None = None
    seed: int | None = None
    depth: float | None = None
    height: float | None = None
    width: float | None = None
    rim: float | None = None
    position: float | None = None
    position_y: float | None = None
    form: Literal["none", "mean", "line", "parabola"] = "none"
    cutoff_long: float | None = None
    cutoff_short: float | None = None
    trim: float | None = None
    rescale_rq: float | None = None
    truncate: float | None = None
    shift: float = 0.0
    shift_y: float = 0.0
    extend: Literal["mirror", "repeat", "flat"] = "mirror"

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_alternatives(
            ("file", "generator", "heights"), "a file, a generator or heights", needed=True
        )
        if self.heights is not None and self.spacing is None:
            raise InputError.missing("spacing", "the distance between neighbouring heights")
        if self.heights is not None and self.heights.values.ndim == 1 and self.spacing_y is not None:
            raise InputError.worded("spacing_y", "is not used by heights of a profile")
        if self.generator is not None:
            self._check_generator()
        allowed = used_by(self.generator, heights=self.heights is not None)
        for name in sorted(self._given() - allowed):
            what = f"the generator {self.generator!r}" if self.generator else "a file"
            what = what if self.heights is None else "heights"
            raise InputError.worded(name, f"is not used by {what}")
        return self

    @property
    def is_measured(self) -> bool:
        """Whether the surface is measured, in a file or an array of heights, and not generated."""
        return self.generator is None

    def _given(self) -> set[str]:
        """Names of the keys whose value differs from the default."""
        fields = type(self).model_fields.items()
        return {name for name, field in fields if getattr(self, name) != field.default}

    def _check_generator(self) -> None:
        if self.generator not in GENERATORS:
            raise InputError(
                "generator", got=shown(self.generator), takes=f"one of {', '.join(map(repr, GENERATORS))}"
            )
        for name in GENERATORS[self.generator][0]:
            if getattr(self, name) is None:
                raise InputError.worded(name, f"missing; the generator {self.generator!r} needs it")
        rolloff, shortest = self.rolloff_wavelength, self.shortest_wavelength
        if rolloff is not None and shortest is not None and shortest >= rolloff:
            raise InputError(
                "shortest_wavelength",
                got=f"{shortest:g} m",
                takes=f"less than rolloff_wavelength, {rolloff:g} m",
            )
        round_waves = self.generator == "gaussian" and self.correlation_length_y is None
        if round_waves and self.orientation is not None:
            raise InputError(
                "orientation",
                got=f"{self.orientation:g} deg for an isotropic surface",
                takes="correlation_length_y with it",
            )

    def check_geometry(self, geometry: str) -> None:
        """Check that the surface has no key that only the other kind of contact may have. Raises InputError
        if a key does not fit the geometry; the key in the message is not preceded by ``roughness.``.
        """
        if geometry == "line":
            for name in _POINT_KEYS:
                if name in self._given():
                    raise InputError.worded(name, "is not used by a line contact, only by a point contact")
            if self.direction == "y" and not self.assume_transverse:
                raise InputError(
                    "direction",
                    got="'y', measured across entrainment; a line contact sees every profile as ridges "
                    "across it",
                    takes="assume_transverse = true to use it so all the same",
                )
        elif self.assume_transverse:
            raise InputError.worded(
                "assume_transverse", "is not used by a point contact, only by a line contact"
            )


def used_by(generator: str | None, *, heights: bool = False) -> set[str]:
    """Keys of a rough surface from a file, from an array of heights, or from a generator.

    Examples
    --------
    >>> "x_unit" in used_by(None), "x_unit" in used_by("pit"), "depth" in used_by("pit")
    (True, False, True)
    """
    used = {"surface", "shift", "shift_y"}
    if heights:
        return used | {"heights", *_HEIGHTS_KEYS, *_STEPS}
    if generator is None:
        return used | {"file", *_FILE_KEYS, *_STEPS}
    needed, optional = GENERATORS[generator]
    of_mean = ("ra", FACTOR) if "rq" in needed else ()
    return used | {"generator", *needed, *optional, *of_mean, *(() if generator in SHAPES else _STEPS)}


def unused_of_surfaces(tables: Any, geometry: Any) -> set[str]:
    """Dotted keys that none of the rough surfaces of a contact can use; none if their kind is not known."""
    given = [as_mapping(table) for table in tables] if isinstance(tables, list | tuple) else []
    kinds = {table.get("generator") for table in given}
    used = set(Roughness.model_fields)
    if (
        given
        and kinds <= {None, *GENERATORS}
        and all({"file", "heights", "generator"} & row.keys() for row in given)
    ):
        used = set().union(*map(used_by, kinds), {"heights"} if None in kinds else ())
    used -= set(_POINT_KEYS if geometry == "line" else ("assume_transverse",))
    return {f"roughness.{key}" for key in Roughness.model_fields if key not in used}


def check_geometry(tables: Iterable[Roughness], geometry: str) -> None:
    """Check that rough surfaces have only keys that fit the geometry of the contact, "line" or "point".
    Raises InputError if a key does not fit; the message names the key, its value, and what is allowed.
    """
    for table in tables:
        with within("roughness"):
            table.check_geometry(geometry)


def _file_table(holder: Any, key: str) -> Any:
    """Value of a key of a table, in which a text becomes a table with this file; None without the table."""
    if not isinstance(holder, dict):
        return None
    if isinstance(holder.get(key), str):
        holder[key] = {"file": holder[key]}
    return holder.get(key)


def find_files(table: dict[str, Any], folder: Path) -> None:
    """Make the names of files absolute, which are relative to the ``folder`` of the case file: roughness, a
    common-mode voltage, a duty cycle, a measurement, a record of the shaft voltage, and viscosities.

    They then stay valid if the case is written to another folder.
    """
    rough, measured = table.get("roughness"), table.get("measured")
    record, viscosities = (
        _file_table(holder, key)
        for holder, key in ((measured, "shaft_record"), (table.get("lubricant"), "viscosity_table"))
    )
    tables = (table.get("source"), table.get("duty"), measured, record, viscosities)
    for holder in (*(rough if isinstance(rough, list) else []), *tables):
        if not isinstance(holder, dict) or not isinstance(holder.get("file"), str):
            continue
        if not Path(holder["file"]).is_absolute():
            holder["file"] = str((folder / holder["file"]).absolute())
