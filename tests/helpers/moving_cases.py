"""Small contacts with moving roughness, solved in about a second."""

from ehlectric import Case

LINE = {
    "contact": {
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "0.5 GPa",
        "entrainment_speed": "4 m/s",
    },
    "lubricant": {"base": "paper"},
    "roughness": [{"surface": 1, "generator": "asperity", "height": "50 nm", "width": "60 um"}],
    "grid": {"nodes": 65, "field_degree": 2},
    "motion": {"passes": 1.0},
}
POINT = {
    "contact": {
        "geometry": "point",
        "radius_x": "10 mm",
        "radius_y": "10 mm",
        "reduced_modulus": "226 GPa",
        "load": "20 N",
        "entrainment_speed": "2 m/s",
    },
    "lubricant": {"base": "paper"},
    "roughness": [{"surface": 1, "generator": "pit", "depth": "100 nm", "width": "90 um"}],
    "grid": {"nodes": 65, "field_degree": 2, "field_nodes": 17, "field_nodes_y": 17},
    "motion": {"passes": 1.0},
}
TABLES = {"line": LINE, "point": POINT}


def moving(table=LINE, changes=None, **tables):
    """Case of these tables; whole tables are replaced first, then single values by dotted keys."""
    case = Case.from_dict(table | tables)
    return case.replace(changes) if changes else case
