"""Keys of a summary that hold breakdown voltage, applied voltage and margin, of contacts and bearings."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.drives.swept import SweptCase
from ehlectric.sweep.results import SweepResults


@dataclass(frozen=True)
class Breakdown:
    """Keys and names of a breakdown voltage, the applied voltage and the margin between them.

    All keys are empty for a drive: its films are charged and discharged, and no single voltage is applied.

    Attributes
    ----------
    value : str
        Dotted key of the breakdown voltage in the summary.
    margin : str
        Dotted key of the margin, breakdown voltage divided by applied voltage.
    voltage : str
        Dotted key of the applied voltage.
    name : str
        Name of the breakdown voltage in figures.
    voltage_name : str
        Name of the applied voltage in figures.
    """

    value: str
    margin: str
    voltage: str
    name: str = "breakdown voltage"
    voltage_name: str = "applied voltage"

    @property
    def keys(self) -> tuple[str, str]:
        """Dotted keys of the breakdown voltage and of the margin."""
        return self.value, self.margin

    def voltages(self, results: SweepResults) -> Array:
        """Applied voltage of every point of a sweep [V], shape (points,); NaN where a point has none."""
        return results.values(self.voltage) if self.voltage else np.full(len(results.points), np.nan)

    def margins(self, results: SweepResults) -> Array:
        """Breakdown voltage divided by applied voltage of every point of a sweep.

        Parameters
        ----------
        results : SweepResults
            Results of a sweep.

        Returns
        -------
        ndarray, shape (points,)
            Margin of each point, from its summary or, where that has none, from the two voltages; NaN where a
            point has no breakdown voltage.
        """
        if not self.margin:
            return np.full(len(results.points), np.nan)
        margin = results.values(self.margin)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = results.values(self.value) / results.values(self.voltage)
        return np.where(np.isfinite(margin), margin, ratio)


CONTACT = Breakdown("discharge.breakdown_voltage", "discharge.margin", "field.voltage")
FIRST_BREAK = Breakdown(
    "bearing.first_break",
    "bearing.margin",
    "bearing.shaft_voltage",
    "first breakdown",
    "shaft voltage",
)
THROUGH = Breakdown(
    "bearing.through_breakdown",
    "bearing.through_margin",
    "bearing.shaft_voltage",
    "ring-to-ring breakdown",
    "shaft voltage",
)

# With a coating on a ring, the breakdown voltages beside the shaft voltage are those of the shaft.
_COATED_FIRST = replace(FIRST_BREAK, value="bearing.shaft_first_break")
_COATED_THROUGH = replace(THROUGH, value="bearing.shaft_through_breakdown")


# Of a drive no applied voltage stands beside the breakdown voltage of a film.
_NONE = Breakdown("", "", "")


def main_value(case: SweptCase) -> str:
    """Key of the summary that figures of a sweep show first.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Base case of the sweep.

    Returns
    -------
    str
        Breakdown voltage of a contact, first breakdown of a bearing, or discharges per second of a drive.
    """
    return breakdown_of(case).value or "drive.events_per_second"


def ranked_value(case: SweptCase) -> str:
    """Key of the summary to whose spread the inputs of a Sobol design are ranked.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Base case of the sweep.

    Returns
    -------
    str
        Margin of a bearing with a motor, of which the breakdown voltage is only a part; else ``main_value``.
    """
    if isinstance(case, BearingCase) and case.motor is not None and case.discharge.has_strength:
        return breakdown_of(case).margin
    return main_value(case)


def breakdown_of(case: SweptCase, value: str | None = None) -> Breakdown:
    """Breakdown voltage that a value of a summary belongs to.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Base case of the sweep.
    value : str, optional
        Dotted key of the value.

    Returns
    -------
    Breakdown
        Breakdown of a contact. For a bearing, the first breakdown of one of its contacts, except if ``value``
        is a key of the ring-to-ring breakdown. Without keys for a drive.
    """
    if isinstance(case, DriveCase):
        return _NONE
    if not isinstance(case, BearingCase):
        return CONTACT
    if case.bearing.coating is not None:
        through = value in (*THROUGH.keys, _COATED_THROUGH.value)
        return _COATED_THROUGH if through else _COATED_FIRST
    return THROUGH if value in THROUGH.keys else FIRST_BREAK
