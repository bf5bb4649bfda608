"""Results of sweeps whose model is known in closed form, in the form that the engine returns."""

import itertools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from scipy.stats import qmc

from ehlectric import Case
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.sweep.points import Point, Range
from ehlectric.sweep.result import SweepResults

SPEED, LOAD, POTENTIAL = "contact.entrainment_speed", "contact.load_per_length", "electric.potential_2"

Inputs = Mapping[str, Any]
Model = Callable[[Inputs], dict[str, Any]]


def case() -> Case:
    """A line contact that the sweeps vary."""
    contact = {
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "load_per_length": "1.57 MN/m",
        "entrainment_speed": "4 m/s",
    }
    return Case.from_dict({"title": "A sweep", "contact": contact, "lubricant": {"base": "paper"}})


def breakdown(inputs: Inputs) -> dict[str, Any]:
    """Summary with the breakdown voltage 10 V (u/(4 m/s))^0.7 (w/(1 MN/m))^-0.1; default voltage 5 V."""
    speed, load = inputs.get(SPEED, 4.0), inputs.get(LOAD, 1e6)
    voltage = inputs.get(POTENTIAL, 4.0) + 1.0
    strength = 10.0 * (speed / 4.0) ** 0.7 * (load / 1e6) ** -0.1
    return {
        "inputs": {"contact": {"entrainment_speed": speed}},
        "film": {"minimum_thickness": strength / 15e6},
        "field": {"voltage": voltage},
        "discharge": {
            "breakdown_voltage": strength,
            "margin": strength / voltage,
            "probability": float(strength < voltage),
            "contact_energy": 1e-9 * voltage**2,
        },
    }


def doubtful_where(wrong: Callable[[Inputs], bool], model: Model = breakdown) -> Model:
    """Model with a severe warning at the points where ``wrong`` is true."""

    def warned(inputs: Inputs) -> dict[str, Any]:
        text = "the film may be 32 % off or more on this grid; do not use it"
        told = [ResultWarning("grid-far-too-coarse", text)] if wrong(inputs) else []
        return texts_and_codes(told) | model(inputs)

    return warned


def points(
    rows: Sequence[Inputs], model: Model, status: Callable[[Inputs], str] = lambda _: "solved"
) -> tuple[Point, ...]:
    """Points of a sweep; solved and unconverged points have a summary."""
    of_sweep = []
    for number, row in enumerate(rows):
        state = status(row)
        summary = model(row) if state in ("solved", "not converged") else None
        of_sweep.append(Point(number, row, state, summary=summary))  # type: ignore[arg-type]
    return tuple(of_sweep)


def grid(axes: Mapping[str, Sequence[Any]], model: Model = breakdown, **how: Any) -> SweepResults:
    """Sweep over a grid; the last key varies fastest."""
    rows = [dict(zip(axes, values, strict=True)) for values in itertools.product(*axes.values())]
    values = {key: tuple(axis) for key, axis in axes.items()}
    return SweepResults(case(), "grid", values, {}, 0, points(rows, model, **how))


def paired(axes: Mapping[str, Sequence[Any]], model: Model = breakdown, **how: Any) -> SweepResults:
    """Sweep over paired lists of values."""
    rows = [dict(zip(axes, values, strict=True)) for values in zip(*axes.values(), strict=True)]
    values = {key: tuple(axis) for key, axis in axes.items()}
    return SweepResults(case(), "paired", values, {}, 0, points(rows, model, **how))


def sobol(
    ranges: Mapping[str, Range], samples: int, model: Model, *, seed: int = 0, **how: Any
) -> SweepResults:
    """Sobol design: rows of A, then of B, then of A with each column of B."""
    base = qmc.Sobol(2 * len(ranges), seed=seed).random(samples)
    a, b = base[:, : len(ranges)], base[:, len(ranges) :]
    pages = [a, b]
    for k in range(len(ranges)):
        pages.append(a.copy())
        pages[-1][:, k] = b[:, k]
    rows = [
        {key: _within(span, part) for (key, span), part in zip(ranges.items(), row, strict=True)}
        for row in np.concatenate(pages)
    ]
    return SweepResults(case(), "sobol", {}, dict(ranges), samples, points(rows, model, **how))


def _within(span: Range, part: float) -> float:
    if span.spacing == "log":
        return float(span.start * (span.stop / span.start) ** part)
    return float(span.start + (span.stop - span.start) * part)
