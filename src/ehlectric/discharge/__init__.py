"""Electrical discharge of a solved contact: breakdown voltage, capacitance by zone, energy and pit size."""
