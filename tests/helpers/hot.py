"""Oils, bodies and columns of heated films, for tests."""

import numpy as np

from ehlectric.film.sheared.profile import Across
from ehlectric.film.thermal.columns import Stream
from ehlectric.film.thermal.half_space import Surface
from ehlectric.film.thermal.physics import Body

STEEL = {"thermal_conductivity": 46.0, "heat_capacity": 470.0, "density": 7850.0}


def steel(temperature):
    """Body of steel with a bulk temperature [K]."""
    return Body(temperature, **STEEL)


def cold_surface(temperature, nodes):
    """Surface that stays at its temperature [K], whatever heat flows into it."""
    downstream = np.zeros(nodes)
    downstream[0] = 1e-14
    return Surface(temperature, downstream, np.zeros(nodes))


def channel(u, *, degree=12, nodes=41, length=1e-3, thickness=1e-6, conductivity=0.14, **other):
    """Stream of a channel with constant thickness; ``u`` [m/s] is a function of zeta or a number."""
    across = Across.of(degree)
    shape = (across.zeta.size, nodes, 1)
    speed = u(across.zeta) if callable(u) else np.full(across.zeta.size, u)
    zeros = np.zeros(shape)
    values = {
        "v": zeros,
        "density": np.full(shape, 870.0),
        "heat_capacity": np.full(shape, 1.74e6),
        "conductivity": np.full(shape, conductivity),
        "heating": zeros,
        "heating_slope": zeros,
        "compression": zeros,
    }
    return Stream(
        across=across,
        dx=length / (nodes - 1),
        dy=0.0,
        symmetric=False,
        thickness=np.full(shape[1:], thickness),
        filling=np.ones(shape[1:]),
        u=np.broadcast_to(speed[:, np.newaxis, np.newaxis], shape).copy(),
        **(values | other),
    )
