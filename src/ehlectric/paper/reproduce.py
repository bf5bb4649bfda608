"""The paper's study written to a folder: tables, figures and a report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ehlectric.errors import InputError
from ehlectric.figures.style import style
from ehlectric.paper import report
from ehlectric.paper.figures import FIGURES
from ehlectric.paper.study import run_study
from ehlectric.paper.tables import TABLES, PaperTable
from ehlectric.runtime.files import clear, prepare, whole

REPORT = "report.html"


@dataclass(frozen=True)
class Reproduced:
    """What was written, and what it says.

    Attributes
    ----------
    files : list of Path
        The report first, where there is one.
    tables : dict
        Those written, by name.
    verdicts : dict
        Of ``report.verdicts``; empty where only a part was asked for.
    converged : bool
        Whether every film is a solution.
    """

    files: list[Path]
    tables: dict[str, PaperTable]
    verdicts: dict[str, str]
    converged: bool


def figure_file(number: int) -> str:
    """Name of a figure's file."""
    return f"figure_{number}.png"


def reproduce(
    folder: str | Path,
    *,
    figure: int | None = None,
    table: int | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> Reproduced:
    """Solve the paper's contacts and write what it shows.

    Parameters
    ----------
    folder : str or Path
        Where to; made if it is not there.
    figure, table : int, optional
        Only this figure, 2 to 11, or this table, 3; else everything and report.html.
    progress : callable, optional
        Called with (done, of, what was done).

    Returns
    -------
    Reproduced
        The files, and what they say.

    Raises
    ------
    InputError
        Where there is no such figure or table, or the folder cannot be written to.

    Notes
    -----
    H. Morris, M. Leighton and N. Morris, Lubricants 2022, 10(5), 87, doi:10.3390/lubricants10050087.
    """
    figures, tables = _asked_for(figure, table)
    whole_report = figure is None and table is None
    names = [figure_file(number) for number in figures] + [f"{name}.csv" for name in tables]
    names += [REPORT] if whole_report else []
    folder = prepare(folder, names)
    parts = [part for number in figures for part in FIGURES[number].parts]
    parts += [part for name in tables for part in TABLES[name][1]]
    study = run_study(parts, progress=progress)
    clear(folder, names)
    made = {name: TABLES[name][0](study) for name in tables}
    for name, paper_table in made.items():
        paper_table.save(folder / f"{name}.csv")
    drawn = {number: folder / figure_file(number) for number in figures}
    with style():
        for number, path in drawn.items():
            with whole(path) as beside:
                FIGURES[number].draw(study).savefig(beside, dpi=200)
            if progress is not None:
                progress(number, max(figures), f"figure {number}")
    verdicts = {}
    if whole_report:
        verdicts = report.verdicts(made)
        with whole(folder / REPORT) as beside:
            beside.write_text(report.html(study, made, drawn), encoding="utf-8")
    return Reproduced([folder / name for name in reversed(names)], made, verdicts, study.converged)


def _asked_for(figure: int | None, table: int | None) -> tuple[list[int], list[str]]:
    """Numbers of figures and names of tables."""
    if figure is not None and figure not in FIGURES:
        why = ": Figure 1 is a photograph under copyright" if figure == 1 else ""
        raise InputError("--figure", got=figure, takes=f"{min(FIGURES)} to {max(FIGURES)}{why}")
    if table is not None and table != 3:
        raise InputError("--table", got=table, takes="3; Tables 1 and 2 are inputs")
    if figure is None and table is None:
        return list(FIGURES), list(TABLES)
    return ([] if figure is None else [figure]), ([] if table is None else ["table_3"])
