"""Index of equations: comments below the labels of equations, and the functions that they name."""

from pathlib import Path

import pytest
from docs._ext.equation_pages import equation_pages

ROOT = Path(__file__).parents[1] / "docs"

PAGE = "# Film\n\n$$\na = b\n$$ ({label})\n% equation: {comment}\n\nText.\n"


def index_of(folder, *, label="sum", comment):
    """Table of a folder with one page with one equation."""
    page = folder / "theory" / "film.md"
    page.parent.mkdir()
    page.write_text(PAGE.format(label=label, comment=comment), encoding="utf-8")
    return equation_pages(folder)["equations"]


def test_an_equation_is_listed_with_page_and_function(tmp_path):
    table = index_of(tmp_path, comment="load; ehlectric.film.gap.Gap.load")
    assert table.splitlines()[2:] == [
        "| load | {eq}`sum` | [Film](/theory/film.md) | `ehlectric.film.gap.Gap.load` |"
    ]


def test_an_equation_needs_no_function(tmp_path):
    assert "| load | {eq}`sum` | [Film](/theory/film.md) | – |" in index_of(tmp_path, comment="load")


@pytest.mark.parametrize("function", ["ehlectric.film.gap.Gap.weight", "ehlectric.film.gap.no_such"])
def test_a_function_that_does_not_exist_is_rejected(tmp_path, function):
    with pytest.raises(LookupError, match=r"theory/film\.md"):
        index_of(tmp_path, comment=f"load; {function}")


def test_a_comment_without_a_label_is_rejected(tmp_path):
    with pytest.raises(ValueError, match="must follow the label"):
        index_of(tmp_path, label="two words", comment="load")


def test_all_functions_of_the_documentation_exist():
    assert "{eq}`reynolds`" in equation_pages(ROOT)["equations"]
