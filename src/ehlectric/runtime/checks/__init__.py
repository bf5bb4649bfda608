"""Checks of stored files before they are used: seal, soundness of HDF5 files, and rules for their values."""
