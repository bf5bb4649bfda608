"""What a grid takes, and what the machine has: no case dies in the middle for want of memory."""

from __future__ import annotations

import os

import numpy as np

from ehlectric.case import Case
from ehlectric.errors import InputError
from ehlectric.inputs import Grid

# Peak memory [bytes], measured up to a million nodes: of the film by node, of the field by column and by the
# square of its degree plus one.
FILM_BYTES = 1400
FIELD_BYTES = 64

# The same of a point contact, whose half alone is solved: of the film by node of that half, with the vectors
# of its Krylov space, of the field by column of it and degree plus one. Estimates, until both are measured.
POINT_FILM_BYTES = 1600
KRYLOV_VECTORS = 60
POINT_FIELD_BYTES = 400


def check_memory(case: Case) -> None:
    """Refuse a grid that the memory of this machine cannot hold.

    Parameters
    ----------
    case : Case
        A valid case.

    Raises
    ------
    InputError
        Where film and field would take more than the physical memory.
    """
    if case.contact.geometry == "point":
        _check_point(case.grid)
        return
    grid = case.grid
    columns = grid.field_nodes
    if columns is None:
        start, stop = grid.field_range
        columns = int(grid.nodes * (stop - start) / (grid.outlet - grid.inlet))
    film = FILM_BYTES * grid.nodes
    needed = film + FIELD_BYTES * columns * (grid.field_degree + 1) ** 2
    available = physical_memory()
    if needed > available:
        key = "nodes" if grid.field_nodes is None or film > 0.5 * needed else "field_nodes"
        raise InputError(
            f"grid.{key}: got {getattr(grid, key)} with field_degree {grid.field_degree}, about "
            f"{needed / 1e9:.0f} GB; takes a grid that fits into the {available / 1e9:.0f} GB of this machine"
        )


def _check_point(grid: Grid) -> None:
    """The same for the grid of a point contact."""
    assert grid.field_side is not None
    # The narrowest domain a point contact has: more columns of the field lie in its range than in any other.
    side = 1.6 if grid.side is None else grid.side
    nodes_y = grid.nodes if grid.nodes_y is None else grid.nodes_y
    start, stop = grid.field_range
    columns = grid.field_nodes or int(grid.nodes * (stop - start) / (grid.outlet - grid.inlet))
    columns_y = grid.field_nodes_y or int(nodes_y * min(1.0, grid.field_side / side))
    film = (POINT_FILM_BYTES + 8 * KRYLOV_VECTORS) * grid.nodes * (nodes_y // 2 + 1)
    field = POINT_FIELD_BYTES * columns * (columns_y // 2 + 1) * (grid.field_degree + 1)
    available = physical_memory()
    if film + field > available:
        key = "nodes" if grid.field_nodes is None or film > field else "field_nodes"
        size = f"{grid.nodes} x {nodes_y}" if key == "nodes" else f"{columns} x {columns_y}"
        needed = f"{(film + field) / 1e9:.0f} GB"
        raise InputError(
            f"grid.{key}: got {size} with field_degree {grid.field_degree}, about {needed}; takes a grid "
            f"that fits into the {available / 1e9:.0f} GB of this machine"
        )


def physical_memory() -> float:
    """Memory of the machine [bytes], infinite where the system does not tell."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return np.inf
