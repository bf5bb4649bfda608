"""Memory that a case needs. A case that does not fit into what is left is refused before it is solved."""

from __future__ import annotations

import math

from ehlectric.cases.case import Case
from ehlectric.cases.grid_inputs import Grid, Motion
from ehlectric.errors import MemoryLimitError
from ehlectric.film import KRYLOV_LIMIT
from ehlectric.runtime.memory import available_memory, in_bytes, least_limit

# Peak memory of a line contact [bytes], measured up to a million nodes: of the film per node; of the field
# per column and per (degree + 1)^2.
FILM_BYTES = 1400
FIELD_BYTES = 64

# Peak memory of a point contact [bytes]: of the film per node that is solved for, plus the vectors of
# flexible GMRES, two per iteration and at most ``KRYLOV_LIMIT`` iterations; of the field per column
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
# Finer grids of a flooded point contact cover at most 0.6 of the domain, on which the temperature is known.
_HEATED_LINE = {"sheared": (10e3, 0.0), "thermal": (36e3, 17.0)}
_HEATED_POINT = {"sheared": 7e3, "thermal": 21e3, "patch": 4.2e3}

# Memory of moving roughness [bytes], per node and recorded instant: six maps in single precision, as they are
# read back, and copies in double precision of the maps that figures use.
RECORD_BYTES = 64


def check_memory(case: Case) -> None:
    """Raise a MemoryLimitError if film and field of a case, or the recorded instants of its motion, do not
    fit into the available memory.
    """
    geometry, grid = case.contact.geometry, case.first_grid
    if case.motion is not None:
        _check_record(case.motion, grid, math.prod(_film_nodes(geometry, grid)))
    heat = None if case.film is None else "thermal" if case.film.thermal else "sheared"
    check_grid(geometry, grid, rough=bool(case.roughness), heat=heat)


def check_grid(geometry: str, grid: Grid, *, rough: bool, heat: str | None = None) -> None:
    """Raise a MemoryLimitError if film and field on a grid do not fit into the available memory."""
    available = available_memory()
    film, field = line_memory(grid) if geometry == "line" else point_memory(grid, rough=rough)
    if heat is not None:
        film += heated_memory(geometry, grid, heat, rough=rough)
    if film + field > available:
        of_film = grid.field_nodes is None or film > field
        key, size = ("nodes", _film_nodes) if of_film else ("field_nodes", _field_columns)
        raise MemoryLimitError(
            f"grid.{key}",
            got=f"{' x '.join(map(str, size(geometry, grid)))} with field_degree {grid.field_degree}, about "
            f"{(film + field) / 1e9:.0f} GB;",
            takes=f"a grid that fits into {in_bytes(available)}, {least_limit()}",
        )


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


def _film_nodes(geometry: str, grid: Grid) -> tuple[int, ...]:
    """Numbers of nodes of the film along each axis."""
    return (grid.nodes_along,) if geometry == "line" else (grid.nodes_along, grid.nodes_across)


def _field_columns(geometry: str, grid: Grid) -> tuple[int, ...]:
    """Numbers of columns of the field along each axis, in a whole contact."""
    start, stop = grid.field_range
    along = grid.field_nodes or int(grid.nodes_along * (stop - start) / grid.length)
    if geometry == "line":
        return (along,)
    assert grid.field_side is not None
    # 1.6 is the narrowest default domain. It has the largest share of its columns in the field range.
    side = 1.6 if grid.side is None else grid.side
    return along, grid.field_nodes_y or int(grid.nodes_across * min(1.0, grid.field_side / side))


def line_memory(grid: Grid) -> tuple[float, float]:
    """Largest memory of the film and of the field of a line contact [bytes]."""
    (columns,) = _field_columns("line", grid)
    return FILM_BYTES * grid.nodes_along, FIELD_BYTES * columns * (grid.field_degree + 1) ** 2


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
    columns, columns_y = _field_columns("point", grid)
    lines = _solved_lines(grid, rough=rough)
    film = (POINT_FILM_BYTES + 8 * KRYLOV_VECTORS) * grid.nodes_along * lines
    if lines < grid.nodes_across and (grid.field_nodes_y is None or grid.field_nodes_y % 2 == 1):
        columns_y = columns_y // 2 + 1
    return film, POINT_FIELD_BYTES * columns * columns_y * (grid.field_degree + 1)
