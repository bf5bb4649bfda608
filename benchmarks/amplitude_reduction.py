"""Amplitude reduction of waviness in the film of a line contact in pure rolling.

python -m benchmarks.amplitude_reduction    (ten minutes: writes the table of docs/data and its figure)
python -m benchmarks.amplitude_reduction --figure    (fit and figure from the existing table)

As defined by Venner, Couhier, Lubrecht and Greenwood, Amplitude reduction of waviness in transient EHL line
contacts, Tribology Series 32 (1997) 103-112, doi:10.1016/S0167-8922(08)70440-1.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares

from ehlectric import Case
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import film_problem
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.runtime.threads import quiet_solution

ROOT = Path(__file__).parents[1]
TABLE = ROOT / "docs/data/amplitude_reduction.csv"
FIGURE = ROOT / "docs/figures/amplitude_reduction.png"
PUBLISHED = ROOT / "tests/data/published/amplitude_reduction.csv"

# Oil, steel and radius of Venner et al.; load and speed follow from M and L.
RADIUS, MODULUS, VISCOSITY, ALPHA = 14.1e-3, 226e9, 0.04, 22e-9
LUBRICANT = {"base": "paper", "roelands_pressure": 1.96e8}

HEADER = """\
# Amplitude reduction of waviness in line contacts in pure rolling, by benchmarks/amplitude_reduction.py:
# A_d/A_i as Venner et al. (1997) define it, doi:10.1016/S0167-8922(08)70440-1, error of it from the grid of
# half the nodes; wavelength over b, amplitude over the smooth central film H = h R/b^2.
"""

# Least number of time steps per wavelength, and largest number of grid spacings per step. Whole numbers of
# spacings need no interpolation.
STEPS_A_WAVELENGTH, MOST_SPACINGS = 100, 4

# M, L, inlet of the domain, and wavelengths divided by the half-width.
STUDY = (
    (100.0, 11.0, -2.5, (4.0, 2.0, 1.0, 0.5, 0.25, 0.125)),
    (20.0, 5.0, -4.0, (2.0, 1.0, 0.5, 0.25)),
    (20.0, 15.0, -4.0, (2.0, 1.0, 0.25)),
    (50.0, 10.0, -2.5, (2.0, 0.5, 0.25)),
    (100.0, 5.0, -2.5, (1.0, 0.25)),
    (200.0, 8.0, -2.5, (1.0, 0.25)),
    (200.0, 15.0, -2.5, (2.0, 0.5, 0.125)),
    (500.0, 8.0, -2.5, (1.0, 0.25)),
)


@dataclass(frozen=True)
class Reduction:
    """Computed amplitude reduction of one waviness in one contact.

    ``wavelength`` is divided by the half-width b, ``amplitude`` by the smooth central film ``central`` (H at
    X = 0). ``ratio`` is A_d/A_i. ``error`` is a third of the difference from the grid of half the nodes, as
    for a scheme of second order.
    """

    moes_m: float
    moes_l: float
    wavelength: float
    amplitude: float
    nodes: int
    central: float
    ratio: float
    error: float

    @property
    def nabla(self) -> float:
        """Parameter (wavelength/b) M^(3/4)/L^(1/2) of the published fit."""
        return self.wavelength * self.moes_m**0.75 / self.moes_l**0.5


def contact(moes_m: float, moes_l: float, *, nodes: int, inlet: float = -2.5, outlet: float = 1.5) -> Case:
    """Line contact with given Moes groups: the speed follows from L, the load from M."""
    # 2 U and W of M = W (2 U)^(-1/2), L = alpha E' (2 U)^(1/4).
    double_speed = (moes_l / (ALPHA * MODULUS)) ** 4
    return Case.from_dict(
        {
            "contact": {
                "reduced_radius": RADIUS,
                "reduced_modulus": MODULUS,
                "load_per_length": moes_m * double_speed**0.5 * MODULUS * RADIUS,
                "entrainment_speed": 0.5 * double_speed * MODULUS * RADIUS / VISCOSITY,
            },
            "lubricant": LUBRICANT | {"viscosity": VISCOSITY, "pressure_viscosity_coefficient": ALPHA},
            "grid": {"nodes": nodes, "inlet": inlet, "outlet": outlet},
        }
    )


def waviness(
    amplitude: float, wavelength: float, front: float
) -> Callable[[float, NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]:
    """Gap of a sinusoid that moves with the mean speed, its front at X = ``front`` at T = 0."""

    def gap(time: float, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        behind = (x - front - time) / wavelength
        ramp = 10.0 ** (-10.0 * np.maximum(0.0, behind) ** 2)
        wave = -amplitude * ramp * np.cos(2.0 * np.pi * behind)
        return wave[:, np.newaxis] + np.zeros_like(y)

    return gap


def amplitude_reduction(
    moes_m: float,
    moes_l: float,
    wavelength: float,
    amplitude: float = 0.1,
    nodes: int = 1601,
    inlet: float = -2.5,
) -> Reduction:
    """A_d/A_i of a waviness in pure rolling, on two grids.

    Parameters
    ----------
    moes_m, moes_l : float
        M and L of the sum of the surface speeds.
    wavelength, amplitude : float
        Wavelength divided by the half-width; amplitude divided by the smooth film at X = 0.
    nodes : int
        Nodes of the finer grid.
    inlet : float
        X where the domain begins; it ends at 1.5.
    """
    grids = [_on_grid(moes_m, moes_l, wavelength, amplitude, n, inlet) for n in (nodes // 2 + 1, nodes)]
    (coarse, _), (fine, central) = grids
    return Reduction(moes_m, moes_l, wavelength, amplitude, nodes, central, fine, abs(fine - coarse) / 3.0)


def _on_grid(
    moes_m: float, moes_l: float, wavelength: float, amplitude: float, nodes: int, inlet: float
) -> tuple[float, float]:
    """Ratio A_d/A_i and smooth central film H(0) on one grid."""
    case = contact(moes_m, moes_l, nodes=nodes, inlet=inlet)
    problem = film_problem(case, resolve(case))
    with quiet_solution():
        steady = nested_iteration(problem, None)[-1]
        assert steady.status == "converged", steady.status
        mesh = steady.level.mesh
        central = at_centre(mesh, steady.state.thickness)
        # Half a wavelength ahead of its front the waviness has a third of a per cent of its height.
        film = UnsteadyFilm(problem, waviness(amplitude * central, wavelength, inlet - 0.5 * wavelength))
        spacings = int(np.clip(wavelength / (STEPS_A_WAVELENGTH * mesh.dx), 1, MOST_SPACINGS))
        duration = np.ptp(mesh.x) + 0.5 * wavelength + max(1.0, 2.0 * wavelength)
        times, films = _central_films(film, steady, spacings * mesh.dx, duration)
    # By the end, the whole contact has been wavy for two periods.
    last = np.linspace(times[-1] - wavelength, times[-1], 2001)
    return float(np.ptp(CubicSpline(times, films)(last))) / (2.0 * amplitude * central), central


def _central_films(
    film: UnsteadyFilm, steady: GridSolution, step: float, duration: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times T and central films H(0, T) of all time steps."""
    history = film.start(steady, step)
    times, films = [0.0], [at_centre(film.level.mesh, steady.state.thickness)]
    while history.now.time < duration:
        history = film.advance(history, step)
        times.append(history.now.time)
        films.append(at_centre(film.level.mesh, history.now.state.thickness))
    return np.array(times), np.array(films)


def published_fit(nabla: NDArray[np.float64]) -> NDArray[np.float64]:
    """Amplitude reduction by eq. (5) of Venner et al. (1997)."""
    ratio: NDArray[np.float64] = 1.0 / (1.0 + 0.17 * nabla + 0.03 * nabla**2)
    return ratio


def fitted(nabla: NDArray[np.float64], ratio: NDArray[np.float64]) -> tuple[float, float]:
    """Parameters c and p of 1/(1 + c n^p), by least squares of the logarithms."""

    def misses(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        c, p = parameters
        return np.log(ratio) + np.log1p(c * nabla**p)

    c, p = least_squares(misses, (0.1, 1.5)).x
    return float(c), float(p)


def scatter(ratio: NDArray[np.float64], fit: NDArray[np.float64]) -> str:
    """Text with the root mean square and the maximum of the relative distance of points from a fit."""
    distance = 100.0 * (ratio / fit - 1.0)
    return f"scatter {np.sqrt(np.mean(distance**2)):.1f} %, at most {np.max(np.abs(distance)):.0f} %"


def study() -> list[Reduction]:
    """Compute all points; the table is written anew after each."""
    points = []
    for moes_m, moes_l, inlet, wavelengths in STUDY:
        for wavelength in wavelengths:
            points.append(amplitude_reduction(moes_m, moes_l, wavelength, inlet=inlet))
            print(points[-1], flush=True)
            write(points)
    return points


def write(points: list[Reduction]) -> None:
    """Write the points to the table."""
    with TABLE.open("w", newline="") as file:
        file.write(HEADER)
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*asdict(points[0]), "nabla"])
        for point in points:
            table.writerow([f"{value:.5g}" for value in (*asdict(point).values(), point.nabla)])


def read() -> list[Reduction]:
    """Points of the existing table."""
    with TABLE.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [
        Reduction(**{key: int(value) if key == "nodes" else float(value) for key, value in row.items()})
        for row in rows
        if row.pop("nabla")
    ]


def report(points: list[Reduction]) -> None:
    """Print the fit and its scatter, and draw the figure."""
    points = sorted(points, key=lambda point: point.nabla)
    nabla = np.array([point.nabla for point in points])
    ratio = np.array([point.ratio for point in points])
    c, p = fitted(nabla, ratio)
    ours, theirs = 1.0 / (1.0 + c * nabla**p), published_fit(nabla)
    print(f"{len(points)} points, {len({(p.moes_m, p.moes_l) for p in points})} pairs of (M, L)")
    print(f"1/(1 + {c:.4f} n^{p:.3f}): {scatter(ratio, ours)}")
    print(f"published fit: {scatter(ratio, theirs)}")
    print("    M    L lambda/b      n  ratio    error  over ours  over theirs")
    over_ours, over_theirs = 100.0 * (ratio / ours - 1.0), 100.0 * (ratio / theirs - 1.0)
    for one, own, other in zip(points, over_ours, over_theirs, strict=True):
        print(
            f"{one.moes_m:5g} {one.moes_l:4g} {one.wavelength:8g} {one.nabla:6.2f}"
            f" {one.ratio:.4f} {one.error:8.4f} {own:+8.1f} % {other:+10.1f} %"
        )
    draw(points, (c, p))


def draw(points: list[Reduction], fit: tuple[float, float]) -> None:
    """Draw the ratio over nabla, with both fits and the published table."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.0, 4.6), layout="constrained")
    groups = sorted({(p.moes_m, p.moes_l) for p in points})
    for (moes_m, moes_l), marker in zip(groups, "osD^v<>P", strict=False):
        own = [p for p in points if (p.moes_m, p.moes_l) == (moes_m, moes_l)]
        label = f"M = {moes_m:g}, L = {moes_l:g}"
        axes.plot([p.nabla for p in own], [p.ratio for p in own], marker, ms=5, label=label)
    with PUBLISHED.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    printed = [(float(row["wavelength"]), float(row["ratio"])) for row in rows if row["amplitude"] == "0.1"]
    nabla = [wavelength * 100**0.75 / 11**0.5 for wavelength, _ in printed]
    axes.plot(nabla, [ratio for _, ratio in printed], "k+", ms=9, label="Venner et al., M = 100, L = 11")
    n = np.geomspace(0.3, 60.0, 200)
    axes.plot(n, published_fit(n), "k--", lw=1, label="their fit")
    axes.plot(
        n, 1.0 / (1.0 + fit[0] * n ** fit[1]), "k-", lw=1, label=f"1/(1 + {fit[0]:.3f} n$^{{{fit[1]:.2f}}}$)"
    )
    axes.set(xscale="log", ylim=(0.0, 1.02))
    axes.set(xlabel="(wavelength/b) M$^{3/4}$/L$^{1/2}$", ylabel="amplitude left, A$_d$/A$_i$")
    axes.legend(fontsize="small")
    FIGURE.parent.mkdir(exist_ok=True)
    figure.savefig(FIGURE, dpi=150)


if __name__ == "__main__":
    report(read() if "--figure" in sys.argv else study())
