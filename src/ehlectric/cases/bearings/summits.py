"""Table ``bearing.summits`` of a bearing file: summits of the roughness, for the number of metallic spots."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.table import Table
from ehlectric.errors import InputError

_Density = Annotated[
    float, Amount("1/m**2", least=1e6, most=1e16, reason="of the sum of both surfaces' heights")
]
_Radius = Annotated[float, Amount("m", least=1e-9, most=1.0, reason="of the caps")]
_Height = Annotated[float, Amount("m", above=0.0, most=1e-4, reason="of the summit heights")]
_Highest = Annotated[float, Amount("", above=0.0, most=100.0, reason="in deviations of the heights")]
_Bandwidth = Annotated[float, Amount("", least=1.5, most=1e6, reason="Nayak's, of a Gaussian surface")]


class Summits(Table):
    """Density, radius and heights of the summits of both surfaces together, at one sampling interval."""

    density: _Density
    radius: _Radius
    height_deviation: _Height | None = None
    bandwidth: _Bandwidth | None = None
    highest: _Highest | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.height_deviation is not None and self.bandwidth is not None:
            raise InputError(
                "height_deviation",
                got="height_deviation and bandwidth together",
                takes="one of the two, as it follows from bandwidth",
            )
        return self
