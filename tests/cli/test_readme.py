"""README: its answer is the one the command prints, its Python runs, and its files exist."""

import re
import shlex

import matplotlib.pyplot as plt
import pytest

from tests.helpers.commands import run_command
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
def test_the_answer_of_the_readme_is_that_of_the_command(tmp_path):
    command = shlex.split(blocks("sh")[0].strip())
    assert command[:2] == ["ehlectric", "bearing"]
    words = [str(ROOT / word) if word.startswith("examples/") else word for word in command[1:]]
    done = run_command(*words, "--no-plots", cwd=tmp_path)
    assert done.returncode == 0
    printed = " ".join(done.stdout.split())
    rows, verdict = re.split(r"^(?=Breakdown|No breakdown)", blocks("text")[0], maxsplit=1, flags=re.M)
    for row in rows.splitlines():
        assert " ".join(row.split()) in printed
    assert " ".join(verdict.split()) in printed


@pytest.mark.slow
def test_the_python_of_the_readme_runs(monkeypatch):
    monkeypatch.chdir(ROOT)
    (block,) = blocks("python")
    names = {}
    exec(compile(block, "README.md", "exec"), names)
    assert names["result"].converged
    plt.close("all")
