"""Arrays that the long tests and the documentation both need; in one run they are computed once."""

from __future__ import annotations

import fcntl
import hashlib
import os
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

# Variable of the environment that names a folder for them. The folder is new for each run, so that it never
# has what other code computed.
SHARED = "EHLECTRIC_SHARED"


def shared(compute: Callable[[], Sequence[np.ndarray]], *inputs: object) -> list[np.ndarray]:
    """Arrays that a function computes from inputs whose texts are all that they depend on.

    Where the environment names a folder, they are kept there for the other processes of the run.
    """
    if SHARED not in os.environ:
        return list(compute())
    name = hashlib.sha256(repr(inputs).encode()).hexdigest()
    path = Path(os.environ[SHARED]) / f"{name}.npz"
    # The file is locked by whoever computes; the others wait for it.
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.exists():
            part = path.with_suffix(".part.npz")
            np.savez(part, *compute())
            part.rename(path)
    with np.load(path) as found:
        return [found[f"arr_{k}"] for k in range(len(found.files))]
