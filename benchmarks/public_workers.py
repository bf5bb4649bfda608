"""The contact of examples/ball_contact.toml, solved by public packages through their own interfaces.

PYTHON benchmarks/public_workers.py PACKAGE CONTACT, with the Python that has the package and the contact as
JSON (see ``public_solvers.Contact``); prints one line of JSON. It does not import
ehlectric, which need not be installed there.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
import sys
import time
from typing import Any

Contact = dict[str, Any]


def slippy(contact: Contact) -> dict[str, Any]:
    """IterSemiSystem with UnifiedReynoldsSolver: line relaxation in distributed changes, first-order wedge.

    As in the example of IterSemiSystem, but for the domain, which begins where ours does, and the limit of
    the iterations, in place of which there is one of the time. Its own initial guess is left out: 0.5.2
    always starts from no pressure.
    """
    _slippy(contact | {"nodes": 17, "iterations": 2})  # compiles
    started = time.perf_counter()
    state, said = _slippy(contact)
    seconds = time.perf_counter() - started
    n, gap = contact["nodes"], state["gap"]
    change = re.findall(r"last change in pressure was (\S+)", said)
    return {
        "seconds": seconds,
        "minimum": float(gap.min()),
        "central": _central(contact, gap[:, n // 2]),
        "converged": bool(state["converged"]),
        "said": f"last relative change of the pressures {float(change[-1]):.0e}",
    }


def _slippy(contact: Contact) -> tuple[dict[str, Any], str]:
    import numpy as np
    import slippy
    from slippy import contact as models
    from slippy import surface

    slippy.CUDA = False
    n, a, radius = contact["nodes"], contact["half_width"], contact["radius"]
    x, y = a * np.linspace(*contact["along"], n), a * np.linspace(*contact["across"], n)
    profile = -(x[:, np.newaxis] ** 2 + y**2) / (2.0 * radius)
    ball = surface.Surface(profile=profile, grid_spacing=x[1] - x[0])
    flat = surface.FlatSurface()
    poisson = 0.3
    steel = models.Elastic(f"steel {n}", {"E": (1.0 - poisson**2) * contact["reduced_modulus"], "v": poisson})
    ball.material = flat.material = steel

    pressure = contact["max_pressure"]
    ratio = pressure / contact["roelands_pressure"]
    steepness = contact["alpha"] * contact["roelands_pressure"] / contact["roelands_z"]

    def viscosity(nd_pressure: Any, **_: Any) -> Any:
        return np.exp(steepness * ((1.0 + ratio * nd_pressure) ** contact["roelands_z"] - 1.0))

    oil = models.Lubricant("oil")
    oil.add_sub_model("nd_viscosity", viscosity)
    oil.add_sub_model("nd_density", models.lubricant_models.nd_dowson_higginson(pressure))
    model = models.ContactModel("ball on plane", ball, flat, oil)
    reynolds = models.UnifiedReynoldsSolver(
        time_step=0,
        grid_spacing=ball.grid_spacing,
        hertzian_pressure=pressure,
        radius_in_rolling_direction=radius,
        hertzian_half_width=a,
        dimentional_viscosity=contact["viscosity"],
        dimentional_density=872.0,
    )
    step = models.IterSemiSystem(
        "steady",
        reynolds,
        contact["speed"],
        1,
        no_time=True,
        normal_load=contact["load"],
        relaxation_factor=contact["relaxation"],
        max_it_pressure=contact["iterations"],
        no_update_warning=False,
    )
    model.add_step(step)
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        state = model.solve(verbose=True)
    return state, said.getvalue()


def _central(contact: Contact, line: Any) -> float:
    import numpy as np

    return float(np.interp(0.0, np.linspace(*contact["along"], line.size), line))


def tribology(contact: Contact) -> dict[str, Any]:
    """Film thickness of a point contact by the package's formula: it has no Reynolds equation."""
    import tribology as package

    started = time.perf_counter()
    central = package.dowhampoint(
        contact["speed"],
        contact["load"],
        contact["alpha"],
        contact["reduced_modulus"],
        contact["radius"],
        contact["viscosity"],
    )
    seconds = time.perf_counter() - started
    solvers = [name for name in dir(package) if re.search("reynolds|ehl|lubricat.*solve", name.lower())]
    said = ", ".join(solvers) or "a formula, of the central film; no function of the package solves a film"
    return {"seconds": seconds, "central": float(central), "said": said}


def gapflow(contact: Contact) -> dict[str, Any]:
    """A ball over a plane put to GaPFlow: explicit in time, elastic, with Roelands' law."""
    from GaPFlow.problem import Problem

    n, a = contact["nodes"], contact["half_width"]
    sides = {side: ["D", "N", "N"] for side in ("xE", "xW", "yS", "yN")}
    problem = {
        "options": {"output": "gapflow", "silent": True},
        "grid": {
            "Nx": n - 1,
            "Ny": n - 1,
            "Lx": a * (contact["along"][1] - contact["along"][0]),
            "Ly": a * (contact["across"][1] - contact["across"][0]),
            **sides,
            **{f"{side}_D": 872.0 for side in sides},
        },
        "geometry": {"type": "ball", "radius": contact["radius"], "U": contact["speed"], "V": 0.0},
        "numerics": {"adaptive": 1, "max_it": 1000},
        "properties": {
            "EOS": "DH",
            "rho0": 872.0,
            "P0": 1e5,
            "C1": 0.59e9,
            "C2": 1.34,
            "shear": contact["viscosity"],
            "bulk": 0.0,
            "elastic": {"E": contact["reduced_modulus"], "v": 0.0},
            "piezo": {
                "name": "Roelands",
                "p_ref": contact["roelands_pressure"],
                "z": contact["roelands_z"],
            },
        },
    }
    with contextlib.redirect_stdout(io.StringIO()):
        Problem.from_string(json.dumps(problem)).run()
    return {"said": "took a ball"}


PACKAGES = {"slippy": slippy, "tribology": tribology, "GaPFlow": gapflow}


def main() -> None:
    """Solve the contact, and print the result as JSON."""
    try:
        answer = PACKAGES[sys.argv[1]](json.loads(sys.argv[2]))
    except Exception as error:  # whatever a package raises is its answer
        answer = {"said": f"{type(error).__name__}: {error}"}
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
