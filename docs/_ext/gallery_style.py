"""The look of the gallery's figures: that of the figures of the command, on the screen."""

from __future__ import annotations

from typing import Any

from cycler import cycler

_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]


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
