"""The examples of docs/howto/python.md run one after the other, as in a notebook."""

import logging

import pytest
from docs import pages

from tests.helpers.places import EXAMPLES


def blocks():
    return pages.blocks(pages.page("python.md"), "python")


@pytest.mark.slow
def test_the_examples_run(tmp_path, monkeypatch, capsys):
    import matplotlib.pyplot as plt

    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(EXAMPLES)
    monkeypatch.setattr(logging, "basicConfig", lambda **_: None)
    names = {"__name__": "__main__"}
    for number, block in enumerate(blocks()):
        exec(compile(block, f"block {number} of python.md", "exec"), names)
    plt.close("all")
    printed = capsys.readouterr().out
    assert "contact.reduced_radus: unknown key; the nearest known one is contact.reduced_radius" in printed
    assert "<SweepResults grid of 5 points over entrainment speed, 5 solved, verdict " in printed
    assert len(names["margins"]) == 6
    assert list(names["margins"].values()) == sorted(names["margins"].values())
    assert names["first_breakdown"](names["bearing"]) > 1.0
    assert names["largest_field"](names["case"]) > 1e6
    assert {path.name for path in tmp_path.glob("*.pdf")} == {"film.pdf", "contact.pdf"}
    assert (tmp_path / "results" / "film.png").is_file()
