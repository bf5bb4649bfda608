"""Solved films whose surfaces may touch: their key figures, kept in benchmarks/data/mixed.jsonl.

One line of the file is one film. It is solved again only if its contact is not there, or if told to, so that
the tables and the figure of ``benchmarks.mixed`` come from the file in seconds.
"""

from __future__ import annotations

import json
import platform
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from tests.helpers.mixed_films import MixedFilm, at_film, mixed_film, rough_line, rough_point

from benchmarks.measure import ROOT, processor
from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric import Case
from ehlectric.contact.preparation import prepare
from ehlectric.contact.problems import spacings_of
from ehlectric.contact.touching import weighted_percentiles

DATA = Path(__file__).parent / "data" / "mixed.jsonl"

Record = dict[str, Any]

BOUNDARY_FILM = 1e-9

# Nodes along each axis of contacts of a ball.
POINT_GRIDS = (65, 129, 257)


@dataclass(frozen=True)
class Contact:
    """Rough contact that is to be solved.

    Attributes
    ----------
    name : str
        Name of the surface.
    point : bool
        Whether a ball touches, or a roller.
    table : dict
        ``[[roughness]]`` table of the surface.
    nodes : int
        Nodes along entrainment.
    ratio : float
        Central film of the formula for smooth surfaces over the Rq of the Hertz zone.
    boundary_film : float
        Gap at which the surfaces touch [m].
    """

    name: str
    point: bool
    table: dict[str, Any]
    nodes: int
    ratio: float
    boundary_film: float = BOUNDARY_FILM

    @property
    def key(self) -> str:
        """What tells this contact from all others."""
        table = {k: Path(v).name if k == "file" else v for k, v in self.table.items()}
        what = [self.point, self.nodes, float(f"{self.ratio:.6g}"), self.boundary_film, table]
        return json.dumps(what, sort_keys=True)

    @property
    def shortest_wave(self) -> float | None:
        """Shortest wave of the surface [m]; None for a measured one as it was sampled.

        A Gaussian surface has less than 1e-4 of its largest power density at waves as short as its
        correlation length.
        """
        for name in ("cutoff_short", "wavelength", "width", "correlation_length"):
            if name in self.table:
                return float(self.table[name])
        return None

    def case(self) -> tuple[Case, float]:
        """Contact at its speed, and the Rq of the Hertz zone [m]."""
        case = (rough_point if self.point else rough_line)(self.table, nodes=self.nodes, speed=0.1)
        case = case.replace({"contact.boundary_film": self.boundary_film})
        rq = composite_roughness(case)
        return at_film(case, self.ratio * rq), rq


def composite_roughness(case: Case) -> float:
    """Root mean square height of the sum of both surfaces over the Hertz zone [m]."""
    prepared = prepare(case)
    problem = prepared.kind.film_problem(prepared.case, prepared.conditions, prepared.rough)
    x = np.linspace(-1.0, 1.0, 2001 if problem.width is None else 201)
    y = np.zeros(1) if problem.width is None else x
    assert problem.added_gap is not None
    heights = problem.added_gap(x, y)
    inside = x[:, np.newaxis] ** 2 + y**2 <= 1.0
    return float(np.std(heights[inside])) * problem.scales.thickness


def timed(case: Case, limit: float) -> tuple[MixedFilm | None, float]:
    """Film of a case, None if it was given up, and its processor time [s]."""
    started = time.process_time()
    try:
        with processor_limit(limit):
            return mixed_film(case), time.process_time() - started
    except GivenUpError:
        return None, time.process_time() - started


def key_figures(film: MixedFilm) -> Record:
    """Numbers of a film in SI units, shares of one and not of a hundred."""
    whole = 2.0 if film.mesh.y.size == 1 else 1.5 * film.problem.geometry.load
    outside = film.zone & ~film.touching
    gaps = film.gap[outside] * film.problem.scales.thickness
    weights = np.broadcast_to(film.last.level.weights, film.mesh.shape)[outside]
    final = film.last.final
    found: Record = {
        "status": film.last.status,
        "steps": film.steps,
        "krylov": film.krylov,
        "residual": final.norm,
        "share": film.share,
        "area": film.area / whole,
        "oil": film.oil,
    }
    if gaps.size:
        found["mean_film"] = float(np.average(gaps, weights=weights))
        found["median_film"] = float(weighted_percentiles(gaps, weights, [0.5])[0])
        # Mean field of one volt over the Hertz zone outside the spots, in proportion to its capacitance.
        found["mean_field"] = float(np.average(1.0 / gaps, weights=weights))
    return found


def solved(contact: Contact, limit: float) -> Record:
    """Record of a contact, with the time of its film and of the smooth one on the same grid."""
    case, rq = contact.case()
    prepared = prepare(case)
    spacing = max(spacings_of(prepared.case, prepared.conditions))
    wave = contact.shortest_wave
    film, seconds = timed(case, limit)
    _, smooth = timed(case.replace({"roughness": ()}), limit)
    found: Record = {
        "key": contact.key,
        "name": contact.name,
        "point": contact.point,
        "nodes": contact.nodes,
        "ratio": contact.ratio,
        "boundary_film": contact.boundary_film,
        "rq": rq,
        "speed": case.contact.entrainment_speed,
        "per_wave": None if wave is None else wave / spacing,
        "seconds": seconds,
        "smooth_seconds": smooth,
        "limit": limit,
    }
    found |= {"status": "given up"} if film is None else key_figures(film)
    return found | provenance()


def provenance() -> Record:
    """What solved a film, and when."""

    def git(*arguments: str) -> str:
        done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    changed = "+" if git("status", "--porcelain", "src") else ""
    return {
        "solver": git("log", "-1", "--format=%h", "--", "src") + changed,
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "processor": processor(),
        "versions": f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}",
    }


def stored() -> dict[str, Record]:
    """Records of the file by their keys; of several of one contact, the last."""
    if not DATA.exists():
        return {}
    records = map(json.loads, DATA.read_text(encoding="utf-8").splitlines())
    return {record["key"]: record for record in records}


def rounded(value: Any) -> Any:
    """Value with its numbers to six digits, as the iteration leaves no more."""
    if isinstance(value, dict):
        return {key: rounded(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [rounded(each) for each in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def tidy() -> None:
    """Write the file anew without records that later ones replace, in the order of their keys."""
    lines = [json.dumps(record) for _, record in sorted(stored().items())]
    DATA.write_text("".join(line + "\n" for line in lines), encoding="utf-8")


def records(
    contacts: list[Contact],
    *,
    limit: float,
    solve: bool,
    again: bool = False,
    told: Callable[[Record], None] | None = None,
) -> dict[str, Record]:
    """Records of contacts by their keys, from the file or, if ``solve``, from a solution that it then holds.

    With ``again`` all are solved, also those that the file holds. ``told`` takes every new record. Contacts
    that are not solved are missing.
    """
    known = stored()
    found = {}
    for contact in contacts:
        record = known.get(contact.key)
        if solve and (record is None or again):
            record = solved(contact, limit)
            # Several runs may write at a time: a line is appended in one piece.
            with DATA.open("a", encoding="utf-8") as file:
                file.write(json.dumps(rounded(record)) + "\n")
            if told is not None:
                told(record)
        if record is not None:
            found[contact.key] = record
    return found
