"""Input files: every key with unit, bounds and default; library of lubricants, solids and bearings."""
