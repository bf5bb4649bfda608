"""What a grid takes, and what the machine has: no case dies in the middle for want of memory."""

from __future__ import annotations

import os

import numpy as np

from ehlectric.case import Case
from ehlectric.errors import InputError

# Peak memory [bytes], measured up to a million nodes: of the film by node, of the field by column and by the
# square of its degree plus one.
FILM_BYTES = 1400
FIELD_BYTES = 64


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


def physical_memory() -> float:
    """Memory of the machine [bytes], infinite where the system does not tell."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return np.inf
