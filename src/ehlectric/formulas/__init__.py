"""Closed formulas that need no grid: Hertz contact, film thickness and lubrication regimes."""
