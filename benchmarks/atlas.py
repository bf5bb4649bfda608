"""The atlas against contacts that are solved for the comparison: ``python -m benchmarks.atlas lines 300``.

Oils and groups are drawn at random. Each film is compared with the atlas: median, 95 % and largest
difference, and the share inside the stated error.
"""

import math
import sys
from functools import partial

import numpy as np

from ehlectric.cases.oils.lubricant import Lubricant
from ehlectric.errors import InputError
from ehlectric.film.atlas.coefficient import OilGroups
from ehlectric.film.atlas.compute import record
from ehlectric.film.atlas.film import atlas_film
from ehlectric.film.atlas.groups import Groups, groups_of
from ehlectric.film.atlas.measures import NAMES
from ehlectric.lubricant.density import DENSITY_LAWS, dowson_higginson
from ehlectric.lubricant.viscosity import roelands

LIBRARY = ("e-axle-fluid", "fva-3", "iso-vg-32", "iso-vg-46", "m100", "mobil-shc-320")
SHOWN = ("central", "minimum", "mean", "zone", "inlet", "outlet")
TAIT = {
    "tait_k0_prime": 10.545,
    "tait_k00": 9.234e9,
    "tait_beta_k": 6.09e-3,
    "tait_expansion": 7.734e-4,
    "reference_temperature": 298.15,
}


def oils(rng):
    """Viscosity and density laws of random Roelands oils and of the library's oils."""
    densities = (
        partial(dowson_higginson, density_c1=0.59e9, density_c2=1.34),
        lambda pressure: DENSITY_LAWS["tait"].function(pressure, 313.15, **TAIT),
    )
    made = []
    for number in range(20):
        law = {
            "pressure_viscosity_coefficient": rng.uniform(8e-9, 35e-9),
            "roelands_z": rng.uniform(0.4, 0.8),
            "roelands_pressure": rng.uniform(0.1e9, 0.3e9),
        }
        made.append((partial(roelands, **law), densities[number % 2]))
    for name in LIBRARY:
        for celsius in (0, 40, 80, 120):
            try:
                oil = Lubricant.from_dict({"base": name}).at(273.15 + celsius)
            except InputError:
                continue  # outside the range of its laws
            made.append((oil.log_viscosity, oil.density_ratio))
    return made


def drawn(rng, kind):
    """Random groups of a line or of a point contact."""

    def between(least, most):
        return math.exp(rng.uniform(math.log(least), math.log(most)))

    if kind == "lines":
        return Groups(between(0.3, 500.0), between(1.5, 45.0))
    return groups_of(between(3.2, 2300.0), between(1.6, 45.0), between(1.0, 19.0))


def compared(groups, laws):
    """Differences from a solved film and stated errors; None where either has no film."""
    oil = OilGroups.of(*laws)
    pressure = groups.hertz_number / oil.alpha
    if not 0.1e9 < pressure < 4e9:
        return None
    try:
        found = atlas_film(groups, laws, oil)
    except InputError:
        return None
    row = record(groups, laws, oil.alpha)
    if row["status"] != "converged" or row["coarse"] is None:
        return None
    fine, coarse = np.array(row["fine"]), np.array(row["coarse"])
    step = np.where(np.abs(fine - coarse) < 0.2 * np.abs(fine), (fine - coarse) / 3.0, 0.0)
    solved = dict(zip(NAMES, fine + step, strict=True))
    density = laws[1](np.array([solved["pressure"] * pressure]))[0]
    solved["central"] /= float(np.ravel(density)[0])
    return [(getattr(found, name) / solved[name] - 1.0, found.errors[name]) for name in SHOWN]


def main(kind, number):
    rng = np.random.default_rng(15)
    laws, rows = oils(rng), []
    while len(rows) < number:
        row = compared(drawn(rng, kind), laws[rng.integers(len(laws))])
        if row is not None:
            rows.append(row)
    differences, stated = np.moveaxis(np.array(rows), -1, 0)
    for name, off, error in zip(SHOWN, np.abs(differences).T, stated.T, strict=True):
        median, most, worst = 100.0 * np.quantile(off, [0.5, 0.95, 1.0])
        kept = 100.0 * np.mean(off <= error)
        print(f"{name:8s} {median:5.2f} % {most:5.2f} % {worst:5.2f} %   inside {kept:3.0f} %")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
