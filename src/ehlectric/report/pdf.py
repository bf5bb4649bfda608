"""Report as PDF: pages with a header and their numbers, an outline, and the content of the HTML page."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO
from xml.sax.saxutils import escape

from reportlab.lib.pagesizes import A4
from reportlab.lib.units import mm
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import BaseDocTemplate, Flowable, Frame, PageTemplate, Paragraph

from ehlectric.errors import short
from ehlectric.report.content import Report
from ehlectric.report.pdf_parts import LINE, SOFT, fonts, headed, parts_of, style
from ehlectric.version import __version__

_MARGIN, _TOP = 18.0 * mm, 22.0 * mm
_WIDTH, _HEIGHT = A4[0] - 2.0 * _MARGIN, A4[1] - 2.0 * _TOP
_SMALL = 7.5

# Name of the form with the number of pages.
_PAGES = "pages"

# Longest title in the header and in the outline [characters].
_LONGEST = 90


def pdf_of(report: Report) -> bytes:
    """PDF document of a report.

    Parameters
    ----------
    report : Report
        Content of the report. Its texts are escaped: a title with markup stays a text.

    Returns
    -------
    bytes
        Content of the file. The document has no date of its own, so that equal reports are equal files.
    """
    document = _Document(report)
    document.build(list(_story(report)), canvasmaker=_Numbered)
    return document.content.getvalue()


def _story(report: Report) -> Iterator[Flowable]:
    """Flowables of a report."""
    yield Paragraph(escape(f"Report of a result of ehlectric: {report.kind}"), style("soft"))
    yield Paragraph(escape(report.title), style("title"))
    yield Paragraph(f"Report made on {escape(_shown(report.date))}", style("soft"))
    for section in report.sections:
        parts = [part for block in section.blocks for part in parts_of(block, _WIDTH, _HEIGHT)]
        yield from headed(section.title, parts)


def _shown(date: str) -> str:
    return date.replace("T", " ").replace("+00:00", " UTC")


class _Numbered(Canvas):  # type: ignore[misc]
    """Canvas whose pages show a form with the number of all pages, which is drawn once they are there."""

    def save(self) -> None:
        """Draw the number of pages, and finish the document."""
        pages = self.getPageNumber() - 1
        self.beginForm(_PAGES)
        self.setFont(fonts(), _SMALL)
        self.setFillColor(SOFT)
        self.drawString(0.0, 0.0, f"of {pages}")
        self.endForm()
        super().save()


class _Document(BaseDocTemplate):  # type: ignore[misc]
    """Document with a header, page numbers and an outline.

    Attributes
    ----------
    content : BytesIO
        Bytes of the file, once it is built.
    """

    def __init__(self, report: Report) -> None:
        self.content = BytesIO()
        self._report = report
        super().__init__(
            self.content,
            pagesize=A4,
            title=short(report.title, _LONGEST),
            author=f"ehlectric {__version__}",
            subject=report.kind,
            creator=f"ehlectric {__version__}",
            lang="en",
            invariant=1,
        )
        frame = Frame(_MARGIN, _TOP, _WIDTH, _HEIGHT, 0.0, 0.0, 0.0, 0.0)
        self.addPageTemplates(PageTemplate("page", [frame], onPage=self._edges))

    def _edges(self, canvas: Canvas, _document: BaseDocTemplate) -> None:
        """Header and footer of a page."""
        font = fonts()
        canvas.saveState()
        canvas.setFont(font, _SMALL)
        canvas.setFillColor(SOFT)
        canvas.setStrokeColor(LINE)
        title, top = _fitted(self._report.title, font), A4[1] - 14.0 * mm
        canvas.drawString(_MARGIN, top, title)
        canvas.drawRightString(A4[0] - _MARGIN, top, "ehlectric")
        canvas.line(_MARGIN, top - 3.0 * mm, A4[0] - _MARGIN, top - 3.0 * mm)
        canvas.drawString(_MARGIN, 12.0 * mm, f"Report made on {_shown(self._report.date)}")
        end = A4[0] - _MARGIN - stringWidth("of 99", font, _SMALL)
        canvas.drawRightString(end, 12.0 * mm, f"{canvas.getPageNumber()} ")
        canvas.translate(end, 12.0 * mm)
        canvas.doForm(_PAGES)
        canvas.restoreState()

    def afterFlowable(self, flowable: Flowable) -> None:  # noqa: N802
        """Enter each section into the outline."""
        if isinstance(flowable, Paragraph) and flowable.style.name == "section":
            title = flowable.getPlainText()
            key = f"section-{self.page}-{title}"
            self.canv.bookmarkPage(key)
            self.canv.addOutlineEntry(title, key, level=0)


def _fitted(title: str, font: str) -> str:
    """Title that fits beside the name of the program."""
    text, room = title, _WIDTH - 60.0
    while stringWidth(text, font, _SMALL) > room:
        text = short(title, len(text) - 5)
    return text
