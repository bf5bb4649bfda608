"""Solve examples/ball_contact.toml with public packages, and print the table of packages.md.

python benchmarks/public_solvers.py

For each package, a virtual environment is made in a temporary folder and the package is installed from the
registry. This takes up to an hour. The packages get the Python that runs this file.
"""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np

from benchmarks import cases
from benchmarks.measure import best
from benchmarks.point_contacts import markdown
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import resolve_point
from ehlectric.film.isothermal_film import solve_point_film

WORKERS = Path(__file__).with_name("public_workers.py")
GRIDS = (65, 129)
# Finest grid of our solver, with which the films of all packages are compared.
FINEST = 513
# Seconds a solution may take; a finer grid is left out where no solution on the coarser one took less.
LIMIT = 300.0
INSTALL_LIMIT = 600.0
# Replaces the limit of iterations of a package.
ITERATIONS = 1_000_000


@dataclass(frozen=True)
class Package:
    """A package of the registry.

    ``lacks`` says which part of the contact it cannot solve. ``needs`` are the requirements to install if its
    own cannot be met. ``grids`` are the grids it solves on, and ``relaxations`` its under-relaxation factors,
    its own default first.
    """

    name: str
    version: str
    lacks: str
    needs: tuple[str, ...] = ()
    grids: tuple[int, ...] = GRIDS
    relaxations: tuple[float, ...] = (1.0,)


PACKAGES = (
    Package(
        "slippy",
        "0.5.2",
        "no second-order wedge, no estimate of the error, the constants of its density are fixed",
        # The newest NumPy that still has np.float, and what goes with it.
        needs=(
            "numpy==1.23.5",
            "numba==0.57.1",
            "scipy==1.10.1",
            "scikit-image==0.20.0",
            "matplotlib==3.7.5",
            "pyfftw==0.13.1",
            "sympy",
            "tinydb",
            "setuptools<81",
            "wheel",
        ),
        relaxations=(0.1, 0.05, 0.2, 0.4, 0.8),
    ),
    Package(
        "tribology",
        "0.5.16",
        "no Reynolds equation: Hertz, a dry contact by boundary elements, and film-thickness formulas",
        needs=(
            "numpy",
            "scipy",
            "numexpr",
            "matplotlib",
            "opencv-python-headless",
            "setuptools<81",
            "wheel",
        ),
        grids=GRIDS[:1],
    ),
    Package(
        "GaPFlow",
        "1.2.0",
        "no ball or given profile, the gaps are bearings and sliders that do not touch undeformed; no load, "
        "the gap is fixed; explicit in time",
        grids=GRIDS[:1],
    ),
)


def contact() -> dict[str, Any]:
    """The contact of the example, SI units; ``along`` and ``across`` in half-widths of the dry contact."""
    case = Case.from_toml(cases.EXAMPLES / "ball_contact.toml")
    conditions, oil = resolve_point(case), case.oil
    return {
        "load": conditions.load,
        "radius": conditions.radius_x,
        "reduced_modulus": conditions.reduced_modulus,
        "speed": conditions.entrainment_speed,
        "half_width": conditions.semi_axis_x,
        "max_pressure": conditions.max_pressure,
        "viscosity": oil.viscosity,
        "alpha": oil.alpha,
        "roelands_z": oil.inputs["roelands_z"],
        "roelands_pressure": oil.inputs["roelands_pressure"],
        "along": [case.grid.inlet, case.grid.outlet],
        "across": [-conditions.side, conditions.side],
        "iterations": ITERATIONS,
    }


def installed(package: Package, folder: Path) -> tuple[Path | None, str]:
    """Python of a new environment with the package, or None if it cannot be installed, and the reason."""
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    python = folder / "bin" / "python"
    wanted = f"{package.name}=={package.version}"
    remark = _pip(python, wanted)
    if remark and package.needs:
        also = _pip(python, *package.needs) or _pip(python, "--no-deps", "--no-build-isolation", wanted)
        if not also:
            return python, f"`pip install {wanted}` fails ({remark}); installed without its version limits"
        remark = also
    return (None if remark else python), remark


def _pip(python: Path, *arguments: str) -> str:
    """Reason why pip did not install something, "" if it did."""
    # make limits the versions to those of this project's own environment.
    environment = {key: value for key, value in os.environ.items() if key != "PIP_CONSTRAINT"}
    command = [python, "-m", "pip", "install", "--quiet", *arguments]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=INSTALL_LIMIT, env=environment, check=False
        )
    except subprocess.TimeoutExpired:
        return f"not installed after {INSTALL_LIMIT:g} s"
    if done.returncode == 0:
        return ""
    reasons = re.findall(r"^\s*((?:\w*Error|ERROR): .*)$", done.stdout + done.stderr, re.MULTILINE)
    return reasons[0] if reasons else f"pip ended with {done.returncode}"


def answer(python: Path, package: str, problem: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Solution of a problem by a package, in a process of its own, on one thread."""
    threads = {f"{library}_NUM_THREADS": "1" for library in ("OMP", "OPENBLAS", "MKL", "NUMBA")}
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"} | threads
    command = [python, WORKERS, package, json.dumps(problem)]
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            timeout=LIMIT,
            env=environment,
            cwd=folder,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return {"said": f"stopped after {LIMIT:g} s", "converged": False}
    lines = done.stdout.splitlines()
    if done.returncode != 0 or not lines:
        return {"said": (done.stderr.splitlines() or ["no word"])[-1], "converged": False}
    taken: dict[str, Any] = json.loads(lines[-1])
    return taken


def package_rows(package: Package) -> Iterator[tuple[str, ...]]:
    """Rows of the table for one package."""
    name = f"{package.name} {package.version}"
    with tempfile.TemporaryDirectory() as folder:
        python, remark = installed(package, Path(folder) / "environment")
        if python is None:
            yield _row(name, "", {"said": f"not installed: {remark}"})
            return
        for nodes in package.grids:
            taken = []
            for relaxation in package.relaxations:
                problem = contact() | {"nodes": nodes, "relaxation": relaxation}
                taken.append(answer(python, package.name, problem, Path(folder)))
                if len(package.relaxations) > 1:
                    taken[-1]["said"] += f"; relaxation factor {relaxation:g}"
            own, fastest = taken[0], min(taken, key=_seconds)
            if remark:
                own["said"] += f"; {remark}"
                remark = ""
            for one in [own] if fastest is own else [own, fastest]:
                yield _row(name, f"{nodes} × {nodes}" if package.relaxations[1:] else "", one)
            if _seconds(fastest) == math.inf:
                return


def _seconds(taken: dict[str, Any]) -> float:
    """Seconds that a solution took, infinite if there is none."""
    return float(taken["seconds"]) if taken.get("converged") else math.inf


def own_rows() -> Iterator[tuple[str, ...]]:
    """Rows of the table for ehlectric."""
    for wedge in ("first-order", "second-order"):
        for nodes in (*GRIDS, FINEST):
            problem = cases.point_film_problem("ball_contact", nodes, wedge)
            film = solve_point_film(problem)
            taken = {
                "seconds": best(lambda p=problem: solve_point_film(p), 3),
                "minimum": film.minimum_thickness,
                "central": film.central_thickness,
                "converged": film.converged,
                "said": f"largest scaled residual {film.residual:.0e}",
            }
            yield _row(f"ehlectric, {wedge}", f"{nodes} × {nodes}", taken)


def _row(name: str, grid: str, taken: dict[str, Any]) -> tuple[str, ...]:
    converged = {True: "yes", False: "no", None: ""}[taken.get("converged")]
    films = [f"{taken[key] * 1e6:.4f}" if key in taken else "" for key in ("minimum", "central")]
    seconds = ""
    if "seconds" in taken:
        seconds = np.format_float_positional(taken["seconds"], 2, fractional=False, trim="-")
    return name, grid, seconds, *films, converged, taken["said"]


def main() -> None:
    """Print the table of docs/validation/packages.md."""
    head = ("package", "grid", "seconds", "h_min [µm]", "h(0) [µm]", "converged", "what it says")
    rows = [*own_rows()]
    for package in PACKAGES:
        print(f"{package.name} ...", file=sys.stderr, flush=True)
        rows += package_rows(package)
    markdown(head, iter(rows))
    for package in PACKAGES:
        print(f"{package.name}: {package.lacks}.")


if __name__ == "__main__":
    main()
