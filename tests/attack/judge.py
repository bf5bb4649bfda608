"""What no command may do, whatever its input is."""

from __future__ import annotations

import os
import unicodedata
from collections.abc import Iterator
from pathlib import Path

from tests.attack.runner import Outcome

# Longest time on a processor [s] and largest memory [bytes] of a command with an input of the attack.
LONGEST = 30.0
LARGEST = 2 << 30

# Exit statuses: solved, wrong input, not converged.
STATUSES = (0, 2, 3)

# Words of interpreters and libraries, which no user should have to read.
_INTERNAL = (
    "Traceback (most recent call last)", "HDF5-DIAG", "Segmentation fault", "RuntimeWarning", "UserWarning",
    "DeprecationWarning", "ResourceWarning", "Exception ignored", "BrokenProcessPool", "__main__",
    " object at 0x",
)  # fmt: skip


def faults(outcome: Outcome, folder: Path, temporary: Path) -> Iterator[str]:
    """Say what a command did that it must not do.

    Parameters
    ----------
    outcome : Outcome
        What it did.
    folder : Path
        Folder in which it was run: ``out`` of it is its output folder.
    temporary : Path
        Folder of temporary files.

    Yields
    ------
    str
        A fault.
    """
    if not outcome.ended:
        yield f"did not end in {outcome.seconds:.0f} s"
        return
    if outcome.processor > LONGEST:
        yield f"took more than {LONGEST:g} s of a processor"
        return
    if outcome.status not in STATUSES:
        yield f"exit status {outcome.status}"
    text = outcome.out + outcome.err
    yield from (f"prints {word!r}" for word in _INTERNAL if word in text)
    if odd := sorted({mark for mark in text if _unprintable(mark)}):
        yield f"prints characters {odd!a}"
    if outcome.peak > LARGEST:
        yield f"took {outcome.peak / 2**30:.1f} GB"
    yield from _message_faults(outcome)
    if abroad := [path for path in outcome.changed if not _allowed(path, folder / "out", temporary)]:
        yield f"wrote {abroad[:3]}"
    yield from (f"left {path.name} behind" for path in hidden(folder / "out"))


def _message_faults(outcome: Outcome) -> Iterator[str]:
    errors = [line for line in outcome.err.splitlines() if line.startswith("error: ")]
    if outcome.status == 0 and errors:
        yield "prints an error and ends with status 0"
    if outcome.status == 2 and len(errors) != 1:
        yield f"ends with status 2 and {len(errors)} lines of errors"
    if outcome.status == 2 and outcome.err.splitlines()[-1:] != errors[-1:]:
        yield "ends with status 2, and its last line is no error"
    longest = max(map(len, outcome.err.splitlines()), default=0)
    if longest > 5000:
        yield f"prints a line of {longest} characters"


def _unprintable(mark: str) -> bool:
    return mark not in "\n\t" and unicodedata.category(mark) in ("Cc", "Cf", "Cs", "Zl", "Zp", "Co", "Cn")


def _allowed(path: str, *folders: Path) -> bool:
    """Whether a command may write a path: one in its folders, the null device, or compiled code."""
    own = "__pycache__" in Path(path).parts
    return path == os.devnull or own or any(Path(path).is_relative_to(folder) for folder in folders)


def hidden(folder: Path) -> list[Path]:
    """Hidden files in a folder but locks, which stay."""
    found = folder.rglob(".*") if folder.is_dir() else ()
    return [path for path in found if not path.name.endswith(".lock")]
