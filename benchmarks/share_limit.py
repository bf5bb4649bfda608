"""Load share of asperities from grid to grid for oils that flow more easily in thin gaps.

python -m benchmarks.share_limit                     (table and figure from the file of results)
python -m benchmarks.share_limit --solve             (solve what the file does not hold; about an hour)
python -m benchmarks.share_limit --solve --only slip

``benchmarks/data/share_limit.csv`` has one film per line. Each film starts from that of the grid with half
the nodes, and conserves its oil in cavities where such a film is found.
"""

from __future__ import annotations

import argparse
import csv
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from tests.helpers.mixed_films import (
    MODULUS,
    MixedFilm,
    at_film,
    gaussian,
    posed,
    rough_line,
    rough_point,
    sinusoid,
)

from benchmarks.mixed import head, percent, row
from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric import Case
from ehlectric.arrays import Array
from ehlectric.film.face_flow import (
    Coefficients,
    FaceFlow,
    Flow,
    FlowLaw,
    Fluid,
    Sides,
    evaluate,
    logarithmic_mean,
)
from ehlectric.film.mesh import Mesh
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution
from ehlectric.film.problem import FilmProblem
from ehlectric.film.shear_flow import ShearedFlow
from ehlectric.film.shear_laws import LIMIT_FLOOR, Rheology
from ehlectric.runtime.threads import quiet_solution

DATA = Path(__file__).parent / "data" / "share_limit.csv"
FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "share_limit.png"

# Viscosity of the oil at ambient pressure, of lines and of the ball [Pa s].
VISCOSITY = 0.04

# Fluidity eta_0/eta and its logarithmic derivatives by P and by H, from ln(eta/eta_0) of the oil, its
# derivative by P, and H.
Thinned = Callable[[Array, Array, Array], tuple[Array, Array, Array]]


@dataclass(frozen=True)
class ThinGapFlow:
    """Newtonian flow of an oil whose fluidity also depends on the gap, a value of ``Fluid.flow``."""

    thinned: Thinned

    def __call__(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
        """Flow through all faces at P (nx, ny) and H (nx, ny) on a mesh."""
        k = evaluate(fluid, pressure, thickness)
        log_fluidity, by_p, by_h = self.thinned(k.log_viscosity, k.log_viscosity_p, thickness)
        fluidity = np.exp(log_fluidity)
        eps = k.density * thickness**3 * fluidity / fluid.velocity_parameter
        k = replace(
            k,
            log_viscosity=-log_fluidity,
            log_viscosity_p=-by_p,
            fluidity=fluidity,
            eps=eps,
            eps_p=eps * (k.density_p / k.density + by_p),
            eps_h=eps * (3.0 / thickness + by_h),
        )
        along = _through(k, -by_h, thickness, pressure, fluid.velocity_parameter, mesh.dx)
        if mesh.dy is None:
            return Flow(k, along, None)

        def turned(values: Array) -> Array:
            return np.concatenate([values[:, 1:2], values], axis=1).T if mesh.symmetric else values.T

        across = Coefficients(**{name: turned(values) for name, values in vars(k).items()})
        gap = turned(-by_h), turned(thickness), turned(pressure)
        return Flow(k, along, _through(across, *gap, fluid.velocity_parameter, mesh.dy))


def _through(
    k: Coefficients, by_h: Array, thickness: Array, pressure: Array, parameter: float, spacing: float
) -> FaceFlow:
    """Flow along the first axis; ``by_h`` is the derivative of ln eta by H."""
    mean, by_before, by_after = logarithmic_mean(k.log_viscosity, k.fluidity)
    gap = 0.5 * (thickness[1:] + thickness[:-1])
    mass = 0.5 * (k.density[1:] + k.density[:-1])
    difference = np.diff(pressure, axis=0)
    size = gap**3 / (parameter * spacing**2)
    driven, of_mass = mass * size * difference, 0.5 * size * mean * difference
    flux = driven * mean
    of_gap = 1.5 * flux / gap
    return FaceFlow(
        flux=flux,
        conductance=mass * size * mean,
        by_properties=Sides(
            driven * by_before * k.log_viscosity_p[:-1] + of_mass * k.density_p[:-1],
            driven * by_after * k.log_viscosity_p[1:] + of_mass * k.density_p[1:],
        ),
        by_gap=Sides(of_gap + driven * by_before * by_h[:-1], of_gap + driven * by_after * by_h[1:]),
    )


# (problem, number of the law in SI units, slide-to-roll ratio) -> flow of the oil.
Law = Callable[[FilmProblem, float, float], str | FlowLaw]


def _newtonian(_problem: FilmProblem, _number: float, _sliding: float) -> str:
    return "newtonian"


def _sheared(name: str, constant: str) -> Law:
    def of(problem: FilmProblem, number: float, sliding: float) -> ShearedFlow:
        scales = problem.scales
        return ShearedFlow(
            Rheology(name, {constant: number}),
            stress_scale=scales.pressure * scales.thickness / scales.length,
            pressure_scale=scales.pressure,
            # The rough surface 1 of a case with a positive ratio is the faster one.
            slide_to_roll_ratio=-sliding,
        )

    return of


def _slip(problem: FilmProblem, length: float, _sliding: float) -> ThinGapFlow:
    """Slip at both walls: mobility times 1 + 6 b/h with the slip length b [m]."""
    b = length / problem.scales.thickness

    def thinned(log_viscosity: Array, slope: Array, gap: Array) -> tuple[Array, Array, Array]:
        return np.log1p(6.0 * b / gap) - log_viscosity, -slope, 1.0 / (gap + 6.0 * b) - 1.0 / gap

    return ThinGapFlow(thinned)


def _capped(_problem: FilmProblem, most: float, _sliding: float) -> ThinGapFlow:
    """Viscosity below a largest one [Pa s]: 1/eta = 1/eta(p) + 1/eta_max."""
    cap = np.log(most / VISCOSITY)

    def thinned(log_viscosity: Array, slope: Array, _gap: Array) -> tuple[Array, Array, Array]:
        log_fluidity = np.logaddexp(-log_viscosity, -cap)
        return log_fluidity, -slope * np.exp(-log_viscosity - log_fluidity), np.zeros_like(_gap)

    return ThinGapFlow(thinned)


def _warm(problem: FilmProblem, film: float, _sliding: float) -> ThinGapFlow:
    """Hot oil in gaps thinner than about ``film`` [m]: ln(eta/eta_0) h/(h + film) -
    ln(1 + 9 film/(h + film)).

    Where the gap is far thinner the oil has a tenth of its viscosity and no effect of pressure on it.
    """
    b = film / problem.scales.thickness

    def thinned(log_viscosity: Array, slope: Array, gap: Array) -> tuple[Array, Array, Array]:
        part, part_h = gap / (gap + b), b / (gap + b) ** 2
        hot = 1.0 + 9.0 * (1.0 - part)
        return np.log(hot) - part * log_viscosity, -part * slope, -part_h * (9.0 / hot + log_viscosity)

    return ThinGapFlow(thinned)


LAWS: dict[str, Law] = {
    "newtonian": _newtonian,
    "eyring": _sheared("eyring", "eyring_stress"),
    "limiting": _sheared("limiting", "limiting_coefficient"),
    "slip": _slip,
    "capped": _capped,
    "warm": _warm,
}

# Half-width of a strip as small as that of a single short wave [m], and its Hertz pressure [Pa].
NARROW, STRIP_PRESSURE = 1e-7, 1e9


def smooth_line(*, nodes: int, speed: float) -> Case:
    """Smooth cylinder."""
    return rough_line(nodes=nodes, speed=speed)


def narrow_line(*, nodes: int, speed: float) -> Case:
    """Smooth cylinder as small as the cap of a short wave, surrounded by oil at ambient pressure."""
    load = 0.5 * np.pi * NARROW * STRIP_PRESSURE
    radius = 0.25 * NARROW * MODULUS / STRIP_PRESSURE
    return rough_line(nodes=nodes, speed=speed, load=load, reduced_radius=radius)


# Contacts at a speed. The shortest waves have at least sixteen nodes from 801 nodes of a line on, and eight
# from 65² nodes of the ball on.
SURFACES: dict[str, Callable[..., Case]] = {
    "line, smooth": smooth_line,
    "line, 0.1 µm wide": narrow_line,
    "line, Gaussian 200 nm": partial(rough_line, gaussian(200e-9, 20e-6, seed=4)),
    "line, sinusoid 140 nm": partial(rough_line, sinusoid(200e-9, 40e-6)),
    "ball, smooth": rough_point,
    "ball, Gaussian 100 nm": partial(rough_point, gaussian(100e-9, 34e-6, cutoff_short=60e-6)),
}

LINE_NODES = (201, 401, 801, 1601, 3201, 6401)
ROUGH_NODES = (801, 1601, 3201, 6401, 12_801)
POINT_NODES = (65, 129, 257)


@dataclass(frozen=True)
class Series:
    """Contact that is solved from grid to grid."""

    surface: str
    film: float  # central film of the formula for smooth surfaces and a Newtonian oil [m]
    boundary_film: float  # [m]
    law: str = "newtonian"
    number: float = 0.0  # number of the law, SI
    sliding: float = 0.0
    nodes: tuple[int, ...] = field(default=LINE_NODES, compare=False)
    onward: bool = field(default=True, compare=False)  # whether a grid starts from the film of the one before

    @property
    def key(self) -> tuple[str, ...]:
        """What tells this series from all others, as in the file of results."""
        numbers = (self.film, self.boundary_film, self.number, self.sliding)
        return (self.surface, self.law, *(f"{number:g}" for number in numbers))

    def problem(self, nodes: int) -> FilmProblem:
        """Film problem on a grid."""
        case = SURFACES[self.surface](nodes=nodes, speed=0.1)
        problem = posed(at_film(case.replace({"contact.boundary_film": self.boundary_film}), self.film))
        flow = LAWS[self.law](problem, self.number, self.sliding)
        return replace(problem, fluid=replace(problem.fluid, flow=flow))


COLUMNS = (
    *("surface", "law", "film", "boundary_film", "number", "sliding", "nodes"),
    *("spacing", "status", "residual", "carried", "share", "area", "mean_film", "minimum_film", "seconds"),
)

Record = dict[str, str]


def limited(seconds: float, problem: FilmProblem, known: list[GridSolution]) -> list[GridSolution]:
    """Solutions on all grids above the known one; none if they take more processor time than they may."""
    try:
        with processor_limit(seconds), quiet_solution():
            return nested_iteration(problem, None, known)
    except GivenUpError:
        return []


def solved(series: Series, limit: float) -> Iterator[Record]:
    """Records of a series, up to the grid that is given up, or on which no surface of a ball touches."""
    known: list[GridSolution] = []
    for nodes in series.nodes:
        problem = series.problem(nodes)
        started = time.process_time()
        solutions = limited(limit, problem, known)
        record = dict(zip(COLUMNS, series.key, strict=False)) | {"nodes": str(nodes)}
        numbers = {"seconds": time.process_time() - started}
        scales = problem.scales
        numbers["spacing"] = scales.length * (problem.outlet - problem.inlet) / (nodes - 1)
        if not solutions:
            yield record | {"status": "given up"} | {k: f"{v:.4g}" for k, v in numbers.items()}
            return
        film = MixedFilm(problem, solutions)
        final = film.last.final
        zone = film.zone & ~film.touching
        whole = 2.0 if film.mesh.y.size == 1 else 1.5 * problem.geometry.load
        numbers["minimum_film"] = scales.thickness * float(film.gap.min())
        numbers |= {"residual": final.norm, "share": film.share, "area": film.area / whole}
        if zone.any():
            weights = np.broadcast_to(film.last.level.weights, zone.shape)[zone]
            numbers["mean_film"] = scales.thickness * float(np.average(film.gap[zone], weights=weights))
        carried = "yes" if film.last.fraction is not None else "no"
        record |= {"status": film.last.status, "carried": carried}
        yield record | {k: f"{v:.4g}" for k, v in numbers.items()}
        if film.converged and film.mesh.y.size > 1 and not film.touching.any():
            return
        if film.converged and series.onward:
            known = solutions[-1:]


# Coefficient of the gap h = c x^1.5 beside a strip of half-width a that touches, c = 8 sqrt(2)/3 p/(E' a^0.5)
# with the largest pressure p of the strip and E' = 2 E*.
_EDGE = 8.0 * np.sqrt(2.0) / 3.0


@dataclass(frozen=True)
class Edge:
    """Edge of a strip that touches, into which oil flows."""

    half_width: float  # [m]
    oil_pressure: float  # pressure of the oil far from the edge [Pa]
    speed: float  # mean speed of the surfaces [m/s]
    pressure: float = 1e9  # largest pressure of the strip [Pa]
    modulus: float = MODULUS  # reduced modulus E' [Pa]
    pressure_viscosity: float = 20e-9  # [1/Pa], Barus

    @property
    def steepness(self) -> float:
        """c of the gap c x^1.5 beside the strip [m^-0.5]."""
        return _EDGE * self.pressure / (self.modulus * np.sqrt(self.half_width))

    def length(self, film: float) -> float:
        """Distance from the edge at which the gap has opened by a film [m]."""
        return float((film / self.steepness) ** (2.0 / 3.0))

    def floats(self, film: float, law: str, number: float, sliding: float) -> bool:
        """Whether the oil reaches the pressure of the strip before its edge, of a boundary film [m]."""

        def rise(log_x: float, p: Array) -> list[float]:
            x = np.exp(-log_x)
            opened = self.steepness * x**1.5
            h = film + opened
            fluidity = self._fluidity(float(p[0]), h, law, number, sliding)
            return [12.0 * self.speed / fluidity * opened / h**3 * x]

        def reached(_log_x: float, p: Array) -> float:
            return float(p[0]) - self.pressure

        reached.terminal = True  # type: ignore[attr-defined]
        ends = -np.log(self.half_width), -np.log(1e-4 * self.length(film))
        found = solve_ivp(rise, ends, [self.oil_pressure], events=reached, method="LSODA", rtol=1e-6)
        return bool(found.status == 1)

    def _fluidity(self, p: float, h: float, law: str, number: float, sliding: float) -> float:
        """1/viscosity [1/(Pa s)] of the flow along the slope of the pressure, where surfaces slide."""
        log_viscosity = min(self.pressure_viscosity * p, 60.0)
        found = np.exp(-log_viscosity) / VISCOSITY
        if law == "slip":
            found *= 1.0 + 6.0 * number / h
        elif law == "capped":
            found += 1.0 / number
        elif law == "warm":
            part = h / (h + number)
            found = np.exp(-part * log_viscosity) * (1.0 + 9.0 * (1.0 - part)) / VISCOSITY
        elif law == "eyring":
            found *= np.hypot(1.0, sliding * self.speed / (h * found * number))
        elif law == "limiting":
            stress = number * np.hypot(p, LIMIT_FLOOR)
            found *= (1.0 + (sliding * self.speed / (h * found * stress)) ** 5) ** 0.2
        return float(found)

    def least_film(self, law: str, number: float, sliding: float) -> float:
        """Thinnest boundary film at which the strip touches [m], by bisection."""
        low, high = np.log(1e-11), np.log(1e-5)
        while high - low > 1e-3:
            middle = 0.5 * (low + high)
            if self.floats(float(np.exp(middle)), law, number, sliding):
                low = middle
            else:
                high = middle
        return float(np.exp(high))


def print_edges() -> None:
    """Thinnest boundary film [nm] at which strips touch, over law, width of the strip and pressure around."""
    at = [(a, p) for a in (5e-6, 1e-7) for p in (1e5, 2e8, 5e8)]
    head("law", *(f"{1e6 * a:g} µm, {1e-9 * p:.1f} GPa" for a, p in at))
    for law, number, sliding in EDGE_LAWS:
        edges = [Edge(half_width=a, oil_pressure=p, speed=BALL_SPEED) for a, p in at]
        films = [edge.least_film(law, number, sliding) for edge in edges]
        row(f"{law} {number:g}, {sliding:g}", *(f"{1e9 * film:.2g}" for film in films))
    print()


def _laws(
    surface: str, film: float, boundary_film: float, laws: list[tuple[str, float, float]], **more: Any
) -> list[Series]:
    """Series of one contact over laws with their numbers and slide-to-roll ratios."""
    return [Series(surface, film, boundary_film, *law, **more) for law in laws]


NANO = 1e-9

# Laws of the smooth lines, with their numbers in SI units and slide-to-roll ratios.
SMOOTH_LAWS = [
    ("eyring", 5e6, 1.0),
    ("eyring", 5e5, 1.0),
    ("limiting", 0.05, 1.0),
    ("slip", 1 * NANO, 0.0),
    ("slip", 10 * NANO, 0.0),
    ("warm", 1 * NANO, 0.0),
    ("warm", 10 * NANO, 0.0),
    ("capped", 1e3, 0.0),
    ("capped", 1.0, 0.0),
    ("capped", 0.1, 0.0),
    ("capped", 0.02, 0.0),
]
ROUGH_LAWS = [
    ("eyring", 5e6, 1.0),
    ("limiting", 0.05, 1.0),
    ("slip", 10 * NANO, 0.0),
    ("warm", 10 * NANO, 0.0),
    ("capped", 1.0, 0.0),
]
EDGE_LAWS = [("newtonian", 0.0, 0.0), ("eyring", 5e6, 1.0), ("eyring", 5e5, 1.0), *ROUGH_LAWS[1:]]

# Mean speed of the surfaces at which the smooth ball has a film of 11 nm by the formula [m/s].
BALL_SPEED = 0.011


def parts() -> dict[str, list[Series]]:
    """Series by what they show."""
    apart: dict[str, Any] = {"nodes": LINE_NODES, "onward": False}
    rough: dict[str, Any] = {"nodes": ROUGH_NODES}
    point: dict[str, Any] = {"nodes": POINT_NODES}
    coarse: dict[str, Any] = {"nodes": POINT_NODES[:2]}
    line, ball = "line, Gaussian 200 nm", "ball, Gaussian 100 nm"
    return {
        "smooth": [
            *(
                Series("line, smooth", 2 * NANO, part * 2 * NANO, **apart)
                for part in (0.25, 0.5, 0.7, 0.8, 1, 1.5)
            ),
            *_laws("line, smooth", 2 * NANO, 1 * NANO, SMOOTH_LAWS, **apart),
            *(
                Series("ball, smooth", 10 * NANO, part * 10 * NANO, **point, onward=False)
                for part in (0.25, 0.5, 1, 1.5)
            ),
        ],
        "narrow": [
            *(
                Series("line, 0.1 µm wide", 2 * NANO, part * NANO, *law, **apart)
                for law in (("newtonian", 0.0, 0.0), ("eyring", 5e6, 1.0), ("eyring", 5e5, 1.0))
                for part in (0.3, 1, 1.3, 2)
            ),
        ],
        "ball": [
            *(Series(ball, 3.2 * NANO, part * NANO, **point) for part in (1, 2, 5)),
            *_laws(ball, 3.2 * NANO, 1 * NANO, ROUGH_LAWS, **coarse),
            *(Series(ball, 11 * NANO, part * NANO, **coarse) for part in (1, 2)),
            *(Series(ball, 11 * NANO, part * NANO, **point) for part in (10, 5)),
        ],
        "line": [
            *(Series(line, 38 * NANO, part * NANO, **rough) for part in (1, 5)),
            *(Series(line, 13 * NANO, part * NANO, **rough) for part in (1, 2, 5)),
            *(Series(line, 3.8 * NANO, part * NANO, **rough) for part in (0.5, 1, 2)),
            *_laws(line, 3.8 * NANO, 1 * NANO, ROUGH_LAWS, **rough),
            Series("line, sinusoid 140 nm", 3.8 * NANO, 1 * NANO, **rough),
        ],
    }


def stored() -> list[Record]:
    """Records of the file."""
    if not DATA.exists():
        return []
    with DATA.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write(records: list[Record]) -> None:
    """Write the file anew."""
    with DATA.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(records)


def of_series(series: Series, records: list[Record]) -> list[Record]:
    """Records of a series."""
    columns = COLUMNS[: len(series.key)]
    return [record for record in records if tuple(record[name] for name in columns) == series.key]


def cell(record: Record) -> str:
    """Load share and area in per cent; why there is none."""
    if record["status"] != "converged":
        return record["status"]
    return f"{percent(float(record['share']))}, {percent(float(record['area']))}"


def print_series(all_series: list[Series], records: list[Record]) -> None:
    """Load share and area from grid to grid, and the mean film of the last grid."""
    before: tuple[int, ...] = ()
    for series in all_series:
        found = {int(record["nodes"]): record for record in of_series(series, records)}
        if not found:
            continue
        if series.nodes != before:
            print()
            head(
                "surface",
                "film nm",
                "boundary film nm",
                "law",
                "sliding",
                *map(str, series.nodes),
                "mean film nm",
            )
        before = series.nodes
        films = [record["mean_film"] for record in found.values() if record.get("mean_film")]
        row(
            series.surface,
            f"{1e9 * series.film:g}",
            f"{1e9 * series.boundary_film:g}",
            f"{series.law} {series.number:g}" if series.number else series.law,
            f"{series.sliding:g}",
            *(cell(found[nodes]) if nodes in found else "" for nodes in series.nodes),
            f"{1e9 * float(films[-1]):.3g}" if films else "",
        )


# Share below which a point is drawn as a triangle at the lower edge.
_LEAST = 1e-5


def _drawn(axis: Any, series: Series, records: list[Record], *, label: str, style: str) -> None:
    """Curve of the load share over the spacing [µm]."""
    found = [record for record in of_series(series, records) if record["status"] == "converged"]
    at = np.array([1e6 * float(record["spacing"]) for record in found])
    share = np.array([float(record["share"]) for record in found])
    (line,) = axis.loglog(at, np.maximum(share, _LEAST), style, lw=1.6, ms=4, marker="o", label=label)
    none = share < _LEAST
    axis.loglog(at[none], np.full(none.sum(), _LEAST), "v", color=line.get_color(), ms=7, clip_on=False)


def draw(records: list[Record]) -> None:
    """Load share over the spacing of a smooth line and of a rough ball."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    figure, axes = plt.subplots(1, 2, figsize=(7.4, 5.2), sharey=True)
    figure.subplots_adjust(left=0.1, right=0.98, top=0.94, bottom=0.34, wspace=0.08)
    smooth, ball = parts()["smooth"], parts()["ball"]
    for axis, chosen, surface, film, ticks in (
        (axes[0], smooth, "line, smooth", 2 * NANO, (0.2, 0.5, 1, 2, 5)),
        (axes[1], ball, "ball, Gaussian 100 nm", 3.2 * NANO, (2, 4, 6)),
    ):
        for series in chosen:
            if (series.surface, series.film) != (surface, film):
                continue
            style = CURVES.get((series.law, round(series.boundary_film / NANO, 1), series.number))
            if style is not None:
                _drawn(axis, series, records, label=style[0], style=style[1])
        axis.set(xlabel="spacing of the nodes, µm", ylim=(_LEAST, 1.3))
        axis.invert_xaxis()
        axis.set_xticks(ticks)
        axis.xaxis.set_major_formatter(ScalarFormatter())
        axis.xaxis.set_minor_formatter(NullFormatter())
    axes[0].set_ylabel("share of the load on asperities")
    axes[0].set_title("Smooth line, film of 2 nm", fontsize=11)
    axes[1].set_title("Rough ball, smooth film of 3.2 nm", fontsize=11)
    entries: dict[str, Any] = {}
    for axis in axes:
        handles, labels = axis.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    names = [name for name, _ in CURVES.values() if name in entries]
    lines = [entries[name] for name in names]
    figure.legend(
        lines, names, title="boundary film, and law of the oil", loc="lower center", ncols=3, fontsize=9
    )
    figure.savefig(FIGURE, dpi=150)


# Legend and style of the curves that are drawn, by law, boundary film [nm] and number of the law.
CURVES = {
    ("newtonian", 0.5, 0.0): ("0.5 nm", "C0-"),
    ("newtonian", 1.0, 0.0): ("1 nm", "C1-"),
    ("newtonian", 1.6, 0.0): ("1.6 nm", "C2-"),
    ("newtonian", 2.0, 0.0): ("2 nm", "C3-"),
    ("newtonian", 5.0, 0.0): ("5 nm", "C4-"),
    ("eyring", 1.0, 5e6): ("1 nm, Eyring", "C5--"),
    ("slip", 1.0, 1 * NANO): ("1 nm, slip 1 nm", "C6--"),
    ("slip", 1.0, 10 * NANO): ("1 nm, slip 10 nm", "C6:"),
    ("warm", 1.0, 10 * NANO): ("1 nm, hot thin gaps", "C7--"),
    ("capped", 1.0, 1.0): ("1 nm, at most 1 Pa s", "C8--"),
}


def main() -> None:
    """Solve what is asked for, and print the tables."""
    options = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument(
        "parts", nargs="*", choices=[*parts(), []], help="what to show; all if none is given"
    )
    options.add_argument("--solve", action="store_true", help="solve what the file of results does not hold")
    options.add_argument("--limit", type=float, default=60.0, help="processor time of one film [s]")
    options.add_argument("--only", default="", help="law to solve in place of all")
    chosen = options.parse_args()
    for part in chosen.parts or parts():
        all_series = parts()[part]
        for series in all_series if chosen.solve else ():
            if chosen.only in series.law and not of_series(series, stored()):
                new = []
                for record in solved(series, chosen.limit):
                    new.append(record)
                    row(*series.key, record["nodes"], cell(record), record["seconds"])
                write([*stored(), *new])
        print_series(all_series, stored())
    print()
    print_edges()
    draw(stored())


if __name__ == "__main__":
    main()
