"""Figures 4 to 11 of the paper in its layout, drawn of our solutions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ehlectric import plot
from ehlectric.paper import schematics
from ehlectric.paper.contacts import CONTACTS, PaperContact
from ehlectric.paper.study import Solved, Study, largest_difference
from ehlectric.result import Result
from ehlectric.typing import Array

# Curves of one panel by speed, from dark to light, apart in print and for colour-blind readers.
_COLOURS = ("#440154", "#31688e", "#35b779", "#d0a010")
_MICRO = 1e6

# The straight line of mid-film over the curves of s = 1/2.
_STRAIGHT: dict[str, Any] = {"color": "#d55e00", "lw": 0.6, "ls": (0, (3, 5))}


@dataclass(frozen=True)
class PaperFigure:
    """A figure: what it shows, the parts of the study it takes, and how it is drawn."""

    caption: str
    parts: tuple[str, ...]
    draw: Callable[[Study], Figure]


def _panels(rows: int, columns: int, size: tuple[float, float]) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    return figure, list(figure.subplots(rows, columns, squeeze=False).ravel())


def _of(gigapascal: int) -> list[PaperContact]:
    return [contact for contact in CONTACTS if contact.gigapascal == gigapascal]


def _panel_name(contact: PaperContact, letter: str, result: Result) -> str:
    """Label and name of a sub-figure as printed; with its M where that is not the one printed."""
    groups = result.conditions.formulas
    name = f"({letter}) {contact.printed}"
    printed = float(contact.printed[1:].split("L")[0])
    return name if abs(printed - groups.moes_m) < 1.0 else f"{name}  (M = {groups.moes_m:.1f})"


def _title(ax: Axes, text: str) -> None:
    ax.set_title(text, loc="left", weight="bold")


def potentials(study: Study) -> Figure:
    """Figure 4: potential in two smooth films."""
    figure, panels = _panels(1, 2, (10.0, 3.6))
    for ax, letter, contact in zip(panels, "ab", (CONTACTS[0], CONTACTS[3]), strict=True):
        result = study.smooth[contact].result
        _title(plot.potential(result, ax), _panel_name(contact, letter, result))
    return figure


def _strengths(solved: dict[PaperContact, Solved], gigapascal: int) -> Figure:
    figure, panels = _panels(2, 2, (10.0, 6.8))
    for ax, contact in zip(panels, _of(gigapascal), strict=True):
        result = solved[contact].result
        _title(plot.field_strength(result, ax), _panel_name(contact, contact.label, result))
    return figure


def smooth_strengths(gigapascal: int) -> Callable[[Study], Figure]:
    """Figures 5 and 6: dimensionless field strength in the smooth films."""
    return lambda study: _strengths(study.smooth, gigapascal)


def rough_strengths(gigapascal: int) -> Callable[[Study], Figure]:
    """Figures 9 and 10: dimensionless field strength in the rough films."""
    return lambda study: _strengths(study.rough, gigapascal)


def _middle(solved: dict[PaperContact, Solved], scale: Callable[[Result], float], label: str) -> Figure:
    """Field strength at mid-film over X by both readings, one panel a pressure."""
    figure, panels = _panels(1, 2, (10.0, 4.2))
    for ax, letter, gigapascal in zip(panels, "ab", (1, 2), strict=True):
        differences = []
        for colour, contact in zip(_COLOURS, _of(gigapascal), strict=True):
            result = solved[contact].result
            x = result.field.x / result.conditions.half_width
            factor = scale(result)
            ax.plot(x, factor * result.field.middle_strength, color=colour, label=contact.printed)
            ax.plot(x, factor * solved[contact].straight, **_STRAIGHT)
            differences.append(largest_difference(solved[contact]))
        ax.plot([], [], **_STRAIGHT, label="straight line")
        _title(ax, f"({letter}) {gigapascal} GPa")
        ax.set_title(
            f"straight line and $s = 1/2$ differ by up to {100.0 * max(differences):.2g} %", loc="right"
        )
        ax.set(xlabel="$x/b$", ylabel=label, xlim=(-1.25, 1.25))
        ax.set_ylim(0.0, 1.22 * ax.get_ylim()[1])
        ax.legend(loc="upper left", ncols=3, frameon=False)
    return figure


def smooth_middle(study: Study) -> Figure:
    """Figure 7: field strength at mid-film of the smooth contacts."""
    return _middle(study.smooth, lambda _: 1.0 / _MICRO, r"mid-film $|E|$ [V/µm]")


def rough_middle(study: Study) -> Figure:
    """Figure 11: dimensionless field strength at mid-film of the rough contacts."""
    return _middle(
        study.rough,
        lambda result: result.film.minimum_thickness / result.field.voltage,
        r"mid-film $|E|\,h_\mathrm{min}/V_{12}$",
    )


def profile_and_pressure(study: Study) -> Figure:
    """Figure 8: the profile, and the pressure of one contact with and without it."""
    figure, (left, right) = _panels(1, 2, (10.0, 3.8))
    result, smooth = study.rough[CONTACTS[3]].result, study.smooth[CONTACTS[3]].result
    x = result.film.x
    left.plot(_MICRO * x, 1e9 * result.roughness[0], color=_COLOURS[1], lw=0.5)
    for cut in (-50.0, 50.0):
        left.axhline(cut, color="black", lw=0.6, ls=":")
    _title(left, "(a) profile, cut at ±50 nm")
    left.set(xlabel="$x$ [µm]", ylabel="height [nm]", xlim=(_MICRO * x[0], _MICRO * x[-1]), ylim=(-62, 62))
    _pressures(right, result, smooth)
    _title(right, _panel_name(CONTACTS[3], "b", result))
    return figure


def _pressures(ax: Axes, rough: Result, smooth: Result) -> None:
    for result, colour, width, label in (
        (rough, _COLOURS[1], 0.7, "rough"),
        (smooth, "black", 1.0, "smooth"),
    ):
        x: Array = result.film.x / result.conditions.half_width
        ax.plot(x, result.film.pressure / 1e9, color=colour, lw=width, label=label)
    ax.set(xlabel="$x/b$", ylabel="pressure $p$ [GPa]", xlim=(-1.5, 1.25))
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="upper left", frameon=False)


FIGURES: dict[int, PaperFigure] = {
    2: PaperFigure("The elastohydrodynamic model.", (), lambda _: schematics.film_model()),
    3: PaperFigure("The electrostatic model.", (), lambda _: schematics.field_model()),
    4: PaperFigure("Potential of the smooth films (a) M12L15 and (b) M34L9.", ("smooth",), potentials),
    5: PaperFigure("Field strength of the smooth films at 1 GPa.", ("smooth",), smooth_strengths(1)),
    6: PaperFigure("Field strength of the smooth films at 2 GPa.", ("smooth",), smooth_strengths(2)),
    7: PaperFigure("Mid-film field strength at (a) 1 GPa and (b) 2 GPa.", ("smooth",), smooth_middle),
    8: PaperFigure(
        "(a) The measured profile and (b) the pressure of M34L9 with and without it.",
        ("smooth", "rough"),
        profile_and_pressure,
    ),
    9: PaperFigure("Field strength of the rough films at 1 GPa.", ("rough",), rough_strengths(1)),
    10: PaperFigure("Field strength of the rough films at 2 GPa.", ("rough",), rough_strengths(2)),
    11: PaperFigure("Dimensionless mid-film field strength of the rough films.", ("rough",), rough_middle),
}
