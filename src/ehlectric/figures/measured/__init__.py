"""Figures of measurements beside computed values."""
