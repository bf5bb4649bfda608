"""A run of roughness that moves as it was stored: what there is of it at steps, instants and nodes."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.contact.bodies import surface_ratios
from ehlectric.contact.conditions import Conditions, PointConditions, resolve, resolve_point
from ehlectric.errors import InputError
from ehlectric.runtime.netcdf import opened

if TYPE_CHECKING:
    import xarray as xr


MOTION = "motion.nc"
_NEEDED = (
    "time",
    "minimum_thickness",
    "thin_gap_strength",
    "frame_time",
    "thickness",
    "pressure",
    "strength",
)

# Part of the largest field above which the time counts.
HIGH_FIELD = 0.9


def read_motion(path: str | Path) -> xr.Dataset:
    """The dataset of a run.

    Parameters
    ----------
    path : str or Path
        A motion.nc, or the folder it lies in.

    Returns
    -------
    xarray.Dataset
        Over ``step`` all time steps, over ``frame`` the instants that were kept; SI units.

    Raises
    ------
    InputError
        Where it cannot be read, or is none of a run.
    """
    import xarray as xr

    path = Path(path)
    path = path / MOTION if path.is_dir() else path
    try:
        path.open("rb").close()
    except OSError as error:
        raise InputError(path, f"cannot be read, {(error.strerror or str(error)).lower()}") from None
    damaged = InputError(path, "is no motion of ehlectric, or damaged")
    try:
        with opened(path, "r") as file:
            dataset = xr.open_dataset(xr.backends.H5NetCDFStore(file)).load()
    except InputError:
        raise
    except Exception:  # whatever HDF5 and its wrappers raise at damaged files
        raise damaged from None
    try:
        Case.from_dict(tomllib.loads(dataset.attrs["case"]))
        frames = int(dataset.attrs["frames"])
        last = int(dataset["frame_step"].values[:frames][-1])
    except (LookupError, TypeError, ValueError):
        raise damaged from None
    return dataset.isel(frame=slice(0, frames), step=slice(0, last + 1))


def saved_steps(path: Path) -> int:
    """Steps that a file of a run has, 0 where it has none or cannot be read."""
    try:
        with opened(path, "r") as file:
            return int(file.variables["frame_step"][: int(file.attrs["frames"])][-1])
    except (OSError, LookupError, ValueError, RuntimeError):
        return 0


@dataclass(frozen=True)
class MotionRun:
    """What was stored of a contact whose roughness moves, SI units.

    Attributes
    ----------
    dataset : xarray.Dataset
        Its steps and recorded instants, those that there are.
    case : Case
        What was solved.
    conditions : Conditions or PointConditions
        What the case means.
    """

    dataset: xr.Dataset
    case: Case
    conditions: Conditions | PointConditions

    @classmethod
    def of(cls, dataset: xr.Dataset) -> MotionRun:
        """The run that a dataset holds; steps and instants still without a time are left out.

        Parameters
        ----------
        dataset : xarray.Dataset
            As a run was stored.

        Raises
        ------
        InputError
            Where it is none.
        """
        missing = [name for name in _NEEDED if name not in dataset]
        if missing or "case" not in dataset.attrs:
            lacks = missing[0] if missing else "case"
            raise InputError("dataset", got=f"one without {lacks!r}", takes="that of roughness that moves")
        case = Case.from_dict(tomllib.loads(dataset.attrs["case"]))
        point = case.contact.geometry == "point"
        there = {
            "step": np.isfinite(dataset["time"].values),
            "frame": np.isfinite(dataset["frame_time"].values),
        }
        left = {name: np.flatnonzero(mask) for name, mask in there.items() if not np.all(mask)}
        kept = dataset.isel(left) if left else dataset
        if not kept.sizes["frame"]:
            raise InputError("dataset", got="no recorded instant", takes="one at least")
        return cls(kept, case, resolve_point(case) if point else resolve(case))

    @property
    def point(self) -> bool:
        """Whether it is a point contact."""
        return isinstance(self.conditions, PointConditions)

    @property
    def complete(self) -> bool:
        """Whether it went to its end."""
        return bool(self.dataset.attrs.get("complete", 1))

    @cached_property
    def speeds(self) -> dict[int, float]:
        """Speed of each surface that is rough [m/s], by its number."""
        mean, ratios = self.conditions.entrainment_speed, surface_ratios(self.conditions.slide_to_roll_ratio)
        return {k: mean * ratios[k - 1] for k in sorted({surface.surface for surface in self.case.roughness})}

    @cached_property
    def x(self) -> Array:
        """Nodes of the film in half-widths, shape (nx,)."""
        return np.asarray(self.dataset["x"].values / self.conditions.half_width)

    @cached_property
    def frame_time(self) -> Array:
        """Times of the recorded instants [s], shape (frames,)."""
        return self.values("frame_time")

    @property
    def frames(self) -> int:
        """Number of recorded instants."""
        return int(self.dataset.sizes["frame"])

    def moment(self, name: str) -> float:
        """A time among the attributes [s], not a number where it never comes."""
        return float(self.dataset.attrs.get(name, np.nan))

    def values(self, name: str) -> Array:
        """All values of a variable as floats."""
        return np.asarray(self.dataset[name].values, dtype=float)

    def along(self, name: str, frame: int | None = None) -> Array:
        """A variable along entrainment, of a point contact on the line of nodes nearest to y = 0.

        Parameters
        ----------
        name : str
            One with values at the nodes of the film.
        frame : int, optional
            Of this recorded instant; of all there are otherwise.

        Returns
        -------
        ndarray, shape (frames, nx) or (nx,)
        """
        values = self.dataset[name]
        if self.point:
            values = values.isel(y=int(np.argmin(np.abs(self.values("y")))))
        if frame is not None:
            values = values.isel(frame=frame)
        return np.asarray(values.values, dtype=float)

    @cached_property
    def strength(self) -> Array:
        """Largest field at every step [V/m], shape (steps,).

        That which was solved at the recorded instants; between them it goes as the voltage over the least
        film does, of which it is a multiple that hardly changes.
        """
        time, estimate = self.values("time"), self.values("thin_gap_strength")
        share = self.values("max_strength") / np.interp(self.frame_time, time, estimate)
        return np.asarray(estimate * np.interp(time, self.frame_time, share))

    @cached_property
    def settled_from(self) -> float:
        """From when on instants count [s]: since the roughness has filled the contact, or from the first.

        Where fewer than two instants are kept since then, all of them count.
        """
        covered = self.moment("covered_from")
        return covered if np.count_nonzero(self.frame_time >= covered) > 1 else 0.0

    @cached_property
    def _settled(self) -> Mask:
        """Which steps count, shape (steps,)."""
        return np.asarray(self.values("time") >= self.settled_from)

    @property
    def settled_time(self) -> float:
        """How long the steps that count last [s]."""
        return float(np.ptp(self.values("time")[self._settled]))

    @property
    def high_field(self) -> float:
        """Field strength above which the film is near its breakdown [V/m], of what counts."""
        return HIGH_FIELD * float(np.max(self.strength[self._settled]))

    @property
    def share_high(self) -> float:
        """Part of the time that counts in which the field is high.

        Of all steps, not of the instants alone, between which an asperity may have passed.
        """
        return time_above(self.values("time")[self._settled], self.strength[self._settled], self.high_field)

    @cached_property
    def coincident_frame(self) -> int | None:
        """The recorded instant nearest to that at which the surfaces lie as the case has them.

        None where that time is not in the run, or nothing is there to compare with.
        """
        time, at = self.frame_time, self.moment("coincident")
        if "stationary_thickness" not in self.dataset or not time[0] <= at <= time[-1]:
            return None
        return int(np.argmin(np.abs(time - at)))


def intervals_above(time: Array, values: Array, level: float) -> Array:
    """When values are above a level.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        Linear in between.
    level : float
        In the unit of the values.

    Returns
    -------
    ndarray, shape (m, 2)
        Starts and ends.

    Examples
    --------
    >>> intervals_above(np.arange(5.0), np.array([2.0, 0.0, 2.0, 0.0, 0.0]), 1.0)
    array([[0. , 0.5],
           [1.5, 2.5]])
    """
    above = values > level
    before = np.flatnonzero(above[1:] != above[:-1])
    share = (level - values[before]) / (values[before + 1] - values[before])
    crossings = time[before] + share * (time[before + 1] - time[before])
    ends = [time[:1]] if above[0] else []
    ends.append(crossings)
    ends += [time[-1:]] if above[-1] else []
    intervals: Array = np.concatenate(ends).reshape(-1, 2)
    return intervals


def time_above(time: Array, values: Array, level: float) -> float:
    """Part of the time in which a value, linear between its instants, is above a level.

    Examples
    --------
    >>> round(time_above(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]), 0.75), 9)
    0.25
    """
    if time.size < 2:
        return float(values[0] > level)
    return float(np.sum(np.diff(intervals_above(time, values, level))) / np.ptp(time))
