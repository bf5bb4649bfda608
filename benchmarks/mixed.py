"""Films whose surfaces touch: which converge, at what cost, and what does not depend on the grid.

python -m benchmarks.mixed                   (all tables and the figure, from the films of benchmarks/data)
python -m benchmarks.mixed lines --solve     (made and measured surfaces over lambda in line contacts)
python -m benchmarks.mixed points --solve    (the same in contacts of a ball)
python -m benchmarks.mixed grids --solve     (surfaces whose shortest wave has 16 nodes, from grid to grid)
python -m benchmarks.mixed boundary --solve  (boundary films of 5 to 0.5 nm)
python -m benchmarks.mixed short             (load share and mean film of the coarsest grids in one table)
python -m benchmarks.mixed cost              (processor time beside that of full films)
python -m benchmarks.mixed sweep --solve     (one rough ball over speed beside published fits, and a figure)

``--solve`` solves the films that the file of results does not hold, and adds each to it; with ``--again`` it
solves all of them once more. Without it what is missing stays empty. A film that takes more processor time
than ``--limit`` is given up, and the table says so.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
from tests.helpers.mixed_films import gaussian, sinusoid
from tests.helpers.places import DEKTAK, SURFACES

from benchmarks.mixed_store import POINT_GRIDS, Contact, Record, records, tidy
from benchmarks.mixed_sweep import SWEPT_LAMBDAS, converged, draw, formula_share, sweep_series
from ehlectric.formulas.asperities import LOAD_SHARE, load_shares

LAMBDAS = (3.0, 1.0, 0.3, 0.1, 0.03)


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


def robust(*, point: bool, grids_: Iterable[int]) -> list[Contact]:
    """Every surface over lambda and grids."""
    named = surfaces(point=point).items()
    return [
        Contact(name, point, table, nodes, ratio)
        for nodes in grids_
        for name, table in named
        for ratio in LAMBDAS
    ]


LINE_GRIDS = (3201, 12_801)

# Surfaces whose shortest wave has at least sixteen nodes on one of the coarser grids.
LINE_SHORTEST, POINT_SHORTEST = 13e-6, 60e-6


def resolved(*, point: bool) -> dict[str, dict[str, Any]]:
    """Tables of the surfaces from grid to grid: measured ones without their waves that are too short."""
    short = POINT_SHORTEST if point else LINE_SHORTEST
    tables = surfaces(point=point)
    found = {name: table | {"cutoff_short": short} for name, table in tables.items() if "file" in table}
    if point:
        return {
            "asperity 100 nm": {"generator": "asperity", "height": 100e-9, "width": 70e-6},
            "sinusoid 70 nm": sinusoid(100e-9, 70e-6),
            "gaussian 100 nm": gaussian(100e-9, 34e-6, cutoff_short=short),
        } | found
    made = {name: tables[name] for name in ("asperity 200 nm", "sinusoid 140 nm", "gaussian 200 nm")}
    return made | found


def grid_series() -> list[Contact]:
    """Contacts of ``resolved`` on their grids."""
    return [
        Contact(name, point, table, nodes, ratio)
        for point, grids_ in ((False, (801, 1601, 3201, 6401, 12_801)), (True, POINT_GRIDS))
        for name, table in resolved(point=point).items()
        for ratio in (0.3, 0.1, 0.03)
        for nodes in grids_
    ]


def boundary_series() -> list[Contact]:
    """Two contacts over the thickness of the boundary film."""
    return [
        Contact(name, point, table, nodes, ratio, 1e-9 * nanometres)
        for name, point, table, nodes in (
            ("gaussian 200 nm", False, gaussian(200e-9, 20e-6, seed=4), 1601),
            ("gaussian 100 nm", True, gaussian(100e-9, 30e-6), 65),
        )
        for ratio in (0.1, 0.03, 0.01)
        for nanometres in (5.0, 2.0, 1.0, 0.5)
    ]


# Rough ball of the sweep over speed, and the values of lambda.
def row(*entries: Any) -> None:
    """Print one row of a table."""
    print("| " + " | ".join(map(str, entries)) + " |", flush=True)


def head(*names: str) -> None:
    """Print the head of a table."""
    row(*names)
    row(*("---" for _ in names))


def status(record: Record | None) -> str:
    """Whether a film converged, or why there is none."""
    if record is None:
        return "not solved"
    if record["status"] == "given up":
        return f"given up after {record['limit']:.0f} s"
    if record["status"] == "stalled":
        return f"stalled at {record['residual']:.0e}"
    return str(record["status"])


def percent(share: float | None) -> str:
    """Share in per cent with two digits, without those of a rest."""
    if share is None:
        return ""
    if share > 0.995:
        return "100"
    return "0" if share < 5e-5 else f"{100.0 * share:.2g}"


def nanometres(record: Record, key: str) -> str:
    """Film in nm."""
    return f"{float(f'{1e9 * record[key]:.3g}'):g}" if key in record else ""


def cells(record: Record | None) -> list[str]:
    """Figures of a film in the tables over lambda."""
    if record is None or record["status"] not in ("converged", "stalled"):
        return [status(record), "", "", "", "", ""]
    films = [nanometres(record, key) for key in ("mean_film", "median_film")]
    field = f"{1e-6 * record['mean_field']:.3g}" if "mean_field" in record else ""
    return [status(record), percent(record["share"]), percent(record["area"]), *films, field]


FIGURES = ("status", "load share %", "area %", "mean nm", "median nm", "field V/µm")


def print_robust(contacts: list[Contact], found: dict[str, Record]) -> None:
    """Surfaces over lambda: convergence, cost and key figures."""
    head("nodes", "surface", "Rq nm", "λ", *FIGURES, "steps", "CPU s")
    for contact in contacts:
        record = found.get(contact.key)
        if record is not None:
            rq, cost = f"{1e9 * record['rq']:.0f}", (record.get("steps", ""), f"{record['seconds']:.1f}")
            row(contact.nodes, contact.name, rq, f"{contact.ratio:g}", *cells(record), *cost)
    done = sum(map(converged, found.values()))
    print(f"\n{done} of {len(found)} converged, {len(contacts) - len(found)} not solved\n")


def print_short(contacts: list[Contact], found: dict[str, Record]) -> None:
    """Load share and mean film of every surface and grid in one row."""
    head("surface", "nodes", *(f"λ {ratio:g}" for ratio in LAMBDAS))
    for first in contacts:
        series = [found.get(other.key) for other in contacts if _same_but_speed(first, other)]
        if first.ratio != LAMBDAS[0] or not any(series):
            continue
        entries = []
        for record in series:
            if converged(record) and record is not None:
                film = nanometres(record, "mean_film") or "none"
                entries.append(f"{percent(record['share'])}, {film}")
            else:
                entries.append("-" if record is None else status(record))
        kind = "²" if first.point else ""
        row(first.name, f"{first.nodes}{kind}", *entries)
    print()


def change(now: Record, before: Record | None, key: str) -> str:
    """Change of a figure from the coarser grid in per cent."""
    if before is None or not before.get(key) or key not in now:
        return ""
    return f"{100.0 * (now[key] / before[key] - 1.0):+.1f}"


def print_grids(contacts: list[Contact], found: dict[str, Record]) -> None:
    """Key figures from grid to grid, with their changes."""
    keys = ("share", "area", "mean_film", "median_film", "mean_field")
    changes = ("share", "area", "mean", "median", "field")
    head("surface", "λ", "nodes", "per wave", *FIGURES, *(f"{name} ±%" for name in changes))
    before: Record | None = None
    for contact in contacts:
        record = found.get(contact.key)
        if record is None:
            continue
        if before is not None and (before["name"], before["ratio"]) != (contact.name, contact.ratio):
            before = None
        off = [change(record, before, key) for key in keys] if converged(record) else [""] * len(keys)
        surface = f"{'point' if contact.point else 'line'} {contact.name}"
        wave = f"{record['per_wave']:.0f}"
        row(surface, f"{contact.ratio:g}", contact.nodes, wave, *cells(record), *off)
        before = record if converged(record) else None
    print()


def print_boundary(contacts: list[Contact], found: dict[str, Record]) -> None:
    """Key figures over the boundary film."""
    head("contact", "λ", "boundary film nm", *FIGURES)
    for contact in contacts:
        kind = f"{'point' if contact.point else 'line'} {contact.nodes}"
        row(kind, f"{contact.ratio:g}", f"{1e9 * contact.boundary_film:g}", *cells(found.get(contact.key)))
    print()


def print_cost(contacts: list[Contact], found: dict[str, Record]) -> None:
    """Times of films that touch over that of the full film of the same surface on the same grid."""
    head("nodes", "surface", "full film λ, s", "smooth film s", *(f"λ {ratio:g}" for ratio in LAMBDAS[1:]))
    over: list[float] = []
    for contact in contacts:
        if contact.ratio != LAMBDAS[0]:
            continue
        group = [found.get(other.key) for other in contacts if _same_but_speed(contact, other)]
        full = next((each for each in group if each is not None and converged(each)), None)
        if full is None or full["share"] > 0.0:
            continue
        entries = []
        for each in group[1:]:
            if each is None or not converged(each):
                entries.append("" if each is None else status(each))
                continue
            times = each["seconds"] / full["seconds"]
            touches = each["share"] > 0.0
            if touches:
                over.append(times)
            entries.append(f"**{times:.1f}**" if touches else f"{times:.1f}")
        smooth = f"{full['smooth_seconds']:.2f}"
        row(contact.nodes, contact.name, f"{full['ratio']:g}, {full['seconds']:.2f}", smooth, *entries)
    least = np.array(over)
    print(f"\nbold: surfaces touch; {np.sum(least <= 3.0)} of {least.size} at most three times, ", end="")
    print(f"median {np.median(least):.1f}, most {least.max():.0f}\n" if least.size else "none\n")


def _same_but_speed(contact: Contact, other: Contact) -> bool:
    return (contact.name, contact.point, contact.nodes) == (other.name, other.point, other.nodes)


def print_sweep(contacts: list[Contact], found: dict[str, Record]) -> None:
    """One rough ball over speed beside published fits, and the figure."""
    grids_ = {n: [found.get(c.key) for c in contacts if c.nodes == n] for n in POINT_GRIDS}
    grids_ = {nodes: series for nodes, series in grids_.items() if any(map(converged, series))}
    laws = load_shares(np.array(SWEPT_LAMBDAS))
    names = [law.name for law in LOAD_SHARE.values()]
    head("λ", *(f"solved, {nodes}²" for nodes in grids_), "Masjedi-Khonsari", *names)
    for k, ratio in enumerate(SWEPT_LAMBDAS):
        columns = [series[k] for series in grids_.values()]
        solved = [f"{each['share']:.2g}" if converged(each) else status(each) for each in columns]
        known = formula_share(ratio)
        formula = "" if known is None else f"{known:.2g}"
        row(f"{ratio:.2g}", *solved, formula, *(f"{law[k]:.2g}" for law in laws.values()))
    for nodes, series in grids_.items():
        shares = np.array([each["share"] for each in series if converged(each)])
        rises = np.sum(np.diff(shares) > 0.0)
        print(f"\n{nodes}²: {shares.size} of {len(series)} converged, {rises} rises of the share with speed")
    print()
    draw(grids_)


def coarsest_grids() -> list[Contact]:
    """Every surface over lambda, on the coarsest grid of line and of point contacts."""
    return robust(point=False, grids_=LINE_GRIDS[:1]) + robust(point=True, grids_=POINT_GRIDS[:1])


def every_surface() -> list[Contact]:
    """Every surface over lambda, in line and point contacts."""
    return robust(point=False, grids_=LINE_GRIDS) + robust(point=True, grids_=POINT_GRIDS)


PARTS: dict[str, tuple[Callable[[], list[Contact]], Callable[[list[Contact], dict[str, Record]], None]]] = {
    "lines": (lambda: robust(point=False, grids_=LINE_GRIDS), print_robust),
    "points": (lambda: robust(point=True, grids_=POINT_GRIDS), print_robust),
    "grids": (grid_series, print_grids),
    "boundary": (boundary_series, print_boundary),
    "short": (coarsest_grids, print_short),
    "cost": (every_surface, print_cost),
    "sweep": (sweep_series, print_sweep),
}


def chosen(contacts: list[Contact], options: argparse.Namespace) -> list[Contact]:
    """Contacts that the options leave."""
    return [
        contact
        for contact in contacts
        if options.only in contact.name
        and (not options.nodes or contact.nodes in options.nodes)
        and (not options.ratios or contact.ratio in options.ratios)
    ]


def main() -> None:
    """Solve and print the tables that are asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("parts", nargs="*", choices=[*PARTS, []], help="what to show; all if none is given")
    parser.add_argument("--solve", action="store_true", help="solve what the file of results does not hold")
    parser.add_argument("--again", action="store_true", help="with --solve, solve all once more")
    parser.add_argument("--tidy", action="store_true", help="drop what was solved again from the file")
    parser.add_argument("--limit", type=float, default=120.0, help="processor time of one film [s]")
    parser.add_argument("--nodes", type=int, nargs="*", help="grids to solve in place of all")
    parser.add_argument("--ratios", type=float, nargs="*", help="values of lambda to solve in place of all")
    parser.add_argument("--only", default="", help="surfaces to solve, whose names contain this")
    options = parser.parse_args()
    for part in options.parts or PARTS:
        contacts, show = PARTS[part][0](), PARTS[part][1]
        if options.solve:

            def told(record: Record) -> None:
                row(record["nodes"], record["name"], record["ratio"], *cells(record), record["seconds"])

            left = chosen(contacts, options)
            records(left, limit=options.limit, solve=True, again=options.again, told=told)
            continue
        show(contacts, records(contacts, limit=options.limit, solve=False))
    if options.tidy:
        tidy()


if __name__ == "__main__":
    main()
