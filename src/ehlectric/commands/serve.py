"""The command that serves the web app."""

from __future__ import annotations

import math
from typing import Annotated

import typer

from ehlectric.commands.options import option
from ehlectric.commands.terminal import say, user_errors
from ehlectric.errors import InputError


def app(
    port: Annotated[
        int | None,
        typer.Option(
            "--port",
            metavar="N",
            min=0,
            max=65535,
            help="Port of the server; 0 for any free one.",
            show_default="8080, or the next free one",
        ),
    ] = None,
    host: Annotated[
        str,
        option(
            "ADDRESS",
            "Address to bind to. Any other than this machine's own, such as 0.0.0.0 for all, asks for a "
            "token, which is printed with the address.",
            "--host",
        ),
    ] = "127.0.0.1",
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open a browser.")] = True,
    jobs: Annotated[
        int | None,
        typer.Option(
            "--jobs",
            metavar="N",
            min=1,
            max=1000,
            help="Solutions that run at once; further ones wait.",
            show_default="half of the cores",
        ),
    ] = None,
    memory: Annotated[
        float | None,
        typer.Option(
            "--memory",
            metavar="GB",
            min=1.0,
            help="Largest memory of each process of a solution, in GB.",
            show_default="half of the free memory, between 2 and 8",
        ),
    ] = None,
    time_limit: Annotated[
        float,
        typer.Option(
            "--time-limit", metavar="MINUTES", min=0.01, help="Longest time of a solution, in minutes."
        ),
    ] = 60.0,
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
