"""Computed counterparts of the measurements: the cases of the rigs, and what they give."""

from __future__ import annotations

import numpy as np

from ehlectric import Case, solve
from ehlectric.lubricant.viscosity import roelands_exponent

NANO, PICO = 1e-9, 1e-12
GLASS = {"youngs_modulus": "70 GPa", "poissons_ratio": 0.21}
STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3}


def oil(viscosity, coefficient, *, permittivity=2.1):
    """Oil after Roelands, from its viscosity [Pa s] and pressure-viscosity coefficient [1/GPa]."""
    pressure = 0.198e9
    return {
        "viscosity": viscosity,
        "viscosity_law": "roelands",
        "pressure_viscosity_coefficient": coefficient * 1e-9,
        "roelands_z": roelands_exponent(viscosity, coefficient * 1e-9, pressure),
        "roelands_pressure": pressure,
        "density_law": "dowson-higginson",
        "density_c1": 0.59e9,
        "density_c2": 1.34,
        "permittivity_law": "clausius-mossotti",
        "relative_permittivity": permittivity,
    }


# Oils at the temperatures of their runs. 4.27 mPa s is fitted to one film of a rig whose oil is not named.
# The capacitance over the film does not depend on the viscosity of PAO4, which only sets the speeds.
OILS = {
    "fva3": oil(0.2025, 24.2),
    "fva3_library": {"base": "fva-3"},
    "shc320": oil(0.296, 15.0),
    "unnamed": oil(4.27e-3, 14.0),
    "pao4": oil(0.025, 14.0, permittivity=2.10),
}


def ball_on_disc(oil, *, disc=GLASS, nodes=257, temperature=None, **tables):
    """Case of the rig's ball of 19.05 mm on its disc under 20 N, at 1 m/s and a temperature [K]."""
    contact = {
        "geometry": "point",
        "radius_x": "9.525 mm",
        "radius_y": "9.525 mm",
        "body_1": STEEL,
        "body_2": disc,
        "load": "20 N",
        "entrainment_speed": "1 m/s",
    }
    if temperature is not None:
        contact["temperature"] = temperature
    grid = {"nodes": nodes, "inlet": -4.5, "outlet": 1.5, "side": 3.0}
    return Case.from_dict({"contact": contact, "lubricant": oil, "grid": grid} | tables)


def central_films(case, speeds):
    """Central films [nm] of a case at other entrainment speeds [m/s]."""
    films = []
    for speed in speeds:
        film = solve(case.replace({"contact.entrainment_speed": float(speed)})).film
        assert film.converged, speed
        films.append(film.central_thickness / NANO)
    return np.array(films)


def capacitances(case, speeds):
    """Central films [nm] and capacitances at the meter with air and with oil around the film [pF]."""
    rows = []
    for speed in speeds:
        result = solve(case.replace({"contact.entrainment_speed": float(speed)}))
        assert result.film.converged, speed
        meter = result.summary()["meter"]
        rows.append(
            (
                result.film.central_thickness / NANO,
                *(meter[f"capacitance_{around}"] / PICO for around in ("air", "oil")),
            )
        )
    return np.array(rows).T
