"""Closed formulas that need no grid: Hertzian contact, film thickness and lubrication regimes."""
