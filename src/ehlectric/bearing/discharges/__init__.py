"""Discharges of a bearing beside its breakdown voltages: energy, pit, current density, and leakage."""
