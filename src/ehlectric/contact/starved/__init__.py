"""Starved contacts: supply of oil of a film problem, keys of the summary, stored values and warnings."""
