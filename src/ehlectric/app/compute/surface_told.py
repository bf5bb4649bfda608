"""Warnings about a rough surface in its contact, in the words of a person who chooses one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ehlectric.app.answers.told import Told
from ehlectric.cases.roughness import Roughness
from ehlectric.formulas.film_line import Thickness
from ehlectric.quantities.units import unit_for
from ehlectric.surfaces.domain import Domain
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface

# Number of copies of a surface in a domain from which a warning names them.
_COPIES = 2.0

_CONTINUED = {
    "mirror": "copies of it, each mirrored at its ends, fill the domain",
    "repeat": "copies of it fill the domain",
}


def too_rough(table: Roughness, rough: RoughSurface | RoughMap, formula: Thickness) -> Told | None:
    """Warning about heights whose root mean square is above the film thickness of a formula."""
    film = formula.central_thickness
    if not rough.steps or film is None:
        return None
    heights = float(np.std(rough.steps[-1][1].heights))
    ratio = heights / film
    if ratio <= 1.0:
        return None
    name = "Sq" if isinstance(rough.steps[-1][1], Map) else "Rq"
    formless = table.file is not None and table.form in ("none", "mean")
    advice = "remove the form first" if formless else "filter its long waves, and check the units of heights"
    text = (
        f"{name} is {_times(ratio)} times the film thickness ({_length(heights)}, against "
        f"{_length(film)} by formula), so the surfaces would touch: {advice}"
    )
    return Told("", "warning", text)


def plainly(told: Told, table: Roughness, rough: RoughSurface | RoughMap, domain: Domain) -> Told:
    """Warning, of which that about a surface far shorter than the domain has its lengths in plain words."""
    if told.code != "roughness-continued":
        return told
    last = rough.steps[-1][1]
    lengths: tuple[tuple[float, float], ...]
    if isinstance(last, Map):
        what, lengths = "map", ((last.length_x, domain.length), (last.length_y, 2.0 * domain.side))
    else:
        across = table.direction == "y" and np.isfinite(domain.side)
        what, lengths = "profile", ((last.length, 2.0 * domain.side if across else domain.length),)
    length, needed = min(lengths, key=lambda pair: pair[0] / pair[1])
    copies = needed / length
    if copies < _COPIES or table.extend not in _CONTINUED:
        return told
    text = (
        f"The {what} is {_length(length)} long and the domain {_length(needed)}: about {_times(copies)} "
        f"{_CONTINUED[table.extend]}, so the contact has the same heights again and again; "
        f"use a longer {what}"
    )
    return replace(told, text=text)


def _times(ratio: float) -> str:
    return f"{ratio:.0f}" if ratio >= 10.0 else f"{ratio:.2g}"


def _length(length: float) -> str:
    factor, unit = unit_for(length, "m", least=1.0)
    return f"{factor * length:.3g} {unit}"
