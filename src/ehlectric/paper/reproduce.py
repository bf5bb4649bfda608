"""The paper's study written to a folder: tables, figures and a report."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ehlectric.drawing import style
from ehlectric.errors import InputError
from ehlectric.paper import report
from ehlectric.paper.figures import FIGURES
from ehlectric.paper.study import Study, run_study
from ehlectric.paper.tables import TABLES
from ehlectric.store import clear, prepare, whole

REPORT = "report.html"


def figure_file(number: int) -> str:
    """Name of a figure's file."""
    return f"figure_{number}.png"


def reproduce(
    folder: str | Path,
    *,
    figure: int | None = None,
    table: int | None = None,
    progress: Callable[[int, int, str], None] | None = None,
) -> tuple[list[Path], Study]:
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
    files : list of Path
        The files written.
    study : Study
        What was solved; its ``converged`` says whether every film is a solution.

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
    study = run_study(parts, progress=progress) if parts else Study()
    clear(folder, names)
    files: list[Path] = []
    for name in tables:
        files.append(folder / f"{name}.csv")
        TABLES[name][0](study).save(files[-1])
    drawn = {number: folder / figure_file(number) for number in figures}
    with style():
        for number, path in drawn.items():
            with whole(path) as beside:
                FIGURES[number].draw(study).savefig(beside, dpi=200)
            if progress is not None:
                progress(number, max(figures), f"figure {number}")
    files += drawn.values()
    if whole_report:
        files.append(folder / REPORT)
        with whole(files[-1]) as beside:
            beside.write_text(report.html(study, drawn), encoding="utf-8")
    return files[::-1], study


def verdict(study: Study) -> list[str]:
    """What a whole study says, one line each; nothing of a part of it."""
    if not study.placed:
        return []
    said = report.verdicts({name: build(study) for name, (build, _) in TABLES.items()})
    return [f"{name.replace('_', ' ').capitalize()}: {text}" for name, text in said.items()]


def _asked_for(figure: int | None, table: int | None) -> tuple[list[int], list[str]]:
    """Numbers of figures and names of tables."""
    if figure is not None and figure not in FIGURES:
        why = ": Figure 1 is a photograph under copyright" if figure == 1 else ""
        raise InputError(f"--figure: got {figure}, takes {min(FIGURES)} to {max(FIGURES)}{why}")
    if table is not None and table != 3:
        raise InputError(f"--table: got {table}, takes 3; Tables 1 and 2 are inputs")
    if figure is None and table is None:
        return list(FIGURES), list(TABLES)
    return ([] if figure is None else [figure]), ([] if table is None else ["table_3"])
