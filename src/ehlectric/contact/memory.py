"""What a grid takes, and what the machine has: no case dies in the middle for want of memory."""

from __future__ import annotations

import math

from ehlectric.cases.case import Case
from ehlectric.cases.grid import Grid
from ehlectric.cases.motion import Motion
from ehlectric.errors import MemoryLimitError
from ehlectric.film.newton import KRYLOV_LIMIT
from ehlectric.runtime.memory import physical_memory

# Peak memory [bytes], measured up to a million nodes: of the film by node, of the field by column and by the
# square of its degree plus one.
FILM_BYTES = 1400
FIELD_BYTES = 64

# The same of a point contact: of the film by node that is solved for, with the vectors that flexible GMRES
# keeps, two an iteration, where it takes all that ``newton.KRYLOV_LIMIT`` allows; of the field by column that
# is solved for and degree plus one. Measured on 129 x 129 to 1025 x 1025 nodes, halves and wholes, a circle
# and an ellipse, at degrees 3 to 12: 790 to 950 bytes beside those vectors, and 580 to 660. A fifth is added.
POINT_FILM_BYTES = 1140
KRYLOV_VECTORS = 2 * KRYLOV_LIMIT + 1
POINT_FIELD_BYTES = 790

# Bytes of a node of an instant of roughness that moves: six maps in single precision as they are read again,
# and those of them that figures take in double.
RECORD_BYTES = 64


def check_memory(case: Case) -> None:
    """Refuse a grid, or instants of a motion, that the memory of this machine cannot hold.

    Parameters
    ----------
    case : Case
        A valid case.

    Raises
    ------
    MemoryLimitError
        Where film and field would take more than the physical memory.
    """
    if case.motion is not None:
        _check_record(case.motion, case.grid, point=case.contact.geometry == "point")
    if case.contact.geometry == "point":
        _check_point(case)
        return
    grid = case.grid
    columns = _columns_along(grid)
    film = FILM_BYTES * grid.nodes
    field = FIELD_BYTES * columns * (grid.field_degree + 1) ** 2
    _refuse_beyond(grid, (film, field), (f"{grid.nodes}", f"{columns}"))


def _check_record(motion: Motion, grid: Grid, *, point: bool) -> None:
    """The same for the instants that are kept of a motion, which are all read again at its end."""
    nodes = grid.nodes * (grid.nodes_across if point else 1)
    steps = motion.steps or (math.inf if motion.passes is None else motion.passes * grid.nodes)
    available, needed = physical_memory(), RECORD_BYTES * nodes * min(motion.record, steps + 1)
    if needed > available:
        raise MemoryLimitError(
            "motion.record",
            got=f"{motion.record} instants of {nodes} nodes, about {needed / 1e9:.0f} GB;",
            takes=f"at most {int(available / RECORD_BYTES / nodes)} in {available / 1e9:.0f} GB",
        )


def _check_point(case: Case) -> None:
    """The same for a point contact."""
    grid = case.grid
    nodes_y, columns, columns_y = _point_sizes(grid)
    needed = point_memory(grid, rough=bool(case.roughness))
    _refuse_beyond(grid, needed, (f"{grid.nodes} x {nodes_y}", f"{columns} x {columns_y}"))


def _refuse_beyond(grid: Grid, needed: tuple[float, float], sizes: tuple[str, str]) -> None:
    """Refuse what film and field need [bytes] of their nodes and columns, beyond the memory that there is."""
    available, (film, field) = physical_memory(), needed
    if film + field > available:
        of_film = grid.field_nodes is None or film > field
        key, size = ("nodes", sizes[0]) if of_film else ("field_nodes", sizes[1])
        raise MemoryLimitError(
            f"grid.{key}",
            got=f"{size} with field_degree {grid.field_degree}, about {(film + field) / 1e9:.0f} GB;",
            takes=f"a grid that fits into the {available / 1e9:.0f} GB of this machine",
        )


def _columns_along(grid: Grid) -> int:
    """Columns of the field along entrainment."""
    start, stop = grid.field_range
    return grid.field_nodes or int(grid.nodes * (stop - start) / (grid.outlet - grid.inlet))


def point_memory(grid: Grid, *, rough: bool) -> tuple[float, float]:
    """Memory that a point contact takes at most.

    Parameters
    ----------
    grid : Grid
        Of a point contact.
    rough : bool
        Whether its surfaces may differ from their mirror image: half of a smooth contact is solved for,
        where an odd number of nodes lies across it.

    Returns
    -------
    tuple of float
        Of its film and of its field [bytes].

    Examples
    --------
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 513}})
    >>> film, _ = point_memory(case.grid, rough=False)
    >>> round(film / 1e9, 1)
    0.3
    """
    nodes_y, columns, columns_y = _point_sizes(grid)
    whole = rough or nodes_y % 2 == 0
    lines = nodes_y if whole else nodes_y // 2 + 1
    film = (POINT_FILM_BYTES + 8 * KRYLOV_VECTORS) * grid.nodes * lines
    if not whole and (grid.field_nodes_y is None or grid.field_nodes_y % 2 == 1):
        columns_y = columns_y // 2 + 1
    return film, POINT_FIELD_BYTES * columns * columns_y * (grid.field_degree + 1)


def _point_sizes(grid: Grid) -> tuple[int, int, int]:
    """Nodes across the contact, and columns of its field along and across, all of them."""
    assert grid.field_side is not None
    # The narrowest domain a point contact has: more columns of the field lie in its range than in any other.
    side = 1.6 if grid.side is None else grid.side
    nodes_y = grid.nodes_across
    columns_y = grid.field_nodes_y or int(nodes_y * min(1.0, grid.field_side / side))
    return nodes_y, _columns_along(grid), columns_y
