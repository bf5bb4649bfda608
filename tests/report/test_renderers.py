"""Reports as HTML and PDF: the same content, escaped, accessible, and equal to the last byte."""

import re

import pytest

from ehlectric.report.pdf import pdf_of
from ehlectric.report.written_report import html_of
from tests.helpers.reports import HOSTILE, Page, needs_pdftotext, small_report, text_of_pdf


def test_a_page_needs_no_other_file():
    page = Page(html_of(small_report()))
    assert not {"script", "link", "iframe", "object"} & {tag for tag, _ in page.tags}
    assert all(image["src"].startswith("data:image/") for image in page.of("img"))
    assert all(link["href"].startswith(("#", "https://doi.org/")) for link in page.of("a"))


def test_a_page_is_read_by_a_screen_reader():
    page = Page(html_of(small_report()))
    assert page.of("html") == [{"lang": "en"}]
    assert [tag for tag, _ in page.tags if re.fullmatch("h[1-6]", tag)] == ["h1", "h2", "h2"]
    assert all(image["alt"] for image in page.of("img"))
    assert {head.get("scope") for head in page.of("th")} == {"col", "row"}
    assert len(page.of("caption")) == len(page.of("table")) == 2
    # The colour of the light is not the only sign.
    assert "Breakdown possible" in page.text


def test_texts_of_a_user_stay_texts():
    page = Page(html_of(small_report(HOSTILE, HOSTILE)))
    assert not page.of("script")
    assert not page.of("b")
    assert "49" not in page.text
    assert page.text.count("<script>alert(1)</script> & <b>bold</b>") > 5


@needs_pdftotext
def test_texts_of_a_user_stay_texts_on_paper():
    text = text_of_pdf(pdf_of(small_report(HOSTILE, HOSTILE)))
    assert "<script>alert(1)</script> & <b>bold</b> {{ 7 * 7 }}" in text
    assert "µ λ ≤" in text


@needs_pdftotext
def test_both_have_the_same_texts():
    report = small_report()
    paper, page = text_of_pdf(pdf_of(report)), Page(html_of(report)).text
    texts = (
        "A sentence.", "Breakdown possible", "The film did not converge.", "row 2 A sentence.", "2.5",
        "Johnson, doi:10.1/a?b=1&c=2", "Finding A sentence.", "What it shows.", "title = 1",
    )  # fmt: skip
    for text in texts:
        assert text in paper, text
        assert text in page, text


@needs_pdftotext
def test_heads_of_a_long_table_stand_on_every_page():
    text = text_of_pdf(pdf_of(small_report(rows=200)))
    pages = int(re.search(r"1 of (\d+)", text)[1])
    assert pages >= 4
    assert f"{pages} of {pages}" in text
    assert text.count("name value") >= pages - 1


@pytest.mark.slow
@pytest.mark.parametrize("render", [html_of, pdf_of])
def test_equal_reports_are_equal_files(render):
    assert render(small_report()) == render(small_report())


def test_a_document_has_title_author_and_outline():
    content = pdf_of(small_report("Film of a 6208"))
    assert b"/Title (Film of a 6208)" in content
    assert b"/Author (ehlectric" in content
    assert b"/Outlines" in content
    assert b"/Lang (en)" in content


@pytest.mark.slow
def test_words_that_no_line_holds():
    """A word as long as a page does not stop a document."""
    pdf_of(small_report("x" * 3000, "y" * 3000))
