"""Figures of one contact."""
