"""Warnings of the clearance of a bearing: a class before mounting, a preload, and a ring that gets loose."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.bearing.fits.mounted import MountedClearance
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.cases.library.clearance import clearance_range
from ehlectric.errors import ResultWarning


def class_warnings(bearing: Bearing) -> Iterator[ResultWarning]:
    """Warning of a clearance that is the middle of a class.

    Parameters
    ----------
    bearing : Bearing
        Table ``[bearing]``.
    """
    if bearing.clearance_class is None or bearing.bore is None:
        return
    allowed = clearance_range(bearing.kind, bearing.clearance_class, bearing.bore)
    low, high, middle = (1e6 * value for value in (allowed.least, allowed.most, allowed.middle))
    after = "which fits and a warm inner ring make smaller"
    if bearing.fits is not None:
        after = f"so that the clearance in operation may be {0.5 * (high - low):.3g} µm smaller or larger"
    yield ResultWarning(
        "clearance-class",
        f"clearance class {bearing.clearance_class} is {low:.3g} to {high:.3g} µm before mounting; "
        f"computed with {middle:.3g} µm, {after}",
    )


def fit_warnings(clearance: MountedClearance | None) -> Iterator[ResultWarning]:
    """Warnings of fits and temperatures that preload a bearing, or loosen one of its rings.

    Parameters
    ----------
    clearance : MountedClearance or None
        Clearances of the bearing; None without fits.
    """
    if clearance is None:
        return
    mounted, running = clearance.mounted, clearance.running
    if running.clearance < 0.0:
        yield ResultWarning(
            "clearance-negative",
            f"the clearance in operation is {1e6 * running.clearance:.3g} µm: fits and temperatures preload "
            f"the bearing, from {1e6 * clearance.unmounted:.3g} µm before mounting; a larger clearance "
            "class, looser fits or a cooler inner ring prevent it",
        )
    for name, before, after in (
        ("inner ring is loose on its shaft", mounted.shaft_interference, running.shaft_interference),
        ("outer ring is loose in its housing", mounted.housing_interference, running.housing_interference),
    ):
        if after <= 0.0 < before:
            yield ResultWarning(
                "fit-loose",
                f"the {name} in operation: the interference of {1e6 * before:.3g} µm becomes "
                f"{1e6 * after:.3g} µm at these temperatures, and the ring may creep",
            )
