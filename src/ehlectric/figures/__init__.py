"""Figures of all results; only this package draws."""
