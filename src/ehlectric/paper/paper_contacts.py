"""The paper's eight contacts as cases, their printed films, and solvers by their names on the command
line.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib import resources
from pathlib import Path

from ehlectric.cases.case import Case
from ehlectric.contact import DEFAULT_SOLVERS, Result, Solvers
from ehlectric.errors import InputError, shown
from ehlectric.formulas.film_line import LineContact
from ehlectric.paper import fas, sor

# Smooth contacts have as many nodes as in the paper. Rough ones need more: over six half-widths, 3201 nodes
# are 0.5 to 0.9 µm apart, while the correlation length of the profile is 1.5 µm.
SMOOTH_NODES = 3201
ROUGH_NODES = 12_801
_CONTACT = {"reduced_radius": 14.1e-3, "reduced_modulus": 226e9}


@dataclass(frozen=True)
class PaperContact:
    """One of the eight line contacts of the paper."""

    gigapascal: int  # Hertz pressure [GPa], 1 or 2
    u_s: float  # sum of the surface speeds u1 + u2 [m/s]
    load: float  # load per length [N/m]
    label: str  # letter of its sub-figure in the paper
    printed: str  # name in the paper, from the rounded Moes numbers M and L, such as "M12L15"

    @property
    def name(self) -> str:
        """Name of the contact in tables: Hertz pressure and u1 + u2."""
        return f"{self.gigapascal} GPa, {self.u_s:g} m/s"

    def case(self, *, nodes: int = SMOOTH_NODES, wedge: str = "second-order", **tables: object) -> Case:
        """Case of a smooth contact from Tables 1 and 2, with the misprinted viscosity of Table 1 corrected.

        Examples
        --------
        >>> CONTACTS[0].case().contact.entrainment_speed
        4.0
        """
        table = {
            "title": f"{self.printed}: {self.name}",
            "contact": _CONTACT | {"load_per_length": self.load, "entrainment_speed": 0.5 * self.u_s},
            "lubricant": {"base": "paper"},
            "grid": {"nodes": nodes, "wedge": wedge},
        }
        return Case.from_dict(table | tables)

    def rough_case(self, profile: Path, *, nodes: int = ROUGH_NODES, shift: float = 0.0) -> Case:
        """Case of a rough contact, with a stationary profile on the lower surface.

        A parabola and wavelengths above 80 µm are removed from the profile, which is then cut at ±50 nm, as
        in the paper.

        ``shift``, distance that the profile is moved along x [m].
        """
        rough = {
            "surface": 1,
            "file": str(profile),
            "form": "parabola",
            "cutoff_long": "80 um",
            "truncate": "0.05 um",
            "shift": shift,
        }
        return self.case(nodes=nodes, roughness=[rough])

    def constant_case(self) -> Case:
        """Case of a smooth contact whose permittivity does not depend on the density."""
        lubricant = {"base": "paper", "permittivity_law": "constant"}
        return self.case(lubricant=lubricant)


# Load per length [N/m] by Hertz pressure [GPa]. Table 2 gives the load at 2 GPa. At 1 GPa,
# w = 2 pi R p_h^2/E'.
LOADS = {1: 3.925e5, 2: 1.57e6}
_PRINTED = {
    1: ("M12L15", "M17L13", "M24L11", "M34L9"),
    2: ("M49L15", "M68L13", "M98L11", "M139L9"),
}
CONTACTS = tuple(
    PaperContact(gigapascal, u_s, LOADS[gigapascal], label, printed)
    for gigapascal, names in _PRINTED.items()
    for u_s, label, printed in zip((8.0, 4.0, 2.0, 1.0), "abcd", names, strict=True)
)


def of_paper(result: Result) -> LineContact:
    """Contact for M and L of the paper, whose L has the slope alpha of ln(eta) at zero pressure."""
    assert isinstance(result.case, Case)
    return replace(result.conditions.contact, pressure_viscosity_coefficient=result.case.oil.alpha)


@contextmanager
def measured_profile() -> Iterator[Path]:
    """Context manager that yields the path of the packaged profile.

    The profile replaces the measured disc of the paper, which is not public. It is one scan of a Dektak
    stylus profiler, from ContactEngineering/SurfaceTopography under the MIT licence.
    """
    with resources.as_file(resources.files("ehlectric.paper") / "data" / "dektak-1.csv") as path:
        yield path


def table_3() -> list[dict[str, float]]:
    """Rows of the printed Table 3: u_s [m/s], M, L, and films [µm] of Venner and Napel and of the paper.

    Examples
    --------
    >>> table_3()[0]["venner_h_min"]
    0.65
    """
    text = (resources.files("ehlectric.paper") / "data" / "table_3.csv").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def _accepted(case: Case) -> Case:
    """Case as the paper's methods solve it, which have no wedge of third order.

    Raises an InputError if they cannot solve it: no line contact, an unsuitable grid, or this wedge.
    """
    if case.contact.geometry != "line":
        raise InputError.worded(
            "contact.geometry",
            f"got {case.contact.geometry!r}; the solver 'paper' needs 'line': its methods are "
            "for line contacts",
            got=shown(case.contact.geometry),
            takes="'line'",
        )
    if case.inlet is not None:
        raise InputError("inlet", got="[inlet] for the solver 'paper'", takes="the solver 'ehlectric'")
    if case.film is not None:
        raise InputError.worded("film", "is not solved by the solver 'paper', whose films are isothermal")
    grid = case.grid.fixed() if case.grid.error is None else case.grid
    fas.grid_sizes(grid.nodes_along)
    case = case.model_copy(update={"grid": grid})
    if case.grid.wedge != "third-order":
        return case
    if "wedge" in case.grid.model_fields_set:
        raise InputError(
            "grid.wedge",
            got="'third-order' for the solver 'paper'",
            takes="'second-order' or 'first-order', or no wedge",
        )
    return case.model_copy(update={"grid": case.grid.model_copy(update={"wedge": "second-order"})})


PAPER = Solvers("paper", film={"line": fas.solve_film}, field={"line": sor.solve_field}, accept=_accepted)
SOLVERS = {solvers.name: solvers for solvers in (DEFAULT_SOLVERS, PAPER)}
