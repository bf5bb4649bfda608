"""Names of the figures of every kind of result."""

from __future__ import annotations

FIGURE_FILES = (
    "film.png",
    "potential.png",
    "field_strength.png",
    "field_profiles.png",
    "field_deviation.png",
)
ROUGHNESS_FIGURE = "roughness.png"  # of rough contacts alone
POINT_FIGURE_FILES = (
    "film_map.png",
    "pressure_map.png",
    "field_map.png",
    "field_deviation.png",
    "field_sections.png",
    "cuts.png",
)

# Of a whole bearing: loads and films, the circuit, its course over a pitch of the cage, and over frequency.
BEARING_FIGURE_FILES = (
    "bearing_loads.png",
    "bearing_circuit.png",
    "bearing_pitch.png",
    "bearing_impedance.png",
)

# And over the speed of the shaft.
SPEED_FIGURE_FILES = ("capacitance_over_speed.png", "breakdown_over_speed.png")

# Figures of transient contacts: over time, over position and time, and compared with stationary roughness.
MOTION_FIGURE_FILES = ("motion_history.png", "motion_maps.png", "motion_beside_stationary.png")

# A folder holds one result: what another one left of these goes.
ALL_FIGURES = tuple(dict.fromkeys((*FIGURE_FILES, *POINT_FIGURE_FILES, ROUGHNESS_FIGURE)))
