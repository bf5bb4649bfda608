"""Title of a case, a bearing or a sweep: one line, of which every character is seen."""

from __future__ import annotations

import unicodedata
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

from ehlectric.cases.amounts import WRITTEN
from ehlectric.errors import InputError, printable, shown, unseen

# Longest title [characters].
LONGEST = 200

# Unicode categories that no title has: control characters, and halves of pairs, which no file can hold.
_NEVER = frozenset({"Cc", "Cs"})


def _title(text: str, info: ValidationInfo) -> str:
    """Title that is one line.

    A title that a person writes into a file has no character that is not seen either, such as one that turns
    the direction of the text: every program that shows the files of the result would obey it. Titles of
    earlier results may have such characters; they are escaped where they are shown.
    """
    written = bool(info.context and info.context.get(WRITTEN))
    if len(text) > LONGEST or any(unicodedata.category(letter) in _NEVER for letter in text):
        raise InputError(got=shown(text), takes=f"at most {LONGEST} printable characters on one line")
    hidden = next(filter(unseen, text), "") if written else ""
    if hidden:
        name = unicodedata.name(hidden, "a character without a name").lower()
        got = f"{shown(text)} with {printable(hidden)} ({name}), which is not seen"
        raise InputError(got=got, takes="a title without it")
    return text


# Title of files and figures, on one line.
Title = Annotated[str, AfterValidator(_title)]
