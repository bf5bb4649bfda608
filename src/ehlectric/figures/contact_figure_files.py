"""Figures of stationary contacts: a table of their names, functions and conditions, and their titles."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.contact import PointResult
from ehlectric.figures import line_figures, point_figures
from ehlectric.figures.contact_curves import breakdown, meter, probability, shear_stress, temperature
from ehlectric.figures.contact_findings import AnyContact, finding, strength_limit
from ehlectric.figures.contact_maps import spots
from ehlectric.figures.figure_names import (
    BREAKDOWN_FIGURE,
    METER_FIGURE,
    ROUGHNESS_FIGURE,
    SHEAR_FIGURE,
    SPOTS_FIGURE,
    TEMPERATURE_FIGURE,
    in_formats,
)
from ehlectric.figures.style import drawing_of, figure_of, name_over, style

# Empty edge above and below the maps [inches].
_EDGE = 0.06


def _module(result: AnyContact) -> Any:
    """Module of the figures of a kind of contact."""
    return point_figures if isinstance(result, PointResult) else line_figures


def _weibull(result: AnyContact) -> bool:
    return result.case.discharge is not None and result.case.discharge.weibull is not None


def _heated(result: AnyContact, *, thermal: bool) -> bool:
    return result.film.heated is not None and bool(result.film.heated.thermal) is thermal


# Figures that only some contacts have: name, function that draws it, and whether a contact has it.
_FURTHER: Sequence[tuple[str, Callable[..., Axes], Callable[[Any], bool]]] = (
    (ROUGHNESS_FIGURE, lambda r: _module(r).roughness(r), lambda r: bool(np.any(r.roughness))),
    (TEMPERATURE_FIGURE, temperature, partial(_heated, thermal=True)),
    (SHEAR_FIGURE, shear_stress, partial(_heated, thermal=False)),
    (BREAKDOWN_FIGURE, probability, _weibull),
    (BREAKDOWN_FIGURE, breakdown, lambda r: not _weibull(r) and strength_limit(r) is not None),
    (METER_FIGURE, meter, lambda r: r.meter is not None),
    (SPOTS_FIGURE, spots, lambda r: r.converged and bool(np.any(r.film.contact))),
)


def drawings_of(result: AnyContact) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a contact, by the names of their files."""
    common: dict[str, Callable[..., Axes]] = _module(result).FIGURES
    return common | {name: draw for name, draw, has in _FURTHER if has(result)}


def default_name(result: AnyContact) -> str:
    """Name of the most informative figure of a contact: the film, or the field where a discharge is
    assessed.
    """
    if isinstance(result, PointResult):
        return "film_map.png" if result.discharge is None else "field_map.png"
    return "film.png" if result.discharge is None else "field_profiles.png"


def figure(result: AnyContact, name: str) -> Figure:
    """Figure of a contact. Raises InputError where the result has no figure of this name."""
    draw = drawing_of(drawings_of(result), name)
    with style():
        ax = draw(result)
        _name(ax, result, name)
        # Only maps have axes of equal scale.
        if ax.get_aspect() != "auto":
            _fit_height(figure_of(ax))
    return figure_of(ax)


def _name(ax: Axes, result: AnyContact, name: str) -> None:
    """Draw the title over all panels of a figure: the finding, and below it the title of the case."""
    (file,) = in_formats([name])
    title = textwrap.shorten(result.case.title, 90, placeholder=" ...")
    first = finding(result, file) if result.converged else "NOT CONVERGED"
    name_over(ax, "\n".join(filter(None, [first, title])), converged=result.converged)


def _fit_height(figure: Figure) -> None:
    """Make a figure of maps as high as what is drawn on it.

    Axes of equal scale need less height than the page offers where a legend or a colour bar takes width.
    """
    figure.draw_without_rendering()
    needed = figure.get_tightbbox()
    height = float(needed.height) + 2.0 * _EDGE
    if height < figure.get_figheight():
        figure.set_figheight(height)
