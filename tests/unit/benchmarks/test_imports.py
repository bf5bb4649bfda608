"""Benchmarks are run by hand: what they import is there all the same."""

import importlib

from tests.helpers.each import each
from tests.helpers.places import ROOT

NAMES = sorted(path.stem for path in (ROOT / "benchmarks").glob("*.py"))


@each("name", NAMES)
def test_a_benchmark_is_imported(name):
    assert importlib.import_module(f"benchmarks.{name}").__doc__ or name == "__init__"
