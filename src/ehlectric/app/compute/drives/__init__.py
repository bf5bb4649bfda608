"""Answers about drives: at once by the capacitive divider, and simulated over time."""
