"""A point and a line contact whose surfaces touch, each solved once."""

from functools import cache

from ehlectric import Case, PointResult, Result, solve

WAVE = {"surface": 1, "generator": "sinusoid", "amplitude": "0.3 um", "wavelength": "40 um"}
LINE = Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "0.5 GPa",
            "entrainment_speed": "0.01 m/s",
            "boundary_friction": 0.12,
        },
        "lubricant": {"base": "paper"},
        "roughness": [WAVE],
        "grid": {"nodes": 401},
    }
)
POINT = Case.from_dict(
    {
        "contact": {
            "geometry": "point",
            "radius_x": "10 mm",
            "radius_y": "10 mm",
            "reduced_modulus": "226 GPa",
            "load": "20 N",
            "entrainment_speed": "6.4 mm/s",
        },
        "lubricant": {"base": "paper"},
        "electric": {"resistivity": "2.2e-7 ohm m"},
        "roughness": [
            {"surface": 1, "generator": "gaussian", "rq": "100 nm", "correlation_length": "40 um", "seed": 1}
        ],
        "grid": {"nodes": 65},
    }
)


@cache
def solved(geometry: str = "point") -> PointResult | Result:
    """Result of the contact of a geometry."""
    return solve(POINT if geometry == "point" else LINE)
