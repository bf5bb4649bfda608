"""Input files: every key with its unit, bounds and default; the library of oils, solids and bearings."""
