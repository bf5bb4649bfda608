"""The paper's eight contacts as cases, its measured surface replaced, and its printed table."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from ehlectric.cases.case import Case

# Nodes for smooth contacts as in the paper, and for rough ones: the correlation length of the profile is
# 1.5 µm, and 3201 nodes over six half-widths are 0.5 to 0.9 µm apart.
SMOOTH_NODES = 3201
ROUGH_NODES = 12_801
_CONTACT = {"reduced_radius": 14.1e-3, "reduced_modulus": 226e9}


@dataclass(frozen=True)
class PaperContact:
    """One of the eight contacts.

    Attributes
    ----------
    gigapascal : int
        Largest Hertz pressure [GPa], 1 or 2.
    u_s : float
        u1 + u2 [m/s].
    load : float
        Load per length [N/m].
    label : str
        Letter of its sub-figure.
    printed : str
        Its name in the paper, of rounded M and L.
    """

    gigapascal: int
    u_s: float
    load: float
    label: str
    printed: str

    @property
    def name(self) -> str:
        """What it is called in a table."""
        return f"{self.gigapascal} GPa, {self.u_s:g} m/s"

    def case(self, *, nodes: int = SMOOTH_NODES, wedge: str = "second-order", **tables: object) -> Case:
        """The case of Tables 1 and 2, with Table 1's misprinted viscosity put right.

        Parameters
        ----------
        nodes : int
            Nodes of the film.
        wedge : str
            "second-order", or "first-order", the paper's.
        **tables
            Further tables of the case.

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
        """The case with a profile on the lower surface, held still and cut at 50 nm as the paper's.

        A parabola and waves longer than 80 µm are taken out first; ``shift`` moves the profile along x [m].
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
        """The case with a permittivity that does not change with the density."""
        lubricant = {"base": "paper", "permittivity_law": "constant"}
        return self.case(lubricant=lubricant)


# Table 2 gives the load of 2 GPa; that of 1 GPa follows from w = 2 pi R p_h^2/E'.
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


@contextmanager
def measured_profile() -> Iterator[Path]:
    """Path of the packaged profile, which stands in for the paper's disc: that is not public.

    One scan of a Dektak stylus profiler, from ContactEngineering/SurfaceTopography under the MIT licence.
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
