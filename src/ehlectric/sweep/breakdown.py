"""Which keys of a summary are a breakdown voltage, its margin, and the voltage that is applied."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.any_case import AnyCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.sweep.results import SweepResults


@dataclass(frozen=True)
class Breakdown:
    """A breakdown voltage with what it is set beside.

    Attributes
    ----------
    value, margin, voltage : str
        Dotted keys of the summary: breakdown voltage, that over the applied one, and the applied one.
    name, voltage_name, whose : str
        What figures call the first and the last of them, and the short of the latter.
    """

    value: str
    margin: str
    voltage: str
    name: str = "breakdown voltage"
    voltage_name: str = "applied voltage"
    whose: str = "applied"

    @property
    def keys(self) -> tuple[str, str]:
        """Breakdown voltage and margin."""
        return self.value, self.margin

    def margins(self, results: SweepResults) -> Array:
        """Breakdown voltage over applied voltage of every point, not a number where there is none.

        Returns
        -------
        ndarray, shape (points,)
            The margin of the summaries; where they have none, from the two voltages.
        """
        margin = results.values(self.margin)
        ratio = results.values(self.value) / results.values(self.voltage)
        return np.where(np.isfinite(margin), margin, ratio)


CONTACT = Breakdown("discharge.breakdown_voltage", "discharge.margin", "field.voltage")
FIRST_BREAK = Breakdown(
    "bearing.first_break",
    "bearing.margin",
    "bearing.shaft_voltage",
    "first break",
    "shaft voltage",
    "shaft's",
)
THROUGH = Breakdown(
    "bearing.through_breakdown",
    "bearing.through_margin",
    "bearing.shaft_voltage",
    "through breakdown",
    "shaft voltage",
    "shaft's",
)


def breakdown_of(case: AnyCase, value: str | None = None) -> Breakdown:
    """The breakdown voltage that a value of a summary is about.

    Parameters
    ----------
    case : Case or BearingCase
        The base case of a sweep.
    value : str, optional
        Its dotted key.

    Returns
    -------
    Breakdown
        Of a bearing the first break, but for the keys of its through breakdown.
    """
    if not isinstance(case, BearingCase):
        return CONTACT
    return THROUGH if value in THROUGH.keys else FIRST_BREAK
