"""Memory that this process may still use, and errors that mean that it has no more.

The machine sets a limit, and so may the shell (``ulimit -v``) and the control groups of the process, as those
of a container. The least of them counts.
"""

from __future__ import annotations

import ctypes
import errno
import os
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from pathlib import Path, PurePosixPath

from ehlectric.errors import MemoryLimitError

# Largest size of a file of measured rows, such as a duty cycle [bytes]: all of its cells are texts in memory.
MOST_MEASURED = 8_000_000

# Texts of errors that mean that memory ran out, although their types do not show it: of the loader of shared
# libraries, of threads that cannot start, and of HDF5.
_TEXTS = ("cannot allocate memory", "failed to map segment", "can't start new thread", "memory allocation")

# Files of a control group, of version 2 and 1: limit, use, and the key of memory.stat for file contents that
# the kernel drops when memory is needed.
_VERSIONS = {
    2: ("memory.max", "memory.current", "inactive_file"),
    1: ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"),
}

# Interval in which what the control groups leave is read once [s].
_FRESH = 0.1


def physical_memory() -> float:
    """Physical memory of the machine [bytes]; infinite where the operating system does not report it."""
    try:
        return float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, ValueError, OSError):
        return float("inf")


def available_memory() -> float:
    """Memory that this process may still use [bytes].

    It is the least of the physical memory of the machine, of what is left of the limits of the process
    (``ulimit -v`` and ``ulimit -d``), and of what is left of the limits of its control groups.

    Returns memory [bytes]; at least zero, and infinite where the operating system reports no limit.

    The control groups are read ten times a second at most. They are about ten files, and a contact that
    refines its grid asks for every grid.
    """
    return max(
        0.0,
        min(physical_memory(), left_of_process(), _lately(left_of_groups, int(time.monotonic() / _FRESH))),
    )


@lru_cache(maxsize=1)
def _lately(of: Callable[[], float], _tenth: int) -> float:
    """Number of bytes that a function returns, which is called once in each interval of time."""
    return of()


def least_limit() -> str:
    """Words for the limit that ``available_memory`` comes from."""
    limits = {
        "the memory of this machine": physical_memory(),
        "what ulimit leaves to this process": left_of_process(),
        "what its control group, as in a container, leaves to this process": left_of_groups(),
    }
    return min(limits, key=lambda name: limits[name])


def out_of_memory(error: BaseException) -> str:
    """Line about an error that means that memory ran out.

    Examples
    --------
    >>> out_of_memory(MemoryError("Unable to allocate 5 GiB")).partition(";")[0]
    'out of memory: Unable to allocate 5 GiB'
    """
    text = " ".join(str(error).split())[:200]
    said = "out of memory" + (f": {text}" if text else "")
    return f"{said}; available are {in_bytes(available_memory())}, {least_limit()}"


def left_of_process(status: Path = Path("/proc/self/status")) -> float:
    """Memory that the limits of the process leave to it [bytes]; infinite without a limit."""
    try:
        resource = import_module("resource")
    except ModuleNotFoundError:  # Windows
        return float("inf")
    left = float("inf")
    for limit, used in ((resource.RLIMIT_AS, "VmSize"), (resource.RLIMIT_DATA, "VmData")):
        soft, _ = resource.getrlimit(limit)
        if soft != resource.RLIM_INFINITY:
            left = min(left, float(soft - _in_use(status, used)))
    return left


def _in_use(status: Path, name: str) -> int:
    """Number of bytes next to a name in a status file of the kernel; zero where it is missing."""
    try:
        for line in status.read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith(f"{name}:"):
                return 1024 * int(line.split()[1])
    except (OSError, ValueError, IndexError):
        pass
    return 0


def left_of_groups(process: Path = Path("/proc/self"), root: Path = Path("/")) -> float:
    """Memory that the control groups of the process leave to it [bytes]; infinite without a limit.

    The limits of the process's own group and of all groups above it count, of both versions of control
    groups. File contents that the kernel would drop first are not counted as used.
    """
    left = float("inf")
    for version, group, mount in _groups(process):
        top = root / mount.relative_to("/")
        for folder in (group, *group.parents):
            left = min(left, _left_of_group(top / folder.relative_to("/"), version))
    return left


def _groups(process: Path) -> Iterator[tuple[int, PurePosixPath, PurePosixPath]]:
    """Versions, paths below the mount point, and mount points of the groups that limit memory."""
    try:
        lines = (process / "cgroup").read_text(encoding="utf-8", errors="replace").splitlines()
        mounts = (process / "mountinfo").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return
    paths = {}
    for line in lines:
        number, controllers, path = (*line.split(":", 2), "", "")[:3]
        if number == "0" and not controllers:
            paths[2] = path
        elif "memory" in controllers.split(","):
            paths[1] = path
    for line in mounts:
        before, _, after = line.partition(" - ")
        fields, kind = before.split(), after.split()
        if len(fields) < 5 or len(kind) < 1:
            continue
        version = {"cgroup2": 2, "cgroup": 1}.get(kind[0])
        if version not in paths or (version == 1 and "memory" not in kind[-1].split(",")):
            continue
        yield version, _below(paths[version], fields[3]), PurePosixPath(fields[4])


def _below(path: str, top: str) -> PurePosixPath:
    """Path of a group below the group that is mounted.

    Only the mounted group itself is visible where the path does not lie below it, as in a container.
    """
    group = PurePosixPath("/") / path
    if ".." in group.parts:
        return PurePosixPath("/")
    try:
        return PurePosixPath("/") / group.relative_to(top)
    except ValueError:
        return PurePosixPath("/")


def _left_of_group(folder: Path, version: int) -> float:
    """Memory that one group leaves [bytes]; infinite where it has no limit."""
    limit_file, use_file, droppable = _VERSIONS[version]
    try:
        limit = (folder / limit_file).read_text(encoding="ascii").strip()
        if limit == "max":
            return float("inf")
        used = int((folder / use_file).read_text(encoding="ascii"))
        stat = (folder / "memory.stat").read_text(encoding="ascii", errors="replace")
        rows = (line.split() for line in stat.splitlines())
        spare = next((int(row[1]) for row in rows if len(row) == 2 and row[0] == droppable), 0)
        return float(int(limit) - max(0, used - spare))
    except (OSError, ValueError):
        return float("inf")


def is_out_of_memory(error: BaseException | None) -> bool:
    """Whether an error, or one that it came from, means that memory ran out or would not suffice.

    Examples
    --------
    >>> is_out_of_memory(MemoryError()), is_out_of_memory(RuntimeError("can't start new thread"))
    (True, True)
    >>> is_out_of_memory(OSError("no such file"))
    False
    """
    seen: set[int] = set()
    while error is not None and id(error) not in seen:
        seen.add(id(error))
        if isinstance(error, MemoryError | MemoryLimitError) or getattr(error, "errno", None) == errno.ENOMEM:
            return True
        if isinstance(error, ImportError | RuntimeError | OSError):
            text = str(error).lower()
            if any(known in text for known in _TEXTS):
                return True
        error = error.__cause__ or error.__context__
    return False


def in_bytes(size: float) -> str:
    """Number of bytes as text with a unit and two or three digits.

    Examples
    --------
    >>> in_bytes(128_000), in_bytes(5.1e9), in_bytes(20 * 10**9), in_bytes(12)
    ('128 kB', '5.1 GB', '20 GB', '12 B')
    """
    for unit, scale in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if size >= 0.9995 * scale:
            value = size / scale
            return f"{value:.0f} {unit}" if value >= 99.5 else f"{value:.3g} {unit}"
    return f"{size:.0f} B"


def trim() -> None:
    """Give freed memory back to the system, where the C library can."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)
