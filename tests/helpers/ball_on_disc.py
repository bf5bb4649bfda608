"""Computed counterparts of the measurements: the cases of the rigs, and what they give."""

from __future__ import annotations

from functools import partial

import numpy as np

from ehlectric import Case, solve
from ehlectric.lubricant.viscosity import roelands_exponent
from tests.helpers.shared import shared

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

    def found(at_speed):
        film = solve(at_speed).film
        assert film.converged, at_speed.contact.entrainment_speed
        return [np.array([film.central_thickness / NANO])]

    return _over_speed(found, case, speeds)[0]


def capacitances(case, speeds):
    """Central films [nm] and capacitances at the meter with air and with oil around the film [pF]."""

    def found(at_speed):
        result = solve(at_speed)
        assert result.film.converged, at_speed.contact.entrainment_speed
        meter = result.summary()["meter"]
        around = [meter[f"capacitance_{filled}"] / PICO for filled in ("air", "oil")]
        return [np.array([result.film.central_thickness / NANO, *around])]

    return _over_speed(found, case, speeds)


def _over_speed(found, case, speeds):
    """Numbers of a case at each entrainment speed, one row for each number."""
    cases = [case.replace({"contact.entrainment_speed": float(speed)}) for speed in speeds]
    rows = [shared(partial(found, each), found.__qualname__, each.to_toml())[0] for each in cases]
    return np.array(rows).T
