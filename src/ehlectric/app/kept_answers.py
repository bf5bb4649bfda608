"""Answers to the inputs with which a page begins, kept from one start of the app to the next.

They are kept as Python keeps its compiled modules: in the folder ``__pycache__`` of the package, until a file
of the package or a library that computes changes, and not at all if Python writes no such files.
"""

from __future__ import annotations

import os
import pickle
import secrets
import sys
from collections.abc import Iterator
from contextlib import suppress
from hashlib import sha256
from importlib.util import cache_from_source, find_spec
from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).parents[1]

# Libraries whose versions change the last digits of answers, or their texts.
_LIBRARIES = ("numpy", "scipy", "pydantic")


def read(path: Path | None = None) -> dict[str, Any]:
    """Kept answers by the keys of their calls; none if there are none of the present program.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write({"a call": 1.5}, Path(folder, "answers"))
    ...     read(Path(folder, "answers")), read(Path(folder, "others"))
    ({'a call': 1.5}, {})
    """
    path = path or _path()
    if path is None:
        return {}
    try:
        state, answers = pickle.loads(path.read_bytes())
    except Exception:  # No file, or one that was cut off: the answers are computed again.
        return {}
    return dict(answers) if state == _state() else {}


def write(answers: dict[str, Any], path: Path | None = None) -> None:
    """Keep answers by the keys of their calls, where the folder can be written to."""
    path = path or _path()
    if path is None:
        return
    begun = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
    try:
        path.parent.mkdir(exist_ok=True)
        begun.write_bytes(pickle.dumps((_state(), answers)))
        begun.replace(path)
    except OSError:
        with suppress(OSError):
            begun.unlink()


def _path() -> Path | None:
    if sys.dont_write_bytecode or sys.implementation.cache_tag is None:
        return None
    return Path(cache_from_source(__file__)).with_suffix(".pickle")


def _state() -> str:
    """Times and sizes of the files of the package and of the libraries, as one text."""
    return sha256("\n".join(_files()).encode()).hexdigest()


def _files() -> Iterator[str]:
    for name in _LIBRARIES:
        library = find_spec(name)
        if library is not None and library.origin is not None:
            yield _stamp(library.origin)
    for folder, folders, names in os.walk(_PACKAGE):
        folders[:] = sorted(inner for inner in folders if inner != "__pycache__")
        for name in sorted(names):
            yield _stamp(os.path.join(folder, name))  # noqa: PTH118  # joins of paths take most of the time


def _stamp(path: str) -> str:
    status = os.stat(path)  # noqa: PTH116
    return f"{path} {status.st_mtime_ns} {status.st_size}"
