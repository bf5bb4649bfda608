"""Table ``viscosity_table`` of a lubricant: measured viscosities over pressure and temperature."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from pydantic import model_validator

from ehlectric.cases.amounts import amount_at
from ehlectric.cases.measurements import MOST_POINTS, ColumnBook, Measurement, listed_heads, read_measurement
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, within
from ehlectric.lubricant.law import is_many
from ehlectric.lubricant.oil import RangeCheck
from ehlectric.quantities.result_warnings import ResultWarning

if TYPE_CHECKING:
    from ehlectric.lubricant.viscosity_fit import ViscosityFit

KEY = "viscosity_table"

# Columns of the file of a viscosity table.
VISCOSITIES = ColumnBook.of(
    KEY, "'pressure [MPa]', 'temperature [degC]' and 'viscosity [mPa s]'", MOST_POINTS
)

_COLUMNS = ("pressure", "temperature", "viscosity")


class ViscosityTable(Table, book="lubricant.viscosity_table", named_by="file"):
    """Measured viscosity over pressure and temperature, to which a viscosity law is fitted."""

    file: str | None = None
    pressure: tuple[float, ...] | None = None
    temperature: tuple[float, ...] | None = None
    viscosity: tuple[float, ...]

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key in ("pressure", "temperature"):
            values = getattr(self, key)
            if values is not None and len(values) != len(self.viscosity):
                got = f"{len(values)} values and {len(self.viscosity)} of viscosity"
                raise InputError(key, got=got, takes="as many")
        return self

    def fit(self, law: str | None, reference: float | None) -> ViscosityFit:
        """Law of the table; ``law``, name of the viscosity law, None for any; ``reference``, reference
        temperature [K].
        """
        from ehlectric.lubricant.viscosity_fit import fit_viscosity

        return fit_viscosity(self.pressure, self.temperature, self.viscosity, law, reference)


def with_rows(table: Mapping[Any, Any]) -> Mapping[Any, Any]:
    """Table of a lubricant whose viscosity table contains the rows of its file.

    Raises InputError if the file cannot be read, or contains no viscosity.
    """
    given = table.get(KEY)
    if isinstance(given, str | Path):
        given = {"file": str(given)}
    if not isinstance(given, Mapping) or not isinstance(given.get("file"), str) or "viscosity" in given:
        return table
    try:
        read = read_measurement(given["file"], VISCOSITIES)
    except InputError as error:
        raise InputError.worded(KEY, str(error)) from None
    if not read.has("viscosity"):
        heads = listed_heads((*read.heads.values(), *read.ignored))
        kinematic = (
            "; multiply a kinematic viscosity by the density"
            if "inema" in heads.lower() or "inéma" in heads.lower()
            else ""
        )
        raise InputError(
            KEY,
            f"{read.source}: has no viscosity, but {heads}",
            takes=f"headings such as {VISCOSITIES.examples}{kinematic}",
        )
    _check_newtonian(read)
    rows = {name: read.values[name].tolist() for name in _COLUMNS if read.has(name)}
    return {**table, KEY: {**given, **rows}}


# Largest ratio of viscosities at one temperature and pressure whose shear rates differ.
_NEWTONIAN = 1.05

# Temperatures of rows that are one temperature [K].
_LEVEL = 0.5


def _check_newtonian(read: Measurement) -> None:
    """Refuse a table in which the viscosity depends on the shear rate."""
    if not read.has("shear_rate"):
        return
    zeros = np.zeros(read.size)
    pressure, temperature = (read.values.get(name, zeros) for name in ("pressure", "temperature"))
    viscosity, rate = read.values["viscosity"], read.values["shear_rate"]
    levels = np.stack([pressure, np.round(temperature / _LEVEL)], axis=1)
    _, level = np.unique(levels, axis=0, return_inverse=True)
    for number in np.unique(level):
        rows = np.flatnonzero(level.ravel() == number)
        low, high = rows[np.argmin(viscosity[rows])], rows[np.argmax(viscosity[rows])]
        if viscosity[high] > _NEWTONIAN * viscosity[low] and rate[high] != rate[low]:
            upper, lower = (
                f"{1e3 * viscosity[row]:.4g} mPa s at {rate[row]:.4g} 1/s in line {read.lines[row]}"
                for row in (high, low)
            )
            got = f"{read.source}: the viscosity depends on the shear rate: {upper}, and {lower}"
            raise InputError(KEY, got, takes="the rows of the Newtonian plateau, at low shear rates")


def fitted_values(table: Mapping[Any, Any], base: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of the fitted law, which replace keys of the base; none without a viscosity table.

    Raises InputError if no law describes the table, or the lubricant also has a data sheet.
    """
    given = table.get(KEY)
    if given is None:
        return {}
    if table.get("temperature") is not None:
        raise InputError(KEY, got=f"{KEY} and temperature together", takes="either of them")
    with within(KEY):
        rows = given if isinstance(given, ViscosityTable) else ViscosityTable.from_dict(given)
    law, reference = (
        table.get("viscosity_law"),
        table.get("reference_temperature", base.get("reference_temperature")),
    )
    if reference is not None:
        reference = amount_at("lubricant.reference_temperature").parse(reference, written=True)
    fit = rows.fit(law if isinstance(law, str) and fits_pressure(rows) else None, reference)
    keys: dict[str, Any] = dict(fit.keys)
    if fit.temperatures is not None:
        # A measured temperature scatters by about half a kelvin.
        low, high = fit.temperatures
        keys["temperature_range"] = [low - 0.5, high + 0.5]
    return keys


def fits_pressure(rows: ViscosityTable) -> bool:
    """Whether a table contains pressures, so that a law over pressure is fitted."""
    return rows.pressure is not None and max(rows.pressure) - min(rows.pressure) > 0.0


def table_check(
    rows: ViscosityTable | None, parameters: Mapping[str, Any], temperature: Any, viscosity: Any
) -> RangeCheck | None:
    """Check of the viscosity table of an oil with some parameters by name, SI units; None without a table."""
    if rows is None:
        return None
    from ehlectric.lubricant.viscosity_fit import fit_warnings

    law = parameters["viscosity_law"] if fits_pressure(rows) else None
    reference = parameters.get("reference_temperature")
    fit = rows.fit(law, None if is_many(reference) else reference)
    replaced = [key for key, value in fit.keys.items() if not _equal(parameters.get(key), value)]
    if replaced:
        return RangeCheck(
            partial(_replaced, keys=", ".join(replaced)), viscosity, {}, temperature, "viscosity"
        )
    numbers = {name: float(getattr(fit, name)) for name in ("rows", "rms", "worst", "highest", "share")}
    return RangeCheck(partial(fit_warnings, law=fit.law), viscosity, numbers, temperature, "viscosity")


def _equal(given: Any, value: float | str) -> bool:
    if is_many(given):
        # A value for each of many points.
        return False
    if isinstance(value, str) or not isinstance(given, int | float):
        return bool(given == value)
    return math.isclose(given, value, rel_tol=1e-9)


def _replaced(*_: Any, keys: str) -> Any:
    yield ResultWarning.of("viscosity-table", "replaced", keys=keys)
