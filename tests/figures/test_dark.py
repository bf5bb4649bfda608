"""The dark style: its palette, and the exchange of colours when a figure is drawn."""

import numpy as np
import pytest
from matplotlib import rc_params_from_file
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex, to_rgb
from matplotlib.patches import Rectangle

from ehlectric import figure, load
from ehlectric.figures import style as styles
from ehlectric.figures.style import figure_of, label_point, line_colours, new_panels, outlined, style
from ehlectric.quantities import palette
from ehlectric.quantities.palette import BLACK, BLUE, BODY, DARK, ORANGE, WHITE, legible
from tests.helpers.contrasts import contrast
from tests.helpers.places import ROOT

PAGE = DARK[WHITE]
LINES = ("BLUE", "ORANGE", "GREEN", "AMBER", "PURPLE", "SKY", "GREY", "MIDDLE_GREY", "LIGHT_GREY")
LINES += ("BLACK", "STRENGTH", "OCHRE", "RED", "PALE_BLUE")

# Shared by artists of many figures.
EDGE = outlined(2.0)


def of(colour, other):
    """Contrast of two colours by their names."""
    return float(contrast(np.array(to_rgb(colour)), np.array(to_rgb(other))))


@pytest.mark.parametrize("name", LINES)
def test_lines_are_seen_on_a_dark_page(name):
    assert of(DARK[getattr(palette, name)], PAGE) >= 3.0


def test_no_colour_of_the_dark_page_is_exchanged_twice():
    assert not set(DARK) & set(DARK.values())
    assert len(set(DARK.values())) == len(DARK)


def test_colours_of_the_sheet_are_those_of_the_palette():
    """The sheet has the page and the ink; frames of legends and grids are between both."""
    sheet = rc_params_from_file(ROOT / "src/ehlectric/figures/dark.mplstyle", use_default_template=False)
    of_page = {key: to_hex(sheet[key]) for key in ("figure.facecolor", "axes.facecolor")}
    assert set(of_page.values()) == {PAGE}
    others = {to_hex(value) for key, value in sheet.items() if key not in of_page}
    assert {DARK[BLACK]} <= others
    assert all(1.3 < of(colour, PAGE) < of(DARK[BLACK], PAGE) for colour in others - {DARK[BLACK]})


def test_contrasts_are_those_of_the_recommendation():
    """Values of WCAG 2: black on white, and the grey #767676, the lightest one for texts on white."""
    assert palette.contrast(BLACK, WHITE) == pytest.approx(21.0)
    assert palette.contrast("#767676", WHITE) == pytest.approx(4.54, abs=0.005)
    assert palette.contrast("#767676", WHITE) == pytest.approx(of("#767676", WHITE))


@pytest.mark.parametrize("name", LINES)
def test_names_of_lines_can_be_read(name):
    colour = getattr(palette, name)
    assert of(legible(colour, WHITE), WHITE) >= 4.5
    assert of(legible(DARK[colour], PAGE), PAGE) >= 4.5


def test_the_colours_of_many_lines_are_seen_in_each_style():
    for look in ("screen", "dark"):
        with style(look):
            darkest, lightest = (to_hex(line_colours()(end)) for end in (0.0, 1.0))
        page = WHITE if look == "screen" else PAGE
        # Yellow is the end of most contrast on a dark page, and left out on white.
        assert min(of(darkest, page), of(lightest, page)) >= (1.6 if look == "screen" else 3.0)


def drawn_dark():
    """A line, a shading, a text with outline, arrow and box, and lines of a constant colour, in dark."""
    with style("dark"):
        (ax,) = new_panels(1, 1, (6.3, 3.4))
        ax.plot([0.0, 1.0], [0.0, 1.0], color=BLUE, marker="o", mfc=WHITE)
        ax.fill_between([0.0, 1.0], 0.0, 1.0, color=ORANGE, alpha=0.2, lw=0.0)
        ax.fill_between([0.0, 1.0], 1.0, 2.0, facecolor=(ORANGE, 0.2), lw=0.0)
        label_point(ax, (0.5, 0.5), "text", (5.0, 5.0), path_effects=EDGE, color="black")
        box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.9}
        ax.text(0.2, 0.2, "in a box", color="black", bbox=box)
        values = np.add.outer(np.arange(4.0), np.arange(4.0))
        ax.contour(values, [1.0, 2.0], colors="black")
        ax.pcolormesh(values, cmap="viridis")
        ax.add_patch(Rectangle((0.0, 0.0), 0.5, 0.5, facecolor=BODY))
    return ax


def test_colours_are_exchanged_once_when_a_figure_is_drawn():
    ax = drawn_dark()
    for _ in range(2):
        figure_of(ax).draw_without_rendering()
        (line,), (patch,) = ax.get_lines(), ax.patches
        assert (to_hex(line.get_color()), to_hex(line.get_markerfacecolor())) == (DARK[BLUE], PAGE)
        assert to_hex(patch.get_facecolor()) == DARK[BODY]
        shades = [one for one in ax.collections if isinstance(one, PolyCollection)][:2]
        # Faint shadings are more opaque on a dark page, whichever way their opacity is given.
        assert [to_hex(one.get_facecolor()[0]) for one in shades] == [DARK[ORANGE]] * 2
        assert [one.get_facecolor()[0][3] for one in shades] == pytest.approx([0.32] * 2)


def test_outlines_boxes_and_lines_of_one_colour_are_exchanged_and_maps_are_not():
    ax = drawn_dark()
    figure_of(ax).draw_without_rendering()
    (beside,) = [text for text in ax.texts if text.get_text() == "text"]
    assert [edge.colour for edge in beside.get_path_effects()] == [PAGE]
    assert [edge.colour for edge in EDGE] == [WHITE]
    (boxed,) = [text for text in ax.texts if text.get_text() == "in a box"]
    assert to_hex(boxed.get_bbox_patch().get_facecolor()) == PAGE
    # Its edge has no colour: it would show with the opacity of the box.
    assert boxed.get_bbox_patch().get_edgecolor()[:3] == (0.0, 0.0, 0.0)
    lines, mesh = [one for one in ax.collections if one.get_array() is not None]
    assert {to_hex(colour) for colour in lines.to_rgba(lines.get_array())} == {DARK[BLACK]}
    assert mesh.get_cmap().name == "viridis"


@pytest.mark.slow
def test_a_figure_drawn_outside_of_the_style_is_dark_too(tmp_path):
    """Colours of the page are those of the figure, whatever the settings of Matplotlib are later."""
    drawn = figure(load(ROOT / "tests/data/releases/1.0.0/line"), "film", style="dark")
    drawn.savefig(tmp_path / "film.png", dpi=50)
    assert to_hex(drawn.get_facecolor()) == PAGE
    assert styles.mpl.rcParams["figure.facecolor"] == "white"
    texts = [label for ax in drawn.axes for label in (ax.xaxis.label, ax.yaxis.label) if label.get_text()]
    assert all(of(to_hex(label.get_color()), PAGE) >= 4.5 for label in texts)
