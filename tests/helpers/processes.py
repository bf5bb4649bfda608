"""Processes of this machine, by the files of Linux below /proc."""

import time
from pathlib import Path


def alive(number):
    """Whether a process runs; one that has ended and waits for its parent does not."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def tree(number):
    """Numbers of a process and of all that descend from it."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(path.parent.name)] = int(path.read_text().rpartition(")")[2].split()[1])
        except (FileNotFoundError, ProcessLookupError):
            continue
    found = [number]
    for parent in found:
        found += [child for child, its in parents.items() if its == parent]
    return found


def workers_of(number):
    """Numbers of the worker processes that a process has started; the tracker of their resources is none."""
    found = []
    for child in tree(number)[1:]:
        try:
            words = Path(f"/proc/{child}/cmdline").read_bytes()
        except (FileNotFoundError, ProcessLookupError):
            continue
        found += [child] if b"spawn_main" in words else []
    return found


def memory_of(numbers):
    """Memory of processes [bytes]; what they share counts once."""
    total = 0
    for number in numbers:
        try:
            lines = Path(f"/proc/{number}/smaps_rollup").read_text().splitlines()
        except (FileNotFoundError, ProcessLookupError):
            continue
        total += sum(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))
    return total


# Time after which a test gives up what it waits for [s]. It only ends a test that would hang: the event is
# waited for, however long a busy machine takes for it.
PATIENCE = 120.0


def wait_until(condition, seconds=PATIENCE, every=0.05):
    """Whether a condition comes to hold; the time only ends a test that would hang."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(every)
    return True
