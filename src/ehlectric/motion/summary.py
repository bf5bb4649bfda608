"""Summary of a transient run: film and field over time, their errors, and a comparison with stationary
roughness.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.contact import FIELD_ERROR, inaccurate_field, oil_supply, unknown_error
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.film import MINIMUM_ORDER
from ehlectric.motion.motion_touching import TouchHistory
from ehlectric.motion.stored_run import MotionRun
from ehlectric.motion.warnings import touch_warnings
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored import warnings_in

if TYPE_CHECKING:
    import xarray as xr


# The minimum counts as near its lowest value over time up to this multiple of it.
_NEAR_LOWEST = 1.05

# Part of the change from the coarse run that is the error of the run. With second order it would be a third.
# The minimum at the constriction converges more slowly, and so does a film wave that is short
# against the grid; the order of the minimum covers both.
_PART_LEFT = 1.0 / (2.0**MINIMUM_ORDER - 1.0)

# Smallest estimate, as the films may agree by chance.
_LEAST = 5e-5


@dataclass(frozen=True)
class RunErrors:
    """Relative discretisation errors of a run, of its grid and its time steps together."""

    minimum: float  # error of the minimum film thickness of all steps
    central: float  # largest error over time of the film thickness at the centre

    @property
    def largest(self) -> float:
        """The larger of both errors."""
        return max(self.minimum, self.central)


def run_errors(run: MotionRun) -> RunErrors | None:
    """Discretisation errors of a run; None if its coarse run did not converge at all steps, or it has none.

    Runs of earlier versions have no coarse run. A run whose surfaces touch has no errors either: its minimum
    is the boundary film, and its load share is compared with the load share of the coarse run.
    """
    names = ("lowest_thickness", "coarse_lowest_thickness", "central_thickness", "coarse_central_thickness")
    if any(name not in run.dataset for name in names) or TouchHistory.of(run) is not None:
        return None
    lowest, coarse_lowest, central, coarse_central = (run.values(name)[::2] for name in names)
    if lowest.size < 2 or not np.all(np.isfinite(coarse_lowest)):
        return None
    return estimated(
        (lowest, coarse_lowest), (central, coarse_central), float(np.min(run.values("minimum_thickness")))
    )


def estimated(lowest: tuple[Array, Array], central: tuple[Array, Array], minimum: float) -> RunErrors:
    """Errors of a run from its film thicknesses and the film thicknesses of its coarse run at the same
    instants.

    ``lowest`` and ``central`` are the minimum film thickness between the nodes and the central film thickness
    over time, of the run and of its coarse run, in any unit, shape (n,).

    Two minima over time may agree by chance. Their change is therefore the largest one of all instants at
    which the minimum of either film is within 5 % of its lowest value over time. The distance of the lowest
    node from the lowest place between the nodes is added.

    Of 32 line and point contacts with waves, asperities and pits at slide-to-roll ratios from -1 to 2, one
    exceeded the estimate, by a factor of 1.6: a film wave of five nodes. The true error was about half of the
    estimate in the median. It was found from grids and steps that were two or four times as fine.

    Examples
    --------
    Of a change of 4 % a third is left where the grid resolves the film; the estimate is larger:

    >>> constant = np.ones(3)
    >>> round(estimated((constant, constant), (constant, 1.04 * constant), 1.0).central, 3)
    0.029
    """
    fine, coarse = lowest
    near = (fine <= _NEAR_LOWEST * np.min(fine)) | (coarse <= _NEAR_LOWEST * np.min(coarse))
    change = float(np.max(np.abs(fine - coarse)[near]))
    between = max(minimum - float(np.min(fine)), 0.0)
    of_centre = float(np.max(np.abs(central[0] - central[1]) / central[0]))
    return RunErrors(
        minimum=max((_PART_LEFT * change + between) / minimum, _LEAST),
        central=max(_PART_LEFT * of_centre, _LEAST),
    )


SCHEMA = "ehlectric.motion/1"
QUANTILES = 0.05, 0.5, 0.95

# The recorded instant that is compared with stationary roughness may be at most this far from the time at
# which all roughness is at its position in the case [time steps].
_NEAR = 0.6

# Estimated errors of the moving film above which there is a warning, and above which it says not to use it.
FILM_ERROR, FAR_TOO_LARGE = 0.01, 0.1


def counted(run: MotionRun) -> Mask:
    """Recorded instants that count for statistics over time, shape (frames,)."""
    return np.asarray(run.frame_time >= run.field_history.settled_from)


def summary_of(dataset: xr.Dataset) -> dict[str, Any]:
    """Results of a transient run, nested as in summary.json, SI units.

    The case is part of the dataset. Surface files are not needed.

    Raises InputError if the dataset is not a transient run.
    """
    run, attributes = MotionRun.of(dataset), dataset.attrs
    complete = bool(attributes["complete"])
    results = {
        "schema": SCHEMA,
        "version": str(attributes["version"]),
        "title": run.case.title,
        "converged": complete,
        **texts_and_codes([*warnings_in(attributes), *_halved(run), *_unreliable(run)]),
        "inputs": run.case.to_dict(),
        "motion": _progress(run),
        "film": _film(run),
        "field": _field(run),
        "asperities": _asperities(TouchHistory.whole(run)),
        "discharge": _discharge(run),
        "stationary": json.loads(attributes["stationary"]),
        "beside_stationary": _compared_with_stationary(run),
        "rough": json.loads(attributes["rough"]),
        "seconds": float(attributes["seconds"]),
    }
    summary: dict[str, Any] = plain(results)
    return summary


def _unreliable(run: MotionRun) -> Iterator[ResultWarning]:
    """Warnings about film and field, or about the asperities of a run whose surfaces touch."""
    touching = TouchHistory.of(run)
    if touching is None:
        yield from _inaccurate_film(run)
        yield from _inaccurate(run)
    else:
        yield from touch_warnings(touching)


def _halved(run: MotionRun) -> Iterator[ResultWarning]:
    halvings = run.dataset["halvings"].values
    if np.any(halvings):
        yield ResultWarning.of("steps-halved", steps=np.count_nonzero(halvings), times=int(halvings.sum()))


def _inaccurate_film(run: MotionRun) -> Iterator[ResultWarning]:
    """Warning about a film over time whose estimated error is large or unknown."""
    if "coarse_lowest_thickness" not in run.dataset:
        return  # a run of an earlier version, which has no estimate
    errors = run_errors(run)
    if errors is None:
        yield ResultWarning.of("error-unknown", "moving")
    elif errors.largest > FILM_ERROR:
        code = "grid-far-too-coarse" if errors.largest > FAR_TOO_LARGE else "grid-too-coarse"
        steps = " and more motion.steps" if run.case.motion and run.case.motion.steps else ""
        yield ResultWarning.of(code, "moving", percent=100.0 * errors.largest, steps=steps)


def _inaccurate(run: MotionRun) -> Iterator[ResultWarning]:
    """Warnings about maximum fields of recorded instants whose estimated error is large or unknown."""
    errors = _field_errors(run)
    known = errors[np.isfinite(errors)]
    if known.size and np.max(known) > FIELD_ERROR:
        yield inaccurate_field(run.case.grid, float(np.max(known)))
    if known.size < errors.size:
        yield unknown_error(f" at {errors.size - known.size} of {errors.size} recorded instants")


def _field_errors(run: MotionRun) -> Array:
    """Estimated errors of the maximum field of the recorded instants, NaN where one is unknown.

    Runs of earlier versions have none.
    """
    if "max_strength_error" not in run.dataset:
        return np.empty(0)
    errors: Array = run.dataset["max_strength_error"].values
    return errors


def _field_error(run: MotionRun) -> float | None:
    """Largest estimated error of the maximum field of the recorded instants, None if one is unknown."""
    errors = _field_errors(run)
    return float(np.max(errors)) if errors.size and np.all(np.isfinite(errors)) else None


def _progress(run: MotionRun) -> dict[str, Any]:
    dataset = run.dataset
    steps = dataset.sizes["step"] - 1
    return run.schedule.described() | {
        "steps_done": steps,
        "frames": dataset.sizes["frame"],
        "newton_per_step": float(dataset["newton_iterations"].values.sum()) / max(steps, 1),
        "krylov_per_step": float(dataset["krylov_iterations"].values.sum()) / max(steps, 1),
        "halvings": int(dataset["halvings"].values.sum()),
    }


def _asperities(touching: TouchHistory) -> dict[str, Any]:
    largest = int(np.argmax(touching.load_share))
    return {
        "load_share_mean": touching.mean_share,
        "load_share_mean_coarser": touching.coarser,
        "load_share_largest": touching.load_share[largest],
        "load_share_largest_time": touching.time[largest] if np.any(touching.spots) else None,
        "contact_area_share_mean": np.mean(touching.area_share[touching.counted]),
        "spots_mean": np.mean(touching.spots[touching.counted]),
        "time_share": touching.time_share,
        "steps": touching.steps,
    }


def _film(run: MotionRun) -> dict[str, Any]:
    dataset = run.dataset
    thickness, pressure = dataset["minimum_thickness"].values, dataset["max_pressure"].values
    thinnest, highest = int(np.argmin(thickness)), int(np.argmax(pressure))
    time, errors = dataset["time"].values, run_errors(run)
    return (
        {
            "before": thickness[0],
            "minimum_thickness": thickness[thinnest],
            "minimum_time": time[thinnest],
            "minimum_position": _position(run, "minimum", thinnest),
            "max_pressure": pressure[highest],
            "max_pressure_time": time[highest],
            "discretisation_error": errors and errors.largest,
            "minimum_thickness_error": errors and errors.minimum,
            "central_thickness_error": errors and errors.central,
        }
        | _supplied(run)
        | _warm(run)
    )


def _supplied(run: MotionRun) -> dict[str, Any]:
    """Layer of oil and positions of the meniscus [m]; empty for a run without a supply of oil."""
    supply = oil_supply(run.case.inlet, run.conditions)
    if supply is None or supply.layer is None:
        return {}
    layer = run.conditions.thickness_scale * float(supply.layer(np.zeros(1))[0])
    positions = run.values("meniscus")
    known = positions[np.isfinite(positions)]
    return {
        "oil_layer": layer,
        "meniscus_before": positions[0] if np.isfinite(positions[0]) else None,
        "meniscus_least": np.min(known) if known.size else None,
        "meniscus_largest": np.max(known) if known.size else None,
    }


def _warm(run: MotionRun) -> dict[str, Any]:
    """Rise of the temperature at mid-film [K]; empty for a run without heat."""
    if run.case.film is None or not run.case.film.thermal:
        return {}
    rise = run.values("temperature_rise")
    return {"temperature_rise_before": rise[0], "max_temperature_rise": np.max(rise)}


def _field(run: MotionRun) -> dict[str, Any]:
    dataset, history = run.dataset, run.field_history
    strength, time = dataset["max_strength"].values, dataset["frame_time"].values
    largest = int(np.argmax(strength))
    within = counted(run)
    maxima = local_maxima(run, within)
    capacitance = dataset["capacitance"].values[within]
    return {
        "voltage": run.case.electric.voltage,
        "before": strength[0],
        "max_strength": strength[largest],
        "max_strength_time": time[largest],
        "max_strength_position": _position(run, "max_strength", largest),
        "max_strength_error": _field_error(run),
        "max_thin_gap_strength": np.max(dataset["thin_gap_strength"].values),
        "share_above_90": history.share_near_maximum,
        "time_above_90": history.share_near_maximum * history.settled_time,
        "local_maxima": maxima.size,
        "local_maxima_quantiles": list(np.quantile(maxima, QUANTILES)) if maxima.size else None,
        "capacitance_mean": np.mean(capacitance),
        "capacitance_least": np.min(capacitance),
        "capacitance_largest": np.max(capacitance),
    }


def _position(run: MotionRun, name: str, index: int) -> float | list[float]:
    """Position at an index of the variables ``name_x`` and ``name_y`` [m]; a list in a point contact."""
    place = [float(run.dataset[f"{name}_{axis}"].values[index]) for axis in run.kind.axes]
    return place if len(place) > 1 else place[0]


def local_maxima(run: MotionRun, within: Mask) -> Array:
    """Local maxima of the field strength over position, within the Hertz zone [V/m], shape (n,).

    They are the field strengths at nodes where the field is larger than at all neighbouring nodes, from all
    recorded instants of the mask ``within``, shape (frames,).
    """
    strength = np.nan_to_num(run.dataset["strength"].values[within], nan=-np.inf)
    axes = zip(run.kind.axes, run.conditions.semi_axes, strict=True)
    places = np.meshgrid(*(run.dataset[axis].values / half for axis, half in axes), indexing="ij")
    inside = (np.hypot(*places) if len(places) > 1 else np.abs(places[0])) < 1.0
    size = (1, *(3 for _ in run.kind.axes))
    neighbours = np.ones(size, dtype=bool)
    neighbours[tuple(n // 2 for n in size)] = False
    around = scipy.ndimage.maximum_filter(strength, footprint=neighbours, mode="constant", cval=-np.inf)
    peaks: Array = strength[(strength > around) & inside]
    return peaks.astype(float)


def breakdown_voltages(run: MotionRun) -> Array | None:
    """Breakdown voltage at every recorded instant, shape (frames,) [V].

    None without a constant dielectric strength.
    """
    discharge = run.case.discharge
    if discharge is None or discharge.dielectric_strength is None:
        return None
    strength = float(dielectric_strength(discharge, np.zeros(1))[0])
    voltages: Array = strength * run.case.electric.voltage / run.values("max_strength")
    return voltages


def _discharge(run: MotionRun) -> dict[str, Any] | None:
    """Breakdown voltage over time; None without a constant dielectric strength."""
    voltages = breakdown_voltages(run)
    if voltages is None:
        return None
    voltage, dataset = run.case.electric.voltage, run.dataset
    least = int(np.argmin(voltages))
    return {
        "breakdown_voltage": voltages[least],
        "breakdown_time": dataset["frame_time"].values[least],
        "breakdown_field_error": _field_error(run),
        "breakdown_voltage_before": voltages[0],
        "breakdown_voltage_median": np.median(voltages[counted(run)]),
        "margin": voltages[least] / voltage,
    }


def coincident_instant(run: MotionRun) -> int | None:
    """Number of the recorded instant at which all roughness is at its position in the case.

    None if no instant is recorded close to this time, or the run has no stationary film to compare with.
    """
    schedule, dataset = run.schedule, run.dataset
    if "stationary_thickness" not in dataset or not np.isfinite(schedule.coincident):
        return None
    away = np.abs(dataset["frame_time"].values - schedule.coincident * schedule.time)
    nearest = int(np.argmin(away))
    return nearest if away[nearest] <= _NEAR * schedule.step * schedule.time else None


def _compared_with_stationary(run: MotionRun) -> dict[str, Any] | None:
    """Differences between moving and stationary roughness when both are in the same position.

    The nodes with abs(x) < b are compared. None if no such instant is recorded.
    """
    frame, dataset = coincident_instant(run), run.dataset
    if frame is None:
        return None
    inside = np.abs(dataset["x"].values) < run.conditions.half_width
    comparison: dict[str, Any] = {"time": dataset["frame_time"].values[frame]}
    for name, which in (("thickness", "minimum"), ("pressure", "maximum"), ("strength", "maximum")):
        moving = dataset[name].values[frame][inside].astype(float)
        stationary = dataset[f"stationary_{name}"].values[inside]
        known = np.isfinite(moving) & np.isfinite(stationary)  # the strength is NaN outside the field range
        comparison |= _compared(name, which, moving[known], stationary[known])
    return comparison


def _compared(name: str, which: str, moving: Array, stationary: Array) -> dict[str, Any]:
    """Extremes and differences of a quantity at the same nodes, by key; None if there are no nodes."""
    extreme = f"{which}_{name}"
    keys = extreme, f"{extreme}_stationary", f"{name}_rms_difference", f"{name}_largest_difference"
    if not moving.size:
        return dict.fromkeys(keys)
    reduce = np.min if which == "minimum" else np.max
    difference = np.abs(moving - stationary)
    rms = np.sqrt(np.mean(difference**2))
    return dict(zip(keys, (reduce(moving), reduce(stationary), rms, difference.max()), strict=True))
