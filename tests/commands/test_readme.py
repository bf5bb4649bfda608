"""README: its Python runs, and its files exist."""

import re

import matplotlib.pyplot as plt
import pytest

from tests.helpers.places import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```", README, flags=re.S | re.M)


def test_the_links_of_the_readme_lead_somewhere():
    links = re.findall(r"\]\(([\w/.-]+)\)|src=\"([^\"]+)\"", README)
    assert len(links) > 10
    for link in links:
        assert (ROOT / "".join(link)).exists(), link


@pytest.mark.slow
@pytest.mark.gate
def test_the_python_of_the_readme_runs(monkeypatch):
    monkeypatch.chdir(ROOT)
    (block,) = blocks("python")
    names = {}
    exec(compile(block, "README.md", "exec"), names)
    assert names["result"].converged
    plt.close("all")
