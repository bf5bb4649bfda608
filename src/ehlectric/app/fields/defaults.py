"""Values that hold where the inputs give none: those of the library, and those of the input files."""

from __future__ import annotations

from typing import Any

from ehlectric.app.catalogue import bearing, coating, oil
from ehlectric.app.fields.ends import bearing_at, end_and_key
from ehlectric.app.inputs import Inputs
from ehlectric.cases.defaults import BOUNDARY_FILM, DEFAULT_ERROR

_DEFAULTS = {
    "contact.boundary_film": f"{1e9 * BOUNDARY_FILM:g} nm",
    "electric.mean_free_path": "0 nm",
    "electric.tribofilm_resistance": "0 ohm m^2",
    "bearing.element_material": "steel",
    "bearing.ring_material": "steel",
    "bearing.radial_load": "0 N",
    "bearing.axial_load": "0 N",
    "bearing.fits.shaft_material": "steel",
    "bearing.fits.shaft_bore": "0 mm",
    "drive.seed": 0,
    "source.scale": 1,
    "circuit.common_mode_resistance": "0 ohm",
    "circuit.ground_resistance": "0 ohm",
}

# Values of a library's oil that do not hold with a data sheet, as the cases resolve it.
_NOT_WITH_SHEET = (
    *("lubricant.viscosity", "lubricant.pressure_viscosity_coefficient", "lubricant.density"),
    "lubricant.atmospheric_law",
)

_LIBRARY = {"bearing.coating": coating, "bearing": bearing, "lubricant": oil}


def default_of(inputs: Inputs, key: str) -> Any:
    """Value that holds where the inputs do not give the key; None where there is none.

    Examples
    --------
    >>> default_of(Inputs({"bearing": {"base": "6208"}}), "bearing.bore")
    '40 mm'
    """
    if key == "drive.contacts":
        return inputs.value("drive_end.contacts") or "solved"
    end, key = end_and_key(key)
    inputs = bearing_at(inputs, end)
    if key == "grid.error":
        error = DEFAULT_ERROR[inputs.value("contact.geometry") == "point"]
        return f"{100.0 * error:g} %"
    if key in _NOT_WITH_SHEET and inputs.value("lubricant.temperature") is not None:
        return None
    estimated = inputs.value("lubricant.temperature.base_oil") is not None
    if key == "lubricant.roelands_z" and estimated:
        return None
    for table, known in _LIBRARY.items():
        if key.startswith(f"{table}."):
            value = known(str(inputs.value(f"{table}.base"))).get(key.removeprefix(f"{table}."))
            if value is not None:
                return value
            break
    return _DEFAULTS.get(key)
