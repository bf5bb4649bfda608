"""Report as PDF: fonts, tables that split over pages, figures as images, pages with a header, and an
outline.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from io import BytesIO
from typing import Any
from xml.sax.saxutils import quoteattr

from reportlab.lib.colors import HexColor
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase.pdfmetrics import registerFont, registerFontFamily, stringWidth
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    BaseDocTemplate,
    CondPageBreak,
    Flowable,
    Frame,
    Image,
    KeepInFrame,
    KeepTogether,
    LongTable,
    PageBreak,
    PageTemplate,
    Paragraph,
    Preformatted,
    Spacer,
    XPreformatted,
)

from ehlectric.errors import short
from ehlectric.quantities.palette import GREY, LIGHTS
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import SEVERITY_WORDS
from ehlectric.readable import capital
from ehlectric.report.pdf_letters import FOLDER, marked, runs_of
from ehlectric.report.report_content import (
    Cell,
    Light,
    Link,
    Named,
    Numbers,
    Picture,
    Report,
    Table,
    Text,
    Warnings,
    image_of,
)
from ehlectric.version import __version__

# Fonts with Greek letters and signs, which matplotlib carries, and styles of paragraphs.
_FONTS, _STYLES = (data_file("ehlectric.report", "pdf_styles.toml")[name] for name in ("fonts", "styles"))

INK, SOFT, LINE, PANEL = (HexColor(colour) for colour in ("#1a1a1a", GREY, "#c8c8c8", "#f2f3f5"))
_LINK, _ALARM = "#0058a3", "#b00020"
_COLOURS = {"soft": SOFT, "alarm": HexColor(_ALARM)}
_SEVERITIES = {"severe": _ALARM, "warning": LIGHTS["yellow"], "note": LIGHTS["grey"]}

# Parts of a word after which a line may end.
_PARTS = re.compile(r"[^_.\-/]*[_.\-/]|[^_.\-/]+")

# Room next to the text of a cell [pt], and characters of a line of a file.
_PAD, _LINE_LENGTH = 3.0, 96

# Room that a title of a section needs for itself and for what begins below it [pt].
_ROOM = 130.0

# Height of a figure next to the numbers of the first page [pt]: with its caption it is as high as they are.
_ROOM_NEXT_TO_PICTURE = 235.0

# Sizes of the first page, of which the largest is taken at which its contents fit.
_SCALES = (1.0, 0.98, 0.95, 0.92, 0.9, 0.85, 0.8, 0.75, 0.7)

# Height above the height of all pages [pt].
_ANY = 1e5

# Share of the height of a page above which a figure has a page of its own.
_TALL = 0.6


@cache
def fonts() -> str:
    """Name of the family of fonts, which is registered at the first call."""
    for name, file in _FONTS.items():
        registerFont(TTFont(name, FOLDER / file))
    registerFontFamily("Sans", normal="Sans", bold="Sans-Bold", italic="Sans-Oblique", boldItalic="Sans-Bold")
    return "Sans"


@cache
def style(name: str, size: float = 9.0) -> ParagraphStyle:
    """Style of paragraphs: "body", "title", "section", "caption", "cell", "number", "head" or "alarm"."""
    base: dict[str, Any] = {"fontName": fonts(), "fontSize": size, "leading": 1.35 * size, "textColor": INK}
    changes = {key: _COLOURS.get(value, value) for key, value in _STYLES[name].items()}
    return ParagraphStyle(name, **{**base, **changes})


def parts_of(block: object, width: float, height: float) -> Iterator[Flowable]:
    """Flowables of a block in a frame of a width and a height [pt]."""
    match block:
        case Text(text=text, tone="code"):
            yield _code(text)
        case Text(text=text, tone=tone):
            yield Paragraph(marked(text), style("body" if tone == "plain" else tone))
        case Numbers(numbers=numbers, columns=columns):
            yield _numbers(numbers, width, columns)
            yield Spacer(1.0, 6.0)
        case Table():
            yield _table(block, width)
            yield Spacer(1.0, 8.0)
        case Light():
            yield _light(block, width)
            yield Spacer(1.0, 6.0)
        case Warnings(lines=lines):
            for line in lines:
                first = f"<b>{SEVERITY_WORDS[line.severity]}.</b> {marked(line.meaning)}"
                *others, last = map(marked, line.texts)
                last = f'{last} <font color="{GREY}">{marked(line.code)}</font>'
                yield _panel([first, *others, last], _SEVERITIES[line.severity], width)
                yield Spacer(1.0, 4.0)
        case Picture():
            # Two figures of usual height share a page; a tall figure takes a whole page.
            tall = 72.0 * float(block.figure.get_size_inches()[1]) > _TALL * height
            yield _picture(block, width, height - 60.0 if tall else 0.5 * height - 55.0)


def _code(text: str) -> Flowable:
    """Lines of a file, broken where they are too long; in markup only if letters need other fonts."""
    if text.isascii():
        return Preformatted(text, style("code"), maxLineLength=_LINE_LENGTH, newLineChars="")
    lines = (
        line[k : k + _LINE_LENGTH]
        for line in text.split("\n")
        for k in range(0, len(line) or 1, _LINE_LENGTH)
    )
    return XPreformatted(marked("\n".join(lines)), style("code"))


# Shape of a lamp by its level, so that the colour is not the only sign.
_LAMPS = {"green": "\u25cf", "yellow": "\u25c6", "red": "\u25a0", "grey": "\u25cb"}


def _numbers(numbers: Sequence[tuple[str, str, str]], width: float, columns: int) -> Flowable:
    """Large numbers, ``columns`` of them in a row, with their labels above and their notes below."""
    cells = [
        [Paragraph(marked(label), style("label", 7.5)), Paragraph(marked(value), style("value"))]
        + ([Paragraph(marked(note), style("label", 7.0))] if note else [])
        for label, value, note in numbers
    ]
    rows = [cells[k : k + columns] for k in range(0, len(cells), columns)]
    rows[-1] += [[]] * (columns - len(rows[-1]))
    look = [("VALIGN", (0, 0), (-1, -1), "TOP"), ("LEFTPADDING", (0, 0), (-1, -1), 0.0)]
    look += [("TOPPADDING", (0, 0), (-1, -1), 0.0), ("BOTTOMPADDING", (0, 0), (-1, -1), 4.0)]
    return LongTable(rows, colWidths=[width / columns] * columns, hAlign="LEFT", style=look)


def _light(light: Light, width: float) -> Flowable:
    """Panel of a verdict, with its lamp next to what it means."""
    colour = LIGHTS[light.level]
    heading, bound = marked(light.words), f" ({marked(light.bound)})" if light.bound else ""
    lamp = f'<font size="13" color="{colour}">{_LAMPS[light.level]}</font>'
    words = f'{lamp} <font size="12"><b>{heading}</b></font>{bound}'
    return _panel([words, marked(light.text)], colour, width)


def _panel(texts: Sequence[str], colour: str, width: float) -> Flowable:
    """Panel of paragraphs, in the markup of reportlab, next to a line of a colour."""
    look = [
        ("BACKGROUND", (0, 0), (-1, -1), PANEL),
        ("LINEBEFORE", (0, 0), (0, -1), 4.0, HexColor(colour)),
        ("LEFTPADDING", (0, 0), (-1, -1), 10.0),
        ("TOPPADDING", (0, 0), (-1, -1), 3.0),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 3.0),
    ]
    rows = [[Paragraph(text, style("cell"))] for text in texts]
    return LongTable(rows, colWidths=[width], hAlign="LEFT", style=look)


def _picture(picture: Picture, width: float, room: float, *, most: float = 1.0) -> Flowable:
    """Figure of at most a width and a height [pt] with its caption, on one page, enlarged ``most`` times."""
    wide, high = (72.0 * float(inches) for inches in picture.figure.get_size_inches())
    scale = min(most, width / wide, room / high)
    image = Image(BytesIO(image_of(picture, "png")), scale * wide, scale * high, hAlign="LEFT")
    caption = Paragraph(f"<b>{marked(picture.title)}.</b> {marked(picture.caption)}", style("body", 8.0))
    return KeepTogether([image, caption, Spacer(1.0, 8.0)])


def headed(title: str, parts: Sequence[Flowable]) -> Iterator[Flowable]:
    """Flowables of a section below its title, which never stands alone at the end of a page.

    Tables begin below their title as long as some of their rows fit: no page ends early because of them.
    """
    heading = Paragraph(marked(title), style("section"))
    if parts and isinstance(parts[0], KeepTogether):
        # Two groups that are kept together would be parted between each other.
        yield KeepTogether([heading, *parts[0]._content])
        yield from parts[1:]
    else:
        yield from (CondPageBreak(_ROOM), heading, *parts)


def _table(table: Table, width: float) -> Flowable:
    """Table that splits over pages; its caption and heads stand on each of them."""
    size = 8.0 if len(table.heads) <= 5 else 7.0
    cells = [[_plain(cell) for cell in row] for row in table.rows]
    widths = [width * share for share in table.shares] or _widths([list(table.heads), *cells], width, size)
    names = ["number" if n in table.numeric else "cell" for n in range(len(table.heads))]
    heads = [
        Paragraph(marked(head), style("headnumber" if name == "number" else "head", size))
        for head, name in zip(table.heads, names, strict=True)
    ]
    blank = [""] * (len(heads) - 1)
    rows: list[list[Any]] = [[Paragraph(marked(table.caption), style("caption", 8.5)), *blank], heads]
    for number, row in enumerate(table.rows):
        colour = _ALARM if number in table.alarms else ""
        rows.append(
            [
                Paragraph(_markup(cell, colour, room - 2.0 * _PAD, size), style(name, size))
                for cell, name, room in zip(row, names, widths, strict=True)
            ]
        )
    look = [
        ("SPAN", (0, 0), (-1, 0)),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("VALIGN", (0, 1), (-1, 1), "BOTTOM"),
        ("LINEBELOW", (0, 1), (-1, 1), 0.9, SOFT),
        ("LINEBELOW", (0, 2), (-1, -1), 0.4, LINE),
        ("LEFTPADDING", (0, 0), (-1, -1), _PAD),
        ("LEFTPADDING", (0, 0), (0, -1), 0.0),  # flush with the texts of the page
        ("RIGHTPADDING", (0, 0), (-1, -1), _PAD),
        ("TOPPADDING", (0, 0), (-1, -1), 1.5),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 2.0),
    ]
    return LongTable(rows, colWidths=widths, repeatRows=2, hAlign="LEFT", style=look)


def _plain(cell: Cell) -> str:
    if isinstance(cell, Named):
        return cell.text
    return f"{cell.text}{_address(cell)}" if isinstance(cell, Link) else cell


def _address(link: Link) -> str:
    return link.address.replace("https://doi.org/", "doi:")


def _markup(cell: Cell, colour: str, room: float, size: float) -> str:
    """Cell in the markup of reportlab, with its own characters escaped, for a column of a width [pt]."""
    if isinstance(cell, Link):
        shown = marked(_address(cell))
        return f'{marked(cell.text)}<a href={quoteattr(cell.address)} color="{_LINK}">{shown}</a>'
    text = " ".join(_parted(word, room, size) for word in _plain(cell).split(" "))
    return f'<font color="{colour}">{text}</font>' if colour else text


def _parted(word: str, room: float, size: float) -> str:
    """Word in the markup of reportlab, broken after marks such as "_" where a line cannot hold it."""
    lines = [""]
    for part in _PARTS.findall(word):
        if lines[-1] and stringWidth(lines[-1] + part, fonts(), size) > room:
            lines.append("")
        lines[-1] += part
    return "<br/>".join(map(marked, lines))


def _widths(rows: Sequence[Sequence[str]], width: float, size: float) -> list[float]:
    """Widths of columns [pt]: as wide as their texts if they fit on the page, else in proportion to them."""
    columns = list(zip(*rows, strict=True))
    pad = 2.0 * _PAD + 0.5

    def extent(text: str) -> float:
        return float(stringWidth(text, "Sans-Bold", size))

    extents = [max(extent(text) for text in column) + pad for column in columns]
    if sum(extents) <= width:
        return extents
    least = [
        min(
            max(max((extent(word) for word in text.split()), default=0.0) for text in column) + pad,
            0.4 * width,
        )
        for column in columns
    ]
    # The square root keeps a column of sentences from taking the room of all others.
    free, further = width - sum(least), [max(0.0, a - b) ** 0.5 for a, b in zip(extents, least, strict=True)]
    if free <= 0.0 or not sum(further):
        return [width * least_of / sum(least) for least_of in least]
    return [low + free * more / sum(further) for low, more in zip(least, further, strict=True)]


_MARGIN, _TOP = 18.0 * mm, 22.0 * mm
_WIDTH, _HEIGHT = A4[0] - 2.0 * _MARGIN, A4[1] - 2.0 * _TOP
_SMALL = 7.5

# Name of the form with the number of pages.
_PAGES = "pages"

# Longest title in the header and in the outline [characters].
_LONGEST = 90


def pdf_of(report: Report) -> bytes:
    """PDF document of a report. Returns content of the file; the document has no date of its own, so that
    equal reports are equal files.
    """
    document = _Document(report)
    document.build(list(_story(report)), canvasmaker=_Numbered)
    return document.content.getvalue()


def _story(report: Report) -> Iterator[Flowable]:
    first, *others = report.sections
    if first.single_page:
        yield first_page(report)
        if others:
            yield PageBreak()
    else:
        yield from _top(report)
        others = [first, *others]
    for section in others:
        parts = [part for block in section.blocks for part in parts_of(block, _WIDTH, _HEIGHT)]
        yield from headed(section.title, parts)


def _top(report: Report) -> list[Flowable]:
    """Title of a report, with what it is and its date."""
    kind = f"{capital(report.kind)}. Report made on {_shown(report.date)}"
    return [Paragraph(marked(report.title), style("title")), Paragraph(marked(kind), style("soft"))]


def first_page(report: Report) -> Flowable:
    """First page of a report: all of it is smaller if its texts are too long for the page."""
    canvas = Canvas(BytesIO())
    for scale in _SCALES:
        parts = KeepInFrame(_WIDTH / scale, _ANY, list(_first_parts(report, _WIDTH / scale)))
        _, high = parts.wrapOn(canvas, _WIDTH / scale, _ANY)
        if scale * high <= _HEIGHT:
            break
    return _Scaled(parts, min(scale, _HEIGHT / high))


class _Scaled(Flowable):  # type: ignore[misc]
    """Contents of a page, with all of their lengths multiplied by ``scale``."""

    def __init__(self, parts: KeepInFrame, scale: float) -> None:
        super().__init__()
        self.parts, self.scale = parts, scale

    def wrap(self, _width: float, _height: float) -> tuple[float, float]:
        """Take the whole page."""
        return _WIDTH, _HEIGHT

    def draw(self) -> None:
        """Draw the contents from the top of the page."""
        _, high = self.parts.wrapOn(self.canv, _WIDTH / self.scale, _ANY)
        self.canv.scale(self.scale, self.scale)
        self.parts.drawOn(self.canv, 0.0, _HEIGHT / self.scale - high)


def _first_parts(report: Report, width: float) -> Iterator[Flowable]:
    """Flowables of the first page in a width [pt]."""
    yield from _top(report)
    blocks = list(report.sections[0].blocks)
    while blocks:
        match blocks:
            case [Numbers(columns=1) as numbers, Picture() as picture, *blocks]:
                yield _side_by_side(numbers, picture, width)
                yield Spacer(1.0, 4.0)
            case [Picture() as picture, *blocks]:
                yield from _loose([_picture(picture, width, _HEIGHT, most=2.0)])
            case [block, *blocks]:
                yield from _loose(parts_of(block, width, _HEIGHT))


def _side_by_side(numbers: Numbers, picture: Picture, width: float) -> Flowable:
    """Numbers below each other, and a figure next to them."""
    left, right = (share * width for share in (0.42, 0.58))
    shown = list(_loose([_picture(picture, right - 6.0, _ROOM_NEXT_TO_PICTURE)]))
    look = [("VALIGN", (0, 0), (-1, -1), "TOP"), ("LEFTPADDING", (0, 0), (0, 0), 0.0)]
    look += [("RIGHTPADDING", (0, 0), (-1, -1), 0.0)]
    return LongTable([[_numbers(numbers.numbers, left, 1), shown]], colWidths=[left, right], style=look)


def _loose(parts: Iterable[Flowable]) -> Iterator[Flowable]:
    """Flowables without groups that are kept together, as a frame that shrinks has none."""
    for part in parts:
        yield from part._content if isinstance(part, KeepTogether) else [part]


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
    """Document with a header, page numbers and an outline."""

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
        if canvas.getPageNumber() > 1:
            place = _MARGIN
            for other, run in runs_of(title):
                canvas.setFont(other or font, _SMALL)
                canvas.drawString(place, top, run)
                place += stringWidth(run, other or font, _SMALL)
            canvas.setFont(font, _SMALL)
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
    """Title that fits next to the name of the program."""
    text, room = title, _WIDTH - 60.0
    while stringWidth(text, font, _SMALL) > room:
        text = short(title, len(text) - 5)
    return text
