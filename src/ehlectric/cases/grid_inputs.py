"""Tables `electric`, `grid`, `solver` and `motion` of a case: potentials, discretisation, stopping rule
and time.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.defaults import DEFAULT_ERROR
from ehlectric.cases.table import Table
from ehlectric.errors import InputError


class Electric(Table, book="electric"):
    """Potentials of the two surfaces, the lower one first, and what conducts where they touch."""

    potential_1: float = -1.0
    potential_2: float = 1.0
    resistivity: float | None = None
    mean_free_path: float | None = None
    tribofilm_resistance: float | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.voltage < 1e-6:
            raise InputError(
                "potential_2",
                got=f"{self.potential_2:g} V, which is potential_1;",
                takes="one that differs by at least 1 µV, as there is no field between equal potentials",
            )
        return self

    @property
    def voltage(self) -> float:
        """Voltage between the surfaces [V], above 0."""
        return abs(self.potential_2 - self.potential_1)

    @property
    def default(self) -> bool:
        """Whether both potentials are the defaults."""
        fields = type(self).model_fields
        return all(getattr(self, name) == fields[name].default for name in ("potential_1", "potential_2"))


# Largest polynomial degree across the film: it resolves waves down to a fortieth of the film thickness.
MOST_DEGREE = 40

# Smallest number of film nodes in the field range that resolve the field.
_LEAST_COLUMNS = 16
_FieldEnd = Annotated[float, Amount("", least=-100.0, most=100.0, reason="in half-widths")]

# Ends of the domain where they are not given, of a line and of a point contact; half-widths or semi-axes.
DEFAULT_ENDS = {False: (-4.0, 2.0), True: (-4.5, 1.5)}

# Defaults of a point contact's grid that a line contact does not have; lengths in semi-axes.
_POINT_GRID: dict[str, Any] = {"field_side": 1.25}

# Numbers of nodes of a grid that is not refined and has no ``nodes``, and intervals of the first grid of one
# that is, over the default domain of six lengths: of a line and of a point contact.
_FIXED = {False: 3201, True: 257}
_FIRST = {False: 400, True: 128}
_DEFAULT_LENGTH = 6.0

# Keys that only the grid of a point contact has.
POINT_GRID_KEYS = ("nodes_y", "side", "field_side", "field_nodes_y")

# Smallest number of nodes across the Hertz zone of a point contact that resolve its film. Largest number of
# nodes along an axis; a film on a finer grid needs more memory than a workstation has.
LEAST_ACROSS = 16
_MOST_AXIS = 4097


class Grid(Table, book="grid"):
    """Discretisation of the film and of the field.

    The unit of length is the half-width of a line contact. For a point contact it is the semi-axis along
    entrainment; for ``side`` and ``field_side`` it is the semi-axis across.
    """

    nodes: int | None = None
    error: float | None = None
    nodes_y: int | None = None
    inlet: float | None = None
    outlet: float | None = None
    side: float | None = None
    wedge: Literal["third-order", "second-order", "first-order"] = "third-order"
    field_range: tuple[_FieldEnd, _FieldEnd] = (-1.25, 1.25)
    field_side: float | None = None
    field_nodes: int | None = None
    field_nodes_y: int | None = None
    field_degree: int = 6
    refine: float | None = None
    most_nodes: int | None = None

    @property
    def of_point(self) -> bool:
        """Whether this is the grid of a point contact, which always has a ``field_side``."""
        return self.field_side is not None

    @property
    def ends(self) -> tuple[float, float]:
        """Ends of the domain along entrainment, given or by default."""
        inlet, outlet = DEFAULT_ENDS[self.of_point]
        return inlet if self.inlet is None else self.inlet, outlet if self.outlet is None else self.outlet

    @property
    def length(self) -> float:
        """Length of the domain along entrainment."""
        inlet, outlet = self.ends
        return outlet - inlet

    @property
    def default_domain(self) -> bool:
        """Whether neither ends nor sides are given, so that a solver may take a larger domain."""
        return self.inlet is None and self.outlet is None and self.side is None

    @property
    def nodes_across(self) -> int:
        """Number of nodes across a point contact; that along it if ``nodes_y`` is not given."""
        return self.first().nodes_along if self.nodes_y is None else self.nodes_y

    @property
    def nodes_along(self) -> int:
        """Number of nodes along entrainment of the first grid."""
        nodes = self.first().nodes
        assert nodes is not None
        return nodes

    @property
    def target(self) -> float | None:
        """Relative error of the film to which the grid is refined; None if it has given nodes only."""
        if self.refine is not None or self.error is not None:
            return self.refine if self.error is None else self.error
        return None if self._given else DEFAULT_ERROR[self.of_point]

    @property
    def _given(self) -> bool:
        return self.nodes is not None or self.nodes_y is not None

    def first(self, *, rough: bool = False) -> Grid:
        """Grid with which a refinement begins: this one if it has nodes, else a coarse one.

        With only ``nodes_y`` it has the number of nodes along entrainment of a grid that is not refined. This
        also holds for a rough contact, since roughness needs a spacing that a coarse grid does not have.
        """
        if self.nodes is not None:
            return self
        if rough or self.nodes_y is not None:
            return self.fixed()
        intervals = _FIRST[self.of_point]
        while self.length / intervals > 1.01 * _DEFAULT_LENGTH / _FIRST[self.of_point]:
            intervals *= 2
        return self.model_copy(update={"nodes": intervals + 1})

    def fixed(self) -> Grid:
        """Grid with its nodes, or with the default number if it has none; it is not refined by itself."""
        if self.nodes is not None:
            return self
        return self.model_copy(update={"nodes": _FIXED[self.of_point]})

    def check_geometry(self, geometry: str) -> None:
        """Raise an InputError if the grid of a line contact has a key of point contacts."""
        for key in POINT_GRID_KEYS if geometry != "point" else ():
            if getattr(self, key) is not None:
                raise InputError.worded(
                    f"grid.{key}", "is not used by a line contact, only where contact.geometry is 'point'"
                )

    @model_validator(mode="after")
    def _check(self) -> Self:
        domain = self.length
        for key in ("nodes", "nodes_y", "refine"):
            if self.error is not None and getattr(self, key) is not None:
                raise InputError(
                    "error", got=f"error and {key}", takes="one of them; nodes and refine go together"
                )
        self._check_most_nodes()
        if self.nodes_along < 8.0 * domain:
            lengths = "semi-axes" if self.of_point else "half-widths"
            raise InputError(
                "nodes",
                got=f"{self.nodes_along} over {domain:g} {lengths}",
                takes=f"at least {int(8.0 * domain) + 1} there: sixteen in the Hertzian zone",
            )
        self._check_field_range(domain)
        if self.of_point:
            self._check_point()
        return self

    def _check_most_nodes(self) -> None:
        most = self.most_nodes
        if most is None:
            return
        if self.target is None:
            raise InputError.worded(
                "most_nodes",
                "is not used with nodes only, because such a grid is not refined",
                takes="error, or nodes and refine",
            )
        if most < self.nodes_along:
            raise InputError(
                "most_nodes",
                got=str(most),
                takes=f"at least {self.nodes_along}, with which the refinement begins",
            )

    def _check_field_range(self, domain: float) -> None:
        (start, stop), (inlet, outlet) = self.field_range, self.ends
        default = "" if "field_range" in self.model_fields_set else ", its default"
        if not inlet <= start < stop <= outlet:
            raise InputError(
                "field_range",
                got=f"[{start:g}, {stop:g}]{default}",
                takes=f"two increasing numbers within inlet and outlet, [{inlet:g}, {outlet:g}]",
            )
        columns = (stop - start) / domain * (self.nodes_along - 1)
        if self.field_nodes is None and columns < _LEAST_COLUMNS:
            raise InputError(
                "field_range",
                got=f"[{start:g}, {stop:g}]{default}, which holds {int(columns)} nodes of the film;",
                takes=f"a range with at least {_LEAST_COLUMNS}, or field_nodes",
            )
        if stop - start < 1e-3:
            raise InputError("field_range", got=f"[{start:g}, {stop:g}]", takes="a range of at least 0.001")

    def _check_point(self) -> None:
        for key in ("nodes", "field_nodes", "most_nodes"):
            nodes = getattr(self, key)
            if nodes is not None and nodes > _MOST_AXIS:
                raise InputError(
                    key,
                    got=f"{nodes} in a point contact",
                    takes=f"at most {_MOST_AXIS} along an axis: more fill the memory",
                )
        if self.side is not None:
            self.check_across(self.side)

    def check_across(self, side: float) -> None:
        """Check the grid of a point contact across entrainment. Raises InputError if the grid is too coarse
        across entrainment, or the domain is narrower than the field range.
        """
        assert self.field_side is not None
        if self.field_side > side:
            raise InputError("field_side", got=f"{self.field_side:g}", takes=f"at most side, {side:g}")
        nodes, key = self.nodes_across, "nodes" if self.nodes_y is None else "nodes_y"
        least = math.ceil(LEAST_ACROSS * side) + 1
        if nodes < least:
            raise InputError(
                key,
                got=f"{nodes} across {2.0 * side:g} semi-axes",
                takes=f"at least {least} there: sixteen in the Hertzian zone",
            )


def point_grid(table: Mapping[str, Any]) -> dict[str, Any]:
    """Table of a point contact's grid: the given keys, and the defaults that only such a grid has.

    Examples
    --------
    >>> grid = Grid.from_dict(point_grid({"inlet": -9.0}))
    >>> grid.ends, grid.field_side, grid.target, grid.first().nodes
    ((-9.0, 1.5), 1.25, 0.02, 257)
    """
    return {**_POINT_GRID, **table}


class Solver(Table, book="solver"):
    """Stopping rule of the film solver."""

    tolerance: float = 1e-9
    max_iterations: int = 30


class Motion(Table, book="motion"):
    """Duration, time steps and recorded instants of a contact with moving roughness.

    Examples
    --------
    >>> Motion.from_dict({"duration": "2 ms"}).duration
    0.002
    """

    passes: float | None = None
    duration: float | None = None
    steps: int | None = None
    record: int = 200

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_alternatives(("passes", "duration"), "either passes or duration", needed=True)
        return self

    def check(self, grid: Grid, *, rough: bool) -> None:
        """Check that a case of moving roughness has a rough surface, and a grid that the motion can use.
        Raises InputError if no surface is rough, the wedge is of first order, or the grid is refined.
        """
        if not rough:
            raise InputError.worded("motion", "needs a rough surface: roughness is what moves")
        if grid.wedge == "first-order":
            raise InputError(
                "grid.wedge", got=f"{grid.wedge!r} with motion", takes="'third-order' or 'second-order'"
            )
        for key in ("refine", "error", "most_nodes"):
            if getattr(grid, key) is not None:
                raise InputError.worded(
                    f"grid.{key}",
                    "is not used with [motion], which has a single grid; give grid.nodes",
                    takes="grid.nodes",
                )
