"""Functions that numba compiles, with their types kept.

Compiled functions stay on the disk for the next run. Numba takes one as up to date if the file of its source
is, but it also contains the functions that it calls from other files. The folder of the compiled functions is
therefore named by the contents of all files of the package ``drive``. If no folder can be written to,
functions are compiled in every run. With NUMBA_DISABLE_JIT, as for debuggers, nothing is compiled.
"""

from __future__ import annotations

import hashlib
import logging
import tempfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.core import event

from ehlectric.runtime.progress import MACHINE

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile a function of numbers and arrays at its first call, and keep it on the disk.

    The function and those that it calls make no arrays.
    """
    if _uncompiled():
        # Compiled functions warn of no overflow either.
        return np.errstate(all="ignore")(function)
    # The folder is chosen when a function is decorated. Other packages keep theirs.
    config: Any = numba.config
    before, folder = config.CACHE_DIR, _folder(config.CACHE_DIR)
    config.CACHE_DIR = str(folder or before)
    try:
        return _jit(function, cache=folder is not None, no_cfunc_wrapper=True)
    finally:
        config.CACHE_DIR = before


def inner(function: F) -> F:
    """Compile a function that only other compiled functions call, which takes less time.

    It is kept in the functions that call it. A function takes numbers of films and flags as variables:
    numba compiles it once more for each constant among its arguments.
    """
    return _jit(function, **_INNER)


def inlined(function: F) -> F:
    """Compile a function as a part of its caller, which takes less time where it is called at one place."""
    return _jit(function, inline="always", **_INNER)


# Without what only Python and C need for a call.
_INNER = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}


def _jit(function: F, **options: bool | str) -> F:
    jit: Any = numba.njit
    # A division by zero gives what it gives in numpy. References to arrays are not counted, which took more
    # than half of the time of a simulation: compiled functions get all arrays from their caller.
    return cast("F", jit(error_model="numpy", _nrt=False, **options)(function))


def compile_for(function: Callable[..., Any], arguments: tuple[Any, ...], say: Callable[[str], None]) -> None:
    """Compile a function for the types of its arguments, or read it from the disk. ``say``, called with a
    text before the function is compiled, and not where it is on the disk.
    """
    dispatcher, typeof = cast("Any", function), cast("Any", numba.typeof)
    if _uncompiled():
        _slow()
        return
    listener = _CompileListener(say, dispatcher)
    try:
        with event.install_listener("numba:compile", listener):
            dispatcher.compile(tuple(typeof(each) for each in arguments))
    except OSError as error:
        # The disk is full, for example. The function itself was compiled before it was to be kept.
        _not_kept(error.strerror or str(error))
    else:
        if listener.called and _folder(cast("Any", numba.config).CACHE_DIR) is None:
            _not_kept("no folder for it can be written to")


class _CompileListener(event.Listener):
    """Listener that reports once that a function is being compiled."""

    def __init__(self, say: Callable[[str], None], function: Any) -> None:
        self.say, self.function, self.called = say, function, False

    def on_start(self, event: Any) -> None:
        """Report at the start of the function, and not for functions that it calls."""
        if not self.called and event.data["dispatcher"] is self.function:
            self.called = True
            self.say("compiling the simulation of discharges, once on this machine")

    def on_end(self, event: Any) -> None:
        """Do nothing."""


def _uncompiled() -> bool:
    """Whether numba leaves functions as they are, as NUMBA_DISABLE_JIT asks it to."""
    return bool(cast("Any", numba.config).DISABLE_JIT)


@cache
def _slow() -> None:
    """Log once that the simulation is slow."""
    text = "the simulation of discharges runs uncompiled, hundreds of times slower: unset NUMBA_DISABLE_JIT"
    MACHINE.warning(text)


@cache
def _not_kept(reason: str) -> None:
    """Log once that each run compiles again."""
    MACHINE.log(
        logging.WARNING,
        "the simulation of discharges is compiled again in every run: %s; NUMBA_CACHE_DIR can name a folder",
        reason,
    )


@cache
def _folder(chosen: str) -> Path | None:
    """First folder for compiled functions that can be written to; None if none can.

    The folder of NUMBA_CACHE_DIR, which is ``chosen``, of the package, or of the user.
    """
    name = f"compiled-{contents_of(Path(__file__).parent.parent)}"
    for base in _bases(chosen):
        try:
            folder = base / name
            folder.mkdir(parents=True, exist_ok=True)
            # Permissions do not suffice: the disk may be mounted for reading only.
            tempfile.TemporaryFile(dir=folder).close()
        except OSError:
            continue
        return folder
    return None


def _bases(chosen: str) -> Iterator[Path]:
    """Folders in which a folder for compiled functions may be made, the best one first."""
    if chosen:
        yield Path(chosen)
    yield Path(__file__).parent / "__pycache__"
    try:
        home = Path.home()
    except RuntimeError:  # the user has none
        return
    yield home / ".cache" / "ehlectric"


def contents_of(folder: Path) -> str:
    """Return a short hash of all Python files in a folder and its subfolders."""
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]
