"""Transient contacts with moving roughness: time steps, files of runs, and summaries."""
