"""Table ``bearing.fits`` of a bearing file: clearance before mounting, interferences, shaft and housing."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.library.clearance import BORE
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown

TEMPERATURE = Amount("K", least=200.0, most=600.0, reason="absolute")
PLAY = Amount("m", least=-1e-3, most=1e-2, reason="full diametral play")
_Interference = Annotated[
    float, Amount("m", least=-1e-2, most=1e-2, reason="on the diameter, negative for a loose fit")
]


def _solid(name: str) -> str:
    names = library.solid_names()
    if name not in names:
        raise InputError(got=shown(name), takes=f"one of the library: {', '.join(names)}")
    return name


_Solid = Annotated[str, AfterValidator(_solid)]


class Fits(Table):
    """Clearance before mounting, fits on shaft and in housing, and their temperatures.

    The clearance in operation follows from them. All dimensions are those at ``reference_temperature``.
    """

    unmounted_clearance: Annotated[float, PLAY] | None = None
    shaft_interference: _Interference
    housing_interference: _Interference
    shaft_bore: Annotated[float, Amount("m", least=0.0, most=10.0, reason="of a hollow shaft")] = 0.0
    housing_diameter: Annotated[float, BORE] | None = None
    shaft_material: _Solid = "steel"
    housing_material: _Solid
    element_temperature: Annotated[float, TEMPERATURE] | None = None
    shaft_temperature: Annotated[float, TEMPERATURE] | None = None
    housing_temperature: Annotated[float, TEMPERATURE] | None = None
    # Standard reference temperature of dimensions, ISO 1.
    reference_temperature: Annotated[float, TEMPERATURE] = 293.15
