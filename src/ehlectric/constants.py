"""Physical constants. ``scipy.constants`` takes a tenth of a second to load, and changes with its release."""

# Electric constant [F/m], CODATA 2022, doi:10.1103/RevModPhys.97.025002.
EPSILON_0 = 8.8541878188e-12

# Molar gas constant [J/(mol K)], exact in the SI.
GAS_CONSTANT = 8.31446261815324

# Standard acceleration of gravity [m/s^2], exact.
GRAVITY = 9.80665
