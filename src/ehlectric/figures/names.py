"""Names of the files of figures, of every kind of result.

The functions that draw them stand in tables by these names; this module is imported without matplotlib.
"""

from __future__ import annotations

# Figures of contacts. The figure of the roughness is drawn of rough contacts only.
FIGURE_FILES = (
    "film.png",
    "potential.png",
    "field_strength.png",
    "field_profiles.png",
    "field_deviation.png",
)
POINT_FIGURE_FILES = (
    "film_map.png",
    "pressure_map.png",
    "field_map.png",
    "field_deviation.png",
    "field_sections.png",
    "cuts.png",
)
ROUGHNESS_FIGURE = "roughness.png"

# Figures of stationary contacts, line or point.
ALL_FIGURES = tuple(dict.fromkeys((*FIGURE_FILES, *POINT_FIGURE_FILES, ROUGHNESS_FIGURE)))

# Figures of transient contacts: over time, over position and time, and compared with stationary roughness.
MOTION_FIGURE_FILES = ("motion_history.png", "motion_maps.png", "motion_beside_stationary.png")

# Figures of bearings: loads and films, circuit, course over a pitch of the cage, impedance over frequency.
BEARING_FIGURE_FILES = (
    "bearing_loads.png",
    "bearing_circuit.png",
    "bearing_pitch.png",
    "bearing_impedance.png",
)

# Figures of bearings over the speed of the shaft.
SPEED_FIGURE_FILES = ("capacitance_over_speed.png", "breakdown_over_speed.png")

# Figure of the sensitivity of a sweep; maps and lines of a sweep are named by the value that they show.
SENSITIVITY_FIGURE = "sensitivity.png"


def map_files(value: str) -> tuple[str, str]:
    """Names of the files of the map and of the lines of a value of a sweep.

    Examples
    --------
    >>> map_files("discharge.breakdown_voltage")
    ('map_discharge.breakdown_voltage.png', 'lines_discharge.breakdown_voltage.png')
    """
    return f"map_{value}.png", f"lines_{value}.png"
