"""Reproduction of the paper: its contacts solved, with tables, figures and a report written to a folder."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

from matplotlib.figure import Figure

from ehlectric.errors import InputError
from ehlectric.figures.figure_names import in_formats
from ehlectric.figures.style import save_figure
from ehlectric.figures.style import style as styled
from ehlectric.paper import paper_report
from ehlectric.paper.paper_figures import FIGURES
from ehlectric.paper.paper_tables import TABLES, PaperTable
from ehlectric.paper.study import run_study
from ehlectric.runtime.files import clear, write
from ehlectric.runtime.folders import alone_in
from ehlectric.runtime.undrawn import drawing

REPORT = "report.html"


@dataclass(frozen=True)
class Reproduced:
    """Files and results of a reproduction of the paper."""

    files: list[Path]  # files written; the report is first, if there is one
    tables: dict[str, PaperTable]
    # Verdicts from ``ehlectric.paper.paper_report.verdicts``; empty if only one figure or table was made.
    verdicts: dict[str, str]
    converged: bool  # whether every film is converged


def figure_files(number: int, formats: Sequence[str] = ("png",)) -> tuple[str, ...]:
    """File names of a figure, one of each format."""
    return in_formats([f"figure_{number}"], formats)


def reproduce(
    folder: str | Path,
    *,
    figure: int | None = None,
    table: int | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    formats: Sequence[str] = ("png",),
    style: str = "screen",
) -> Reproduced:
    """Solve the contacts of the paper, and write its figures and tables.

    ``folder``, output folder; created if it does not exist; ``figure``, number of the only figure to write, 2
    to 11; ``table``, number of the only table to write, 3. Returns files written, tables and verdicts. Raises
    InputError if there is no such figure or table, the folder cannot be used, or another command writes into
    it.

    H. Morris, M. Leighton and N. Morris, Lubricants 2022, 10(5), 87, doi:10.3390/lubricants10050087.
    """
    figures, tables = _requested(figure, table)
    whole_report = figure is None and table is None
    names = [file for number in figures for file in figure_files(number, formats)] + [
        f"{name}.csv" for name in tables
    ]
    names += [REPORT] if whole_report else []
    parts = [part for number in figures for part in FIGURES[number].parts]
    parts += [part for name in tables for part in TABLES[name][1]]
    with alone_in(folder, names) as folder:
        study = run_study(parts, progress=progress)
        clear(folder, names)
        made = {name: TABLES[name][0](study) for name in tables}
        for name, paper_table in made.items():
            paper_table.save(folder / f"{name}.csv")
        copies: dict[int, bytes] = {}
        with styled(style):
            for done, number in enumerate(figures):
                if progress is not None:
                    progress(done, len(figures), "drawing figures")
                with drawing(f"figure_{number}"):
                    drawn = FIGURES[number].draw(study)
                    save_figure(drawn, folder / f"figure_{number}.png", formats)
                    if whole_report:
                        copies[number] = _png(drawn)
        verdicts = {}
        if whole_report:
            verdicts = paper_report.verdicts(made)
            write(folder / REPORT, paper_report.html(study, made, copies).encode())
        # A figure that could not be drawn has no files.
        files = [folder / name for name in names if (folder / name).exists()]
    return Reproduced(files, made, verdicts, study.converged)


def _png(figure: Figure) -> bytes:
    """Content of a PNG file of a figure, with as many pixels as a page on the screen needs."""
    content = BytesIO()
    figure.savefig(content, format="png", dpi=200)
    return content.getvalue()


def _requested(figure: int | None, table: int | None) -> tuple[list[int], list[str]]:
    """Numbers of the figures and names of the tables to write."""
    if figure is not None and figure not in FIGURES:
        why = ": Figure 1 is a photograph under copyright" if figure == 1 else ""
        raise InputError("--figure", got=figure, takes=f"{min(FIGURES)} to {max(FIGURES)}{why}")
    if table is not None and table != 3:
        raise InputError("--table", got=table, takes="3; Tables 1 and 2 are inputs")
    if figure is None and table is None:
        return list(FIGURES), list(TABLES)
    return ([] if figure is None else [figure]), ([] if table is None else ["table_3"])
