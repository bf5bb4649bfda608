"""Stored run of a transient contact: its case, values over time steps, instants and nodes, and its largest
fields.
"""

from __future__ import annotations

from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
import tomli

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.contact import Conditions, PointConditions, surface_ratios
from ehlectric.errors import InputError, WriteError
from ehlectric.motion.moving_contact import KINDS, Kind, Schedule, schedule_of
from ehlectric.motion.stored import FORM, SCHEMA, attributes_in, layout_of, solved_part
from ehlectric.runtime.display import ResultKind, Values, read_only_property
from ehlectric.runtime.file_rules import check_format, refusing
from ehlectric.runtime.files import write
from ehlectric.runtime.folders import locked
from ehlectric.runtime.journal import begun, lock_of, reading
from ehlectric.runtime.netcdf import content_of, opened, read_dataset
from ehlectric.runtime.result_names import MOTION, MOTION_CHANGES, MOTION_JOURNAL

if TYPE_CHECKING:
    import xarray as xr


# The field counts as near its maximum if it is above this fraction of its largest value over time.
NEAR_MAXIMUM = 0.9


@dataclass(frozen=True)
class FieldHistory:
    """Largest field strength at every time step."""

    time: Array  # [s], shape (steps,)
    strength: Array  # largest field strength at the steps [V/m], shape (steps,)
    settled_from: float  # time at which the statistics begin [s]

    @read_only_property
    def _settled(self) -> Mask:
        """Mask of the steps that count for statistics, shape (steps,)."""
        return np.asarray(self.time >= self.settled_from)

    @property
    def settled_time(self) -> float:
        """Duration of the steps that count for statistics [s]."""
        return float(np.ptp(self.time[self._settled]))

    @property
    def near_maximum(self) -> float:
        """Field strength above which the field counts as near its maximum [V/m]."""
        return NEAR_MAXIMUM * float(np.max(self.strength[self._settled]))

    @property
    def share_near_maximum(self) -> float:
        """Share of the settled time in which the field is near its maximum, dimensionless.

        It is computed from all time steps, because an asperity may pass between two recorded instants.
        """
        return time_above(self.time[self._settled], self.strength[self._settled], self.near_maximum)


def strength_between(time: Array, estimate: Array, frame_time: Array, strength: Array) -> Array:
    """Largest field strength at every time step, interpolated between the recorded instants.

    The largest field strength is the voltage divided by the minimum film thickness, times a ratio that
    changes little with time. The ratio is interpolated between the recorded instants.

    The arguments over the time steps are their times [s] and the ``estimate``, voltage divided by minimum
    film thickness [V/m], shape (steps,). Those over the recorded instants are their times [s] and the largest
    field ``strength`` [V/m], shape (frames,). Returns field strength of shape (steps,).

    Examples
    --------
    >>> time, estimate = np.array([0.0, 1.0, 2.0]), np.array([1.0, 2.0, 1.0])
    >>> strength_between(time, estimate, time[::2], np.array([1.1, 1.3]))
    array([1.1, 2.4, 1.3])
    """
    ratio = strength / np.interp(frame_time, time, estimate)
    return np.asarray(estimate * np.interp(time, frame_time, ratio))


def intervals_above(time: Array, values: Array, level: float) -> Array:
    """Start and end of each interval of time in which values are above a level, shape (m, 2).

    The times ascend, shape (n,), and the ``values`` are linear between them, shape (n,).

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
    """Share of the time in which values are above a level, from 0 to 1; for a single instant 0 or 1.

    The times ascend, shape (n,), and the ``values`` are linear between them, shape (n,).

    Examples
    --------
    >>> round(time_above(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]), 0.75), 9)
    0.25
    """
    if time.size < 2:
        return float(values[0] > level)
    return float(np.sum(np.diff(intervals_above(time, values, level))) / np.ptp(time))


_NEEDED = (
    "time",
    "minimum_thickness",
    "thin_gap_strength",
    "frame_time",
    "thickness",
    "pressure",
    "strength",
)


def read_motion(path: str | Path) -> xr.Dataset:
    """Read a transient run, complete or not.

    A run that goes on, or was killed, is read from its journal, motion.sqlite. If it was killed, motion.nc is
    written then.

    Parameters
    ----------
    path : str or Path
        File motion.nc, or the folder with this file or the journal.

    Returns
    -------
    xarray.Dataset
        Values in SI units. The dimension ``step`` counts time steps, ``frame`` counts recorded instants.

    Raises
    ------
    InputError
        If the file cannot be read, has no transient run, or is of a later version.
    DamagedError
        If it is damaged.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.Case.from_toml(ehlectric.example("moving_roughness.toml"))
    >>> case = case.replace({"grid.nodes": 401, "motion.passes": 0.05, "motion.steps": 4, "motion.record": 4})
    >>> with TemporaryDirectory() as folder:
    ...     run = ehlectric.read_motion(ehlectric.run_motion(case, folder)).load()
    >>> run.sizes["x"]
    401
    """
    path = Path(path)
    path = path / MOTION if path.is_dir() else path
    journal = path.with_name(MOTION_JOURNAL)
    if path.name == MOTION and not path.is_file() and begun(journal):
        try:
            return _from_journal(journal, path)
        except InputError:
            if not path.is_file():  # otherwise the run has ended in the meantime
                raise
    return checked_motion(read_dataset(path), path)


def _from_journal(journal: Path, path: Path) -> xr.Dataset:
    """Run from its journal. If no process writes to the journal, also write motion.nc."""
    with ExitStack() as stack:
        try:
            stack.enter_context(locked(journal.parent, lock_of(journal)))
            alone = True
        except InputError:  # the run goes on, or the folder is not writable
            alone = False
        with reading(journal, FORM, checked=True) as file:
            layout = layout_of(file)
            dataset = checked_motion(layout.dataset(), journal)
            if alone:
                with suppress(WriteError):  # the disk may be full, or not be writable
                    write(path, content_of(layout))
    return dataset


def checked_motion(dataset: xr.Dataset, path: Path) -> xr.Dataset:
    """Check a dataset read from a file, and return its solved part, as ``read_motion`` does."""
    check_format(dataset.attrs, SCHEMA, path, "a run with moving roughness")
    if path.with_name(MOTION_CHANGES).is_file():
        text = "has changes that a kill of version 1.0.0 left unfinished"
        raise InputError(path, text, takes="that version to read it, or the case solved again")
    with refusing(path):
        return solved_part(dataset)


def is_stored(folder: Path) -> bool:
    """Whether a folder has a run with moving roughness, complete or not."""
    return (folder / MOTION).is_file() or begun(folder / MOTION_JOURNAL)


def saved_run(folder: Path) -> tuple[int, str]:
    """Number of the last recorded time step in a folder, and the case as TOML; 0 and "" if it has none, or
    the run cannot be read.
    """
    try:
        if begun(journal := folder / MOTION_JOURNAL):
            with reading(journal, FORM) as rows:
                (step,) = rows.execute("SELECT max(step) FROM instants").fetchone()
                return int(step), attributes_in(rows)["case"]
        with opened(folder / MOTION) as file:
            step = file.variables["frame_step"][: int(file.attrs["frames"])][-1]
            return int(step), str(file.attrs["case"])
    except (OSError, LookupError, ValueError, RuntimeError):
        return 0, ""


def refuse_other_case(folder: Path, case: Case | None) -> None:
    """Refuse a folder with recorded steps of another case, as their computation may have taken hours.

    ``case`` is a case with moving roughness, or None for any other run. Raises InputError.
    """
    steps, saved_case = saved_run(folder)
    if steps and not (case is not None and saved_case == case.to_toml()):
        names = [name for name in (MOTION, MOTION_JOURNAL) if (folder / name).is_file()]
        raise InputError(
            folder,
            f"has {steps} saved steps of another case with moving roughness",
            takes=f"another folder, as with -o; or remove {' and '.join(names)} from this one",
        )


@dataclass(frozen=True, eq=False, repr=False)
class MotionRun(Values):
    """Stored run of a contact with moving roughness, SI units.

    Attributes
    ----------
    dataset : xarray.Dataset
        Values at the solved time steps and recorded instants.
    case : Case
        Case of the run.
    conditions : Conditions or PointConditions
        Operating conditions of the case.
    """

    result_kind: ClassVar[ResultKind] = "motion"

    dataset: xr.Dataset
    case: Case
    conditions: Conditions | PointConditions

    @classmethod
    def of(cls, dataset: xr.Dataset) -> Self:
        """Run from a dataset, without steps and instants that are not solved yet.

        Surface files are not read.

        Parameters
        ----------
        dataset : xarray.Dataset
            Dataset from ``read_motion``.

        Returns
        -------
        MotionRun
            Run with the solved steps and recorded instants.

        Raises
        ------
        InputError
            If the dataset is not a transient run, or has no recorded instant.
        """
        missing = [name for name in _NEEDED if name not in dataset]
        if missing or "case" not in dataset.attrs:
            name = missing[0] if missing else "case"
            raise InputError("dataset", got=f"one without {name!r}", takes="the dataset of moving roughness")
        case = Case.from_dict(tomli.loads(dataset.attrs["case"]))
        solved = {
            "step": np.isfinite(dataset["time"].values),
            "frame": np.isfinite(dataset["frame_time"].values),
        }
        selection = {name: np.flatnonzero(mask) for name, mask in solved.items() if not np.all(mask)}
        selected = dataset.isel(selection) if selection else dataset
        if not selected.sizes["frame"]:
            raise InputError("dataset", got="no recorded instant", takes="one at least")
        return cls(selected, case, KINDS[case.contact.geometry].contact.resolve(case))

    @property
    def kind(self) -> Kind:
        """Functions for this kind of contact, line or point."""
        return KINDS[self.case.contact.geometry]

    @read_only_property
    def schedule(self) -> Schedule:
        """Time steps and speeds of the surfaces."""
        return schedule_of(self.case, self.conditions)

    @property
    def complete(self) -> bool:
        """Whether all time steps of the run are solved."""
        return bool(self.dataset.attrs.get("complete", 1))

    @read_only_property
    def speeds(self) -> dict[int, float]:
        """Speed of each rough surface by its number, 1 or 2 [m/s]."""
        mean, ratios = self.conditions.entrainment_speed, surface_ratios(self.conditions.slide_to_roll_ratio)
        return {k: mean * ratios[k - 1] for k in sorted({table.surface for table in self.case.roughness})}

    @read_only_property
    def x(self) -> Array:
        """Positions of the nodes of the film along entrainment, shape (nx,) [half-widths]."""
        return np.asarray(self.dataset["x"].values / self.conditions.half_width)

    @read_only_property
    def frame_time(self) -> Array:
        """Times of the recorded instants, shape (frames,) [s]."""
        return self.values("frame_time")

    @property
    def frames(self) -> int:
        """Number of recorded instants."""
        return int(self.dataset.sizes["frame"])

    def values(self, name: str) -> Array:
        """Values of a variable of the dataset as floats."""
        return np.asarray(self.dataset[name].values, dtype=float)

    def moment(self, name: str) -> float:
        """Time ``covered_from`` or ``coincident`` [s]; NaN if the run does not reach it."""
        return float(self.dataset.attrs.get(name, np.nan))

    def along(self, name: str, frame: int | None = None) -> Array:
        """Values of a map along entrainment; in a point contact, on the line of nodes nearest to y = 0.

        Parameters
        ----------
        name : str
            Name of a variable that has values at the nodes of the film.
        frame : int, optional
            Number of a recorded instant; by default all recorded instants.

        Returns
        -------
        ndarray, shape (frames, nx) or (nx,)
            Values in SI units.
        """
        values = self.dataset[name]
        if "y" in values.dims:
            values = values.isel(y=int(np.argmin(np.abs(self.values("y")))))
        if frame is not None:
            values = values.isel(frame=frame)
        return np.asarray(values.values, dtype=float)

    @read_only_property
    def field_history(self) -> FieldHistory:
        """Largest field strength at every time step."""
        time, estimate = self.values("time"), self.values("thin_gap_strength")
        strength = strength_between(time, estimate, self.frame_time, self.values("max_strength"))
        return FieldHistory(time, strength, settled_from(self))


def settled_from(run: MotionRun) -> float:
    """Time at which the statistics of a run begin [s]: the time at which the roughness fills the contact.

    It is 0 if the roughness never fills the contact, or if fewer than two instants are recorded afterwards.
    """
    covered = run.moment("covered_from")
    return covered if np.count_nonzero(run.frame_time >= covered) > 1 else 0.0


def coincident_frame(run: MotionRun) -> int | None:
    """Number of the recorded instant at which the surfaces are nearest to their positions in the case.

    None if the run does not reach the time of these positions, or has no stationary film to compare with.
    """
    time, at = run.frame_time, run.moment("coincident")
    if "stationary_thickness" not in run.dataset or not time[0] <= at <= time[-1]:
        return None
    return int(np.argmin(np.abs(time - at)))
