"""Processing steps that a case asks for on a measured or generated surface, and warnings about them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, replace

import numpy as np

from ehlectric.cases.roughness import Roughness
from ehlectric.errors import ResultWarning
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Points, Processing, rms

# Largest correlation length or roll-off wavelength, as a fraction of the domain. With fewer than ten of them
# in the domain, the statistics of the heights there are random.
MOST_OF_DOMAIN = 0.1

# Fraction of the points that ``truncate`` may cut off without a warning.
_MOST_CUT = 0.05


def processing_of(table: Roughness) -> Processing:
    """Processing steps of a table ``[[roughness]]``.

    For a file without form removal the mean is removed.
    """
    steps = Processing(**{step.name: getattr(table, step.name) for step in fields(Processing)})
    return replace(steps, form="mean") if table.file is not None and steps.form == "none" else steps


def step_warnings(
    table: Roughness, steps: Sequence[tuple[str, Points]], voids: float | None
) -> Iterator[ResultWarning]:
    """Warnings about voids that were filled and peaks that were cut off in a profile or a map.

    ``steps`` has the surface after every processing step, ``voids`` the fraction of points without data.
    """
    if voids:
        whose, how = "line", "linear"
        if isinstance(steps[0][1], Map):
            whose, how = "map", "harmonic"
        yield ResultWarning(
            "voids-filled",
            f"{100 * voids:.2g} % of the {whose} of surface {table.surface} has no data; these voids were "
            f"filled by {how} interpolation",
        )
    if table.truncate is not None:
        share = float(np.mean(np.abs(steps[-2][1].heights) > table.truncate))
        if share > _MOST_CUT:
            yield ResultWarning(
                "heights-cut",
                f"truncate cuts {100 * share:.2g} % of the points of surface {table.surface}, whose Rq was "
                f"{rms(steps[-2][1].heights) * 1e9:.3g} nm before: the truncated surface differs from the "
                "measured one; raise truncate",
            )
