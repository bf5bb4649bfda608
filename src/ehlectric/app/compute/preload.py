"""Loads what the first answers need, and computes one, so that every fork of this process answers at once."""

from __future__ import annotations

import tomli

from ehlectric.app.compute.bearing_answers import quick_answer
from ehlectric.runs.example_files import example_text

# Units, files of the library and modules that are imported where they are used are read once, here.
quick_answer(tomli.loads(example_text("bearing_6208")))
