"""Supply of oil over speed: SKF's replenishment factor, and the half time of a film without supply."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric import BearingCase
from ehlectric.bearing.film_factor import contact_half_time
from ehlectric.bearing.loads.geometry import rolling_speeds
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.ring_contacts import BallContact, RingContacts
from ehlectric.formulas.inlet_supply import replenishment_factor
from ehlectric.runs.example_files import examples_folder
from sketches.pen import BLUE, GREEN, INK, RED, SIZE

_RPM = math.pi / 30.0
# Colour by the temperature in degC, with the kinematic viscosity of the oil of the examples [m^2/s].
_OILS = {40: (BLUE, 46e-6), 70: (GREEN, 14.85e-6), 100: (RED, 6.8e-6)}

# Load of the most loaded inner contact of the example [N], and its contact angle [rad].
_LOAD, _ANGLE = 876.0, 0.17


def supply() -> Figure:
    """Factor of a 6208 in an oil bath and greased, and the time in which its film halves without supply."""
    figure = Figure(figsize=(8.6, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    _factors(left)
    _half_times(right)
    for ax in (left, right):
        ax.tick_params(colors=INK, labelsize=SIZE - 1)
        ax.spines[["top", "right"]].set_visible(False)
        ax.legend(frameon=False, fontsize=SIZE - 1)
    return figure


def _factors(ax: Axes) -> None:
    turns = np.linspace(0.0, 15000.0, 201)
    for celsius, (colour, viscosity) in _OILS.items():
        for way, style in (("oil-bath", "-"), ("grease", "--")):
            factor = replenishment_factor(
                turns * _RPM,
                viscosity,
                bore=0.04,
                outer_diameter=0.08,
                supply=way,
                kind="deep-groove ball",
            )
            label = f"{celsius} °C" if way == "oil-bath" else None
            ax.plot(turns / 1000.0, factor, style, color=colour, lw=1.6, label=label)
    ax.set(xlabel="speed [1000 rpm]", ylabel=r"replenishment factor $\varphi_\mathrm{rs}$", ylim=(0.0, 1.02))
    ax.set_title("solid: oil bath or jet, dashed: grease", size=SIZE, loc="left")


def _half_times(ax: Axes) -> None:
    greased = {"bearing.supply": "grease"}
    example = BearingCase.from_toml(examples_folder() / "bearing_6208.toml").replace(greased)
    turns, inner = np.geomspace(500.0, 15000.0, 9), True
    for celsius, (colour, _) in _OILS.items():
        times = []
        for speed in turns * _RPM:
            case = example.replace({"bearing.inner_speed": speed, "bearing.temperature": 273.15 + celsius})
            conditions = resolve_bearing(case)
            bearing = conditions.bearing
            rolling = rolling_speeds(
                element_diameter=bearing.element_diameter,
                pitch_diameter=bearing.pitch_diameter,
                inner_speed=speed,
                contact_angle=_ANGLE,
            )
            contact = BallContact(RingContacts(conditions, inner, _ANGLE, rolling.inner_entrainment), _LOAD)
            at = contact.conditions
            axes = at.semi_axis_x, at.semi_axis_y
            times.append(contact_half_time(contact.ring, at.max_pressure, axes, contact.film))
        ax.loglog(turns / 1000.0, times, color=colour, lw=1.6, label=f"{celsius} °C")
    ax.set(xlabel="speed [1000 rpm]", ylabel="half time without supply [s]")
    ax.set_title(f"inner contact at {_LOAD:g} N, greased", size=SIZE, loc="left")
