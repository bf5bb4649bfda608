"""Titles of figures as a reader sees them."""

from matplotlib.figure import Figure
from matplotlib.text import Annotation


def title_of(figure: Figure) -> list[str]:
    """Lines of the title over all panels: the finding, then the smaller lines below it."""
    first = [line for line in figure.get_suptitle().split("\n") if line.strip()]
    below = [artist.get_text() for artist in figure.get_children() if isinstance(artist, Annotation)]
    lines = first + [line for text in below for line in text.split("\n")]
    # No-break spaces hold numbers and units together.
    return [line.replace("\xa0", " ") for line in lines]
