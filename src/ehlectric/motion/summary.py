"""What a run of moving roughness says: film and field over time, and beside the same roughness held still."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.ndimage import maximum_filter

from ehlectric.arrays import Array, Mask
from ehlectric.contact.conditions import PointConditions
from ehlectric.discharge.utilisation import dielectric_strength
from ehlectric.errors import ResultWarning
from ehlectric.motion.file import motion_of
from ehlectric.motion.motion import Motion
from ehlectric.motion.record import MotionRun
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored_warnings import of_attributes, texts_and_codes

if TYPE_CHECKING:
    import xarray as xr


SCHEMA = "ehlectric.motion/1"
QUANTILES = 0.05, 0.5, 0.95

# Steps of time between an instant that is kept and the one at which all lies as the case has it, at the most.
_NEAR = 0.6


def counted(dataset: xr.Dataset) -> Mask:
    """Which instants count, shape (frames,)."""
    return np.asarray(dataset["frame_time"].values >= MotionRun.of(dataset).settled_from)


def summary_of(dataset: xr.Dataset) -> dict[str, Any]:
    """Numbers of a run, nested as summary.json, SI units.

    Parameters
    ----------
    dataset : xarray.Dataset
        As ``read_motion`` gives it.

    Returns
    -------
    dict
        Statistics over time are of the instants since the roughness has filled the Hertz zone, where it does.
    """
    motion, attributes = motion_of(dataset), dataset.attrs
    complete = bool(attributes["complete"])
    found = {
        "schema": SCHEMA,
        "version": str(attributes["version"]),
        "title": motion.case.title,
        "converged": complete,
        **texts_and_codes([*of_attributes(attributes), *_halved(dataset)]),
        "inputs": motion.case.to_dict(),
        "motion": _course(motion, dataset),
        "film": _film(dataset),
        "field": _field(motion, dataset),
        "discharge": _discharge(motion, dataset),
        "stationary": json.loads(attributes["stationary"]),
        "beside_stationary": _beside(motion, dataset),
        "rough": json.loads(attributes["rough"]),
        "seconds": float(attributes["seconds"]),
    }
    summary: dict[str, Any] = plain(found)
    return summary


def _halved(dataset: xr.Dataset) -> Iterator[ResultWarning]:
    halvings = dataset["halvings"].values
    if np.any(halvings):
        yield ResultWarning(
            "steps-halved",
            f"{np.count_nonzero(halvings)} time steps had to be halved, {int(halvings.sum())} times in all; "
            "more motion.steps or a finer grid may be worth while",
        )


def _course(motion: Motion, dataset: xr.Dataset) -> dict[str, Any]:
    steps = dataset.sizes["step"] - 1
    return motion.described() | {
        "steps_done": steps,
        "frames": dataset.sizes["frame"],
        "newton_per_step": float(dataset["newton_iterations"].values.sum()) / max(steps, 1),
        "krylov_per_step": float(dataset["krylov_iterations"].values.sum()) / max(steps, 1),
        "halvings": int(dataset["halvings"].values.sum()),
    }


def _film(dataset: xr.Dataset) -> dict[str, Any]:
    thickness, pressure = dataset["minimum_thickness"].values, dataset["max_pressure"].values
    thinnest, highest = int(np.argmin(thickness)), int(np.argmax(pressure))
    time = dataset["time"].values
    place = [float(dataset[name].values[thinnest]) for name in ("minimum_x", "minimum_y") if name in dataset]
    return {
        "before": thickness[0],
        "minimum_thickness": thickness[thinnest],
        "minimum_time": time[thinnest],
        "minimum_position": place if len(place) > 1 else place[0],
        "max_pressure": pressure[highest],
        "max_pressure_time": time[highest],
    }


def _field(motion: Motion, dataset: xr.Dataset) -> dict[str, Any]:
    strength, time = dataset["max_strength"].values, dataset["frame_time"].values
    largest = int(np.argmax(strength))
    names = [name for name in ("max_strength_x", "max_strength_y") if name in dataset]
    place = [float(dataset[name].values[largest]) for name in names]
    within = counted(dataset)
    maxima = local_maxima(dataset, within)
    capacitance = dataset["capacitance"].values[within]
    run = MotionRun.of(dataset)
    return {
        "voltage": motion.case.electric.voltage,
        "before": strength[0],
        "max_strength": strength[largest],
        "max_strength_time": time[largest],
        "max_strength_position": place if len(place) > 1 else place[0],
        "max_thin_gap_strength": np.max(dataset["thin_gap_strength"].values),
        "share_above_90": run.share_high,
        "time_above_90": run.share_high * run.settled_time,
        "local_maxima": maxima.size,
        "local_maxima_quantiles": list(np.quantile(maxima, QUANTILES)) if maxima.size else None,
        "capacitance_mean": np.mean(capacitance),
        "capacitance_least": np.min(capacitance),
        "capacitance_largest": np.max(capacitance),
    }


def local_maxima(dataset: xr.Dataset, within: Mask) -> Array:
    """Field strengths that are larger than those at all nodes beside, within the Hertz zone [V/m].

    Parameters
    ----------
    dataset : xarray.Dataset
        Of a run.
    within : ndarray of bool, shape (frames,)
        Which instants count.

    Returns
    -------
    ndarray, shape (n,)
        Of all those instants together.
    """
    given = MotionRun.of(dataset).conditions
    strength = np.nan_to_num(dataset["strength"].values[within], nan=-np.inf)
    x = dataset["x"].values
    if isinstance(given, PointConditions):
        inside = np.hypot(x[:, np.newaxis] / given.semi_axis_x, dataset["y"].values / given.semi_axis_y) < 1.0
        size: tuple[int, ...] = (1, 3, 3)
    else:
        inside, size = np.abs(x) < given.half_width, (1, 3)
    neighbours = np.ones(size, dtype=bool)
    neighbours[tuple(n // 2 for n in size)] = False
    beside = maximum_filter(strength, footprint=neighbours, mode="constant", cval=-np.inf)
    peaks: Array = strength[(strength > beside) & inside]
    return peaks.astype(float)


def _discharge(motion: Motion, dataset: xr.Dataset) -> dict[str, Any] | None:
    """Least breakdown voltage over time, by a strength that is the same everywhere."""
    discharge = motion.case.discharge
    if discharge is None or discharge.dielectric_strength is None:
        return None
    voltage = motion.case.electric.voltage
    strength = float(dielectric_strength(discharge, np.zeros(1))[0])
    voltages = strength * voltage / dataset["max_strength"].values
    least = int(np.argmin(voltages))
    return {
        "breakdown_voltage": voltages[least],
        "breakdown_time": dataset["frame_time"].values[least],
        "breakdown_voltage_before": voltages[0],
        "breakdown_voltage_median": np.median(voltages[counted(dataset)]),
        "margin": voltages[least] / voltage,
    }


def instant_beside(motion: Motion, dataset: xr.Dataset) -> int | None:
    """Number of the instant at which all lies as the case has it, None where none was kept near it."""
    if "stationary_thickness" not in dataset or not np.isfinite(motion.coincident):
        return None
    away = np.abs(dataset["frame_time"].values - motion.coincident * motion.course.time)
    nearest = int(np.argmin(away))
    return nearest if away[nearest] <= _NEAR * motion.course.step * motion.course.time else None


def _beside(motion: Motion, dataset: xr.Dataset) -> dict[str, Any] | None:
    """The moving roughness over the same held still, where both lie alike, within the Hertz zone."""
    frame = instant_beside(motion, dataset)
    if frame is None:
        return None
    inside = np.abs(dataset["x"].values) < motion.half_width
    found: dict[str, Any] = {"time": dataset["frame_time"].values[frame]}
    for name, which in (("thickness", "minimum"), ("pressure", "maximum"), ("strength", "maximum")):
        moving = dataset[name].values[frame][inside].astype(float)
        still = dataset[f"stationary_{name}"].values[inside]
        known = np.isfinite(moving) & np.isfinite(still)  # no strength outside the field range
        found |= _compared(name, which, moving[known], still[known])
    return found


def _compared(name: str, which: str, moving: Array, still: Array) -> dict[str, Any]:
    """Extremes and differences of the values at the same nodes, None where there are none."""
    extreme = f"{which}_{name}"
    keys = extreme, f"{extreme}_stationary", f"{name}_rms_difference", f"{name}_largest_difference"
    if not moving.size:
        return dict.fromkeys(keys)
    reduce = np.min if which == "minimum" else np.max
    away = np.abs(moving - still)
    return dict(
        zip(keys, (reduce(moving), reduce(still), np.sqrt(np.mean(away**2)), away.max()), strict=True)
    )
