"""Distributions of the margins of bearings at many points of operation, computed together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.bearing.bearing_discharges import first_margin, margin_apart, with_films_scaled
from ehlectric.bearing.many_points import SolvedPart, gathered, many_of, solved_parts
from ehlectric.bearing.margin import TOUCHING_ALREADY, margin_and_lambda
from ehlectric.bearing.solution import BearingSolution, film_error, lambda_ratio
from ehlectric.bearing.uncertainty import (
    NO_MARGINS,
    Design,
    MarginSpread,
    spread_at,
    spread_of_result,
    without_spread,
)
from ehlectric.errors import InputError
from ehlectric.formulas.sobol import sobol_points
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.files import plain

# Distribution of a point; None where it has no probability of breakdown, and the error where it has no margin
# at any other inputs.
Spread = MarginSpread | InputError | None


def spreads_of(solution: BearingSolution, samples: int, seed: int) -> list[Spread]:
    """Distributions of the margins of a solution of m bearings with estimated contacts.

    Every bearing has the same Sobol points of its uncertain inputs, so that differences between bearings are
    no differences between samples. ``samples``, number of points, a power of 2; ``seed`` of the design.
    Each distribution equals ``spread_of_result`` of the single bearing.
    """
    case = solution.case
    spreads: list[Spread] = [None] * case.shape[0]
    apart = margin_apart(solution)
    if apart is None:
        return spreads
    # Films of the coarse solutions are taken to be as thick as the films of the solution.
    parts = [*solved_parts(case, detail="coarse")]
    (ratio,) = gathered(parts, lambda at: (lambda_ratio(at),), (1, len(spreads)))
    scales = lambda_ratio(solution) / ratio
    scaled = [_with_films_scaled(part, scales[part.points]) for part in parts]
    coarse, _ = gathered(scaled, margin_and_lambda, (2, len(spreads)))
    (coarse_apart,) = gathered(scaled, lambda at: (margin_apart(at),), (1, len(spreads)))
    first = first_margin(solution)
    margins = np.broadcast_to(math.nan if first is None else first, coarse.shape)
    # Margins of thicker films are compared where the surfaces touch.
    touching = np.isnan(margins)
    margins, coarse = np.where(touching, apart, margins), np.where(touching, coarse_apart, coarse)
    off = np.broadcast_to(film_error(solution), coarse.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        factors = margins / coarse
    for place in np.flatnonzero(np.isfinite(margins) & ~(coarse > 0.0)).tolist():
        spreads[place] = InputError.worded(None, NO_MARGINS if np.isnan(coarse[place]) else TOUCHING_ALREADY)
    known = np.flatnonzero(np.isfinite(margins) & (coarse > 0.0))
    designs = {place: Design.of_case(case.single(place), float(off[place])) for place in known.tolist()}
    for places in _alike(designs):
        alike = [designs[place] for place in places]
        factor = np.stack([factors[places], scales[places]])
        new = _spreads(solution, np.array(places), alike, factor, samples=samples, seed=seed)
        for place, spread in zip(places, new, strict=True):
            spreads[place] = spread
    return spreads


def _with_films_scaled(part: SolvedPart, scales: Array) -> SolvedPart:
    """Solved points with their lambda ratios of films ``scales`` times as thick, shape (m,)."""
    solution = part.solution
    return replace(part, solution=replace(solution, case=with_films_scaled(solution.case, scales)))


def _alike(designs: dict[int, Design]) -> Iterator[list[int]]:
    """Places of designs whose uncertain inputs change the same keys of a case."""
    groups: dict[object, list[int]] = {}
    for place, design in designs.items():
        changed = tuple(tuple(change.changes(change.value)) for change in design.computed)
        groups.setdefault((changed, design.rough, design.width), []).append(place)
    yield from groups.values()


def _spreads(
    solution: BearingSolution,
    places: IntArray,
    designs: Sequence[Design],
    factors: Array,
    *,
    samples: int,
    seed: int,
) -> list[Spread]:
    """Distributions of some points of a solution, whose designs change the same keys.

    ``factors``, margins and lambda ratios of the points divided by the values of bearings that are solved
    together, shape (2, m).
    """
    at = sobol_points(designs[0].width, samples, seed)
    try:
        margins = factors[0] * _margins(solution, places, designs, factors[1], at)
    except InputError as error:
        # It may be the error of a single point.
        if len(designs) == 1:
            return [error]
        alone = [
            _spreads(
                solution,
                places[k : k + 1],
                designs[k : k + 1],
                factors[:, k : k + 1],
                samples=samples,
                seed=seed,
            )
            for k in range(len(designs))
        ]
        return [spread for (spread,) in alone]
    return [_spread(design, margin, at, seed) for design, margin in zip(designs, margins.T, strict=True)]


def _margins(
    solution: BearingSolution, places: IntArray, designs: Sequence[Design], scales: Array, at: Array
) -> Array:
    """Margins of m points at n samples, without the factors of their designs, shape (n, m); 0 where the
    surfaces touch, NaN without a result. ``scales``, factors on the films of the points, shape (m,).
    """
    count, case = len(at), solution.case
    # All points next to each other for each sample: the parts of a case that are solved together then have
    # points from the whole range, whose interpolation tables also serve the next part.
    columns = {key: np.tile(array[places], (count, 1)) for key, array in case.arrays().items()}
    inputs = [design.arrays(at, scale) for design, scale in zip(designs, scales.tolist(), strict=True)]
    columns |= {key: np.stack([arrays[key] for arrays in inputs], axis=-1) for key in inputs[0]}
    arrays = {key: column.ravel() for key, column in columns.items()}
    many = many_of(case.single(int(places[0])), arrays, count * len(designs))
    margins, _ = gathered(solved_parts(many, detail="coarse"), margin_and_lambda, (2, count * len(designs)))
    films = np.stack([np.broadcast_to(design.film_scale(at), count) for design in designs], axis=-1)
    rows: Array = films * margins.reshape(count, len(designs))
    return rows


def _spread(design: Design, margins: Array, at: Array, seed: int) -> Spread:
    """Distribution of one point from its margins at samples, shape (n,), or the reason why it has none."""
    try:
        return spread_at(design, margins, at, seed)
    except InputError as error:
        return error


def spread_alone(solution: BearingSolution, samples: int, seed: int) -> Spread:
    """Distribution of the margin of one solved bearing, or the reason why it has none."""
    try:
        return spread_of_result(solution, samples, seed)
    except InputError as error:
        return error


def warnings_of_spread(spread: Spread) -> tuple[ResultWarning, ...]:
    """Warnings of a distribution: points without a result."""
    return spread.warnings if isinstance(spread, MarginSpread) else ()


def tables_of_spread(spread: Spread) -> dict[str, Any]:
    """Table ``uncertainty`` of summary.json without the shares of the inputs, and where a bearing with a
    margin has no such table, the reason as ``margin.left_out``.
    """
    if isinstance(spread, InputError):
        return {"uncertainty": None, "margin": {"left_out": [without_spread(spread)]}}
    return {"uncertainty": None if spread is None else plain(spread.summary())}
