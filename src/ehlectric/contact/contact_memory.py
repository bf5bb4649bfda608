"""Memory that a case needs. A case that does not fit into what is left is refused before it is solved."""

from __future__ import annotations

import math
from collections.abc import Callable

from ehlectric.cases.case import Case
from ehlectric.cases.grid_inputs import Grid, Motion
from ehlectric.errors import MemoryLimitError
from ehlectric.film.newton import KRYLOV_LIMIT
from ehlectric.runtime.memory import available_memory, in_bytes, least_limit

# Peak memory of a line contact [bytes], measured up to a million nodes: of the film per node; of the field
# per column and per (degree + 1)^2.
FILM_BYTES = 1400
FIELD_BYTES = 64

# Peak memory of a point contact [bytes]: of the film per node that is solved for, plus the vectors of
# flexible GMRES, two per iteration and at most ``newton.KRYLOV_LIMIT`` iterations; of the field per column
# that is solved for and per (degree + 1). Measured on half and on whole contacts: 1700 bytes for the film
# without those vectors on 513 x 513 nodes, as it keeps an older preconditioner; 580 to 660 bytes for the
# field on 129 x 129 to 1025 x 1025 nodes, for a circle and an ellipse, at degrees 3 to 12. The constants
# contain a margin of a fifth.
POINT_FILM_BYTES = 2100
KRYLOV_VECTORS = 2 * KRYLOV_LIMIT + 1
POINT_FIELD_BYTES = 790

# Further peak memory of a film with shear and with heat [bytes]. Of a line contact per node and per node
# squared, as each surface has a matrix of the heat upstream of every node; measured on 1601 to 6401 nodes. Of
# a point contact per node that is solved for, measured on 65 x 65 and 129 x 129 nodes. With a fifth more.
_HEATED_LINE = {"sheared": (10e3, 0.0), "thermal": (36e3, 17.0)}
_HEATED_POINT = {"sheared": 7e3, "thermal": 21e3}

# Memory of moving roughness [bytes], per node and recorded instant: six maps in single precision, as they are
# read back, and copies in double precision of the maps that figures use.
RECORD_BYTES = 64


def check_memory(case: Case) -> None:
    """Raise a MemoryLimitError if film and field of a case, or the recorded instants of its motion, do not
    fit into the available memory.
    """
    if case.motion is not None:
        _check_record(case.motion, case.first_grid, _NODES[case.contact.geometry](case.first_grid))
    heat = None if case.film is None else "thermal" if case.film.thermal else "sheared"
    check_grid(case.contact.geometry, case.first_grid, rough=bool(case.roughness), heat=heat)


def check_grid(geometry: str, grid: Grid, *, rough: bool, heat: str | None = None) -> None:
    """Raise a MemoryLimitError if film and field on a grid do not fit into the available memory."""
    sizes = _SIZES[geometry](grid)
    film, field = _NEEDED[geometry](grid, rough=rough)
    if heat is not None:
        film += heated_memory(geometry, grid, heat, rough=rough)
    _refuse_beyond(grid, (film, field), sizes)


def heated_memory(geometry: str, grid: Grid, heat: str, *, rough: bool) -> float:
    """Memory that the shear or the heat of a film needs in addition to the film [bytes].

    Examples
    --------
    >>> round(heated_memory("line", Grid(nodes=6401), "thermal", rough=False) / 1e9, 2)
    0.93
    """
    nodes = grid.nodes_along
    if geometry == "line":
        each, squared = _HEATED_LINE[heat]
        return each * nodes + squared * nodes**2
    return _HEATED_POINT[heat] * nodes * _solved_lines(grid, rough=rough)


def _solved_lines(grid: Grid, *, rough: bool) -> int:
    """Number of lines along entrainment on which a point contact is solved; half of them if it is smooth."""
    across = grid.nodes_across
    return across if rough or across % 2 == 0 else across // 2 + 1


def _check_record(motion: Motion, grid: Grid, nodes: int) -> None:
    """Raise a MemoryLimitError if the instants of a motion, all read back at its end, do not fit."""
    steps = motion.steps or (math.inf if motion.passes is None else motion.passes * grid.nodes_along)
    available, needed = available_memory(), RECORD_BYTES * nodes * min(motion.record, steps + 1)
    if needed > available:
        raise MemoryLimitError(
            "motion.record",
            got=f"{motion.record} instants of {nodes} nodes, about {needed / 1e9:.0f} GB;",
            takes=f"at most {int(available / RECORD_BYTES / nodes)} in {in_bytes(available)}, "
            f"{least_limit()}",
        )


def _refuse_beyond(grid: Grid, needed: tuple[float, float], sizes: tuple[str, str]) -> None:
    """Raise a MemoryLimitError if the memory needed by film and field exceeds the available memory.

    ``needed`` is the memory of the film and of the field [bytes]; ``sizes`` are their grids as text.
    """
    available, (film, field) = available_memory(), needed
    if film + field > available:
        of_film = grid.field_nodes is None or film > field
        key, size = ("nodes", sizes[0]) if of_film else ("field_nodes", sizes[1])
        raise MemoryLimitError(
            f"grid.{key}",
            got=f"{size} with field_degree {grid.field_degree}, about {(film + field) / 1e9:.0f} GB;",
            takes=f"a grid that fits into {in_bytes(available)}, {least_limit()}",
        )


def _columns_along(grid: Grid) -> int:
    """Number of columns of the field along entrainment."""
    start, stop = grid.field_range
    return grid.field_nodes or int(grid.nodes_along * (stop - start) / grid.length)


def line_memory(grid: Grid, *, rough: bool) -> tuple[float, float]:
    """Largest memory of the film and of the field of a line contact [bytes], rough or smooth."""
    del rough
    film = FILM_BYTES * grid.nodes_along
    return film, FIELD_BYTES * _columns_along(grid) * (grid.field_degree + 1) ** 2


def point_memory(grid: Grid, *, rough: bool) -> tuple[float, float]:
    """Largest memory of the film and of the field of a point contact [bytes], rough or smooth.

    Examples
    --------
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 513}})
    >>> film, _ = point_memory(case.grid, rough=False)
    >>> round(film / 1e9, 1)
    0.4
    """
    _, columns, columns_y = _point_sizes(grid)
    lines = _solved_lines(grid, rough=rough)
    film = (POINT_FILM_BYTES + 8 * KRYLOV_VECTORS) * grid.nodes_along * lines
    if lines < grid.nodes_across and (grid.field_nodes_y is None or grid.field_nodes_y % 2 == 1):
        columns_y = columns_y // 2 + 1
    return film, POINT_FIELD_BYTES * columns * columns_y * (grid.field_degree + 1)


def _point_sizes(grid: Grid) -> tuple[int, int, int]:
    """Numbers of film nodes across, and of field columns along and across, in a whole point contact."""
    assert grid.field_side is not None
    # 1.6 is the narrowest default domain. It has the largest share of its columns in the field range.
    side = 1.6 if grid.side is None else grid.side
    nodes_y = grid.nodes_across
    columns_y = grid.field_nodes_y or int(nodes_y * min(1.0, grid.field_side / side))
    return nodes_y, _columns_along(grid), columns_y


def _point_size(grid: Grid) -> tuple[str, str]:
    nodes_y, columns, columns_y = _point_sizes(grid)
    return f"{grid.nodes_along} x {nodes_y}", f"{columns} x {columns_y}"


# Functions of a grid by the geometry of the contact: memory of film and field, their grids as text, and
# number of film nodes.
_NEEDED = {"line": line_memory, "point": point_memory}
_SIZES: dict[str, Callable[[Grid], tuple[str, str]]] = {
    "line": lambda grid: (f"{grid.nodes_along}", f"{_columns_along(grid)}"),
    "point": _point_size,
}
_NODES: dict[str, Callable[[Grid], int]] = {
    "line": lambda grid: grid.nodes_along,
    "point": lambda grid: grid.nodes_along * grid.nodes_across,
}
