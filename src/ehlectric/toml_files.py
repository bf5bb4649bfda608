"""Data files of the package in TOML, each parsed at its first use after a change.

The parser of the standard library takes as long for the book of quantities as the import of NumPy. Python's
loader of modules therefore keeps the contents next to the file, in its folder ``__pycache__``, as it does for
source: it parses a file again if its time or size has changed, and at each start if the folder is read-only.
"""

from __future__ import annotations

import tomllib
from importlib.abc import Traversable
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType
from typing import Any


class _Loader(SourceFileLoader):
    """Loader whose source is a file in TOML.

    Python names the kept file after the source without its last suffix. The suffix ``.py``, which the source
    lacks, keeps ``inputs.toml`` apart from ``inputs.py``.
    """

    def path_stats(self, path: str) -> Any:
        """Time and size of the source."""
        return super().path_stats(path.removesuffix(".py"))

    def get_data(self, path: str) -> bytes:
        """Contents of the source, or of the kept file."""
        return super().get_data(path.removesuffix(".py"))

    def source_to_code(self, data: Any, path: Any, **_: int) -> CodeType:  # type: ignore[override]
        """Code whose constant is the contents of the source."""
        return compile("0", path, "eval").replace(co_consts=(tomllib.loads(bytes(data).decode()),))


def contents(file: Traversable) -> dict[str, Any]:
    """Contents of a data file of the package, new at each call.

    Examples
    --------
    >>> from importlib.resources import files
    >>> sorted(contents(files("ehlectric.quantities") / "sheets.toml")["columns"])
    ['films', 'loads', 'page']
    """
    if not isinstance(file, Path):
        return tomllib.loads(file.read_text(encoding="utf-8"))
    code: Any = _Loader(file.stem, f"{file}.py").get_code(file.stem)
    read: dict[str, Any] = code.co_consts[0]
    return read
