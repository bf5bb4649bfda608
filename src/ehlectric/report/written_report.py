"""Files of a report: one HTML page that needs no other files, and PDF."""

from __future__ import annotations

import base64
import re
import sys
from importlib import resources
from pathlib import Path
from types import ModuleType

from jinja2 import Environment, StrictUndefined

from ehlectric.errors import InputError, shown
from ehlectric.quantities.result_warnings import SEVERITY_WORDS
from ehlectric.report.report_content import Link, Named, Picture, Report, best_image
from ehlectric.runtime.files import check_target, write


def html_of(report: Report) -> str:
    """Page of a report. Returns HTML page, to be encoded as UTF-8."""
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"anchor": anchor, "data": _data}
    environment.tests["link"] = lambda cell: isinstance(cell, Link)
    environment.tests["named"] = lambda cell: isinstance(cell, Named)
    environment.globals["severity_words"] = SEVERITY_WORDS
    environment.globals["name_of"] = lambda block: type(block).__name__.lower()
    template = (resources.files("ehlectric.report") / "page.html.jinja").read_text(encoding="utf-8")
    style = (resources.files("ehlectric.report") / "page.css").read_text(encoding="utf-8")
    # The style is a file of the package, without characters that HTML would take for markup.
    return environment.from_string(template).render(report=report, style=style)


def anchor(title: str) -> str:
    """Name of a section in addresses.

    Examples
    --------
    >>> anchor("What the model neglects")
    'what-the-model-neglects'
    """
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def _data(picture: Picture) -> str:
    """Address that holds the image of a figure itself."""
    kind, content = best_image(picture)
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


FORMATS = ("html", "pdf")


def _content(report: Report, ending: str) -> bytes:
    """Content of a file of a report in one of ``FORMATS``."""
    if ending == "html":
        return html_of(report).encode()
    _load_reportlab()
    from ehlectric.report.pdf import pdf_of

    return pdf_of(report)


def _load_reportlab() -> None:
    """Load reportlab, also where its settings cannot be looked for in the home of the user.

    Its own import goes on without the file ``.reportlab_mods`` of a home, but not where the home is no
    folder, as for many services, whose home is /dev/null.
    """
    try:
        import reportlab  # noqa: F401
    except OSError:
        # The module that the file would have been: reportlab then does not look into the home.
        sys.modules["reportlab_mods"] = ModuleType("reportlab_mods")


def write_report(
    result: str | Path, target: str | Path, *further: str | Path, summary: bool = False
) -> list[Path]:
    """Write the report of a stored result, as HTML or PDF.

    Parameters
    ----------
    result : str or Path
        Folder of a result of any kind, or its result.nc, bearing.nc, gear.nc, drive.nc, axle.nc or motion.nc.
    target : str or Path
        File of the report; its ending, .html or .pdf, decides about its format. An existing file is replaced.
    *further : str or Path
        Further files with the same content, as in the other format.
    summary : bool
        Whether the first page stands alone.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If the ending is another one, the folder has no result or several, or a file cannot be read or
        written.

    Notes
    -----
    The environment variable SOURCE_DATE_EPOCH, in seconds since 1970, sets the date of the report; two
    reports of one result are then equal to the last byte.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import save, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> result = solve({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     files = save(result, folder)
    ...     [path.name for path in write_report(folder, Path(folder) / "report.html")]
    ['report.html']
    """
    targets = [Path(file) for file in (target, *further)]
    endings = [_ending_of(file) for file in targets]
    from ehlectric.report.build import report_of

    report = report_of(result, summary=summary)
    for path, ending in zip(targets, endings, strict=True):
        write(path, _content(report, ending))
    return targets


def _ending_of(target: Path) -> str:
    """Format of a file by its ending. Raises InputError for a wrong target, before anything is computed."""
    ending = target.suffix.lower().removeprefix(".")
    if ending not in FORMATS:
        takes = " or ".join(f".{name}" for name in FORMATS)
        raise InputError(target, f"ends in {shown(target.suffix)}", takes=f"a file that ends in {takes}")
    check_target(target)
    return ending
