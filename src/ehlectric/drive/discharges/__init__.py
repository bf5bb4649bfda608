"""Discharges of bearings over time: events, their statistics, and the voltage between them."""
