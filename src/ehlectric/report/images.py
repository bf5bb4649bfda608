"""Figures of a report as images: vectors where they are small, else pixels."""

from __future__ import annotations

from io import BytesIO
from typing import Literal

from ehlectric.figures.style import style
from ehlectric.report.content import Picture

# Resolution of pixels [1/inch].
DPI = 200

# Largest image of vectors [bytes]; maps have a path for each of their cells.
_LARGEST = 400_000

# Neither kind of image has a date, so that equal figures are equal files.
_METADATA = {"png": {"Software": None}, "svg": {"Date": None, "Creator": None}}


def image_of(picture: Picture, kind: Literal["png", "svg"]) -> bytes:
    """Content of an image file of a figure.

    Parameters
    ----------
    picture : Picture
        Figure with its title, which the file has as metadata.
    kind : str
        "png", or "svg" for vectors.
    """
    content = BytesIO()
    with style():
        metadata = {**_METADATA[kind], "Title": picture.title}
        picture.figure.savefig(content, format=kind, dpi=DPI, metadata=metadata)
    return content.getvalue()


def best_image(picture: Picture) -> tuple[str, bytes]:
    """MIME type and content of a figure for a page: vectors, or pixels where vectors are too large."""
    vectors = image_of(picture, "svg")
    if len(vectors) <= _LARGEST:
        return "image/svg+xml", vectors
    return "image/png", image_of(picture, "png")
