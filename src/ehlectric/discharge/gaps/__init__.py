"""Capacitance of the gap between two whole bodies, outside the domain of the solved film."""
