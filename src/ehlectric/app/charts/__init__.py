"""Figures of the pages as data for Plotly: they can be zoomed and rotated, and show values with units."""
