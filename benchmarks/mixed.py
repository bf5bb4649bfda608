"""Films whose surfaces touch: which converge, at what cost, and what does not depend on the grid.

python -m benchmarks.mixed robust            (line contacts on 3201 nodes)
python -m benchmarks.mixed robust --nodes 12801
python -m benchmarks.mixed robust --point --nodes 257
python -m benchmarks.mixed boundary          (boundary films from 5 to 0.5 nm)
python -m benchmarks.mixed grids             (line contact on 801 to 12801 nodes, point on 65 to 257)
python -m benchmarks.mixed cost              (mixed film beside the full film of the same contact)
python -m benchmarks.mixed sweep --figure    (speeds of one contact beside published fits, and their figure)

A solution that takes more processor time than ``--limit`` is given up, and the table says so.
"""

from __future__ import annotations

import argparse
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from tests.helpers.mixed_films import (
    MixedFilm,
    at_film,
    gaussian,
    mixed_film,
    rough_line,
    rough_point,
    sinusoid,
)
from tests.helpers.places import DEKTAK, SURFACES

from ehlectric import Case
from ehlectric.asperities.shares import LOAD_SHARE, load_shares
from ehlectric.contact.check import check_case
from ehlectric.errors import InputError
from ehlectric.formulas.film_mixed import RoughBodies, masjedi_khonsari_point

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "mixed_sweep.png"

LAMBDAS = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01)

# Hardness of bearing steel of 700 HV, for the formula of Masjedi and Khonsari.
HARDNESS = 7e9


class GivenUpError(Exception):
    """A solution took more processor time than it may."""


def timed(case: Case, limit: float) -> tuple[MixedFilm | None, float]:
    """Film of a case, None if it was given up, and its processor time [s]."""

    def give_up(*_: Any) -> None:
        raise GivenUpError

    signal.signal(signal.SIGPROF, give_up)
    started = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, limit)
    try:
        return mixed_film(case), time.process_time() - started
    except GivenUpError:
        return None, time.process_time() - started
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)


def composite_roughness(case: Case) -> float:
    """Root mean square height of the sum of both surfaces over the Hertz zone [m]."""
    prepared = check_case(case)
    problem = prepared.kind.film_problem(prepared.case, prepared.conditions, prepared.rough)
    x = np.linspace(-1.0, 1.0, 2001 if problem.width is None else 201)
    y = np.zeros(1) if problem.width is None else x
    assert problem.added_gap is not None
    heights = problem.added_gap(x, y)
    inside = x[:, np.newaxis] ** 2 + y**2 <= 1.0
    return float(np.std(heights[inside])) * problem.scales.thickness


def _measured(path: Path, **steps: Any) -> dict[str, Any]:
    return {"file": str(path), "form": "parabola"} | steps


def surfaces(*, point: bool) -> dict[str, dict[str, Any]]:
    """Tables of the surfaces by their names."""
    if point:
        made: dict[str, dict[str, Any]] = {
            "asperity 100 nm": {"generator": "asperity", "height": 100e-9, "width": 40e-6},
            "sinusoid 70 nm": sinusoid(100e-9, 50e-6),
        }
        made |= {f"gaussian {rq} nm": gaussian(1e-9 * rq, 30e-6) for rq in (50, 100, 200, 400)}
        files = {
            "al3d map": _measured(SURFACES / "al3d-1.al3d"),
            "x3p map": _measured(SURFACES / "x3p-2-half.x3p"),
        }
        return made | files
    made = {
        "asperity 200 nm": {"generator": "asperity", "height": 200e-9, "width": 40e-6},
        "sinusoid 140 nm": sinusoid(200e-9, 40e-6),
    }
    made |= {f"gaussian {rq} nm": gaussian(1e-9 * rq, 20e-6, seed=4) for rq in (50, 100, 200, 400)}
    return made | {
        "dektak": _measured(DEKTAK, cutoff_long=80e-6),
        "hfm": _measured(SURFACES / "hfm-1.hfm", cutoff_long=80e-6),
        "x3p": _measured(SURFACES / "x3p-2-half.x3p"),
        "al3d": _measured(SURFACES / "al3d-1.al3d"),
    }


def contact(table: dict[str, Any], nodes: int, *, point: bool, speed: float = 0.1) -> Case:
    """Line or point contact with one rough surface."""
    make = rough_point if point else rough_line
    return make(table, nodes=nodes, speed=speed)


HEAD = "status | steps | Krylov | CPU s | share % | area % | film outside nm | oil lost, made, made outside %"


def cells(film: MixedFilm | None, seconds: float) -> list[str]:
    """Key figures of one film."""
    if film is None:
        return ["given up", "", "", f"{seconds:.0f}", "", "", "", ""]
    whole = 2.0 if film.mesh.y.size == 1 else 1.5 * film.problem.geometry.load
    return [
        film.last.status,
        str(film.steps),
        str(film.krylov),
        f"{seconds:.1f}",
        f"{100.0 * film.share:.2f}",
        f"{100.0 * film.area / whole:.2f}",
        f"{1e9 * film.film_outside:.2f}",
        ", ".join(f"{100.0 * part:.2g}" for part in film.oil),
    ]


def row(*entries: Any) -> None:
    """Print one row of a table at once, since the next one may take minutes."""
    print("| " + " | ".join(map(str, entries)) + " |", flush=True)


def robust(options: argparse.Namespace) -> None:
    """Surfaces over lambda, the central film of the formula over the roughness."""
    row("surface", "Rq nm", "lambda", "speed m/s", HEAD)
    done = converged = 0
    for name, table in surfaces(point=options.point).items():
        if options.only and options.only not in name:
            continue
        try:
            case = contact(table, options.nodes, point=options.point)
            rq = composite_roughness(case)
        except InputError as error:
            row(name, "refused", "", "", error)
            continue
        for ratio in options.ratios or LAMBDAS:
            posed = at_film(case, ratio * rq)
            film, seconds = timed(posed, options.limit)
            done, converged = done + 1, converged + (film is not None and film.converged)
            speed = posed.contact.entrainment_speed
            row(name, f"{1e9 * rq:.1f}", f"{ratio:g}", f"{speed:.3g}", *cells(film, seconds))
    print(f"\n{converged} of {done} converged")


# Contacts whose shortest wave has at least sixteen nodes on the second grid.
GRIDS: dict[str, tuple[bool, dict[str, Any], tuple[float, ...]]] = {
    "line gaussian": (False, gaussian(200e-9, 40e-6, seed=4, cutoff_short=20e-6), (0.3, 0.1, 0.03)),
    "line sinusoid": (False, sinusoid(200e-9, 100e-6), (0.3, 0.1, 0.03)),
    "point gaussian": (True, gaussian(100e-9, 34e-6, cutoff_short=60e-6), (0.3, 0.1, 0.03)),
}


def grids(options: argparse.Namespace) -> None:
    """Load share, area and film from grid to grid."""
    row("contact", "lambda", "nodes", "per shortest wave", HEAD)
    for name, (point, table, ratios) in GRIDS.items():
        if options.only and options.only not in name:
            continue
        for ratio in options.ratios or ratios:
            for nodes in (65, 129, 257) if point else (401, 801, 1601, 3201, 6401):
                if nodes > options.most:
                    continue
                case = contact(table, nodes, point=point)
                case = at_film(case, ratio * composite_roughness(case))
                prepared = check_case(case)
                spacing = max(prepared.kind.spacings(case, prepared.conditions))
                wave = table.get("cutoff_short", table.get("wavelength"))
                row(name, f"{ratio:g}", nodes, f"{wave / spacing:.0f}", *cells(*timed(case, options.limit)))


def boundary(options: argparse.Namespace) -> None:
    """Load share over the thickness of the boundary film."""
    row("contact", "lambda", "boundary film nm", HEAD)
    for point, table, nodes in (
        (False, gaussian(200e-9, 20e-6, seed=4), 1601),
        (True, gaussian(100e-9, 30e-6), 65),
    ):
        for ratio in (0.1, 0.03, 0.01):
            for nanometres in (5.0, 2.0, 1.0, 0.5):
                case = contact(table, nodes, point=point)
                case = at_film(case, ratio * composite_roughness(case))
                case = case.replace({"contact.boundary_film": 1e-9 * nanometres})
                what = f"point {nodes}" if point else f"line {nodes}"
                row(what, f"{ratio:g}", f"{nanometres:g}", *cells(*timed(case, options.limit)))


def cost(options: argparse.Namespace) -> None:
    """Mixed films beside the full film of the same surfaces at a speed at which they do not touch."""
    row("contact", "lambda", "full film: lambda, CPU s", "ratio", HEAD)
    chosen = (
        (False, "gaussian 200 nm", 3201),
        (False, "sinusoid 140 nm", 3201),
        (True, "gaussian 100 nm", 129),
    )
    for point, name, nodes in chosen:
        case = contact(surfaces(point=point)[name], nodes, point=point)
        rq = composite_roughness(case)
        full, least = None, 2.0
        while full is None or full.touching.any() or not full.converged:
            full, of_full = timed(at_film(case, least * rq), options.limit)
            least *= 1.5
        for ratio in LAMBDAS[1:]:
            film, seconds = timed(at_film(case, ratio * rq), options.limit)
            what = f"{name} {nodes}"
            row(
                what,
                f"{ratio:g}",
                f"{least / 1.5:.2g}, {of_full:.1f}",
                f"{seconds / of_full:.1f}",
                *cells(film, seconds),
            )


# Rough ball of the sweep over speed, and the values of lambda.
SWEPT = gaussian(100e-9, 34e-6)
SWEPT_LAMBDAS = np.geomspace(0.01, 3.0, 12)

# Lambda, and film or None, of every speed on one grid.
Swept = list[tuple[float, MixedFilm | None]]


def swept(nodes: int, limit: float) -> Swept:
    """Films of the rough ball over lambda on a grid."""
    case = contact(SWEPT, nodes, point=True)
    rq, found = composite_roughness(case), []
    for ratio in SWEPT_LAMBDAS:
        posed = at_film(case, float(ratio) * rq)
        film, seconds = timed(posed, limit)
        row(nodes, f"{ratio:.3g}", f"{posed.contact.entrainment_speed:.3g}", *cells(film, seconds))
        found.append((float(ratio), film))
    return found


def formula_share(ratio: float) -> float | None:
    """Load share of the rough ball by the formula of Masjedi and Khonsari."""
    case = contact(SWEPT, 65, point=True)
    rq = composite_roughness(case)
    conditions = check_case(at_film(case, ratio * rq)).conditions
    return masjedi_khonsari_point(
        conditions.contact, RoughBodies(roughness=rq, hardness=HARDNESS)
    ).asperity_share


def sweep(options: argparse.Namespace) -> None:
    """One rough ball over speed on several grids, beside published fits."""
    row("nodes", "lambda", "speed m/s", HEAD)
    grids_ = {nodes: swept(nodes, options.limit) for nodes in (65, 129, 257) if nodes <= options.most}
    print()
    row(
        "lambda",
        *(f"solved, {nodes}" for nodes in grids_),
        "Masjedi-Khonsari",
        *(law.name for law in LOAD_SHARE.values()),
    )
    laws = load_shares(SWEPT_LAMBDAS)
    for k, ratio in enumerate(SWEPT_LAMBDAS):
        films = [found[k][1] for found in grids_.values()]
        solved = ["" if film is None or not film.converged else f"{film.share:.3g}" for film in films]
        known = formula_share(float(ratio))
        formula = "" if known is None else f"{known:.3g}"
        row(f"{ratio:.3g}", *solved, formula, *(f"{law[k]:.3g}" for law in laws.values()))
    if options.figure:
        draw(grids_)


def draw(grids_: dict[int, Swept]) -> None:
    """Share, area and film over lambda."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.8), layout="constrained")
    fine = np.geomspace(SWEPT_LAMBDAS[0], SWEPT_LAMBDAS[-1], 200)
    for key, share in load_shares(fine).items():
        left.semilogx(fine, share, lw=0.9, label=LOAD_SHARE[key].name)
    known = [(ratio, formula_share(ratio)) for ratio in map(float, fine[::5])]
    given = np.array([(ratio, share) for ratio, share in known if share is not None])
    left.semilogx(given[:, 0], given[:, 1], "C7--", lw=1.2, label="Masjedi-Khonsari")
    rq = composite_roughness(contact(SWEPT, 65, point=True))
    for (nodes, found), style in zip(grids_.items(), ("k:", "k--", "k-"), strict=False):
        solved = [(ratio, film) for ratio, film in found if film is not None and film.converged]
        at, films = [ratio for ratio, _ in solved], [film for _, film in solved]
        whole = 1.5 * films[0].problem.geometry.load
        left.semilogx(
            at, [film.share for film in films], style, marker="o", ms=3, label=f"solved, {nodes} nodes"
        )
        label = f"{nodes} nodes" if nodes == max(grids_) else None
        right.loglog(
            at,
            [max(film.area / whole, 1e-5) for film in films],
            f"C3{style[1:]}",
            label=label and f"area of spots, {label}",
        )
        right.loglog(
            at,
            [film.film_outside / rq for film in films],
            f"C0{style[1:]}",
            label=label and f"gap outside them over Rq, {label}",
        )
    left.set(
        xlabel="λ, film of smooth surfaces over Rq", ylabel="share of the load on asperities", ylim=(0, 1.02)
    )
    left.set_title("The finer the grid, the less touches", fontsize=10)
    left.legend(fontsize=7)
    right.set(xlabel="λ, film of smooth surfaces over Rq", ylim=(1e-4, 10.0))
    right.set_title("The gap outside the spots differs less", fontsize=10)
    right.legend(fontsize=7)
    figure.savefig(FIGURE, dpi=150)


RUNS: dict[str, Callable[[argparse.Namespace], None]] = {
    "robust": robust,
    "grids": grids,
    "boundary": boundary,
    "cost": cost,
    "sweep": sweep,
}


def main() -> None:
    """Print the tables that are asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run", choices=RUNS, help="what to measure")
    parser.add_argument("--nodes", type=int, default=3201, help="nodes along entrainment")
    parser.add_argument("--point", action="store_true", help="point contacts")
    parser.add_argument("--limit", type=float, default=120.0, help="processor time of one film [s]")
    parser.add_argument(
        "--most", type=int, default=100_000, help="largest number of nodes of a series of grids"
    )
    parser.add_argument("--only", default="", help="surfaces or contacts whose names contain this")
    parser.add_argument("--ratios", type=float, nargs="*", help="values of lambda in place of the usual ones")
    parser.add_argument("--figure", action="store_true", help="draw the figure of the sweep")
    options = parser.parse_args()
    RUNS[options.run](options)


if __name__ == "__main__":
    main()
