"""The open benchmark of films: contacts of a design, solved to a stated error, and written as tables.

python -m benchmarks.open_benchmark solve FOLDER [--part 0 --parts 2]   (what FOLDER lacks; resumes)
python -m benchmarks.open_benchmark write FOLDER                        (open_benchmark/ from FOLDER)

The tables are all that another program needs: ``contacts.csv`` has every input in SI units.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from scipy.stats import qmc

from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric import Case, ConvergenceError, solve
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.film.isothermal_film import Film, PointFilm
from ehlectric.lubricant.viscosity import roelands_exponent
from ehlectric.version import __version__

TARGET = Path(__file__).parents[1] / "open_benchmark"

RADIUS = 10e-3  # along entrainment, of all contacts [m]

# Reduced moduli [Pa], of steel on steel to plastic on steel: a contact has the largest with which it rolls at
# this speed [m/s] at least. Those that would roll faster than the other are left out of the sequence.
MODULI = (226e9, 50e9, 10e9)
SPEEDS = (0.01, 100.0)

ROELANDS, S0 = 1.96e8, 1.1  # constants of Roelands' law: p0 [Pa], and the slope index over the temperature

# Viscosity [Pa s], pressure-viscosity coefficient [1/Pa], and density law of each oil.
OILS: dict[str, tuple[float, float, str]] = {
    "thin": (0.005, 14e-9, "dowson-higginson"),
    "mineral": (0.04, 20e-9, "dowson-higginson"),
    "stiff": (0.2, 26e-9, "dowson-higginson"),
    "incompressible": (0.04, 20e-9, "incompressible"),
}
PERMITTIVITY = 2.2  # of all oils, at any pressure
VOLTAGE = 1.0  # between the surfaces [V]

# Oil and bodies of the contacts with heat: conductivity [W/m/K], heat capacity [J/kg/K] and density [kg/m^3].
OIL_HEAT = {"thermal_conductivity": 0.14, "heat_capacity": 2000.0, "density": 870.0}
STEEL = {"thermal_conductivity": 46.0, "heat_capacity": 460.0, "density": 7850.0}
EXPANSION, TEMPERATURE, EYRING = 6.5e-4, 313.15, 5e6  # [1/K], [K], [Pa]

# Hertz pressures of the contacts that are kept [Pa]; others are left out of the sequence.
PRESSURES = (0.02e9, 3.0e9)

# Candidates of a class for each contact that it has: a candidate that is not solved to its error is left out.
CANDIDATES = 1.4

ROUGH_INLET = -30.0  # of rough contacts, in half-widths
LIMIT = 150.0  # processor time of a candidate [s]

NODES = 201  # of a profile
ENDS = ((-2.0, 1.5), (-1.5, 1.5))  # of the profiles along x and y, in semi-axes

Table = dict[str, Any]


@dataclass(frozen=True)
class Class:
    """Class of contacts: how many, the lowest and highest values of the design, and the error to solve to."""

    number: int
    seed: int
    ranges: dict[str, tuple[float, float]]  # all are drawn evenly in their logarithm
    make: Callable[[dict[str, float], str], Table]  # inputs of a contact from its numbers and its oil
    error: float  # of the film, over its thickness


def speed_of(moes_l: float, modulus: float, viscosity: float, coefficient: float) -> float:
    """Entrainment speed [m/s] by Moes' L = alpha E' (2 eta u/(E' R))^(1/4).

    ``modulus`` [Pa]; ``viscosity`` [Pa s]; ``coefficient`` [1/Pa].
    """
    return 0.5 * (moes_l / (coefficient * modulus)) ** 4 * modulus * RADIUS / viscosity


def _rolling(at: dict[str, float], oil: str) -> tuple[Table, float]:
    """Modulus and speed of a contact from Moes' L, and the speed parameter 2 eta u/(E' R)."""
    viscosity, coefficient, _ = OILS[oil]
    speeds = {modulus: speed_of(at["moes_l"], modulus, viscosity, coefficient) for modulus in MODULI}
    modulus = next((modulus for modulus in MODULI if speeds[modulus] > SPEEDS[0]), MODULI[-1])
    speed = speeds[modulus]
    contact = {"reduced_modulus": modulus, "entrainment_speed": speed}
    return contact, 2.0 * viscosity * speed / (modulus * RADIUS)


def _line(at: dict[str, float], oil: str) -> Table:
    """Smooth line contact."""
    contact, speed = _rolling(at, oil)
    return contact | {"load_per_length": at["moes_m"] * speed**0.5 * contact["reduced_modulus"] * RADIUS}


def _point(at: dict[str, float], oil: str) -> Table:
    """Smooth point contact, with its ratio of the radii across and along entrainment."""
    contact, speed = _rolling(at, oil)
    load = at["moes_m"] * speed**0.75 * contact["reduced_modulus"] * RADIUS**2
    return contact | {"radius_y": at["radii"] * RADIUS, "load": load}


def _rough(at: dict[str, float], oil: str) -> Table:
    """Line contact with a wavy surface 1 at rest: amplitude over the film, wavelength over the half-width."""
    contact = _line(at, oil)
    half_width = np.sqrt(8.0 * contact["load_per_length"] * RADIUS / (np.pi * contact["reduced_modulus"]))
    film = _guess(contact, oil)
    return contact | {
        "waviness_amplitude": at["amplitude"] * film,
        "waviness_wavelength": at["wavelength"] * float(half_width),
    }


def _hot(at: dict[str, float], oil: str) -> Table:
    """Line contact with heat and shear, of surfaces that slide."""
    return _line(at, oil) | {"slide_to_roll_ratio": at["slip"], "temperature": TEMPERATURE}


def _guess(contact: Table, oil: str) -> float:
    """Film of a smooth line by Dowson and Higginson's formula [m], to which waves are scaled."""
    viscosity, coefficient, _ = OILS[oil]
    modulus = contact["reduced_modulus"]
    speed = viscosity * contact["entrainment_speed"] / (modulus * RADIUS)
    load = contact["load_per_length"] / (modulus * RADIUS)
    return float(2.65 * (coefficient * modulus) ** 0.54 * speed**0.7 * load**-0.13 * RADIUS)


CLASSES: dict[str, Class] = {
    "line": Class(100, 11, {"moes_m": (3.0, 300.0), "moes_l": (1.0, 20.0)}, _line, 1e-4),
    "point": Class(
        100, 12, {"moes_m": (5.0, 700.0), "moes_l": (1.0, 18.0), "radii": (0.5, 20.0)}, _point, 1e-3
    ),
    "rough": Class(
        20,
        13,
        {"moes_m": (5.0, 100.0), "moes_l": (4.0, 15.0), "amplitude": (0.03, 0.5), "wavelength": (0.1, 1.0)},
        _rough,
        1e-3,
    ),
    "hot": Class(20, 14, {"moes_m": (5.0, 100.0), "moes_l": (6.0, 15.0), "slip": (0.02, 1.0)}, _hot, 1e-3),
}


def contacts() -> Iterator[tuple[str, Table]]:
    """Names and inputs of all candidates."""
    for kind, drawn in CLASSES.items():
        yield from drawn_of(kind, round(CANDIDATES * drawn.number))


def drawn_of(kind: str, number: int) -> Iterator[tuple[str, Table]]:
    """Names and inputs of the first contacts of a class: a Sobol sequence, whose last number has the oil."""
    drawn, kept = CLASSES[kind], 0
    low, high = np.log(np.array(list(drawn.ranges.values())).T)
    for *unit, chosen in qmc.Sobol(low.size + 1, seed=drawn.seed).random(2048):
        at = dict(zip(drawn.ranges, np.exp(low + unit * (high - low)).tolist(), strict=True))
        oil = list(OILS)[int(chosen * len(OILS))]
        table = {"oil": oil, **drawn.make(at, oil)}
        if kept < number and _real(table):
            kept += 1
            yield f"{kind}-{kept:03d}", table | {"moes_m": at["moes_m"], "moes_l": at["moes_l"]}


def case_of(table: Table, error: float | None) -> Case:
    """Case of a contact; ``error`` of the film to solve to, None without a grid."""
    viscosity, coefficient, density = OILS[table["oil"]]
    contact: Table = {key: table[key] for key in ("reduced_modulus", "entrainment_speed")}
    if geometry_of(table) == "point":
        contact |= {"geometry": "point", "radius_x": RADIUS, "radius_y": table["radius_y"]}
        contact["load"] = table["load"]
    else:
        contact |= {"reduced_radius": RADIUS, "load_per_length": table["load_per_length"]}
    lubricant: Table = {
        "viscosity_law": "roelands",
        "pressure_viscosity_coefficient": coefficient,
        "roelands_pressure": ROELANDS,
        "roelands_z": roelands_exponent(viscosity, coefficient, ROELANDS),
        "density_law": density,
        "permittivity_law": "constant",
        "relative_permittivity": PERMITTIVITY,
        "ambient_pressure": 0.0,
        "viscosity": viscosity,
    }
    if density == "dowson-higginson":
        lubricant |= {"density_c1": 0.59e9, "density_c2": 1.34}
    whole: Table = {"contact": contact, "lubricant": lubricant}
    whole["electric"] = {"potential_1": 0.0, "potential_2": VOLTAGE}
    if "slide_to_roll_ratio" in table:
        contact |= {key: table[key] for key in ("slide_to_roll_ratio", "temperature")}
        contact |= {"body_1": STEEL, "body_2": STEEL}
        lubricant |= {"atmospheric_law": "roelands", "roelands_s0": S0, "eyring_stress": EYRING}
        lubricant |= {"thermal_expansion": EXPANSION, "reference_temperature": TEMPERATURE, **OIL_HEAT}
        whole["film"] = {"thermal": True, "rheology": "eyring"}
    if "waviness_amplitude" in table:
        wave = {"amplitude": table["waviness_amplitude"], "wavelength": table["waviness_wavelength"]}
        whole["roughness"] = [{"surface": 1, "generator": "sinusoid", **wave}]
    if error is not None:
        whole["grid"] = {"error": error}
        if "waviness_amplitude" in table:
            # The program widens the domain of smooth contacts only.
            whole["grid"] |= {"inlet": ROUGH_INLET, "outlet": 2.0}
    return Case.from_dict(whole)


def geometry_of(table: Table) -> str:
    """Geometry of a contact, line or point."""
    return "point" if "radius_y" in table else "line"


def _real(table: Table) -> bool:
    """Whether speed and Hertz pressure of a contact are within their bounds."""
    if table["entrainment_speed"] > SPEEDS[1]:
        return False
    pressure = KINDS[geometry_of(table)].resolve(case_of(table, None)).max_pressure
    return bool(PRESSURES[0] < pressure < PRESSURES[1])


def solved(table: Table, error: float) -> tuple[Table, np.ndarray]:
    """Results of a contact, and its profiles along x and, of a point, along y, shape (3 or 6, n).

    A row of positions over the semi-axis is followed by pressure [Pa] and film [m], axis by axis.
    """
    start = process_time()
    result = solve(case_of(table, error))
    summary = result.summary()
    film, field, dry = summary["film"], summary["field"], summary["hertz"]
    heat = film if "slide_to_roll_ratio" in table else {}
    point = geometry_of(table) == "point"
    axes = [dry["semi_axis_x"], dry["semi_axis_y"]] if point else [dry["half_width"]]
    row = {
        "half_width": axes[0],
        "semi_axis_y": axes[1] if point else None,
        "hertz_pressure": dry["max_pressure"],
        "central_film": film["central_thickness"],
        "minimum_film": film["minimum_thickness"],
        "mean_film": film["mean_thickness"],
        "film_error": film["discretisation_error"],
        "domain_error": result.film.domain_loss,
        "max_pressure": film["max_pressure"],
        "max_pressure_error": film["max_pressure_error"],
        "traction_coefficient": heat.get("traction_coefficient"),
        "temperature_rise": heat.get("max_temperature_rise"),
        "temperature_rise_error": heat.get("temperature_rise_error"),
        "capacitance": field["capacitance" if point else "capacitance_per_length"],
        "max_field": field["max_strength"],
        "max_field_error": field["max_strength_error"],
        "nodes": film["nodes"],
        "seconds": process_time() - start,
        "warnings": ";".join(summary["warning_codes"]),
    }
    profiles = []
    for axis, (length, ends) in enumerate(zip(axes, ENDS, strict=False)):
        at = np.linspace(*ends, NODES)
        lines = [_along(result.film, axis, each) for each in (result.film.pressure, result.film.thickness)]
        profiles += [at, *(np.interp(length * at, result.film.axes[axis], line) for line in lines)]
    return row, np.array(profiles)


def _along(film: Film | PointFilm, axis: int, values: np.ndarray) -> np.ndarray:
    """Nodal values along an axis of the contact, through its middle."""
    if values.ndim == 1:
        return values
    middle = [int(np.argmin(np.abs(nodes))) for nodes in film.axes]
    return values[:, middle[1]] if axis == 0 else values[middle[0]]


def class_of(name: str) -> str:
    """Class of a contact, from its name."""
    return name.rsplit("-", 1)[0]


def solve_missing(folder: Path, part: int, parts: int) -> None:
    """Solve the candidates of a part that the folder lacks, a file for each, until all classes are full."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, (name, table) in enumerate(contacts()):
        kind = class_of(name)
        if number % parts != part or _path(folder, name).exists():
            continue
        if len(_accepted(folder, kind)) >= CLASSES[kind].number:
            continue
        row = stored(folder, name, table)
        print(name, row["film_error"], row.get("nodes"), row.get("seconds"), flush=True)


def _path(folder: Path, name: str) -> Path:
    """File of a contact."""
    return folder / f"{name}.npz"


def stored(folder: Path, name: str, table: Table) -> Table:
    """Results of a contact, which is solved first where the folder lacks it.

    Where there is no film, or none within ``LIMIT``, ``film_error`` is None and ``missed`` has the reason.
    """
    path = _path(folder, name)
    if not path.exists():
        profile = np.empty((3, 0))
        try:
            with processor_limit(LIMIT):
                row, profile = solved(table, CLASSES[class_of(name)].error)
        except GivenUpError:
            row = {"film_error": None, "missed": f"takes more than {LIMIT:g} s"}
        except ConvergenceError as missed:
            row = {"film_error": None, "missed": str(missed)}
        np.savez(path, row=json.dumps(row), profile=profile)
    return _read(path)[0]


@cache
def _read(path: Path) -> tuple[Table, np.ndarray]:
    """Results and profile of a file, which is never written again."""
    with np.load(path) as file:
        return json.loads(str(file["row"])), file["profile"]


def _accepted(folder: Path, kind: str) -> list[str]:
    """Names of the candidates of a class that are solved to its error, in order, as many as it has."""
    paths = sorted(folder.glob(f"{kind}-[0-9]*.npz"))
    found = [path.stem for path in paths if good(_read(path)[0], CLASSES[kind].error)]
    return found[: CLASSES[kind].number]


def good(row: Table, limit: float) -> bool:
    """Whether a film is known to an error, and its domain takes off no more."""
    return row["film_error"] is not None and max(row["film_error"], row["domain_error"]) <= limit


def write(folder: Path, target: Path = TARGET) -> None:
    """Tables of inputs, results and profiles, and the manifest with their hashes."""
    inputs, results, lines = [], [], []
    accepted = {kind: _accepted(folder, kind) for kind in CLASSES}
    for kind, names in accepted.items():
        if len(names) < CLASSES[kind].number:
            raise SystemExit(f"{kind}: {len(names)} of {CLASSES[kind].number} contacts; solve more first")
    for name, table in contacts():
        if name not in accepted[class_of(name)]:
            continue
        row, profile = _read(_path(folder, name))
        results.append({"name": name, **row})
        for axis, rows in zip("xy", np.split(profile, len(profile) // 3), strict=False):
            lines += [(name, axis, *values) for values in rows.T.tolist()]
        inputs.append({"name": name, **_inputs(table)})
    _write_rows(target / "contacts.csv", inputs)
    _write_rows(target / "results.csv", results)
    with (target / "profiles.csv").open("w", newline="", encoding="utf-8") as file:
        file.write("name,axis,position,pressure,film\n")
        for name, axis, position, pressure, film in lines:
            file.write(f"{name},{axis},{position:.4f},{pressure:.6g},{film:.6g}\n")
    files = ("contacts.csv", "results.csv", "profiles.csv", "compare.py")
    manifest = {
        "title": "Open benchmark of elastohydrodynamic films with their electric field",
        "licence": "CC-BY-4.0",
        "made_by": f"ehlectric {__version__}, python -m benchmarks.open_benchmark",
        "contacts": len(inputs),
        "sha256": {name: hashlib.sha256((target / name).read_bytes()).hexdigest() for name in files},
    }
    (target / "manifest.json").write_text(json.dumps(manifest, indent=2) + "\n", "utf-8")


def _inputs(table: Table) -> Table:
    """Row of the inputs: all that another program needs, in SI units."""
    viscosity, coefficient, density = OILS[table["oil"]]
    return {
        "geometry": geometry_of(table),
        "moes_m": table["moes_m"],
        "moes_l": table["moes_l"],
        "reduced_modulus": table["reduced_modulus"],
        "radius_x": RADIUS,
        "radius_y": table.get("radius_y"),
        "load": table["load" if geometry_of(table) == "point" else "load_per_length"],
        "entrainment_speed": table["entrainment_speed"],
        "slide_to_roll_ratio": table.get("slide_to_roll_ratio", 0.0),
        "oil": table["oil"],
        "viscosity": viscosity,
        "pressure_viscosity_coefficient": coefficient,
        "roelands_z": roelands_exponent(viscosity, coefficient, ROELANDS),
        "density_law": density,
        "waviness_amplitude": table.get("waviness_amplitude", 0.0),
        "waviness_wavelength": table.get("waviness_wavelength"),
        "thermal": int("slide_to_roll_ratio" in table),
    }


def _write_rows(path: Path, rows: list[Table]) -> None:
    """Table with a head; numbers with seven digits, and nothing where there is no value."""
    with path.open("w", newline="", encoding="utf-8") as file:
        names = [key for key in dict.fromkeys(key for row in rows for key in row) if key != "seconds"]
        writer = csv.DictWriter(file, names, extrasaction="ignore")
        writer.writeheader()
        writer.writerows({key: _text(value) for key, value in row.items()} for row in rows)


def _text(value: Any) -> str:
    """Value as text."""
    if value is None:
        return ""
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def main() -> None:
    """Solve what is missing, or write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("step", choices=("solve", "write"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--part", type=int, default=0)
    parser.add_argument("--parts", type=int, default=1)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    if asked.step == "solve":
        solve_missing(asked.folder, asked.part, asked.parts)
    else:
        write(asked.folder)


if __name__ == "__main__":
    main()
