"""Point contacts with a moving rough surface, solved in time steps: means over time of what touches.

A ball rolls over a flat with a generated Gaussian surface, which moves through the contact. Load share, area
and spots of each time step are averaged from the step on at which the roughness fills the Hertz zone. The
means are kept in benchmarks/data/asperity_models.csv; ``benchmarks.asperity_models`` compares them with
statistical models.
"""

from __future__ import annotations

import csv
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from tests.helpers.mixed_films import at_film, gaussian, rough_point

from ehlectric import Case
from ehlectric.arrays import Array
from ehlectric.contact.preparation import prepare
from ehlectric.contact.touching import hertz_weights, load_share_of, spots_of, weighted_rms
from ehlectric.errors import ConvergenceError
from ehlectric.film.isothermal_film import PointFilm
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.solver import TransientSolver

DATA = Path(__file__).parent / "data" / "asperity_models.csv"

# Rq of the generated surface [m].
RQ = 100e-9

# Length of the domain [semi-axes]; time is counted in passages of the Hertz zone, two semi-axes.
_LENGTH = 4.0


@dataclass(frozen=True)
class Posed:
    """A contact to solve.

    Attributes
    ----------
    correlation_length : float
        Correlation length of the surface [um].
    nodes : int
        Nodes along each axis.
    slide_to_roll_ratio : float
        Sliding speed over the entrainment speed; positive where the rough surface is the faster one.
    film : float
        Central film of smooth surfaces by the formula over the Rq, which sets the speed.
    passages : int
        Times that oil passes through the Hertz zone while the means are taken.
    """

    correlation_length: float
    nodes: int
    slide_to_roll_ratio: float
    film: float
    passages: int

    @property
    def case(self) -> Case:
        """Case of the contact."""
        case = rough_point(
            gaussian(RQ, 1e-6 * self.correlation_length),
            nodes=self.nodes,
            slide_to_roll_ratio=self.slide_to_roll_ratio,
        )
        # The roughness is in the whole zone after 4.5 semi-axes of its own way, see ``Schedule.covered``.
        way = 4.5 / (1.0 + 0.5 * self.slide_to_roll_ratio) + 2.0 * self.passages
        moving: Case = at_film(case, self.film * RQ).replace({"motion": {"passes": way / _LENGTH}})
        return moving


# Thinner films of the short waves take more than two seconds of processor time a step.
POSED = (
    *(Posed(30.0, 65, 0.0, film, 6) for film in (3.0, 2.0, 1.5, 1.0, 0.7, 0.5, 0.35)),
    *(Posed(30.0, 129, 0.0, film, 3) for film in (1.0, 0.5, 0.35)),
    *(Posed(15.0, 129, 0.0, film, 3) for film in (1.5, 1.0)),
    Posed(30.0, 65, 1.0, 0.5, 6),
)


@dataclass(frozen=True, kw_only=True)
class Solved:
    """Means over time of a solved contact; the first five attributes are those of ``Posed``.

    Attributes
    ----------
    speed : float
        Entrainment speed [m/s].
    steps, done : int
        Time steps over which the means are to be taken, and those that were solved.
    mean_film, rq_deformed : float
        Mean film of the Hertz zone, and root mean square of the film less that of smooth surfaces [nm].
    load_share, area_share : float
        Load of the asperities over the load, and the part of the Hertz zone that touches.
    load_share_error : float
        Standard error of the mean load share, from the means of single passages.
    spots : float
        Mean number of spots.
    time_share : float
        Share of the time steps with at least one spot.
    seconds : float
        Processor time of the run [s].
    failure : str
        Reason why the run ended early; empty if it did not.
    """

    correlation_length: float
    nodes: int
    slide_to_roll_ratio: float
    film: float
    passages: int
    speed: float
    steps: int
    done: int
    mean_film: float
    rq_deformed: float
    load_share: float
    load_share_error: float
    area_share: float
    spots: float
    time_share: float
    seconds: float
    failure: str = ""

    @property
    def posed(self) -> Posed:
        """The contact that was solved."""
        return Posed(*(getattr(self, field.name) for field in fields(Posed)))


def standard_error(values: Array, batches: int) -> float:
    """Standard error of the mean of a series whose neighbours depend on each other, from means of batches.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Values at equal steps of time.
    batches : int
        Number of batches, longer than the time over which values depend on each other.

    Returns
    -------
    float
        Standard deviation of the means of the batches over the root of their number; nan for one batch.
    """
    means = [float(np.mean(batch)) for batch in np.array_split(values, batches) if batch.size]
    return float(np.std(means, ddof=1) / np.sqrt(len(means))) if len(means) > 1 else float("nan")


def solved(posed: Posed) -> Solved:
    """Means over time of a contact, over the steps before a failure if there is one."""
    started, case = time.process_time(), posed.case
    prepared = prepare(case)
    contact = TransientContact.of(case, prepared.rough)
    solver, schedule = TransientSolver(contact), contact.schedule
    first = int(np.ceil(schedule.covered / schedule.step - 1e-9))
    history = solver.start()
    smooth = solver.film(history.now).thickness
    rows, failure = list[tuple[float, ...]](), ""
    try:
        for step, latest in solver.run(history):
            if step > first:
                film = solver.film(latest.now)
                assert isinstance(film, PointFilm)
                rows.append(_instant(contact, film, smooth))
            if step % 20 == 0:
                seconds = time.process_time() - started
                print(f"{posed}: {step} of {schedule.steps}, {seconds:.0f} s", file=sys.stderr, flush=True)
    except ConvergenceError as error:
        failure = str(error)
    series = np.array(rows).reshape(-1, 5)
    means = series.mean(axis=0) if rows else np.full(5, np.nan)
    return Solved(
        **vars(posed),
        speed=float(contact.conditions.entrainment_speed),
        steps=schedule.steps - first,
        done=len(rows),
        mean_film=1e9 * means[0],
        rq_deformed=1e9 * means[1],
        load_share=means[2],
        load_share_error=standard_error(series[:, 2], posed.passages),
        area_share=means[3],
        spots=means[4],
        time_share=float(np.mean(series[:, 4] > 0.0)) if rows else float("nan"),
        seconds=time.process_time() - started,
        failure=failure,
    )


def _instant(contact: TransientContact, film: PointFilm, smooth: Array) -> tuple[float, ...]:
    """Mean film, deformed roughness, load share, area share and number of spots at an instant."""
    zone, spots = hertz_weights(film, contact.conditions.semi_axes), spots_of(film)
    whole = float(np.sum(zone))
    return (
        float(np.vdot(zone, film.thickness)) / whole,
        weighted_rms(film.thickness - smooth, zone),
        load_share_of(contact.conditions, spots),
        float(np.sum(zone[film.contact])) / whole,
        float(spots.number),
    )


def stored() -> list[Solved]:
    """Solved contacts of the data file, in the order of ``POSED``."""
    if not DATA.is_file():
        return []
    with DATA.open(newline="", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    rows = [_read(row) for row in csv.DictReader(lines)]
    return sorted(rows, key=lambda row: POSED.index(row.posed))


def _read(row: dict[str, str]) -> Solved:
    kinds: dict[str, Callable[[str], Any]] = {"int": int, "float": float, "str": str}
    return Solved(**{field.name: kinds[str(field.type)](row[field.name]) for field in fields(Solved)})


def store(row: Solved) -> None:
    """Append a contact to the data file, which begins with how it was made."""
    new = not DATA.is_file()
    with DATA.open("a", newline="", encoding="utf-8") as file:
        if new:
            file.write("# Made by: python -m benchmarks.asperity_models --solve\n")
            file.write("# The columns are the attributes of Solved in benchmarks/moving_asperities.py.\n")
            csv.writer(file, lineterminator="\n").writerow(field.name for field in fields(Solved))
        values = [getattr(row, field.name) for field in fields(Solved)]
        cells = [f"{value:.6g}" if isinstance(value, float) else value for value in values]
        csv.writer(file, lineterminator="\n").writerow(cells)
