"""Models of cases of every kind at many values of their uncertain inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, Protocol

from ehlectric.arrays import Array
from ehlectric.axle import AxleModel
from ehlectric.bearing import BearingModel, Names
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.measurements import BEARING_POINTS, GEAR_POINTS, ColumnBook, axle_points
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.drive import DriveModel
from ehlectric.errors import InputError
from ehlectric.gear import GearModel
from ehlectric.quantities.verdict import Verdict


class Model(Protocol):
    """Case at many values of its k uncertain inputs."""

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the measurable quantities that the model computes."""

    @property
    def candidates(self) -> tuple[str, ...]:
        """Quantities that can be compared as the next to measure, in a short time."""

    def names(self) -> tuple[Names, ...]:
        """Names and ranges of the inputs."""

    def values(self, place: int, parts: Array) -> Array:
        """Values of an input at parts of its range, SI units, shape (n,)."""

    def numbers(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Quantities, or the margin, at inputs from 0 to 1 and operating points, shape (n, k) -> (n, p)."""

    def errors(
        self, at: Array, points: Sequence[Mapping[str, float]], quantities: Sequence[str]
    ) -> dict[str, Array]:
        """Standard deviations of quantities due to interpolation between solutions, with the arguments and
        the shapes of ``numbers``.
        """

    def updated(self, values: Mapping[str, float], ranges: Mapping[str, tuple[float, float]]) -> Any:
        """Case with other values of some inputs, by the keys of ``names``, and with other ranges."""

    def verdict(self, case: Any, chance: Chance | None) -> Verdict:
        """Verdict on an updated case with the probability of breakdown."""


_MODELS: Mapping[type, Any] = MappingProxyType(
    {
        BearingCase: BearingModel.of,
        DriveCase: DriveModel.of,
        GearCase: GearModel.of,
        AxleCase: AxleModel.of,
    }
)


# Columns of a file of operating points of a case, by its kind.
_POINTS: Mapping[type, Callable[[Any], ColumnBook]] = MappingProxyType(
    {
        BearingCase: lambda _: BEARING_POINTS,
        DriveCase: lambda _: BEARING_POINTS,
        GearCase: lambda _: GEAR_POINTS,
        AxleCase: lambda case: axle_points(case.keys_of_elements(), case.keys_of_shafts()),
    }
)


def points_of(case: Any) -> ColumnBook:
    """Columns of a file of operating points of a case that has a model."""
    return _POINTS[type(case)](case)


def model_of(case: Any) -> Model:
    """Model of a case. Raises InputError for a case that has none, or whose contacts must be solved."""
    for kind, of in _MODELS.items():
        if isinstance(case, kind):
            model: Model = of(case)
            return model
    raise InputError(
        "measured",
        got=f"a {type(case).__name__}",
        takes="the case of a bearing, a drive, a gear pair or an axle",
    )
