"""Memory of the machine."""

from __future__ import annotations

import os

import numpy as np


def physical_memory() -> float:
    """Physical memory of the machine [bytes]; infinite where the operating system does not tell it."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return np.inf
