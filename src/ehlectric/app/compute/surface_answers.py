"""Rough surfaces before they are used: processing steps, statistics, figures and warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.app.charts.surface_charts import line_figure, map_figure, profile_figure
from ehlectric.app.compute.answer_parts import page_warnings_of, with_session_files
from ehlectric.app.view_models import PageWarning, StepFigure, SummitsTable, SurfaceAnswer
from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.roughness_inputs import Roughness, check_geometry
from ehlectric.contact import FORMULA, KINDS, PreparedContact, domain_of, formulas_of
from ehlectric.errors import InputError
from ehlectric.formulas.film_line import Thickness
from ehlectric.quantities.units import to_si, unit_for
from ehlectric.readable import readable
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.maps import Map, without_void_borders
from ehlectric.surfaces.profiles import Profile
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface, measured, measured_map
from ehlectric.surfaces.surface_warnings import summit_statistics
from ehlectric.tables.surface_tables import (
    SUMMITS_NOTE,
    SUMMITS_TITLE,
    size_text,
    statistics_rows,
    summits_rows,
)

# Number of copies of a surface in a domain from which a warning names them.
_COPIES = 2.0

_CONTINUED = {
    "mirror": "copies of it, each mirrored at its ends, fill the domain",
    "repeat": "copies of it fill the domain",
}


def too_rough(table: Roughness, rough: RoughSurface | RoughMap, formula: Thickness) -> PageWarning | None:
    """Warning about heights whose root mean square is above the film thickness of a formula."""
    film = formula.central_thickness
    if not rough.steps or film is None:
        return None
    heights = float(np.std(rough.steps[-1][1].heights))
    ratio = heights / film
    if ratio <= 1.0:
        return None
    name = "Sq" if isinstance(rough.steps[-1][1], Map) else "Rq"
    formless = table.file is not None and table.form in ("none", "mean")
    advice = "remove the form first" if formless else "filter its long waves, and check the units of heights"
    text = (
        f"{name} is {_times(float(ratio))} times the film thickness ({_length(heights)}, against "
        f"{_length(float(film))} from a film-thickness formula), so asperities would be in contact: {advice}"
    )
    return PageWarning("", "warning", text)


def plainly(
    warning: PageWarning, table: Roughness, rough: RoughSurface | RoughMap, domain: Domain
) -> PageWarning:
    """Warning, of which that about a surface far shorter than the domain has its lengths in plain words."""
    if warning.code != "roughness-continued":
        return warning
    last = rough.steps[-1][1]
    lengths: tuple[tuple[float, float], ...]
    if isinstance(last, Map):
        what, lengths = "map", ((last.length_x, domain.length), (last.length_y, 2.0 * domain.side))
    else:
        across = table.direction == "y" and np.isfinite(domain.side)
        what, lengths = "profile", ((last.length, 2.0 * domain.side if across else domain.length),)
    length, needed = min(lengths, key=lambda pair: pair[0] / pair[1])
    copies = needed / length
    if copies < _COPIES or table.extend not in _CONTINUED:
        return warning
    text = (
        f"The {what} is {_length(length)} long and the domain {_length(needed)}: about {_times(copies)} "
        f"{_CONTINUED[table.extend]}, so the contact has the same heights again and again; "
        f"use a longer {what}"
    )
    return replace(warning, text=text)


def _times(ratio: float) -> str:
    return f"{ratio:.0f}" if ratio >= 10.0 else readable(ratio, 2)


def _length(length: float) -> str:
    factor, unit = unit_for(length, "m", least=1.0)
    return f"{readable(factor * length)} {unit}"


# Memory that the reading and the processing of a surface may take beyond the memory of the process [bytes].
_MEMORY = 3e9

# Points of an exact shape that are drawn, along a line and along the sides of a map.
_LINE, _SIDE = 2001, 161


def look(
    table: Mapping[str, Any], case: Mapping[str, Any], folder: str, name: str = "", *progress: Progress
) -> SurfaceAnswer:
    """Rough surface of a table ``[[roughness]]``, after every processing step. Raises InputError if the table
    or its file cannot be used, with the line of ``ehlectric surface``; keys of the table are preceded by
    ``roughness.``.
    """
    roughness = table
    try:
        still = {key: value for key, value in case.items() if key not in ("motion", "roughness")}
        whole = with_session_files({**still, "roughness": [table]}, Path(folder))
        roughness = whole["roughness"][0]
        for report in progress:
            report(0, 0, "reading the surface")
        with _bounded_memory():
            return _look(roughness, whole)
    except InputError as error:
        raise _named(error, roughness, name) from None


def _look(table: Mapping[str, Any], case: Mapping[str, Any]) -> SurfaceAnswer:
    """Answer about a table that is the only rough surface of a case."""
    roughness = Roughness.from_written(dict(table))
    if roughness.file is None:
        contact = _Contact(Case.from_written(case))
        (rough,) = contact.rough
        return _answer(roughness, rough, contact.warnings(), contact.domain)
    geometry = _geometry(case)
    check_geometry([roughness], geometry)
    rough = measured_map(roughness) if geometry == "point" else measured(roughness)
    return _answer(roughness, rough, _of_contact(case, rough), None)


def _geometry(case: Mapping[str, Any]) -> str:
    contact = case.get("contact")
    return str(contact.get("geometry", "line")) if isinstance(contact, Mapping) else "line"


class _Contact:
    """Contact of a case with one rough surface."""

    def __init__(self, case: Case, rough: Any = None) -> None:
        self.case, self.kind = case, KINDS[case.contact.geometry]
        self.conditions = self.kind.resolve(case)
        self.domain: Domain = domain_of(case, self.conditions)
        self.rough = self.kind.rough(case.roughness, self.domain) if rough is None else [rough]

    def warnings(self) -> tuple[PageWarning, ...]:
        contact = PreparedContact(self.case, self.conditions, self.domain, self.rough)
        warnings = contact.surface_warnings(self.case)
        table, rough = self.case.roughness[0], self.rough[0]
        # The formula that holds in all regimes.
        thin = too_rough(table, rough, formulas_of(self.conditions)[FORMULA[self.case.contact.geometry]])
        shown = tuple(plainly(warning, table, rough, self.domain) for warning in page_warnings_of(warnings))
        return shown if thin is None else (thin, *shown)


def _of_contact(case: Mapping[str, Any], rough: Any) -> tuple[PageWarning, ...]:
    """Warnings about a measured surface in its contact; a note where the contact is not valid yet."""
    try:
        return _Contact(Case.from_written(case), rough).warnings()
    except InputError as error:
        note = PageWarning(
            "", "note", f"not compared with the grid of the contact, whose inputs are wrong: {error}"
        )
        return (*page_warnings_of(rough.warnings), note)


def _answer(
    table: Roughness, rough: RoughSurface | RoughMap, warnings: tuple[PageWarning, ...], domain: Domain | None
) -> SurfaceAnswer:
    described = plain(rough.describe())
    if not rough.steps:
        assert domain is not None
        shape = StepFigure("in the domain", _shape_figure(rough, domain), "Heights of the shape")
        return SurfaceAnswer("shape", described, "exact shape", (), (), (shape,), warnings, {})
    summits = summit_statistics(rough.steps[-1][1])
    described["summits"] = plain(summits)
    heads, rows = statistics_rows(described)
    read = rough.surface_read
    names = [name for name, _ in rough.steps]
    if read is None:
        names[0] = "as made"
    rows = [(name, *row[1:]) for name, row in zip(names, rows, strict=True)]
    lines = {}
    if read is not None and read.spacing_y is not None:
        lines = dict(zip(("row", "column"), read.heights.shape, strict=True))
    of_map = isinstance(rough.steps[0][1], Map)
    figures = tuple(
        StepFigure(name, _figure(step, _voids(table, rough) if number == 0 else None), _label(name, row))
        for number, (name, (_, step), row) in enumerate(zip(names, rough.steps, rows, strict=True))
    )
    kind = "map" if of_map else "profile"
    summit_heads, summit_rows = summits_rows(summits)
    of_summits = SummitsTable(SUMMITS_TITLE, summit_heads, tuple(summit_rows), SUMMITS_NOTE)
    return SurfaceAnswer(
        kind, described, size_text(described), heads, tuple(rows), figures, warnings, lines, of_summits
    )


def _label(name: str, row: tuple[str, ...]) -> str:
    return f"Heights, {name}; root mean square height {row[2]} nm, {row[1]} points"


def _figure(step: Map | Profile, voids: Array | None) -> dict[str, Any]:
    return map_figure(step, voids) if isinstance(step, Map) else profile_figure(step)


def _voids(table: Roughness, rough: RoughSurface | RoughMap) -> Array | None:
    """Points of the first step of a map that have no data in the file; None where all have."""
    read = rough.surface_read
    if read is None or not rough.voids or not isinstance(rough.steps[0][1], Map):
        return None
    there = np.isnan(without_void_borders(read.heights))
    return there.T if table.along == "row" else there[:, ::-1]


def _shape_figure(rough: RoughSurface | RoughMap, domain: Domain) -> dict[str, Any]:
    if isinstance(rough, RoughSurface):
        x = np.linspace(domain.inlet, domain.outlet, _LINE)
        return line_figure(x, rough.height(x))
    x, y = (
        np.linspace(*ends, _SIDE) for ends in ((domain.inlet, domain.outlet), (-domain.side, domain.side))
    )
    drawn = Map(float(x[1] - x[0]), float(y[1] - y[0]), rough.height(x, y))
    return map_figure(drawn)


def _named(error: InputError, table: Mapping[str, Any], name: str) -> InputError:
    """Error with the shown name of the file, and with the keys of the table under ``roughness``."""
    key, text, file = error.key or "", error.text, table.get("file")
    if isinstance(file, str) and name:
        key, text = key.replace(file, name), text.replace(file, name)
    if key == "cutoff":
        lengths = {
            name: table[name] for name in ("cutoff_long", "cutoff_short") if table.get(name) is not None
        }
        wrong = [name for name, length in lengths.items() if _micrometres(length) == error.got]
        key = [*wrong, *lengths][0]
    if key in Roughness.model_fields:
        key = f"roughness.{key}"
    return error.with_text(key or None, text)


def _micrometres(length: Any) -> str:
    """Length as the error of a filter shows it."""
    return f"{readable((to_si(length, 'm') if isinstance(length, str) else length) * 1e6, 4)} µm"


@contextmanager
def _bounded_memory() -> Iterator[None]:
    """Context in which this process can take only a bounded amount of further memory.

    Readers find the bound as memory that is not available, and refuse a file that needs more.
    """
    try:
        resource: Any = import_module("resource")
        used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    except (ImportError, OSError):
        # Only Linux reports the size of a process in this way; elsewhere the readers' own bounds hold.
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    bound = used + int(_MEMORY)
    resource.setrlimit(resource.RLIMIT_AS, (bound if soft < 0 else min(bound, soft), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
