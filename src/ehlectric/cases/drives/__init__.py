"""Inputs of a drive file: source, circuit, bearings and breakdown."""
