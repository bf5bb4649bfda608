"""How films of points differ from oil to oil: ``python -m benchmarks.atlas_oils 40``.

Each random contact is solved with a random oil and with the reference oil of the atlas, at the same groups,
so that their ratio is the effect of the oil alone, without the errors of the table. What the correction for
the oil leaves of it is fitted by the shape of the oil's viscosity law, times (1, l, m, ln k) with
l = ln(L/10) and m = ln(M/50), M of the line contact with the same velocity parameter. Contacts and oils are
others than those with which the atlas is compared. Solved pairs are appended to
``benchmarks/data/oils-random.jsonl.gz``.
"""

import argparse

import numpy as np

from benchmarks.atlas import add_arguments, drawn_point, extrapolated, is_solvable, oils, solve, solved
from benchmarks.atlas_nodes import record
from ehlectric.film.atlas.atlas_films import OilChange, OilGroups, reference_groups, reference_laws
from ehlectric.film.atlas.atlas_groups import Groups

FITTED = ("central", "minimum")

SEED = 16

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
    """Groups and number of the oil of a random contact; None where it is not solved."""
    rng = np.random.default_rng([SEED, number])
    groups, oil = drawn_point(rng, LOADS, LUBRICANTS, RATIOS), int(rng.integers(len(found)))
    wide = groups.ratio < 1.0 and groups.load_group >= MOST_WIDE
    return (groups, oil) if not wide and is_solvable(groups, found[oil][1].alpha, 0.1e9) else None


def pair(groups, laws, oil):
    """What is stored of a contact with an oil and with the reference oil."""
    return {
        "own": record(groups, laws, oil.alpha),
        "reference": record(groups, reference_laws(), reference_groups().alpha),
    }


def remainders(row, oil):
    """Terms of the fit, and what the correction leaves of each number; None where a film is not solved."""
    own, reference = extrapolated(row["own"]), extrapolated(row["reference"])
    if own is None or reference is None:
        return None
    groups = Groups(row["own"]["m"], row["own"]["l"], row["own"]["k"])
    change = OilChange(groups, oil)
    left = {
        name: np.log(own[name] / reference[name] / (change.of_lines(name) * change.of_stiff(name)))
        for name in FITTED
    }
    return change.point_terms(groups.ratio), left


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add_arguments(parser)
    found = chosen_oils()
    solve(
        "oils",
        lambda number: contact(number, found),
        lambda groups, oil: pair(groups, *found[oil]),
        parser.parse_args(),
    )
    rows = [(row["oil"], remainders(row, found[row["oil"]][1])) for row in solved("oils")]
    kept = [(oil, *left) for oil, left in rows if left is not None]
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
