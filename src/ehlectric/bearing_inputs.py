"""What a bearing file takes: the bearing and its load, its oil over temperature, the motor around it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, model_validator

from ehlectric import library
from ehlectric.errors import shown
from ehlectric.inputs import Lubricant
from ehlectric.oil_temperature import Walther, density, roelands_alpha
from ehlectric.quantity import Count, Quantity
from ehlectric.validation import Table

BALLS = ("deep-groove ball", "angular-contact ball")
ROLLERS = ("cylindrical roller",)

_Length = Annotated[float, Quantity("m", least=1e-4, most=10.0, reason="of a machine's bearing")]
_Groove = Annotated[float, Quantity("", above=0.5, most=1.0, reason="groove radius over ball diameter")]
_Capacitance = Annotated[float, Quantity("F", above=0.0, most=1e-3, reason="of an electric machine")]
_Viscosity = Annotated[float, Quantity("m**2/s", least=1e-7, most=1.0, reason="kinematic")]


def _known_material(name: str) -> str:
    if name not in library.material_names():
        raise ValueError(f"got {shown(name)}, takes one of the library: {', '.join(library.material_names())}")
    return name


_Material = Annotated[str, AfterValidator(_known_material)]


def _factor(given: Any) -> float | str:
    """A film factor: "none", "inlet-shear", or a number."""
    if given in ("none", "inlet-shear"):
        return str(given)
    takes = "'none', 'inlet-shear', or a number above 0 and at most 1"
    if isinstance(given, bool) or not isinstance(given, int | float) or not 0.0 < given <= 1.0:
        raise ValueError(f"got {shown(given)}, takes {takes}")
    return float(given)


class Bearing(Table):
    """Internal geometry, materials, load, speed and temperature of a rolling bearing."""

    base: str | None = None
    kind: Literal["deep-groove ball", "angular-contact ball", "cylindrical roller"]
    elements: Annotated[int, Count(3, 1000, "rolling elements of one row")]
    element_diameter: _Length
    pitch_diameter: _Length
    inner_groove: _Groove | None = None
    outer_groove: _Groove | None = None
    roller_length: _Length | None = None
    profile: Literal["none", "logarithmic"] | None = None
    shoulder_height: (
        Annotated[float, Quantity("", above=0.0, most=0.5, reason="of the element diameter")] | None
    ) = None
    radial_clearance: (
        Annotated[float, Quantity("m", least=-1e-3, most=1e-3, reason="full diametral play")] | None
    ) = None
    contact_angle: (
        Annotated[float, Quantity("deg", above=0.0, below=80.0, reason="free, without load")] | None
    ) = None
    element_material: _Material = "steel"
    ring_material: _Material = "steel"
    element_capacitance: _Capacitance | None = None
    radial_load: Annotated[float, Quantity("N", least=0.0, most=1e8, reason="on the inner ring")] = 0.0
    axial_load: Annotated[float, Quantity("N", least=0.0, most=1e8, reason="on the inner ring")] = 0.0
    inner_speed: Annotated[float, Quantity("rpm", above=0.0, most=1e6, reason="of the inner ring")]
    temperature: Annotated[float, Quantity("K", least=200.0, most=600.0, reason="absolute, of the oil")]
    composite_rq: Annotated[float, Quantity("m", above=0.0, most=1e-4, reason="of both surfaces together")]
    fill: Literal["oil", "air"] = "oil"
    film_factor: Annotated[float | str, BeforeValidator(_factor)] = "none"
