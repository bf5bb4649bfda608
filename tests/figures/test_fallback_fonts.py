"""Titles in scripts that the font of the figures lacks: fonts of the system, else one note."""

import logging
import subprocess

import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from matplotlib.font_manager import fontManager

from ehlectric.figures import fallback_fonts
from ehlectric.figures.style import name_over, new_panels, save_figure, style
from ehlectric.report import pdf_letters
from ehlectric.report.pdf import pdf_of
from ehlectric.report.report_content import Report, Section
from ehlectric.report.report_content import Text as Block
from tests.helpers.each import each
from tests.helpers.reports import needs_pdftotext

TITLES = ("轴承 6208", "ベアリング 6208", "베어링 6208")


def square():
    pen = TTGlyphPen(None)
    for k, (x, y) in enumerate([(0, 0), (0, 700), (700, 700), (700, 0)]):
        (pen.moveTo if k == 0 else pen.lineTo)((x, y))
    pen.closePath()
    return pen.glyph()


def made_font(folder, name, letters):
    """A font of squares with a name and some letters, in a file."""
    glyphs = {f"u{ord(letter):04X}": letter for letter in letters}
    font = FontBuilder(1000, isTTF=True)
    font.setupGlyphOrder([".notdef", *glyphs])
    font.setupCharacterMap({ord(letter): glyph for glyph, letter in glyphs.items()})
    font.setupGlyf({glyph: square() for glyph in (".notdef", *glyphs)})
    font.setupHorizontalMetrics(dict.fromkeys((".notdef", *glyphs), (800, 50)))
    font.setupHorizontalHeader(ascent=800, descent=-200)
    font.setupNameTable({"familyName": name, "styleName": "Regular", "psName": name.replace(" ", "")})
    font.setupOS2(usWeightClass=400)
    font.setupPost()
    path = folder / f"{name}.ttf"
    font.save(path)
    return path


@pytest.fixture(autouse=True)
def fonts(monkeypatch, tmp_path):
    """The fonts that Matplotlib carries alone, and a function that adds another one."""
    own = [entry for entry in fontManager.ttflist if "mpl-data" in entry.fname]
    monkeypatch.setattr(fontManager, "ttflist", own)
    for noted in (fallback_fonts._noted_letters, pdf_letters._noted):
        noted.clear()
    fallback_fonts.fonts_for.cache_clear()
    pdf_letters._faces.cache_clear()

    def add(name, letters):
        fontManager.addfont(made_font(tmp_path, name, letters))
        fallback_fonts.fonts_for.cache_clear()
        pdf_letters._faces.cache_clear()

    yield add
    fallback_fonts.fonts_for.cache_clear()
    pdf_letters._faces.cache_clear()


def drawn(title, tmp_path, formats=("png",)):
    with style():
        (ax,) = new_panels(1, 1, (4.0, 3.0))
        name_over(ax, f"{title}, film\nsecond line")
        save_figure(ax.figure, tmp_path / "film.png", formats)
    return ax.figure


def notes(caplog):
    return [record.getMessage() for record in caplog.records if record.levelno == logging.WARNING]


@pytest.mark.slow
def test_one_note_names_the_title_that_no_font_has(tmp_path, caplog):
    for title in TITLES:
        caplog.clear()
        for _ in range(2):
            drawn(title, tmp_path)
        (note,) = notes(caplog)
        assert title in note
        assert title.partition(" ")[0][0] in note
        assert "no font of this machine" in note


@pytest.mark.slow
def test_letters_that_the_own_font_has_need_no_note(tmp_path, caplog):
    """DejaVu Sans has Greek, Cyrillic, Hebrew and Arabic letters, and Matplotlib joins the Arabic ones."""
    for title in ("ä µ Ω €", "Подшипник 6208", "מיסב", "محمل كريات"):
        assert drawn(title, tmp_path).get_suptitle().startswith(title)
    assert notes(caplog) == []


@each(("name", "title"), [("Noto Sans CJK SC", TITLES[0]), ("Some Font", TITLES[1])])
def test_a_font_of_the_system_is_taken(fonts, tmp_path, caplog, name, title):
    """Also a font whose name is not known: its letters decide."""
    caplog.clear()
    fonts(name, title.partition(" ")[0])
    figure = drawn(title, tmp_path, ("pdf",))
    assert notes(caplog) == []
    assert figure._suptitle.get_fontfamily()[-1] == name
    assert name.replace(" ", "").encode() in (tmp_path / "film.pdf").read_bytes()


def test_han_of_a_japanese_title_is_that_of_a_japanese_font(fonts):
    fonts("Noto Sans CJK SC", "軸受")
    fonts("Noto Sans CJK JP", "軸受ベアリング")
    names = [entry.name for entry in fallback_fonts.fonts_for(frozenset("軸受ベアリング"))[0]]
    assert names == ["Noto Sans CJK JP"]
    assert [entry.name for entry in fallback_fonts.fonts_for(frozenset("軸受"))[0]] == ["Noto Sans CJK SC"]


def test_letters_of_two_fonts(fonts):
    fonts("One", "轴")
    fonts("Two", "베어링")
    entries, missing = fallback_fonts.fonts_for(frozenset("轴承베어링"))
    assert {entry.name for entry in entries} == {"One", "Two"}
    assert missing == frozenset("承")


def pdf_text(title, tmp_path):
    blocks = (Block("plain"), Block(f'title = "{title}"', "code"))
    sections = (Section("First", blocks, single_page=True), Section(f"Section {title}", blocks))
    (tmp_path / "report.pdf").write_bytes(pdf_of(Report(title, "contact", "2026-01-01T00:00:00", sections)))
    command = ["pdftotext", tmp_path / "report.pdf", "-"]
    return subprocess.run(command, capture_output=True, text=True, check=True)


@needs_pdftotext
@pytest.mark.parametrize("font", [True, False])
def test_the_text_of_a_pdf_keeps_every_title(fonts, tmp_path, caplog, font):
    """Title of the page, header, section and file; letters without a font are boxes that can be copied."""
    for title in TITLES:
        caplog.clear()
        if font:
            fonts(f"Font of {ord(title[0])}", title.partition(" ")[0])
        done = pdf_text(title, tmp_path)
        assert done.stderr == ""
        assert done.stdout.count(title) == 5
        assert [title in note for note in notes(caplog)] == ([] if font else [True])


@needs_pdftotext
def test_one_note_tells_that_a_pdf_does_not_join_arabic_letters(tmp_path, caplog):
    for _ in range(2):
        pdf_text("محمل 6208", tmp_path)
    (note,) = notes(caplog)
    assert "محمل 6208" in note
    assert "right to left" in note or "left to right" in note
