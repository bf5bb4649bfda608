"""Processing steps of a surface that was read or made, and warnings about them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, replace

import numpy as np

from ehlectric.cases.roughness import Roughness
from ehlectric.errors import ResultWarning
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Points, Processing, rms

# Part of the domain that one correlation length or roll-off wavelength may take: with fewer than ten of them
# its statistics are those of chance.
MOST_OF_DOMAIN = 0.1

# Part of a profile's points that may be cut off without a word.
_MOST_CUT = 0.05


def processing_of(table: Roughness) -> Processing:
    """The steps a case asks for; those of a file begin with its mean where it has no form taken out."""
    steps = Processing(**{step.name: getattr(table, step.name) for step in fields(Processing)})
    return replace(steps, form="mean") if table.file is not None and steps.form == "none" else steps


def step_warnings(
    table: Roughness, steps: Sequence[tuple[str, Points]], voids: float | None
) -> Iterator[ResultWarning]:
    """Warnings about the processing steps of a profile or map."""
    if voids:
        whose, how = "line", "by straight lines"
        if isinstance(steps[0][1], Map):
            whose, how = "map", "as a soap film hangs in them"
        yield ResultWarning(
            "voids-filled",
            f"{100 * voids:.2g} % of the {whose} of surface {table.surface} is void; "
            f"voids within it were filled {how}",
        )
    if table.truncate is not None:
        share = float(np.mean(np.abs(steps[-2][1].heights) > table.truncate))
        if share > _MOST_CUT:
            yield ResultWarning(
                "heights-cut",
                f"truncate cuts {100 * share:.2g} % of the points of surface {table.surface}, whose Rq is "
                f"{rms(steps[-2][1].heights) * 1e9:.3g} nm before it: what is left is another surface",
            )
