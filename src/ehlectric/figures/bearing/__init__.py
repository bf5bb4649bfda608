"""Figures of a bearing."""
