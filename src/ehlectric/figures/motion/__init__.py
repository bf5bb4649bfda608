"""Figures and animations of transient contacts."""
