"""Folders and files that tests read."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
DEKTAK = EXAMPLES / "surfaces" / "dektak-1.csv"
DATA = ROOT / "tests" / "data"
SURFACES = DATA / "surfaces"
PUBLISHED = DATA / "published"
MEASURED = DATA / "measured"
