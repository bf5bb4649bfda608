"""Starved films: content of oil in the whole domain, and the iteration that finds the meniscus."""
