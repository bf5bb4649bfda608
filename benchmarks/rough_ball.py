"""A rough ball at three speeds from grid to grid: ``python -m benchmarks.rough_ball``.

Prints the table of the documentation: load share, area, films and capacitance of the contact of
``examples/mixed_contact.toml`` with an Rq of 100 nm and a correlation length of 30 um, and its load share
with other boundary films. The finest grid takes some minutes of processor time.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from time import process_time

from ehlectric import Case, solve

EXAMPLE = Path(__file__).parents[1] / "examples" / "mixed_contact.toml"
SPEEDS, NODES = (6.4e-3, 20e-3, 50e-3), (65, 129, 257)
BOUNDARY_FILMS = (5e-9, 2e-9, 1e-9, 0.5e-9)
_ROUGHNESS = {"surface": 1, "generator": "gaussian", "rq": 100e-9, "correlation_length": 30e-6, "seed": 1}


def case(speed: float, nodes: int, boundary_film: float) -> Case:
    """Contact at a speed [m/s] on a grid, with a boundary film [m]."""
    table = tomllib.loads(EXAMPLE.read_text("utf-8"))
    del table["discharge"]
    table["contact"] |= {"entrainment_speed": speed, "boundary_film": boundary_film}
    return Case.from_dict(table | {"grid": {"nodes": nodes}, "roughness": [_ROUGHNESS]})


def row(speed: float, nodes: int, boundary_film: float = 1e-9) -> str:
    """Row of the table; films in nm, capacitance in pF, and the processor time."""
    start = process_time()
    summary = solve(case(speed, nodes, boundary_film)).summary()
    spots, field = summary["asperities"], summary["field"]
    numbers = (
        f"{1e3 * speed:g} mm/s",
        f"{nodes}²",
        f"{spots['load_share']:.2g}",
        f"{spots['contact_area_share']:.2g}",
        f"{1e9 * spots['mean_film']:.1f}",
        f"{1e9 * spots['film_50']:.1f}",
        f"{1e12 * field['capacitance']:.0f}",
        f"{process_time() - start:.0f} s",
    )
    return f"| {' | '.join(numbers)} |"


def main() -> None:
    """Print both tables."""
    for speed in SPEEDS:
        for nodes in NODES:
            print(row(speed, nodes), flush=True)
    for film in BOUNDARY_FILMS:
        print(f"boundary film {1e9 * film:g} nm:", row(SPEEDS[1], NODES[1], film), flush=True)


if __name__ == "__main__":
    main()
