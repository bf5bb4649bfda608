"""The look of the gallery's figures: that of the figures of the command, on the screen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from cycler import cycler

from ehlectric.quantities.palette import AMBER, BLUE, GREEN, ORANGE, PURPLE, SKY

_COLOURS = [BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY]


def apply(gallery_conf: dict[str, Any], name: str) -> None:  # noqa: ARG001
    """Set before every example."""
    import matplotlib as mpl

    mpl.rcParams.update(
        {
            "axes.labelsize": 9.0,
            "axes.linewidth": 0.7,
            "axes.prop_cycle": cycler(color=_COLOURS),
            "axes.titlesize": 9.0,
            "figure.constrained_layout.use": True,
            "figure.dpi": 110.0,
            "figure.figsize": (6.3, 3.4),
            "font.size": 9.0,
            "legend.fontsize": 8.0,
            "legend.frameon": False,
            "lines.linewidth": 1.2,
        }
    )


def last_figure(block: object, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:  # noqa: ARG001
    """Save the figure that is the value of the last line of a block, which a notebook would show.

    The figures of results do not belong to pyplot, where the gallery looks for figures.
    """
    from matplotlib.figure import Figure
    from sphinx_gallery.scrapers import figure_rst

    figure = block_vars["example_globals"].get("___")
    if not isinstance(figure, Figure):
        return ""
    block_vars["example_globals"]["___"] = None
    path = Path(next(block_vars["image_path_iterator"]))
    sharp = path.with_name(f"{path.stem}_2_00x{path.suffix}")
    for name, dots in ((path, 110.0), (sharp, 220.0)):
        figure.savefig(name, dpi=dots)
    return str(
        figure_rst([str(path)], gallery_conf["src_dir"], srcsetpaths=[{0: str(path), 2.0: str(sharp)}])
    )
