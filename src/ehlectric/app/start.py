"""Start of the app: its address is there at once, and the processes that compute load next to the server."""

from __future__ import annotations

import errno
import os
import socket
import sys
import threading
import webbrowser
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from ehlectric.app.kept_answers import read
from ehlectric.app.security import Guard
from ehlectric.app.work import Limits, Work, clear_left_behind, take_temporary_files
from ehlectric.errors import InputError
from ehlectric.runtime.locks import held_back

# Ports that are tried where none is given.
_PORTS = range(8080, 8180)

# Clients of sockets and another server, which the library of sockets loads if it finds them. This server uses
# none of them, and they would take a third of its start.
_UNUSED = ("aiohttp", "requests", "tornado", "websocket")


def start(
    host: str,
    port: int | None,
    *,
    browser: bool,
    tell: Callable[[str], None],
    limits: Limits | None = None,
) -> None:
    """Serve the app until it is interrupted.

    The port is the first free one from 8080 upwards where it is None, and any free one where it is 0.
    ``tell`` is called with a line that has the address of the app when it takes requests.
    """
    listening = listen(host, port)
    guard = Guard.of(host, listening.getsockname()[1])
    clear_left_behind()
    work = Work(limits)
    try:
        # Files of the server, such as parts of large uploads, are removed with it.
        take_temporary_files(work.scratch.folder)
        # NiceGUI would write its files into the folder in which the command was typed.
        os.environ["NICEGUI_STORAGE_PATH"] = str(work.scratch.folder)
        answers = read()
        if not answers:
            # The processes load the physics while the server loads.
            work.warm()
        # A browser starts meanwhile, and waits for the answer to its request.
        tell(f"ehlectric is at {guard.address}  (Ctrl-C ends it)")
        if browser:
            threading.Thread(target=webbrowser.open, args=(guard.address,), daemon=True).start()
        with _without(_UNUSED):
            from ehlectric.app.server import serve

        serve(guard, listening, work, answers)
    except KeyboardInterrupt:
        # This is how a user ends it.
        pass
    finally:
        with held_back():  # What is left running here would be waited for at the exit.
            work.close()
        listening.close()


@contextmanager
def _without(packages: Iterable[str]) -> Iterator[None]:
    """Context in which packages that are not loaded are taken as missing."""
    hidden: dict[str, Any] = {name: None for name in packages if name not in sys.modules}
    sys.modules.update(hidden)
    try:
        yield
    finally:
        for name in hidden:
            del sys.modules[name]


def listen(host: str, port: int | None) -> socket.socket:
    """Socket that is bound to an address; InputError for a port that is taken, or another machine."""
    for candidate in _PORTS if port is None else (port,):
        try:
            return _bound(host, candidate)
        except socket.gaierror:
            raise InputError("--host", got=host, takes="an address of this machine") from None
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            if error.errno == errno.EADDRNOTAVAIL:
                raise InputError("--host", got=host, takes="an address of this machine") from None
            taken = error.errno == errno.EADDRINUSE
            if port is not None or not taken:
                takes = "a free port, or 0 for any that is free"
                raise InputError("--port", f"{candidate} cannot be used, {reason}", takes=takes) from None
    raise InputError("--port", f"{_PORTS[0]} to {_PORTS[-1]} are taken", takes="a free port")


def _bound(host: str, port: int) -> socket.socket:
    family, kind, protocol, _, address = socket.getaddrinfo(
        host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
    )[0]
    bound = socket.socket(family, kind, protocol)
    try:
        if os.name == "posix":
            # A port whose server has just ended is free; on Windows this would share a port in use.
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind(address)
        bound.listen()
    except OSError:
        bound.close()
        raise
    return bound
