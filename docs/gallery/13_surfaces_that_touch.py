"""
Mixed lubrication
=================

A ball runs on a rough plane at 20 mm/s. The film is thinner than the roughness, so that asperities are in
contact, carry a part of the load and conduct. ``examples/mixed_contact.toml`` is a similar case on more
nodes.
"""

import ehlectric
from ehlectric.contact.touching import share_text

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "geometry": "point",
            "radius_x": "10 mm",
            "radius_y": "10 mm",
            "reduced_modulus": "226 GPa",
            "load": "20 N",
            "entrainment_speed": "20 mm/s",
            "boundary_film": "1 nm",
        },
        "lubricant": {
            "base": "paper",
            "viscosity": "0.04 Pa s",
            "pressure_viscosity_coefficient": "20 1/GPa",
        },
        "roughness": [
            {
                "surface": 1,
                "generator": "gaussian",
                "rq": "0.4 um",
                "correlation_length": "60 um",
                "seed": 1,
            }
        ],
        "electric": {"potential_1": "0 V", "potential_2": "2 V", "resistivity": "2.2e-7 ohm m"},
        "discharge": {"dielectric_strength": "15 V/um"},
        "grid": {"nodes": 97},
    }
)
result = ehlectric.solve(case, require_convergence=True)

# %%
# The film, with the nodes in contact: there the gap is the boundary film of 1 nm. The spots
# are patches and strips on asperities that the contact has flattened.
result.plot("spots")

# %%
# What the spots carry and conduct, and the film around them. The least film is the boundary film, so the
# breakdown voltage is given for parts of the Hertzian zone outside of the spots.
touching, electrical = result.asperities.touching, result.asperities.electrical
print(f"electrical behaviour         {electrical.behaviour}")
print(f"spots                        {touching.spots}, {touching.spots_of_one_node} of a single node")
print(f"part of the Hertzian contact area       {100 * touching.contact_area_share:.0f} %")
print(f"mean film outside of them    {1e9 * touching.mean_film:.0f} nm")
print(f"resistance of the spots      {1e3 * electrical.resistance:.1f} mΩ")
for part in (1, 5, 50):
    voltage = getattr(electrical, f"breakdown_{part}")
    print(f"{part:2} % of the film breaks down at {voltage:.2g} V")

# %%
# The load share of the asperities depends on the grid more than any other number. The contact is therefore
# solved with half the nodes as well, and both shares are printed next to each other. At higher speeds oil
# carries the load. At 0.5 m/s no asperity is in contact on this grid. The word "intermittent" is also printed
# where the grid leaves open whether there are spots at all.
for speed in ("20 mm/s", "0.1 m/s", "0.5 m/s"):
    at_speed = result
    if speed != "20 mm/s":
        at_speed = ehlectric.solve(case.replace({"contact.entrainment_speed": speed}))
    found, coarser = at_speed.asperities, at_speed.asperities.coarser
    before = None if coarser is None else coarser.load_share
    grids = (
        "" if before is None else f" ({share_text(before, found.touching.load_share)} % on half the nodes)"
    )
    share = share_text(found.touching.load_share, before)
    print(
        f"{speed:>8}: asperities carry {share} % of the load{grids}, "
        f"mean film {1e9 * found.touching.mean_film:.0f} nm, {found.electrical.behaviour}"
    )
