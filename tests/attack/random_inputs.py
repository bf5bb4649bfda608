"""Random files of every kind, and what is wrong with the answers: words that are no numbers, films that are
thicker than the room, and a check that accepts what the command refuses.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from ehlectric import BearingResult, SweepResults
from ehlectric.calibration import check_measured
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.gear import solve_gear
from ehlectric.runs import gear_preview
from ehlectric.runs.preview import preview_of
from tests.attack.agreement import KINDS_OF_CASES
from tests.helpers.full_cases import cases_of
from tests.helpers.input_effects import Answer
from tests.helpers.input_keys import scaled, values_in, with_value

# Words that stand where a number should.
_NO_NUMBER = re.compile(r"(?<![\w'.-])-?(nan|inf|infinity)(?![\w'.-])", re.IGNORECASE)

# Outcome of a file that cannot be read.
NOT_VALID = "not valid"

# Most numbers of a file that are changed, and the decades by which they change in either direction.
_MOST_CHANGED, _DECADES = 4, 1.5

# Keys of names that may begin with a number.
_NAMES = ("base", "designation", "title")


def drawn(kind: str, rng: np.random.Generator) -> dict[str, Any]:
    """Tables of a file of a kind: a case with some of its keys, of which a few numbers are changed."""
    if kind in KINDS_OF_CASES and rng.random() < 0.3:
        return KINDS_OF_CASES[kind][1](rng)
    tables = _estimated(cases_of(kind)[rng.integers(len(cases_of(kind)))])
    numbers = [
        (path, value)
        for path, value in values_in(tables)
        if path[-1] not in _NAMES and scaled(value, 2.0) != value
    ]
    for place in rng.permutation(len(numbers))[: rng.integers(1, _MOST_CHANGED + 1)]:
        path, value = numbers[place]
        tables = with_value(tables, path, scaled(value, 10.0 ** rng.uniform(-_DECADES, _DECADES)))
    return tables


def _estimated(tables: Any) -> Any:
    """Nested tables whose contacts are of the atlas instead of solved ones, which take seconds."""
    if not isinstance(tables, dict):
        return tables
    found = {key: _estimated(value) for key, value in tables.items()}
    solved = isinstance(found.get("bearing"), dict) and "contacts" not in found and "lubricant" in found
    return found | {"contacts": "atlas"} if solved or found.get("contacts") == "solved" else found


def faults(kind: str, tables: Mapping[str, Any], folder: Path) -> tuple[list[str], str]:
    """Return what is wrong with the answers to the tables of a file, and its outcome: "not valid" for a file
    that cannot be read, "solved", or a reason.
    """
    try:
        answer = Answer(kind, tables, folder)
    except InputError:
        return [], NOT_VALID
    preview = result = checked = solved = None
    try:
        preview = _preview(answer.case)
    except InputError as error:
        checked = error
    try:
        result = answer.result
        summary = _summary(result)
        if getattr(answer.case, "measured", None) is not None:
            # Only ``calibrate`` reads measured values, with these checks.
            check_measured(answer.case)
    except InputError as error:
        solved = error
        if kind == "sweep" and "solved" not in summary["status"]:
            # A sweep keeps points that fail; a sweep of such points only is refused by its check.
            found = [] if checked is not None else ["check accepts a sweep whose points all fail"]
            return found, f"refused: {summary['reason'][0]}"
    except ConvergenceError as error:
        return [], f"not converged: {error}"
    if checked is not None or solved is not None:
        keys = [None if error is None else error.key for error in (checked, solved)]
        found = [] if keys[0] == keys[1] else [f"check refuses {checked}, and the command refuses {solved}"]
        return found, f"refused: {keys[1]}"
    return [*_no_numbers(preview, result, summary), *_too_thick(kind, result, summary)], "solved"


def _preview(case: Any) -> Any:
    """Preview of a case; of a gear pair without its probabilities, which take seconds."""
    with patch.object(gear_preview, "solve_gear", partial(solve_gear, probable=False)):
        return preview_of(case)


def _summary(result: Any) -> Mapping[str, Any]:
    """Summary of a result without its probabilities, or the columns of a sweep."""
    if isinstance(result, SweepResults):
        columns = result.to_dataframe()
        return {name: list(columns[name].dropna()) for name in columns}
    return result.summary(probable=False) if isinstance(result, BearingResult) else result.summary()


def _no_numbers(preview: Any, result: Any, summary: Mapping[str, Any]) -> Iterator[str]:
    """Words in texts of a preview and of a result that are no numbers."""
    texts = [repr(result), json.dumps(summary, default=str)]
    texts += map(str, getattr(result, "warnings", ()))
    if preview is not None:
        texts.append(json.dumps(preview.summary, default=str))
        texts += [str(one) for one in (*preview.warnings, *preview.rows, preview.verdict)]
    for text in texts:
        for word in _NO_NUMBER.finditer(text):
            yield f"{word[0]!r} in {text[max(0, word.start() - 80) : word.end() + 40]!r}"


def _too_thick(kind: str, result: Any, summary: Mapping[str, Any]) -> Iterator[str]:
    """Films that are thicker than the room between the bodies."""
    if kind == "bearing":
        for at in result.solution.positions:
            gaps = [at.equilibrium.ring(inner=inner).gap for inner in (True, False)]
            films = [np.asarray(ring.values.central_thickness) for ring in at.rings]
            room = np.maximum(gaps[0], 0.0) + np.maximum(gaps[1], 0.0)
            for film in films:
                bound = np.maximum(room, 4.0 * np.nanmin(film))
                if np.any(film > (1.0 + 1e-9) * bound):
                    yield f"a film of {np.max(film):.3g} m in a room of {bound[np.argmax(film)]:.3g} m"
    if kind == "gear" and (backlash := summary["gear"]["normal_backlash"]):
        film = summary["mesh"].get("minimum_thickness") or 0.0
        if film > backlash:
            yield f"a film of {film:.3g} m in a backlash of {backlash:.3g} m"
    if kind in ("line", "point"):
        film = np.asarray(result.film.thickness)
        central = summary["film"]["central_thickness"]
        most = float(np.max(film))
        if central is not None and not (0.0 < central <= most < math.inf):
            yield f"a central film of {central!r} m in a domain with films up to {most!r} m"
