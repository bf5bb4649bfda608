"""Process that runs commands of ehlectric in children of its own, and says what each of them did.

The process has all of ehlectric loaded, so that a command starts in milliseconds: each runs in a fork. It
reads one request a line from standard input, and answers in one line of JSON.
"""

from __future__ import annotations

import atexit
import contextlib
import json
import os
import resource
import select
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.helpers.preloaded import preload

# A child may not take more address space than this [bytes]; the bound that is judged is lower.
ADDRESS_SPACE = 16 << 30

# Events of the interpreter's audit that change files, and which of their arguments are paths.
_CHANGING = {
    "os.mkdir": (0,),
    "os.remove": (0,),
    "os.rename": (0, 1),
    "os.rmdir": (0,),
    "os.symlink": (1,),
    "os.link": (1,),
    "os.truncate": (0,),
    "os.chmod": (0,),
    "shutil.rmtree": (0,),
}
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def _preload() -> None:
    """Import what commands import, and make what they make once, so that forks have it."""
    import matplotlib

    matplotlib.use("agg")
    preload()
    from ehlectric import Case

    Case.from_toml(Path(__file__).parents[2] / "examples" / "line_contact.toml")


def _absolute(path: str | bytes | os.PathLike[str]) -> str:
    # Links are not followed: the path is that which the command named.
    return os.path.normpath(Path.cwd() / os.fsdecode(path))


def _watch(changed: Callable[[str], None]) -> None:
    """Report the paths of files that the process opens for writing, makes, moves or removes."""

    def look(event: str, arguments: tuple[Any, ...]) -> None:
        if event == "open":
            path, _, flags = arguments
            if isinstance(path, str | bytes | os.PathLike) and flags is not None and flags & _WRITING:
                changed(_absolute(path))
        elif event in _CHANGING:
            for number in _CHANGING[event]:
                if isinstance(arguments[number], str | bytes | os.PathLike):
                    changed(_absolute(arguments[number]))

    sys.addaudithook(look)


def _child(request: dict[str, Any]) -> int:
    """Run the command of a request; the exit status."""
    for name, number in (("out", 1), ("err", 2)):
        file = os.open(request[name], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(file, number)
        os.close(file)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = open(2, "w", encoding="utf-8", closefd=False, buffering=1)  # noqa: SIM115
    os.chdir(request["folder"])
    changes = Path(request["changes"]).open("w", encoding="utf-8", buffering=1)  # noqa: SIM115
    _watch(lambda path: changes.write(path + "\n") and None)
    sys.argv = ["ehlectric", *request["arguments"]]
    from ehlectric.__main__ import main

    try:
        main()
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return 1
    finally:
        atexit._run_exitfuncs()
        sys.stdout.flush()
    return 0


def _fork(request: dict[str, Any]) -> int:
    """Start the child of a request; its process number."""
    pid = os.fork()
    if pid:
        return pid
    status = 1
    try:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        status = _child(request)
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(status)


def _processor_time(pid: int) -> float:
    """Time of a process and its children on the processor [s]."""
    found = 0.0
    with contextlib.suppress(OSError):
        threads = Path(f"/proc/{pid}/task").glob("*/children")
        for number in [pid, *(int(child) for path in threads for child in path.read_text().split())]:
            with contextlib.suppress(OSError):
                # The clock that clock_getcpuclockid(3) gives for a process.
                found += time.clock_gettime(~number << 3 | 2)
    return found


# Pause between two looks at the time of a process on the processor [s].
_PAUSE = 1e-3


def _runs_to_its_end(pid: int, request: dict[str, Any]) -> bool:
    """Whether a process ends before the moment at which it is to be killed, and before its time limit."""
    end, until = os.pidfd_open(pid), time.monotonic() + request["limit"]
    moment = request["processor"]
    try:
        while time.monotonic() < until and (moment is None or _processor_time(pid) < moment):
            if select.select([end], [], [], request["limit"] if moment is None else _PAUSE)[0]:
                return True
        return False
    finally:
        os.close(end)


def _answer(request: dict[str, Any]) -> dict[str, Any]:
    """Run a request to its end, or kill it at the moment that it names or at its time limit."""
    started = time.monotonic()
    pid = _fork(request)
    ended = _runs_to_its_end(pid, request)
    if not ended:
        # The process alone, as a shortage of memory does: its workers must notice by themselves.
        os.kill(pid, signal.SIGKILL)
    _, status, usage = os.wait4(pid, 0)
    return {
        "status": os.waitstatus_to_exitcode(status),
        "ended": ended,
        "seconds": time.monotonic() - started,
        "processor": usage.ru_utime + usage.ru_stime,
        "peak": usage.ru_maxrss * 1024,
        "group": pid,
    }


def _hold_all() -> None:
    """Let a thread solve, draw and start a process for ever, as far as locks know."""
    from ehlectric.figures.style import style
    from ehlectric.runtime.threads import one_blas_thread

    held = threading.Event()

    def hold() -> None:
        with one_blas_thread(), style():
            held.set()
            threading.Event().wait()

    threading.Thread(target=hold, daemon=True).start()
    held.wait()


def serve() -> None:
    """Answer requests until standard input ends."""
    _preload()
    if "poor" in sys.argv:
        _hold_all()
    # Answers go out by a descriptor of their own: children have the standard ones for themselves.
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    print("{}", file=answers, flush=True)
    for line in sys.stdin:
        print(json.dumps(_answer(json.loads(line))), file=answers, flush=True)


if __name__ == "__main__":
    serve()
