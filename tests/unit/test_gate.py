"""The list of long tests that every change must pass names tests that are there."""

from tests.conftest import GATE
from tests.helpers.places import ROOT


def test_chosen_tests_are_there_once():
    names = [name for group in GATE.values() for name in group["tests"]]
    assert len(set(names)) == len(names)
    missing = []
    for name in names:
        path, _, function = name.partition("[")[0].partition("::")
        file = ROOT / path
        if not (file.is_file() and f"def {function}(" in file.read_text(encoding="utf-8")):
            missing.append(name)
    assert missing == []
