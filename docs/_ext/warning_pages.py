"""Page of all warnings by topic: severity, meaning, texts and explanation of each code, with an anchor."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby

from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import CODES


def warning_pages() -> dict[str, str]:
    """Return the part of the page of warnings that is written from their data files, by its name."""
    return {"warnings": "\n".join(_topics())}


def _topics() -> Iterator[str]:
    texts = data_file("ehlectric.quantities", "warning_texts.toml")
    for topic, codes in groupby(CODES, key=lambda code: CODES[code].topic):
        yield f"### {topic}\n"
        for code in codes:
            entry = dict(texts.get(code, {}))
            explanation = entry.pop("explanation", "")
            yield f"(warning-{code})=\n**`{code}`** ({CODES[code].severity}). {CODES[code].meaning}\n"
            yield from (f"> {_shown(text)}\n" for text in entry.values())
            yield from [f"{explanation}\n"] if explanation else []


def _shown(text: str) -> str:
    """Text with an ellipsis instead of each value, and without the markup that its characters may be."""
    return re.sub(r"([*_\[\]`|<>])", r"\\\1", re.sub(r"\{[^}]*\}", "…", text))
