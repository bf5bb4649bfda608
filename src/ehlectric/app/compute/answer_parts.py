"""Parts of all answers: cases of the tables of a page, and lines, numbers and warnings as pages show them.

An address or an uploaded file may come from anybody, and the readers of cases open the files that a case
names. So every function of this package makes its case here, where a case may name only files that were
uploaded in the same session.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ehlectric.app.session import session_file
from ehlectric.app.view_models import SEVERITIES, Line, Number, PageWarning
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.drive_case import AnyCase, DriveCase, case_of_dict
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.drive import SIMULATING
from ehlectric.errors import InputError, shown
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.result_warnings import CODES, ResultWarning
from ehlectric.quantities.rows import Row, row_of
from ehlectric.readable import capital, ratio_text
from ehlectric.runs.file_kinds import FileKind, kind_of_tables
from ehlectric.runtime.progress import Progress
from ehlectric.sweep import Sweep

# Note of a number of films that are not converged.
UNUSABLE = "not converged: do not use this value"


def usable(numbers: Iterable[Number], *, converged: bool) -> list[Number]:
    """Numbers of an answer, of which none is known if its films are not ``converged``."""
    return [each if converged else replace(each, note=UNUSABLE, known=False) for each in numbers]


def cards(rows: Iterable[Row], keys: Mapping[str, Iterable[str]]) -> list[Number]:
    """Numbers of some keys, in the order of the keys; keys that no row has are skipped.

    Each has in its note the quantities that stand small below it, the values of ``keys``. A key of the form
    "film_formulas.*.minimum_thickness" takes the first row of this form.
    """
    known = {row.key: row for row in reversed([*rows]) if row.key}
    numbers = []
    for key, further in keys.items():
        head, star, tail = key.partition("*")
        matching = [
            known_key
            for known_key in reversed(known)
            if star and known_key.startswith(head) and known_key.endswith(tail)
        ]
        if key in known or matching:
            number = card(known[matching[0] if matching else key])
            below = (f"{known[name].name} {known[name].amount}" for name in further if name in known)
            numbers.append(replace(number, note="; ".join(filter(None, [number.note, *below]))))
    return numbers


def card(row: Row) -> Number:
    """Number of a row, with its label as a heading.

    Examples
    --------
    >>> found = card(Row("margin", 1.2, note=", of the film", key="discharge.margin"))
    >>> found.label, found.text, found.note
    ('Margin', '1.2', 'of the film')
    """
    label = capital(row.name)
    return Number(row.key, label, row.shown, row.unit, row.note.strip(" ,;:"), row.bound)


def unknown(key: str, about: Quantity, text: str, reason: str = "") -> Number:
    """Number without a value, with the label of its quantity and a text instead of the value."""
    return replace(card(row_of(key, about, text, reason)), known=False)


def concerned(key: str) -> str:
    """Key under which warnings name a quantity: for a film or a voltage from a formula, the key of the solved
    one.

    Examples
    --------
    >>> concerned("film_formulas.moes.central_thickness"), concerned("field.capacitance_per_length")
    ('film.central_thickness', 'field.capacitance')
    """
    table, _, name = key.partition(".")
    solved = {"film_formulas": "film", "breakdown_by_formula": "discharge"}.get(table, table)
    return f"{solved}.{name.rpartition('.')[2]}".removesuffix("_per_length")


def with_warnings(numbers: Iterable[Number], warnings: Sequence[PageWarning]) -> tuple[Number, ...]:
    """Numbers with the warnings that concern them."""
    return tuple(
        replace(number, warnings=tuple(each for each in warnings if concerned(number.key) in each.concerns))
        for number in numbers
    )


def gauge_text(margin: float, facts: Iterable[tuple[str, str]]) -> str:
    """Sentence about a gauge of a margin for those who do not see it, with names and values next to it.

    Examples
    --------
    >>> gauge_text(1.5, [("probability", "3 %")])
    'Margin 1.50 on a scale from 0.1 to 10, with breakdown below 1; probability 3 %'
    """
    scale = f"Margin {ratio_text(margin)} on a scale from 0.1 to 10, with breakdown below 1"
    return "; ".join([scale, *(f"{name} {text}" for name, text in facts)])


# Keys that name a file wherever they stand, as ``roughness.file`` and the varied ``roughness.1.file``, and
# the key of a sweep that may name the file of its case.
_FILE, _CASE = "file", "case"

# Keys that may name the file of a case, of which a page has the tables.
_CASES = (_CASE, *(f"{case}{end}.{_FILE}" for case in ("", "case.") for end in ENDS))

Change = Callable[[str, str], str]


def case_of(table: Mapping[str, Any], folder: Path | None = None) -> AnyCase:
    """Return the case of a bearing or contact from the tables of a page; drives use ``drive_of``. Raises
    InputError if the tables are no valid case, or name another file.
    """
    if kind_of(table) == "drive":
        raise InputError("file", "is a drive file", takes="the case of a contact or a bearing")
    if kind_of(table) == "axle":
        raise InputError("shaft", "is a table of an axle", takes="the case of a contact or a bearing")
    return case_of_dict(with_session_files(table, folder), written=True)


def drive_of(table: Mapping[str, Any], folder: Path | None = None) -> DriveCase:
    """Drive from the tables of a page; see ``case_of``. Its waveform must be in the folder. Raises InputError
    if the tables are no valid drive, or name another file.
    """
    return DriveCase.from_written(with_session_files(table, folder))


def gear_of(table: Mapping[str, Any], folder: Path | None = None) -> GearCase:
    """Gear pair from the tables of a page; see ``case_of``. Raises InputError if the tables are no valid gear
    pair.
    """
    return GearCase.from_written(with_session_files(table, folder))


def axle_of(table: Mapping[str, Any], folder: Path | None = None) -> AxleCase:
    """Axle from the tables of a page, whose meshes have the tables of their gear files; see ``case_of``.
    Raises InputError if the tables are no valid axle, or name a file.
    """
    return AxleCase.from_written(with_session_files(table, folder))


def run_case_of(table: Mapping[str, Any], folder: Path | None = None) -> SolvedCase:
    """Case of any kind except a sweep from the tables of a page; see ``case_of``."""
    kind = kind_of(table)
    if kind == "axle":
        return axle_of(table, folder)
    if kind == "drive":
        return drive_of(table, folder)
    return gear_of(table, folder) if kind == "gear" else case_of(table, folder)


def sweep_of(table: Mapping[str, Any], folder: Path | None = None) -> Sweep:
    """Sweep from the tables of a page; see ``case_of``. Raises InputError if the tables are no valid sweep,
    or name another file.
    """
    return Sweep.from_written(with_session_files(table, folder))


def kind_of(table: Mapping[str, Any]) -> FileKind:
    """Kind of the tables of a page: such as "contact", "bearing" or "axle"."""
    return kind_of_tables(table) or "contact"


def at_operating_point(table: Mapping[str, Any]) -> dict[str, Any]:
    """Tables without a duty cycle and measured values, which have answers of their own and may name files."""
    return {key: value for key, value in table.items() if key not in ("duty", "measured")}


def with_session_files(table: Mapping[str, Any], folder: Path | None) -> dict[str, Any]:
    """Tables in which the names of files are paths in the folder of a session. ``folder``, folder of the
    session; None where it has no files. Raises InputError if a file is not there, or lies elsewhere.
    """

    def located(key: str, name: str) -> str:
        path = None if folder is None or key in _CASES else session_file(name, folder)
        if path is None:
            takes = "its tables" if key in _CASES else "a file that was uploaded in this tab"
            raise InputError(key, got=shown(name), takes=takes)
        return str(path)

    return with_names(table, located)


def with_names(table: Mapping[str, Any], change: Change) -> dict[str, Any]:
    """Copy of tables in which every name of a file is changed; ``change`` gets its key and the name."""
    changed: dict[str, Any] = _changed("", table, change)
    return changed


def names_in(table: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Keys of tables that name a file, each with the name."""
    names: list[tuple[str, str]] = []

    def collect(key: str, name: str) -> str:
        names.append((key, name))
        return name

    with_names(table, collect)
    yield from names


def _changed(key: str, value: Any, change: Change) -> Any:
    if isinstance(value, Mapping):
        return {name: _changed(f"{key}.{name}".lstrip("."), item, change) for name, item in value.items()}
    names = key.rpartition(".")[2] == _FILE
    if isinstance(value, list | tuple):
        # Items of a list of names have the key of the list; tables of a list have numbers.
        inner = (key if names else f"{key}.{number}" for number in range(1, len(value) + 1))
        return [_changed(name, item, change) for name, item in zip(inner, value, strict=True)]
    return change(key, value) if isinstance(value, str) and (names or key == _CASE) else value


def percent_of(progress: Progress) -> Progress:
    """Progress that shows the percentage of a simulated time, and other steps without a number."""

    def report(done: int, of: int, text: str) -> None:
        if text == SIMULATING:
            progress(done, of, "percent simulated")
        else:
            progress(0, 0, text)

    return report


def lines_of(rows: Iterable[Row]) -> tuple[Line, ...]:
    """Lines of rows.

    Examples
    --------
    >>> lines_of([Row("film"), Row("minimum film", 2e-7, "µm")])[1].text
    '0.2 µm'
    """
    return tuple(Line(row.name, row.text, row.alarm) for row in rows)


def page_warnings_of(warnings: Iterable[ResultWarning]) -> tuple[PageWarning, ...]:
    """Warnings of a result with the keys of the quantities that they concern, the severe ones first."""
    page_warnings = []
    for warning in dict.fromkeys(warnings):
        about = CODES[warning.code]
        page_warnings.append(
            PageWarning(warning.code, warning.severity, warning.text, about.concerns, about.meaning)
        )
    return tuple(sorted(page_warnings, key=lambda warning: SEVERITIES.index(warning.severity)))
