"""Films of smooth contacts from the atlas, with the error of each number."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.atlas.coefficient import OilGroups, reference_laws
from ehlectric.atlas.grids import lubricant_coordinate
from ehlectric.atlas.groups import Groups
from ehlectric.atlas.measures import NAMES
from ehlectric.atlas.table import table

Laws = tuple[Callable[..., Any], Callable[..., Any]]

# ln(central) and ln(minimum) change with the differences of an oil's shape and compressibility from those of
# the reference oil, times (1, ln(L/10), ln(M/50)) times these numbers. They are fitted to 604 line contacts
# of 38 oils; M of a point contact is that of a line contact with the same velocity parameter.
_SHAPE = {"central": (0.108, -0.184, -0.030), "minimum": (0.051, -0.191, -0.034)}
_COMPRESSIBILITY = {"central": (-0.052, 0.157, 0.020), "minimum": (-1.032, -0.215, -0.059)}

# Two standard deviations of what the corrections leave of the spread between oils; and of the whole spread,
# for contacts whose oil is not known. Numbers without an entry: the spread was not larger.
_SPREAD = {"central": 0.008, "minimum": 0.014, "mean": 0.016, "zone": 0.003}
_WHOLE_SPREAD = {"central": 0.017, "minimum": 0.030, "mean": 0.020, "zone": 0.004}
_OTHER_SPREAD = 0.01


@dataclass(frozen=True)
class AtlasFilm:
    """Film of a smooth, fully flooded, isothermal contact, interpolated in the atlas.

    Films are in Moes' unit, R (eta0 u_s/(E' R))^(1/2), with the radius R along entrainment.

    Attributes
    ----------
    central, minimum, mean : float
        Film thickness at x = y = 0, smallest film thickness, and mean over the Hertz zone.
    mass : float
        Density ratio times film thickness at x = y = 0, which depends least on the oil.
    central_pressure : float
        Pressure at x = y = 0 over the Hertz pressure.
    zone, inlet, outlet : float
        Mean of rho(0) h(0)/(rho h) over the Hertz zone; integral of dA/h before and behind the middle of the
        contact, outside the Hertz zone, over that of the dry gap plus the central film. They give
        capacitances.
    minimum_at : tuple of float
        Place of the smallest film, x/b along and abs(y)/a across entrainment.
    errors : dict
        Relative error of each number, which about 95 % of solved contacts keep.
    """

    central: float
    minimum: float
    mean: float
    mass: float
    central_pressure: float
    zone: float
    inlet: float
    outlet: float
    minimum_at: tuple[float, float]
    errors: dict[str, float]


@lru_cache(maxsize=1)
def reference_groups() -> OilGroups:
    """Groups of the oil with which the atlas is computed."""
    return OilGroups.of(*reference_laws())


def atlas_film(groups: Groups, laws: Laws | None = None, oil: OilGroups | None = None) -> AtlasFilm:
    """Film of a smooth contact from its groups.

    Parameters
    ----------
    groups : Groups
        M, L and k of the contact, L with the coefficient of ``OilGroups``.
    laws : tuple of callable, optional
        ln(eta/eta0) and rho/rho0 over pressure [Pa]; without them those of the reference oil, with the spread
        between oils as an error.
    oil : OilGroups, optional
        Groups of the oil, where they are known already.

    Returns
    -------
    AtlasFilm
        Numbers of the film with their errors.

    Raises
    ------
    InputError
        Outside the range of the atlas.
    """
    at = (groups.load_group, lubricant_coordinate(groups))
    point = groups.ratio is not None
    values, errors = table("points" if point else "lines")(*at, *((groups.ratio,) if point else ()))
    spread = _WHOLE_SPREAD if laws is None else _SPREAD
    reference = reference_groups()
    oil = (reference if laws is None else OilGroups.of(*laws)) if oil is None else oil
    density = reference_laws()[1]
    logs = dict(zip(NAMES, values.tolist(), strict=True))
    of_reference = groups.formula * math.exp(logs["central"])
    pressure = math.exp(logs["pressure"])
    peak = pressure * groups.hertz_number
    compressed = _ratio(laws[1] if laws else density, peak / oil.alpha)
    mass = of_reference * _ratio(density, peak / reference.alpha) * _factor("central", groups, oil)
    central = mass / compressed
    total = {
        name: float(error) + spread.get(name, _OTHER_SPREAD) for name, error in zip(NAMES, errors, strict=True)
    }
    # The minimum and the mean are stored over the central film.
    total["minimum"] += float(errors[0])
    total["mean"] += float(errors[0])
    return AtlasFilm(
        central=central,
        minimum=of_reference * math.exp(logs["minimum"]) * _factor("minimum", groups, oil),
        mean=central * math.exp(logs["mean"]),
        mass=mass,
        central_pressure=pressure,
        zone=math.exp(logs["zone"]),
        inlet=math.exp(logs["inlet"]),
        outlet=math.exp(logs["outlet"]),
        minimum_at=(logs["minimum_x"], logs["minimum_y"]),
        errors=total,
    )


def _factor(name: str, groups: Groups, oil: OilGroups) -> float:
    """Factor of a film of an oil over that of the reference oil, at the same groups."""
    reference, load = reference_groups(), groups.load_group
    moes_m = load if groups.ratio is None else math.sqrt(3.0 * math.pi / 32.0) * load ** (2.0 / 3.0)
    basis = np.array([1.0, math.log(groups.moes_l / 10.0), math.log(moes_m / 50.0)])
    shape = (oil.shape - reference.shape) * float(basis @ _SHAPE[name])
    compressed = (oil.compressibility - reference.compressibility) * float(basis @ _COMPRESSIBILITY[name])
    return math.exp(shape + compressed)


def _ratio(density: Callable[..., Any], pressure: float) -> float:
    """Density ratio at a pressure [Pa]."""
    ratio: Array = np.ravel(density(np.array([pressure]))[0])
    return float(ratio[0])
