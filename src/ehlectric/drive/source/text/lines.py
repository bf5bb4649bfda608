"""Blocks of whole lines of a text file, in UTF-8 whatever its encoding is."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from pathlib import Path

from ehlectric.errors import InputError
from ehlectric.runtime.reading import blocks

# Largest size of a file [bytes]: some 100 million samples of time and voltage.
MOST_BYTES = 2_000_000_000

# Longest line [bytes]. A file without line ends would fill the memory.
_LONGEST = 100_000

_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def whole_lines(path: Path) -> Iterator[bytes]:
    """Blocks of whole lines of a file.

    Parameters
    ----------
    path : Path
        Text file in UTF-8, UTF-16 or an encoding of one byte a letter.

    Yields
    ------
    bytes
        Lines that end with line feeds, but for the last one of the file, which may have no end. A byte order
        mark is left out, and UTF-16 becomes UTF-8.

    Raises
    ------
    InputError
        If the file cannot be read, is too large, is no text, or has a very long line.
    """
    rest = b""
    for block in _single_ends(_eight_bits(path)):
        if b"\0" in block:
            raise InputError(path, "is not a text file")
        text = rest + block
        end = text.rfind(b"\n") + 1
        rest = text[end:]
        if len(rest) > _LONGEST:
            raise InputError(path, f"has a line of more than {_LONGEST} characters", takes="a sample a line")
        if end:
            yield text[:end]
    if rest:
        yield rest


def _eight_bits(path: Path) -> Iterator[bytes]:
    """Blocks of a file without byte order mark; those of a file in UTF-16 in UTF-8."""
    decoder = None
    for k, content in enumerate(blocks(path, most=MOST_BYTES)):
        if k == 0 and content[:2] in _UTF_16:
            decoder = codecs.getincrementaldecoder("utf-16")()
        if decoder is not None:
            try:
                yield decoder.decode(content).encode("utf-8")
            except UnicodeError:
                raise InputError(path, "is not text in UTF-16") from None
        else:
            yield content.removeprefix(codecs.BOM_UTF8) if k == 0 else content


def _single_ends(content: Iterator[bytes]) -> Iterator[bytes]:
    """Blocks with line feeds in place of the returns of files whose lines end with returns alone."""
    alone: bool | None = None
    for block in content:
        if alone is None and (b"\n" in block or b"\r" in block):
            alone = b"\n" not in block
        yield block.replace(b"\r", b"\n") if alone else block


def decoded(line: bytes) -> str:
    """Text of a line in UTF-8 or Windows-1252."""
    try:
        return line.decode("utf-8")
    except UnicodeDecodeError:
        return line.decode("cp1252", errors="replace")
