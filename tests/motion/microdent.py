"""A dent that moves through the contact of a ball and a disc: measured profiles, and the transient film."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from ehlectric import Case, solve_motion
from tests.helpers.ball_on_disc import oil
from tests.helpers.measurements import load
from tests.helpers.shared import shared
from tests.helpers.surface_writers import x3p

MICRO, NANO = 1e-6, 1e-9
HERTZ_RADIUS = 136.5 * MICRO
OPTICS_END = 340.0  # [nm]; no film is measured above


@dataclass(frozen=True)
class Dent:
    """A dent of the ball and its motion: speed over the entrainment speed, depth and radius [m]."""

    speed: float
    depth: float
    radius: float
    passes: float

    def map(self, path, spacing=1.5 * MICRO):
        """Write its height map, as large as the domain on both sides of it, to an X3P file.

        The program removes the mean height of a map; the map is large, so that this moves the ball by 4 nm.
        """
        x = spacing * np.arange(-390, 391)
        y = spacing * np.arange(-200, 201)
        s = np.hypot(y[:, None], x) / (1.2 * self.radius)
        heights = -self.depth * np.cos(0.5 * np.pi * s) * np.exp(-2.0 * s**2)
        return x3p(path, heights, CX_Increment=repr(spacing), CY_Increment=repr(spacing))


DENTS = {
    "rolling": Dent(1.0, 7.0 * MICRO, 15.5 * MICRO, 1.25),
    "sliding": Dent(0.5, 1.3 * MICRO, 21.5 * MICRO, 2.4),
}


def contact(nodes=129):
    """Case of the smooth contact."""
    lubricant = oil(0.25, 22.0) | {"roelands_pressure": 0.196e9}
    z = 22e-9 * 0.196e9 / (np.log(0.25) + 9.67)
    return Case.from_dict(
        {
            "contact": {
                "geometry": "point",
                "radius_x": "12.5 mm",
                "radius_y": "12.5 mm",
                "load": "15 N",
                "reduced_modulus": "110 GPa",
                "entrainment_speed": "0.09 m/s",
            },
            "lubricant": lubricant | {"roelands_z": float(z)},
            "grid": {
                "nodes": nodes,
                "inlet": -2.5,
                "outlet": 1.5,
                "side": 2.0,
                "field_degree": 2,
                "field_nodes": 17,
                "field_nodes_y": 17,
            },
        }
    )


def passage(dent, folder, *, nodes=129):
    """Films along entrainment while a dent passes.

    Parameters
    ----------
    dent : Dent
        The dent and its motion.
    folder : Path
        Folder for its height map.
    nodes : int, optional
        Nodes in each direction.

    Returns
    -------
    x : ndarray, shape (n,)
        Position along entrainment [µm].
    middle : ndarray, shape (t,)
        Position of the middle of the dent at each instant [µm]; NaN before it is in the domain.
    film : ndarray, shape (t, n)
        Film through the middle of the dent [nm].
    """
    return tuple(shared(partial(_passage, dent, folder, nodes), "dent", dent, contact(nodes).to_toml()))


def _passage(dent, folder, nodes):
    path = dent.map(Path(folder) / "dent.x3p")
    tables = contact(nodes).to_dict()
    tables["contact"]["slide_to_roll_ratio"] = 2.0 * (dent.speed - 1.0)
    tables["roughness"] = [{"surface": 1, "file": str(path), "extend": "flat"}]
    steps = round(dent.passes * (nodes - 1))
    tables["motion"] = {"passes": dent.passes, "steps": steps, "record": steps // 2 + 1}
    result = solve_motion(Case.from_dict(tables))
    assert result.converged
    data = result.dataset
    row = data.sizes["y"] // 2
    seconds = data["time"].to_numpy()[data["frame_step"].to_numpy().astype(int)]
    middle = dent.speed * 0.09 * (seconds - data.attrs["coincident"]) / MICRO
    return data["x"].to_numpy() / MICRO, middle, data["thickness"].to_numpy()[:, :, row] / NANO


def measured(name):
    """Measured profiles of a dent: positions [µm], films [nm], and the middle of the dent [µm].

    The dent is where the film is above the end of the optics; it is None where the dent is outside.
    """
    table = load("mourier_microdent").table
    table = table[table["dent_speed"] == DENTS[name].speed]
    profiles = []
    for _, part in table.groupby("instant"):
        x, film = part["position"].to_numpy(), part["film"].to_numpy()
        inside = x[(film > OPTICS_END) & (np.abs(x) < 130.0)]
        middle = 0.5 * (inside.min() + inside.max()) if inside.size else None
        profiles.append((x, film, middle))
    return profiles


def at(middle, films, wanted):
    """Computed film at the instant at which the dent is at a position [µm], between recorded instants."""
    after = int(np.searchsorted(middle, wanted))
    share = (wanted - middle[after - 1]) / (middle[after] - middle[after - 1])
    return (1.0 - share) * films[after - 1] + share * films[after]
