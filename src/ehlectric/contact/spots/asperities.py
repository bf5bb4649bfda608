"""Asperities of a solved contact: mechanics and electrical answer of its spots, as one table of a summary."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.contact.spots.electrical import Electrical, electrical
from ehlectric.contact.spots.mechanics import Coarser, Touching, spots_of, touching
from ehlectric.contact.spots.oil_balance import OilBalance, oil_balance
from ehlectric.contact.spots.patches import Spots
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm

# Change of the load share from a grid with half the nodes, of the share itself or of the whole load, above
# which the share is not resolved.
UNRESOLVED_SHARE, UNRESOLVED_LOAD = 0.1, 0.005


# Load share of asperities above which finer grids leave spots, however much their area changes.
_NEARLY_ALL = 0.9


@dataclass(frozen=True)
class Asperities:
    """Asperities of a solved contact.

    Attributes
    ----------
    spots : Spots
        Spots in which the surfaces touch.
    touching : Touching
        What they carry, and the film around them.
    electrical : Electrical
        What they conduct, and the capacitance and breakdown around them.
    balance : OilBalance or None
        Oil that the film loses and makes; None where it is not known.
    coarser : Coarser or None
        Load share and area on a grid with half the nodes; None if it was not solved.
    """

    spots: Spots
    touching: Touching
    electrical: Electrical
    balance: OilBalance | None
    coarser: Coarser | None

    @property
    def share_change(self) -> float | None:
        """Change of the load share from the coarser grid; None without it."""
        return None if self.coarser is None else self.touching.load_share - self.coarser.load_share

    def summary(self) -> dict[str, Any]:
        """Values of all parts, as in ``asperities`` of summary.json."""
        coarser, balance = self.coarser, self.balance
        return {
            **asdict(self.touching),
            "load_share_coarser": None if coarser is None else coarser.load_share,
            "contact_area_share_coarser": None if coarser is None else coarser.contact_area_share,
            "mass_error": None if balance is None else balance.mass_error,
            "oil_lost": None if balance is None else balance.oil_lost,
            "oil_made": None if balance is None else balance.oil_made,
            **asdict(self.electrical),
        }


def asperities(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    *,
    rq: float,
    smooth: Array | None,
    coarser: Coarser | None,
) -> Asperities:
    """Asperities of a converged film.

    Parameters
    ----------
    case : Case or Setup
        Case of the contact, or its setup.
    conditions : Conditions or PointConditions
        Operating conditions.
    film : Film or PointFilm
        Converged film.
    rq : float
        Combined Rq of the surfaces over the Hertz zone before they are deformed [m].
    smooth : ndarray or None
        Film thickness with smooth surfaces at the nodes of the film [m]; None if it was not solved.
    coarser : Coarser or None
        Asperities on a grid with half the nodes; None if it was not solved.

    Returns
    -------
    Asperities
        Spots, what they carry and conduct, and the film around them.

    Examples
    --------
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": 0.005}
    >>> wave = {"surface": 1, "generator": "sinusoid", "amplitude": "0.3 um", "wavelength": "20 um"}
    >>> table = {"contact": contact | {"max_hertz_pressure": "0.5 GPa"}, "lubricant": {"base": "paper"}}
    >>> result = solve(Case.from_dict(table | {"grid": {"nodes": 401}, "roughness": [wave]}))
    >>> result.asperities.touching.spots > 0, result.asperities.electrical.behaviour
    (True, 'resistive')
    """
    spots = spots_of(film)
    friction = case.contact.boundary_friction if isinstance(case, Case) else None
    carried = touching(conditions, film, spots, rq=rq, smooth=smooth, friction=friction, coarser=coarser)
    return Asperities(
        spots=spots,
        touching=carried,
        electrical=electrical(
            film,
            spots,
            case.oil,
            electric=case.electric,
            discharge=case.discharge,
            semi_axes=conditions.semi_axes,
            area_error=None if carried.load_share > _NEARLY_ALL else carried.contact_area_error,
        ),
        balance=oil_balance(case, conditions, film),
        coarser=coarser,
    )
