"""The atlas against contacts that are solved for the comparison: ``python -m benchmarks.atlas points 300``.

Oils and groups are drawn at random; contact number i is the same in every run. Solved contacts are appended
to ``benchmarks/data/KIND-random.jsonl.gz``, so that a run goes on where the last one ended, and several runs
may share the work with ``--part`` and ``--parts``. Each film is then compared with the atlas: median, 95 %
and largest difference, and the share inside the stated error.
"""

import argparse
import gzip
import json
import math
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.atlas_nodes import groups_of, record
from ehlectric.cases.case_oil import Lubricant
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import MOST_HERTZ, OilGroups, atlas_film
from ehlectric.film.atlas.atlas_groups import Groups, lubricant_coordinate
from ehlectric.film.atlas.atlas_table import NAMES
from ehlectric.lubricant.density import DENSITY_LAWS, dowson_higginson, incompressible
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


def laws_of(kind):
    """Laws of the oils of a kind of contacts, by their number."""
    laws = oils(np.random.default_rng(15))
    return [(viscosity, incompressible) for viscosity, _ in laws] if kind == "incompressible" else laws


DATA = Path(__file__).parent / "data"

# Load groups, lubricant coordinates and ratios of the semi-axes that are drawn: round and narrow contacts,
# wide ones, those with thin oils, and those with oils that are not compressed.
RANGES = {
    "points": ((3.1, 11500.0), (5.2, 108.0), (1.0, 19.0)),
    "wide": ((3.1, 2400.0), (5.2, 108.0), (0.26, 1.0)),
    "thin": ((3.1, 2400.0), (0.62, 5.2), (1.0, 19.0)),
    "incompressible": ((3.1, 2400.0), (2.0, 108.0), (1.0, 19.0)),
}

# Moes' groups M and L of the lines that are drawn.
LINES = ((0.3, 500.0), (0.5, 45.0))


def _between(rng, least, most):
    """Random number, uniform in its logarithm."""
    return math.exp(rng.uniform(math.log(least), math.log(most)))


def drawn_point(rng, loads, lubricants, ratios):
    """Random groups of a point contact, between limits of load group, lubricant coordinate and ratio."""
    load = _between(rng, *loads)
    return groups_of(load, _between(rng, *lubricants) / load ** (1.0 / 6.0), _between(rng, *ratios))


def is_solvable(groups, alpha, least):
    """Whether Hertz pressures are those of bearings, from ``least`` [Pa], and in the range of the atlas."""
    return least < groups.hertz_number / alpha < 4e9 and groups.hertz_number < MOST_HERTZ


def contact(number, kind, laws):
    """Groups and number of the oil of a random contact; None where its Hertz pressure is no bearing's."""
    rng = np.random.default_rng([15, number])
    if kind == "lines":
        groups = Groups(_between(rng, *LINES[0]), _between(rng, *LINES[1]))
    else:
        groups = drawn_point(rng, *RANGES[kind])
    oil = int(rng.integers(len(laws)))
    least = 0.01e9 if kind in ("thin", "lines") else 0.1e9
    return (groups, oil) if is_solvable(groups, OilGroups.of(*laws[oil]).alpha, least) else None


def add_arguments(parser):
    """Options of what to solve: how many contacts, and the part of them that a process takes."""
    parser.add_argument("number", type=int, help="contacts to solve; 0 compares those that are solved")
    parser.add_argument("--part", type=int, default=0)
    parser.add_argument("--parts", type=int, default=1)
    parser.add_argument("--until", help="time of the day, UTC, at which to stop solving, such as 18:05")


def solve(kind, drawing_of: Callable, row_of: Callable, chosen):
    """Solve random contacts that are not solved yet, and append them to the file of their kind.

    ``drawing_of``, groups and oil of a contact by its number, or None; ``row_of``, what is stored of a
    contact with these groups and this oil; ``chosen``, options of ``add_arguments``.
    """
    done, found, number = {row["number"] for row in solved(kind)}, 0, -1
    name = (
        f"{kind}-random.jsonl.gz"
        if chosen.parts == 1
        else f"{kind}-random-{chosen.part}of{chosen.parts}.jsonl.gz"
    )
    while found < chosen.number:
        number += 1
        drawing = drawing_of(number)
        if drawing is None:
            continue
        found += 1
        if number in done or found % chosen.parts != chosen.part:
            continue
        if chosen.until and f"{datetime.now(UTC):%H:%M}" >= chosen.until:
            return
        groups, oil = drawing
        row = {"number": number, "oil": oil} | row_of(groups, oil)
        with gzip.open(DATA / name, "at") as file:
            file.write(json.dumps(row) + "\n")


def solved(kind):
    """Rows of all solved contacts of a kind."""
    rows = []
    for path in sorted(DATA.glob(f"{kind}-random*.jsonl.gz")):
        with gzip.open(path, "rt") as file:
            rows += [json.loads(line) for line in file]
    return rows


def extrapolated(row):
    """Numbers of a solved film by their names, extrapolated over its two grids; None where it has no film."""
    if row["status"] != "converged" or row["coarse"] is None:
        return None
    fine, coarse = np.array(row["fine"]), np.array(row["coarse"])
    step = np.where(np.abs(fine - coarse) < 0.2 * np.abs(fine), (fine - coarse) / 3.0, 0.0)
    return dict(zip(NAMES, fine + step, strict=True))


def compared(row, laws):
    """Differences of the atlas from a solved film and its stated errors; None where either has no film."""
    groups = Groups(row["m"], row["l"], row["k"])
    oil = OilGroups.of(*laws)
    films = extrapolated(row)
    if films is None:
        return None
    try:
        found = atlas_film(groups, laws, oil)
    except InputError:
        return None
    density = laws[1](np.array([films["pressure"] * groups.hertz_number / oil.alpha]))[0]
    films["central"] /= float(np.ravel(density)[0])
    return [(getattr(found, name) / films[name] - 1.0, found.errors[name]) for name in SHOWN]


def report(rows):
    """Print median, 95 % and largest difference, and the share inside the stated error."""
    differences, stated = np.moveaxis(np.array(rows), -1, 0)
    for name, off, error in zip(SHOWN, np.abs(differences).T, stated.T, strict=True):
        median, most, worst = 100.0 * np.quantile(off, [0.5, 0.95, 1.0])
        kept, said = 100.0 * np.mean(off <= error), 100.0 * np.median(error)
        print(
            f"{name:8s} {median:5.2f} % {most:5.2f} % {worst:5.2f} %   inside {kept:3.0f} % of {said:.1f} %"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=("lines", *RANGES))
    add_arguments(parser)
    parser.add_argument("--each", action="store_true", help="print the contacts that are off most")
    chosen = parser.parse_args()
    laws = laws_of(chosen.kind)
    solve(
        chosen.kind,
        lambda number: contact(number, chosen.kind, laws),
        lambda groups, oil: record(groups, laws[oil], OilGroups.of(*laws[oil]).alpha),
        chosen,
    )
    rows = solved(chosen.kind)
    pairs = [(row, compared(row, laws[row["oil"]])) for row in rows]
    kept = [(row, pair) for row, pair in pairs if pair is not None]
    failed = sum(extrapolated(row) is None for row in rows)
    print(f"{len(rows)} contacts: {failed} not solved, {len(rows) - failed - len(kept)} not in the atlas")
    report([pair for _, pair in kept])
    if chosen.each:
        for row, pair in sorted(kept, key=lambda each: -max(abs(each[1][0][0]), abs(each[1][1][0])))[:12]:
            groups = Groups(row["m"], row["l"], row["k"])
            ratio = groups.ratio or math.nan
            at = f"N {groups.load_group:7.1f} Y {lubricant_coordinate(groups):6.1f} k {ratio:5.2f}"
            print(
                at,
                *(
                    f"{name} {100 * off:+.1f} ({100 * error:.1f})"
                    for name, (off, error) in zip(SHOWN, pair, strict=True)
                ),
            )


if __name__ == "__main__":
    main()
