"""Programs of the system that read what ehlectric writes."""

import os
import shutil

import pytest


def program(name):
    """Path of a program; a test without it is skipped, or fails where all of them are required."""
    found = shutil.which(name)
    if found is None:
        if os.environ.get("EHLECTRIC_BROWSER") == "required":
            pytest.fail(f"{name} is missing; install it with: make browser")
        pytest.skip(f"needs {name}")
    return found
