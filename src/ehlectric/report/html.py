"""Report as one HTML page that needs no other files: no scripts, no fonts and images of other hosts."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping
from importlib import resources
from types import MappingProxyType

from jinja2 import Environment, StrictUndefined

from ehlectric.errors import SEVERITY_WORDS
from ehlectric.report.content import Link, Picture, Report, Table, Text, Warnings
from ehlectric.report.images import best_image
from ehlectric.report.light import Light

# Name of each class of blocks in the template.
_NAMES: Mapping[type, str] = MappingProxyType(
    {Text: "text", Table: "table", Picture: "picture", Warnings: "warnings", Light: "light"}
)


def html_of(report: Report) -> str:
    """Page of a report.

    Parameters
    ----------
    report : Report
        Content of the report. Its texts are escaped: a title with markup stays a text.

    Returns
    -------
    str
        HTML page, to be encoded as UTF-8.
    """
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"anchor": anchor, "data": _data}
    environment.tests["link"] = lambda cell: isinstance(cell, Link)
    environment.globals["severity_words"] = SEVERITY_WORDS
    environment.globals["name_of"] = lambda block: _NAMES[type(block)]
    template = (resources.files("ehlectric.report") / "page.html.jinja").read_text(encoding="utf-8")
    style = (resources.files("ehlectric.report") / "page.css").read_text(encoding="utf-8")
    # The style is a file of the package, without characters that HTML would take for markup.
    return environment.from_string(template).render(report=report, style=style)


def anchor(title: str) -> str:
    """Name of a section in addresses.

    Examples
    --------
    >>> anchor("What the model leaves out")
    'what-the-model-leaves-out'
    """
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def _data(picture: Picture) -> str:
    """Address that holds the image of a figure itself."""
    kind, content = best_image(picture)
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"
