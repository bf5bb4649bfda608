"""The figures of any result as PNG files."""

from __future__ import annotations

import textwrap
from pathlib import Path

from ehlectric.drawing import figure_of, style
from ehlectric.plot import figures_of
from ehlectric.point_plot import point_figures_of
from ehlectric.point_result import PointResult
from ehlectric.result import Result
from ehlectric.store import whole


def save_figures(result: Result | PointResult, folder: Path) -> list[Path]:
    """Draw all figures as PNG files.

    Parameters
    ----------
    result : Result or PointResult
        What to draw.
    folder : Path
        Where to; it must be there.

    Returns
    -------
    list of Path
        The files written.
    """
    drawn = point_figures_of(result) if isinstance(result, PointResult) else figures_of(result)
    title = textwrap.shorten(result.case.title, 45, placeholder=" ...")
    files = []
    with style():
        for name, draw in drawn.items():
            ax = draw(result)
            if result.converged:
                ax.set_title(title, loc="left", parse_math=False)
            else:
                ax.set_title("NOT CONVERGED", loc="left", color="red", weight="bold")
            with whole(folder / name) as path:
                figure_of(ax).savefig(path)
            files.append(folder / name)
    return files
