"""Figures 2 to 11 of the paper in its layout: schematics, and results drawn from the solutions of
ehlectric.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehlectric.arrays import Array
from ehlectric.contact import Result
from ehlectric.figures import line_figures as plot
from ehlectric.figures.style import figure_of, new_panels, outlined, page_width
from ehlectric.paper.paper_contacts import CONTACTS, PaperContact
from ehlectric.paper.study import Study, readings_differ_by, straight_line
from ehlectric.quantities.palette import AMBER, BLUE, BODY, GREEN, OCHRE, OIL, PURPLE
from ehlectric.quantities.units import unit_for

_INK = "black"

# Largest width of a sketch in one column of a journal [inches], and size of its texts there [pt].
_SKETCH, _SMALL = 6.4, 6.0


def _canvas(size: tuple[float, float]) -> Axes:
    """Axes without frame of a new figure of size (width, height) [inches]; in a journal of one column."""
    (ax,) = new_panels(1, 1, size if page_width(_SKETCH) == _SKETCH else (_SKETCH, size[1]))
    ax.set_axis_off()
    return ax


def _arrow(ax: Axes, start: tuple[float, float], stop: tuple[float, float]) -> None:
    """Draw an arrow between two points."""
    ax.annotate(
        "",
        xy=stop,
        xytext=start,
        arrowprops={"arrowstyle": "-|>", "color": _INK, "lw": 1.0, "mutation_scale": 12},
    )


def _text(ax: Axes, x: float, y: float, text: str, **options: object) -> None:
    """Write a text centred at a point."""
    look = {"fontsize": _SMALL} | options if _in_column(ax) else options
    ax.text(x, y, text, ha="center", va="center", **look)  # type: ignore[arg-type]


def _in_column(ax: Axes) -> bool:
    """Whether a sketch is as narrow as a column of a journal."""
    return figure_of(ax).get_figwidth() < _SKETCH


def _gap(x: Array) -> Array:
    """Half of a schematic film thickness: flat from x = -1 to 1 with an exit constriction, wider outside."""
    outside = np.maximum(np.abs(x) - 1.0, 0.0)
    return 0.16 + 0.35 * outside**1.5 - 0.05 * np.exp(-(((x - 0.95) / 0.12) ** 2))


def film_model() -> Figure:
    """Draw Figure 2: two loaded cylinders, the film between them, and the boundary conditions at its ends."""
    ax = _canvas((8.0, 4.4))
    x = np.linspace(-4.0, 2.0, 601)
    half = _gap(x)
    ax.fill_between(x, -half, half, color=OIL, lw=0.0)
    for sign in (-1.0, 1.0):
        ax.fill_between(x, sign * half, sign * 2.6, color=BODY, lw=0.0)
        ax.plot(x, sign * half, color=_INK, lw=1.2)
    pressure = 0.16 + 1.3 * np.sqrt(np.maximum(0.0, 1.0 - x**2))
    ax.plot(x[np.abs(x) <= 1.0], pressure[np.abs(x) <= 1.0], color=_INK, lw=1.0, ls="--")
    _text(ax, 0.0, 0.9 if _in_column(ax) else 1.12, "pressure $p(x)$")
    for sign, k, where in ((1.0, 2, 2.0), (-1.0, 1, -2.0)):
        _text(ax, 0.0, where, f"body {k}: $E_{k}$, $\\nu_{k}$, $R_{k}$")
        _arrow(ax, (-2.3, sign * 1.35), (-1.5, sign * 1.35))
        _text(ax, -2.5, sign * 1.35, f"$u_{k}$")
    _arrow(ax, (0.0, 3.3), (0.0, 2.65))
    _text(ax, 0.25, 3.05, "$w$")
    _arrow(ax, (0.0, -3.3), (0.0, -2.65))
    _text(ax, 0.25, -3.05, "$w$")
    _arrow(ax, (0.35, -0.75), (0.35, -0.16))
    _arrow(ax, (0.35, 0.75), (0.35, 0.16))
    _text(ax, 0.35, 0.0, "$h(x)$")
    for end, side in ((-4.0, "inlet"), (2.0, "outlet")):
        ax.plot([end, end], [-_gap(np.array([end]))[0], _gap(np.array([end]))[0]], color=_INK, lw=1.0, ls=":")
        _text(ax, end, -3.05, f"{side}, $x/b = {end:g}$\n$p = p_\\mathrm{{atm}}$")
    _text(ax, -2.6, 0.0, "lubricant: $\\eta(p)$, $\\rho(p)$")
    _text(ax, 1.55, 0.0, "cavitated")
    _arrow(ax, (-4.75, -0.4), (-4.25, -0.4))
    _arrow(ax, (-4.75, -0.4), (-4.75, 0.4))
    _text(ax, -4.15, -0.4, "$x$")
    _text(ax, -4.75, 0.6, "$y$")
    ax.set(xlim=(-4.9, 2.9), ylim=(-3.5, 3.5))
    return figure_of(ax)


def field_model() -> Figure:
    """Draw Figure 3: the film as a dielectric between two conductors, and the boundary conditions."""
    ax = _canvas((8.0, 3.6))
    apart = "\n" if _in_column(ax) else " "
    x = np.linspace(-1.25, 1.25, 501)
    half = _gap(x)
    ax.fill_between(x, -half, half, color=OIL, lw=0.0)
    for level in np.linspace(-1.0, 1.0, 9)[1:-1]:
        ax.plot(x, level * half, color=OCHRE, lw=0.5)
    for column in np.linspace(-1.25, 1.25, 26):
        reach = float(_gap(np.array([column]))[0])
        ax.plot([column, column], [-reach, reach], color=OCHRE, lw=0.5)
    for sign, k, volts in ((-1.0, 1, "−1"), (1.0, 2, "+1")):
        ax.fill_between(x, sign * half, sign * 0.62, color=BODY, lw=0.0)
        ax.plot(x, sign * half, color=_INK, lw=1.2)
        _text(
            ax,
            0.0 if _in_column(ax) else -0.45,
            sign * 0.42,
            f"surface {k}, conductor:{apart}$V = V_{k}$ = {volts} V on $y = {'+-'[k == 1]}h/2$",
        )
    for column in (-0.75, 0.05, 0.95):
        reach = float(_gap(np.array([column]))[0])
        _arrow(ax, (column, reach), (column, -reach))
    _text(ax, 0.2 if _in_column(ax) else 0.13, 0.0, "$E$", backgroundcolor=OIL)
    for end, side in ((-1.25, "right"), (1.25, "left")):
        size = _SMALL if _in_column(ax) else None
        ax.text(end * 1.04, 0.0, "$\\partial V/\\partial n = 0$", ha=side, va="center", fontsize=size)
    _text(
        ax,
        0.0,
        -0.75,
        f"film: $\\nabla\\cdot(\\varepsilon\\nabla V) = 0$, permittivity $\\varepsilon(\\rho(p(x)))$;{apart}"
        "constriction at the exit, right",
    )
    ax.set(xlim=(-1.75, 1.75), ylim=(-0.85, 0.68))
    return figure_of(ax)


# Colours of the curves of one panel, by speed: distinct for colour-blind readers, and none so dark that a
# black line on it would be lost.
_COLOURS = (BLUE, GREEN, PURPLE, AMBER)
_MICRO = 1e6

# Width of figures with two panels next to each other on the screen [inches].
_SCREEN_WIDTH = 10.0

# Height of the legend below two panels of a journal [inches].
_LEGEND_HEIGHT = 0.9

# Half of the height of sections that are compared, over the thickest central film.
_AROUND = 0.9

# The two definitions of mid-film coincide if the fields on them differ by less than this part.
_COINCIDE = 1e-6

# Look of the straight-line reading of mid-film, drawn over the curves of s = 1/2.
_STRAIGHT: dict[str, Any] = {"color": "black", "lw": 0.6, "ls": (0, (2, 4)), "path_effects": outlined(1.2)}


@dataclass(frozen=True)
class PaperFigure:
    """Figure of the paper."""

    caption: str
    parts: tuple[str, ...]  # parts of the study that it needs, attributes of ``Study``
    draw: Callable[[Study], Figure]


def _of(gigapascal: int) -> list[PaperContact]:
    """Contacts of a Hertz pressure [GPa]."""
    return [contact for contact in CONTACTS if contact.gigapascal == gigapascal]


def _name(contact: PaperContact, result: Result) -> str:
    """Name of a contact as printed, with the computed M if it differs from the print."""
    computed, printed = float(result.conditions.contact.moes_m), float(contact.printed[1:].split("L")[0])
    other = "" if abs(printed - computed) < 1.0 else f" (M = {computed:.1f})"
    return f"{contact.printed}{other}"


def _speed(contact: PaperContact) -> str:
    """Text: sum of the surface speeds of a contact."""
    return f"$u_1+u_2$ = {contact.u_s:g} m/s"


def _title(ax: Axes, name: str, *conditions: str) -> None:
    """Write the name of a panel and its conditions over its left end.

    On narrow pages each has a line above the text over the right end.
    """
    lines = [name, *conditions]
    text = "\n".join([*lines, " "]) if _narrow(ax) and ax.get_title(loc="right") else ", ".join(lines)
    ax.set_title(text, loc="left", weight="bold")


def _narrow(ax: Axes) -> bool:
    """Whether the figure of a panel is narrower than on the screen, as in a journal."""
    return figure_of(ax).get_figwidth() < _SCREEN_WIDTH


def _compared(panels: Sequence[Axes], results: Iterable[Result]) -> Figure:
    """Figure of sections that are compared: with one scale of heights, one colour bar, and labels outside."""
    figure = figure_of(panels[0])
    bars = [bar for ax in panels for drawn in ax.collections if (bar := drawn.colorbar) is not None]
    label, ticks = bars[0].ax.get_ylabel(), bars[0].get_ticks()
    drawn = bars[0].mappable
    for bar in bars:
        bar.remove()
    figure.colorbar(drawn, ax=list(panels), label=label, ticks=ticks, pad=0.02)
    thickest = max(result.film.central_thickness for result in results)
    factor, _ = unit_for(thickest, "m")
    for ax in panels:
        ax.set_ylim(-_AROUND * factor * thickest, _AROUND * factor * thickest)
        ax.label_outer()
    return figure


def potentials(study: Study) -> Figure:
    """Draw Figure 4: electric potential in two smooth films, on one scale of heights."""
    panels = new_panels(1, 2, (10.0, 3.6))
    contacts = (CONTACTS[0], CONTACTS[3])
    for ax, letter, contact in zip(panels, "ab", contacts, strict=True):
        result = study.smooth[contact]
        _title(plot.potential(result, ax), f"({letter}) {_name(contact, result)}", _speed(contact))
    return _compared(panels, [study.smooth[contact] for contact in contacts])


def _strengths(part: str, gigapascal: int) -> Callable[[Study], Figure]:
    """Function that draws Figure 5, 6, 9 or 10: dimensionless field strength in the films of a part.

    The four contacts of a Hertz pressure have the same scales.
    """

    def draw(study: Study) -> Figure:
        panels = new_panels(2, 2, (_SCREEN_WIDTH, 6.8))
        results = {contact: getattr(study, part)[contact] for contact in _of(gigapascal)}
        largest = max(float(np.max(r.field.strength)) * r.strength_scale for r in results.values())
        for ax, (contact, result) in zip(panels, results.items(), strict=True):
            plot.field_strength(result, ax, largest=largest)
            _title(ax, f"({contact.label}) {_name(contact, result)}", _speed(contact))
        return _compared(panels, results.values())

    return draw


def _middle(
    solved: dict[PaperContact, Result],
    scale: Callable[[Result], float],
    label: str,
    exits: dict[int, tuple[float, float]],
) -> Figure:
    """Draw the field strength at mid-film over x/b, by both readings of mid-film, a panel for each pressure.

    ``scale`` gives the factor from V/m to the drawn unit; ``exits`` has the ranges of x/b at the exit that
    insets show, by Hertz pressure [GPa].
    """
    panels = new_panels(1, 2, (_SCREEN_WIDTH, 4.6))
    if _narrow(panels[0]):
        figure = figure_of(panels[0])
        figure.set_figheight(figure.get_figheight() + _LEGEND_HEIGHT)
    for ax, letter, gigapascal in zip(panels, "ab", (1, 2), strict=True):
        contacts = _of(gigapascal)
        difference = max(readings_differ_by(solved[contact]) for contact in contacts)
        coincide = difference < _COINCIDE
        drawn_on = [ax, *([_exit_inset(ax, exits[gigapascal])] if gigapascal in exits else [])]
        for colour, contact in zip(_COLOURS, contacts, strict=True):
            result = solved[contact]
            x, factor = result.field.x / result.conditions.half_width, scale(result)
            straight = factor * straight_line(result)
            for axes in drawn_on:
                name = f"{_name(contact, result)}, {_speed(contact)}"
                axes.plot(x, factor * result.field.middle_strength, color=colour, label=name)
                if not coincide:
                    axes.plot(x, straight, **_STRAIGHT)
        if not coincide:
            ax.plot([], [], **_STRAIGHT, label="mid-film as a straight line")
        apart = "coincide" if coincide else f"differ by up to {100.0 * difference:.2g} %"
        _title(ax, f"({letter}) {gigapascal} GPa")
        ax.set_title(f"both definitions of mid-film{chr(10) if _narrow(ax) else ' '}{apart}", loc="right")
        ax.set(xlabel="$x/b$", ylabel=label, xlim=(-1.25, 1.25))
        _legend_of_readings(ax)
    top = max(scale(r) * float(np.max(r.field.middle_strength)) for r in solved.values())
    for ax in panels:
        # On narrow pages the legend is below the panel, and needs no room in it.
        ax.set_ylim(0.0, (1.08 if _narrow(ax) else 1.35) * top)
        ax.label_outer()
    return figure_of(panels[0])


def _legend_of_readings(ax: Axes) -> None:
    """Legend of the curves at mid-film: in the panel, or below it where the panel is too narrow for it."""
    if _narrow(ax):
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), frameon=False)
    else:
        ax.legend(loc="upper left", ncols=2, frameon=False)


def _exit_inset(ax: Axes, zone: tuple[float, float]) -> Axes:
    """Axes of an inset that shows a range of x/b at the exit."""
    inset = ax.inset_axes((0.27, 0.12 if _narrow(ax) else 0.07, 0.42, 0.36))
    inset.set(xlim=zone, ylim=(0.3, 1.05))
    inset.set_title("exit", fontsize=7.0, pad=2.0)
    inset.tick_params(labelsize=6.5)
    return inset


def smooth_middle(study: Study) -> Figure:
    """Draw Figure 7: field strength at mid-film of the smooth contacts."""
    return _middle(study.smooth, lambda _: 1.0 / _MICRO, r"mid-film $|E|$ [V/µm]", {})


def rough_middle(study: Study) -> Figure:
    """Draw Figure 11: dimensionless field strength at mid-film of the rough contacts."""
    label = r"mid-film $|E|\,h_\mathrm{min}/V_{12}$"
    exits = {1: (0.8, 1.1), 2: (0.92, 1.05)}
    return _middle(study.rough, lambda result: result.strength_scale, label, exits)


def profile_and_pressure(study: Study) -> Figure:
    """Draw Figure 8: the profile in the contact, and the pressure of a contact with and without it."""
    left, right = new_panels(1, 2, (10.0, 3.8))
    result, smooth = study.rough[CONTACTS[3]], study.smooth[CONTACTS[3]]
    x = result.film.x / result.conditions.half_width
    last = result.rough[0]["steps"][-1]
    measured = 0.5 * last["points"] * last["spacing"] / result.conditions.half_width
    left.plot(x, 1e9 * result.roughness[0], color=_COLOURS[0], lw=0.5)
    left.axvspan(x[0], -measured, color=BODY, lw=0.0, label="beyond the scan: mirrored")
    for cut in (-50.0, 50.0):
        left.axhline(cut, color="black", lw=0.6, ls=":")
    _title(left, "(a) profile of surface 1, cut at ±50 nm")
    label = f"$x/b$   ($b$ = {_MICRO * result.conditions.half_width:.4g} µm)"
    left.set(xlabel=label, ylabel="height [nm]", xlim=(x[0], x[-1]), ylim=(-62, 72))
    left.legend(loc="upper right", frameon=False)
    _pressures(right, result, smooth)
    _title(right, f"(b) {_name(CONTACTS[3], result)}", _speed(CONTACTS[3]), "1 GPa")
    return figure_of(left)


def _pressures(ax: Axes, rough: Result, smooth: Result) -> None:
    """Draw the pressure of the rough and the smooth contact over x/b."""
    for result, colour, width, label in (
        (rough, _COLOURS[0], 0.7, "rough"),
        (smooth, "black", 1.0, "smooth"),
    ):
        x: Array = result.film.x / result.conditions.half_width
        ax.plot(x, result.film.pressure / 1e9, color=colour, lw=width, label=label)
    ax.set(xlabel="$x/b$", ylabel="pressure $p$ [GPa]", xlim=(-1.5, 1.25))
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="upper left", frameon=False)


FIGURES: dict[int, PaperFigure] = {
    2: PaperFigure("The elastohydrodynamic model.", (), lambda _: film_model()),
    3: PaperFigure("The electrostatic model.", (), lambda _: field_model()),
    4: PaperFigure("Potential of the smooth films (a) M12L15 and (b) M34L9.", ("smooth",), potentials),
    5: PaperFigure("Field strength of the smooth films at 1 GPa.", ("smooth",), _strengths("smooth", 1)),
    6: PaperFigure("Field strength of the smooth films at 2 GPa.", ("smooth",), _strengths("smooth", 2)),
    7: PaperFigure("Mid-film field strength at (a) 1 GPa and (b) 2 GPa.", ("smooth",), smooth_middle),
    8: PaperFigure(
        "(a) The measured profile and (b) the pressure of M34L9 with and without it.",
        ("smooth", "rough"),
        profile_and_pressure,
    ),
    9: PaperFigure("Field strength of the rough films at 1 GPa.", ("rough",), _strengths("rough", 1)),
    10: PaperFigure("Field strength of the rough films at 2 GPa.", ("rough",), _strengths("rough", 2)),
    11: PaperFigure("Dimensionless mid-film field strength of the rough films.", ("rough",), rough_middle),
}
