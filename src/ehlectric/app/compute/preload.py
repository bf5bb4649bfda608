"""Loads what the first answers need, and computes one, so that every fork of this process answers at once."""

from __future__ import annotations

import tomllib
from importlib import import_module

from ehlectric.app.compute.bearing_answers import quick_answer
from ehlectric.runs.example_files import example_text

# Functions of the other pages; the function of drives loads a compiler, in a quarter of a second, and the
# others take less than a tenth of a second each.
for name in (
    "drive_answers",
    "answer_parts",
    "contact_answers",
    "motion_answers",
    "surface_answers",
    "sweep_answers",
    "page_files",
):
    import_module(f"ehlectric.app.compute.{name}")

# Parts of SciPy, which loads each of them at its first use.
for name in ("fft", "interpolate", "linalg", "ndimage", "sparse.linalg", "special"):
    import_module(f"scipy.{name}")

# Units, files of the library and modules that are imported where they are used are read once, here.
quick_answer(tomllib.loads(example_text("bearing_6208")))
