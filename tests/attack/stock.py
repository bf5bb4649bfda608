"""Files that the attack mutates: small inputs of every kind, and results and databases made of them."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from tests.attack.runner import REPOSITORY, Runner
from tests.helpers.surface_writers import al3d, x3p

EXAMPLES = REPOSITORY / "examples"
SURFACES = REPOSITORY / "tests" / "data" / "surfaces"

_PAPER = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": "4 m/s"}
_ELECTRIC = {
    "electric": {"potential_1": "0 V", "potential_2": "2 V"},
    "discharge": {"dielectric_strength": "15 V/um"},
}
_ROUGH = {"wavelength": "60 um", "amplitude": "20 nm", "generator": "sinusoid", "surface": 1}

CASES: dict[str, dict[str, Any]] = {
    "line": {
        "title": "line", "contact": {**_PAPER, "load_per_length": "1 MN/m"}, "lubricant": {"base": "paper"},
        "grid": {"nodes": 257}, **_ELECTRIC,
    },
    "point": {
        "title": "point",
        "contact": {
            "geometry": "point", "radius_x": "10 mm", "radius_y": "12 mm", "reduced_modulus": "226 GPa",
            "load": "20 N", "entrainment_speed": "1 m/s",
        },
        "lubricant": {"base": "paper"}, "grid": {"nodes": 65}, **_ELECTRIC,
    },
    "rough": {
        "title": "rough", "contact": {**_PAPER, "max_hertz_pressure": "0.7 GPa"},
        "lubricant": {"base": "paper"},
        "roughness": [_ROUGH, {"surface": 2, "file": "profile.csv", "form": "line", "cutoff_short": "8 um"}],
        "grid": {"nodes": 257}, **_ELECTRIC,
    },
    "moving": {
        "title": "moving",
        "contact": {**_PAPER, "max_hertz_pressure": "0.5 GPa", "slide_to_roll_ratio": 0.5},
        "lubricant": {"base": "paper"}, "roughness": [_ROUGH], "grid": {"nodes": 129},
        "motion": {"passes": 0.2, "record": 8}, **_ELECTRIC,
    },
}  # fmt: skip


def _example(name: str) -> dict[str, Any]:
    return tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))


_BALL = _example("bearing_6208")

# Small models of a bearing's use; the library has their dimensions.
BEARINGS: dict[str, dict[str, Any]] = {
    "bearing_6208": _BALL,
    "ranges": {
        **_BALL,
        "bearing": {**_BALL["bearing"], "base": "6205", "film_factor": 0.8},
        "ranges": {
            "bearing.temperature": ["60 degC", "80 degC"],
            "discharge.dielectric_strength": ["10 V/um", "20 V/um"],
        },
    },
    "roller": {
        **_BALL,
        "bearing": {
            **{key: value for key, value in _BALL["bearing"].items() if key != "axial_load"},
            "base": "nu-215",
            "profile": "logarithmic",
            "radial_load": "20 kN",
        },
    },
}


# A drive for a few periods of its carrier, with contacts by formula.
DRIVE: dict[str, Any] = {
    "title": "drive",
    "drive": {"speed": "1500 rpm", "contacts": "formula", "duration": "2 ms", "seed": 4},
    **{name: _example("drive")[name] for name in ("source", "circuit", "breakdown")},
    "drive_end": _BALL,
}

SWEEPS: dict[str, dict[str, Any]] = {
    "grid": {
        "title": "grid", "case": "line.toml",
        "vary": {
            "contact.entrainment_speed": ["2 m/s", "4 m/s"],
            "contact.load_per_length": {"from": "0.8 MN/m", "to": "1.2 MN/m", "count": 2, "spacing": "log"},
        },
    },
    "sobol": {
        "title": "sobol", "case": "line.toml", "design": "sobol", "samples": 16, "seed": 1,
        "vary": {
            "contact.entrainment_speed": {"from": "2 m/s", "to": "4 m/s"},
            "discharge.dielectric_strength": {"from": "12 V/um", "to": "18 V/um"},
        },
    },
}  # fmt: skip


def write_toml(path: Path, table: dict[str, Any]) -> None:
    """Write a table as a TOML file."""
    path.write_bytes(tomli_w.dumps(table).encode("utf-8", "surrogatepass"))


@dataclass(frozen=True)
class Stock:
    """Folder of files to mutate.

    Attributes
    ----------
    folder : Path
        Folder with the inputs, and a folder of results for each of them.
    surfaces : tuple of Path
        Surfaces of all formats that are read without further packages.
    results : tuple of Path
        NetCDF files of stationary, moving and whole-bearing results.
    databases : tuple of Path
        Databases of sweeps: a grid and a Sobol design.
    scheduler : callable
        Starts a Dask cluster whose workers lack the package, when it is first called; the address.
    """

    folder: Path
    surfaces: tuple[Path, ...]
    results: tuple[Path, ...]
    databases: tuple[Path, ...]
    scheduler: Callable[[], str]


def write_inputs(folder: Path) -> tuple[Path, ...]:
    """Write all inputs and surfaces into a folder; the paths of the surfaces."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, table in {**CASES, **BEARINGS, **SWEEPS}.items():
        write_toml(folder / f"{name}.toml", table)
    draw = np.random.default_rng(5)
    profile = np.cumsum(draw.normal(size=400)) * 5e-9
    lines = [f"{0.5 * k:.4g},{1e6 * z:.6g}" for k, z in enumerate(profile)]
    (folder / "profile.csv").write_text("position (um),height (um)\n" + "\n".join(lines) + "\n")
    heights = draw.normal(size=(18, 24)) * 1e-7
    (folder / "matrix.txt").write_text("\n".join(" ".join(f"{1e6 * z:.5g}" for z in row) for row in heights))
    x3p(folder / "map.x3p", heights)
    al3d(folder / "map.al3d", heights)
    return tuple(folder / name for name in ("profile.csv", "matrix.txt", "map.x3p", "map.al3d"))


def make(folder: Path, runner: Runner) -> Stock:
    """Write all inputs, and solve them for results and databases to mutate."""
    surfaces = write_inputs(folder)
    for name in CASES:
        _done(runner, folder, "run", f"{name}.toml", "-o", name, "--no-plots")
    _done(
        runner, folder, "bearing", "bearing_6208.toml", "-o", "bearing", "--contacts", "formula", "--no-plots"
    )
    for name in SWEEPS:
        _done(runner, folder, "sweep", f"{name}.toml", "-o", name, "--workers", "1")
    results = tuple(sorted(folder.glob("*/*.nc")))
    databases = tuple(folder / name / "sweep.sqlite" for name in SWEEPS)
    stored = tuple(path for path in results if path.name != "sweep.nc")
    return Stock(folder, surfaces, stored, databases, runner.scheduler)


def _done(runner: Runner, folder: Path, *words: str) -> None:
    outcome = runner.run(*words, folder=folder)
    if outcome.status != 0:
        raise AssertionError(f"{' '.join(words)}: {outcome.err}")
