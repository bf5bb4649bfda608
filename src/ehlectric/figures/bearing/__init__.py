"""Figures of bearings: loads and films around the shaft, circuit, impedance, and speed."""
