"""Poisson's equation in the gap between two conducting surfaces: from the walls to the electric field."""
