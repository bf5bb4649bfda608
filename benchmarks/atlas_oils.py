"""How films of points differ from oil to oil: ``python -m benchmarks.atlas_oils 40``.

Each random contact is solved with a random oil and with the reference oil of the atlas, at the same groups,
so that their ratio is the effect of the oil alone, without the errors of the table. What the correction for
the oil leaves of it is fitted by the shape of the oil's viscosity law, times (1, l, m, ln k) with
l = ln(L/10) and m = ln(M/50), M of the line contact with the same velocity parameter. Contacts and oils are
others than those with which the atlas is compared. Solved pairs are appended to
``benchmarks/data/oils-random.jsonl.gz``.
"""

import argparse
import gzip
import json
import math

import numpy as np

from benchmarks.atlas import DATA, oils
from benchmarks.atlas_nodes import groups_of, record
from ehlectric.film.atlas.atlas_films import OilChange, OilGroups, reference_groups, reference_laws
from ehlectric.film.atlas.atlas_groups import Groups
from ehlectric.film.atlas.atlas_table import NAMES

FITTED = ("central", "minimum")

SEED, FILE = 16, DATA / "oils-random.jsonl.gz"

# Load groups, lubricant coordinates and ratios of the semi-axes that are drawn; wide contacts as far as the
# atlas has solved nodes.
LOADS, LUBRICANTS, RATIOS, MOST_WIDE = (10.0, 11500.0), (5.2, 108.0), (0.3, 19.0), 2400.0

# Least difference of an oil's shape from that of the reference oil: others say little.
LEAST_SHAPE = 0.015


def chosen_oils():
    """Laws and groups of oils that differ from the reference oil."""
    reference = reference_groups().shape
    every = [(laws, OilGroups.of(*laws)) for laws in oils(np.random.default_rng(SEED))]
    return [(laws, oil) for laws, oil in every if abs(oil.shape - reference) > LEAST_SHAPE]


def contact(number, found):
    """Groups and number of the oil of a random contact; None where its pressure is no bearing's."""
    rng = np.random.default_rng([SEED, number])
    load, lubricant, ratio = (
        math.exp(rng.uniform(*np.log(limits))) for limits in (LOADS, LUBRICANTS, RATIOS)
    )
    oil = int(rng.integers(len(found)))
    groups = groups_of(load, lubricant / load ** (1.0 / 6.0), ratio)
    pressure = groups.hertz_number / found[oil][1].alpha
    solvable = 0.1e9 < pressure < 4e9 and groups.hertz_number < 100.0 and (ratio > 1.0 or load < MOST_WIDE)
    return (groups, oil) if solvable else None


def solved():
    """Pairs that are solved."""
    if not FILE.exists():
        return []
    with gzip.open(FILE, "rt") as file:
        return [json.loads(line) for line in file]


def solve(count, found, part, parts):
    """Solve a part of the first ``count`` pairs, as far as they are not, and append them to the file."""
    done, number, kept = {row["number"] for row in solved()}, -1, 0
    while kept < count:
        number += 1
        drawing = contact(number, found)
        if drawing is None:
            continue
        kept += 1
        if number in done or kept % parts != part:
            continue
        groups, oil = drawing
        own = record(groups, found[oil][0], found[oil][1].alpha)
        reference = record(groups, reference_laws(), reference_groups().alpha)
        row = {"number": number, "oil": oil, "own": own, "reference": reference}
        with gzip.open(FILE, "at") as file:
            file.write(json.dumps(row) + "\n")


def logarithms(row):
    """Logarithms of the numbers of a film, extrapolated over its two grids; None where it is not solved."""
    if row["status"] != "converged" or row["coarse"] is None:
        return None
    fine, coarse = np.array(row["fine"]), np.array(row["coarse"])
    step = np.where(np.abs(fine - coarse) < 0.2 * np.abs(fine), (fine - coarse) / 3.0, 0.0)
    return dict(zip(NAMES, np.log(np.maximum(fine + step, 1e-12)), strict=True))


def remainders(row, oil):
    """Terms of the fit, and what the correction leaves of each number; None where a film is not solved."""
    own, reference = logarithms(row["own"]), logarithms(row["reference"])
    if own is None or reference is None:
        return None
    groups = Groups(row["own"]["m"], row["own"]["l"], row["own"]["k"])
    change = OilChange(groups, oil)
    left = {
        name: own[name] - reference[name] - np.log(change.of_lines(name)) for name in ("central", "minimum")
    }
    return change.point_terms, left


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("number", type=int, help="pairs to solve; 0 fits those that are solved")
    parser.add_argument("--part", type=int, default=0)
    parser.add_argument("--parts", type=int, default=1)
    chosen, found = parser.parse_args(), chosen_oils()
    solve(chosen.number, found, chosen.part, chosen.parts)
    rows = [(row["oil"], remainders(row, found[row["oil"]][1])) for row in solved()]
    kept = [(oil, *pair) for oil, pair in rows if pair is not None]
    print(f"{len(rows)} pairs, {len(rows) - len(kept)} not solved")
    numbers, terms = np.array([oil for oil, _, _ in kept]), np.array([terms for _, terms, _ in kept])
    for name in FITTED:
        left = np.array([values[name] for _, _, values in kept])
        fit = np.linalg.lstsq(terms, left, rcond=None)[0]
        without = np.empty_like(left)
        for oil in set(numbers):
            own = numbers == oil
            without[own] = left[own] - terms[own] @ np.linalg.lstsq(terms[~own], left[~own], rcond=None)[0]
        print(
            f"{name:8s} before {100 * left.std():.2f} %, at most {100 * np.abs(left).max():.2f} %;",
            f"others fitted {100 * without.std():.2f} %, at most {100 * np.abs(without).max():.2f} %:",
            np.round(fit, 3),
        )


if __name__ == "__main__":
    main()
