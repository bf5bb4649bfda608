"""What the machine has of memory."""

from __future__ import annotations

import os

import numpy as np


def physical_memory() -> float:
    """Memory of the machine [bytes], infinite where the system does not tell."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return np.inf
