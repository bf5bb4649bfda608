"""The notebooks among the examples run in an empty folder, cell by cell, as programs for notebooks do."""

import json
import subprocess
import sys

import pytest

from tests.helpers.places import EXAMPLES

# First line of the output of each notebook, its tables, and its tables and figures.
NOTEBOOKS = {"tour": ("Breakdown likely", 1, 7), "e_axle": ("Breakdown expected", 1, 4)}

# The value of the last line of a cell is shown: as an image, or as a table in HTML. A warning is an error.
RUN = """
import ast, json, sys, warnings
warnings.simplefilter("error")
names, shown = {"__name__": "__main__"}, []
for source in json.loads(sys.stdin.read()):
    body = ast.parse(source).body
    last = body.pop() if isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), "cell", "exec"), names)
    if last is not None:
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        for how in ("_repr_png_", "_repr_html_"):
            if hasattr(value, how):
                shown.append((how, len(getattr(value, how)())))
                break
print(json.dumps(shown))
"""


def notebook_of(name):
    return json.loads((EXAMPLES / f"{name}.ipynb").read_text(encoding="utf-8"))


def cells(name, kind):
    """Sources of the cells of a kind, in their order."""
    notebook = notebook_of(name)
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == kind]


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_the_notebook_stores_no_output_that_could_be_of_another_version(name):
    notebook = notebook_of(name)
    assert (notebook["nbformat"], notebook["metadata"]["kernelspec"]["language"]) == (4, "python")
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(not cell["outputs"] and cell["execution_count"] is None for cell in code)
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    # Each cell has a text before it or before the cell that it belongs to.
    assert len(cells(name, "markdown")) >= 0.8 * len(code)


@pytest.mark.slow
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_the_notebook_runs_and_shows_its_figures(name, tmp_path):
    first, tables, count = NOTEBOOKS[name]
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        input=json.dumps(cells(name, "code")),
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
        timeout=600.0,
    )
    assert done.returncode == 0, done.stderr
    *printed, last = done.stdout.splitlines()
    assert any(line.startswith(first) for line in printed)
    shown = json.loads(last)
    assert [how for how, _ in shown].count("_repr_html_") == tables
    # An empty figure has a few thousand bytes.
    assert min(size for how, size in shown if how == "_repr_png_") > 10_000
    assert len(shown) == count
