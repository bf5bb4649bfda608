"""The command that serves the web app."""

from __future__ import annotations

import math

from ehlectric.commands.options import command
from ehlectric.commands.terminal import say, user_errors
from ehlectric.errors import InputError


@command("app")
def app(
    port: int | None = None,
    host: str = "127.0.0.1",
    browser: bool = True,
    jobs: int | None = None,
    memory: float | None = None,
    time_limit: float = 60.0,
) -> None:
    """Serve the web app on this machine, and open it in a browser.

    Ctrl-C ends it, with all that it computes. It needs the extra: pip install "ehlectric[app]".
    """
    with user_errors():
        from importlib.util import find_spec

        if find_spec("nicegui") is None:
            takes = 'an installation with: pip install "ehlectric[app]"'
            raise InputError("app", "NiceGUI is missing", takes=takes)
        from ehlectric.app.start import start
        from ehlectric.app.work import limits_of

        _finite(memory, "--memory")
        _finite(time_limit, "--time-limit")
        limits = limits_of(jobs=jobs, gigabytes=memory, minutes=time_limit)
        start(host, port, browser=browser, tell=say, limits=limits)


def _finite(value: float | None, option: str) -> None:
    """Refuse NaN and infinite numbers, which every comparison with a bound lets pass or not by chance."""
    if value is not None and not math.isfinite(value):
        raise InputError(option, got=value, takes="a finite number")
