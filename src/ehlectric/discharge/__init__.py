"""Electrical discharge through a solved contact: breakdown voltage, capacitance by zone, energy, pit size."""
