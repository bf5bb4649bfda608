"""Contacts of the catalogue's bearings over loads, speeds and temperatures, in the groups of the atlas.

python -m benchmarks.atlas_catalogue    says how many of them lie inside the atlas
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ehlectric.bearing.preparation import prepare_bearing
from ehlectric.bearing.ring_contacts import BallContact, RollerContact
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.library.bearing_catalogue import bearing_catalogue
from ehlectric.contact import PointConditions
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import OilGroups, atlas_film
from ehlectric.film.atlas.atlas_groups import Groups, lubricant_coordinate
from ehlectric.formulas.hertz import axis_ratio
from ehlectric.lubricant.oil import Oil

# Dynamic rating over load, speed of the shaft [rpm], and temperature [degC] of the operating points.
LOADS = (300.0, 100.0, 30.0, 15.0, 8.0, 4.0)
SPEEDS = (100.0, 300.0, 1000.0, 3000.0, 8000.0, 20000.0)
CELSIUS = (0.0, 40.0, 80.0, 120.0)

# ISO VG 46 with the laws of the example of a bearing, which hold at all of these temperatures.
OIL = {
    "base": "paper",
    "temperature": {
        "kinematic_viscosity_40": "46 mm^2/s",
        "kinematic_viscosity_100": "6.8 mm^2/s",
        "density_15": "870 kg/m^3",
    },
}


@dataclass(frozen=True)
class CatalogueContact:
    """Heaviest contact of a ring of a bearing at an operating point.

    Attributes
    ----------
    bearing : str
        Name of the bearing.
    groups : Groups
        Groups of the atlas, L with its coefficient.
    oil : Oil
        Oil at the temperature.
    moes_l : float
        L with the reciprocal asymptotic coefficient, as formulas take it.
    pressure : float
        Hertz pressure [Pa].
    """

    bearing: str
    groups: Groups
    oil: Oil
    moes_l: float
    pressure: float

    @property
    def film(self):
        """Film of the atlas; None where it has none."""
        try:
            return atlas_film(
                self.groups, (self.oil.log_viscosity, self.oil.density_ratio), _oil_groups(self.oil)
            )
        except InputError:
            return None


@lru_cache(maxsize=64)
def _oil_groups(oil):
    return OilGroups.of(oil.log_viscosity, oil.density_ratio)


def catalogue_contacts(kind):
    """Heaviest contacts with both rings of all bearings, "points" or "lines", at all operating points."""
    found = []
    for bearing in bearing_catalogue():
        if (bearing.roller_length is None) != (kind == "points") or bearing.rating is None:
            continue
        for part in LOADS:
            load = bearing.rating.dynamic / part
            for celsius in CELSIUS:
                found += _at_speeds(bearing, load, celsius)
    return found


def _at_speeds(bearing, load, celsius):
    """Contacts at all speeds; the forces of slow shafts serve all, without the centrifugal ones."""
    table = {
        "base": bearing.name,
        "radial_load": load,
        "axial_load": 0.1 * load if bearing.contact_angle else 0.0,
        "inner_speed": "1000 rpm",
        "temperature": f"{celsius} degC",
        "composite_rq": "0.03 um",
    }
    table |= {} if bearing.contact_angle else {"radial_clearance": "10 um"}
    table |= {} if bearing.roller_length is None else {"profile": "none"}
    case = BearingCase.from_dict({"bearing": table, "lubricant": OIL, "contacts": "formula"})
    prepared = prepare_bearing(case, 1)
    made = []
    for ring in prepared.rings:
        heaviest = float(np.max(prepared.equilibria[0].ring(inner=ring.inner).load))
        for speed in SPEEDS:
            moved = replace(ring, speed=ring.speed * speed / 1000.0)
            made.append(_contact(bearing.name, moved, heaviest))
    return made


def _contact(name, ring, load):
    ball = ring.conditions.geometry.__class__.__name__.startswith("Ball")
    conditions = (BallContact if ball else RollerContact)(ring, load).conditions
    contact, oil = conditions.contact, ring.oil
    moved = replace(contact, pressure_viscosity_coefficient=_oil_groups(oil).alpha)
    ratio = None
    if isinstance(conditions, PointConditions):
        ratio = axis_ratio(conditions.radius_x, conditions.radius_y)
    groups = Groups(moved.moes_m, moved.moes_l, ratio)
    return CatalogueContact(name, groups, oil, contact.moes_l, conditions.max_pressure)


def main():
    for kind in ("points", "lines"):
        found = catalogue_contacts(kind)
        inside = sum(contact.film is not None for contact in found)
        print(f"{kind}: {inside} of {len(found)} in the atlas, {100.0 * inside / len(found):.0f} %")
        groups = [contact.groups for contact in found]
        columns = {
            "N": [g.load_group for g in groups],
            "Y": [lubricant_coordinate(g) for g in groups],
            "k": [g.ratio or np.nan for g in groups],
            "GPa": [contact.pressure / 1e9 for contact in found],
            "alpha p_h": [g.hertz_number for g in groups],
        }
        for name, values in columns.items():
            parts = np.quantile(values, [0.0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1.0])
            print(f"{name:>9s}", *(f"{value:9.4g}" for value in parts))


if __name__ == "__main__":
    main()
