"""Texts of reports as a reader sees them, and a small report with every kind of block."""

import shutil
from html.parser import HTMLParser
from subprocess import run
from tempfile import NamedTemporaryFile

import pytest
from matplotlib.figure import Figure

from ehlectric.report.report_content import (
    Light,
    Link,
    Picture,
    Report,
    Section,
    Table,
    Text,
    WarningLine,
    Warnings,
)

needs_pdftotext = pytest.mark.skipif(shutil.which("pdftotext") is None, reason="needs pdftotext (poppler)")

HOSTILE = '<script>alert(1)</script> & <b>bold</b> {{ 7 * 7 }} "quoted" µ λ ≤ \u202e'


class Page(HTMLParser):
    """Texts, tags and attributes of a page."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.texts, self._skipped, self._goes_on = [], [], 0, False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self._goes_on = tag == "wbr"
        self._skipped += tag == "style"

    def handle_endtag(self, tag):
        self._skipped -= tag == "style"

    def handle_data(self, data):
        if self._goes_on:
            # A word may be broken here, but it is one word.
            self.texts[-1] += data
        elif not self._skipped:
            self.texts.append(data)
        self._goes_on = False

    @property
    def text(self):
        """Text on one line, with plain spaces."""
        return " ".join("\n".join(self.texts).split())

    def of(self, tag):
        """Attributes of all tags of a name."""
        return [attributes for name, attributes in self.tags if name == tag]


def text_of_pdf(content):
    """Text of a PDF document by pdftotext, on one line."""
    with NamedTemporaryFile(suffix=".pdf") as file:
        file.write(content)
        file.flush()
        done = run(["pdftotext", "-raw", file.name, "-"], capture_output=True, text=True, check=True)
    return " ".join(done.stdout.split())


def small_report(title="Test", text="A sentence.", *, level="yellow", rows=3):
    """Report with every kind of block."""
    figure = Figure(figsize=(3.0, 2.0))
    figure.subplots().plot([0.0, 1.0], [0.0, 1.0])
    blocks = (
        Text(text),
        Text("Do not use the numbers.", "alarm"),
        Light(level, "Breakdown possible", text),
        Warnings((WarningLine("severe", "not-converged", "The film did not converge.", (text,)),)),
        Table(
            "Numbers",
            ("name", "value"),
            tuple((f"row {n} {text}", f"{n}.5") for n in range(rows)),
            numeric=(1,),
            alarms=(0,),
        ),
        Table("Links", ("for", "source"), (("film", Link("Johnson, ", "https://doi.org/10.1/a?b=1&c=2")),)),
        Picture("film", f"Finding {text}", "What it shows.", figure),
    )
    sections = (Section("Answer", blocks), Section("Input file", (Text(f"title = 1\n# {text}", "code"),)))
    return Report(title, "line contact", "2026-01-01T00:00:00+00:00", sections)
