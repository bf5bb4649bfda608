"""Display of results and cases: one line, a table in a notebook, and figures by name.

The tables and figures are in the packages ``tables`` and ``figures``, which lie above the results that they
show. This module finds their functions by name when they are first needed, as pandas finds its plotting
backend. It is the only place where a lower package calls an upper one.
"""

from __future__ import annotations

import io
import textwrap
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any

from ehlectric.runtime.values import Values, shortened

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Functions of upper packages: (module, name).
_TABLE = ("ehlectric.tables.html", "html_of")
_FIGURE = ("ehlectric.figures.results", "figure")
_DEFAULT = ("ehlectric.figures.defaults", "default_figure")

# Resolution of a figure in a notebook [dots per inch].
_SCREEN = 110


def _call(function: tuple[str, str], *values: Any, **options: Any) -> Any:
    module, name = function
    return getattr(import_module(module), name)(*values, **options)


def headline(title: str, *parts: str | None, verdict: object = None) -> str:
    """Title, key numbers and level of a verdict on one line; parts that are None or empty are left out.

    Examples
    --------
    >>> headline("6208", "minimum film 0.4 µm", None)
    "'6208': minimum film 0.4 µm"
    """
    level = getattr(verdict, "level", None)
    told = ", ".join(filter(None, [*parts, f"verdict {level}" if level else None]))
    return ": ".join(filter(None, [repr(textwrap.shorten(title, 60)) if title else "", told]))


class Tabled:
    """Object that a notebook shows as a table, and that prints as one short line, ``_headline``."""

    def _headline(self) -> str:
        """Title and key numbers on one line, for the representation."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return shortened(f"<{type(self).__name__} {self._headline()}>")

    def __str__(self) -> str:
        return repr(self)

    def _repr_html_(self) -> str:
        return str(_call(_TABLE, self))


class Shown(Tabled, Values):
    """Result that prints as one line, that a notebook shows as a table, and that draws its figures."""

    def plot(self, name: str | None = None, **options: Any) -> Figure:
        """Figure of this result.

        Parameters
        ----------
        name : str, optional
            Name of the figure, with or without ".png", such as "field_map". By default the figure that tells
            most about a result of this kind. ``ehlectric.figure_names`` lists the names.
        **options
            ``style``, "screen" or "journal"; and of the figures of a sweep ``x``, ``y``, ``value`` and
            ``at``, see ``ehlectric.figures.sweep.save.figure``.

        Returns
        -------
        matplotlib.figure.Figure
            Figure. A notebook shows it if it is the last line of a cell; in a script, ``savefig`` writes it
            as PNG, SVG or PDF.

        Raises
        ------
        InputError
            If the result has no figure of this name, or its figures have no such option.
        """
        if name is None:
            name, chosen = _call(_DEFAULT, self, **options)
            options = chosen | options
        return shown(_call(_FIGURE, self, name, **options))


def shown(figure: Figure) -> Figure:
    """Figure that a notebook shows as an image, whatever its backend is.

    A figure that is not made by pyplot has no display of its own in a notebook.
    """
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]
    return figure


def _png(figure: Figure) -> bytes:
    """Figure as a PNG image of the resolution of a screen."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=_SCREEN)
    return image.getvalue()
