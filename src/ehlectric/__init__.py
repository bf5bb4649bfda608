"""Film and electric field of lubricated contacts.

The public names are imported when they are first used, so that ``import ehlectric`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ehlectric.version import __version__

if TYPE_CHECKING:
    from ehlectric.case import Case
    from ehlectric.errors import ConvergenceError, InputError
    from ehlectric.result import Result
    from ehlectric.solver import solve
    from ehlectric.store import load, save
    from ehlectric.sweep import run_sweep
    from ehlectric.sweep_inputs import Sweep
    from ehlectric.sweep_store import read_sweep

__all__ = [
    "Case",
    "ConvergenceError",
    "InputError",
    "Result",
    "Sweep",
    "__version__",
    "load",
    "read_sweep",
    "run_sweep",
    "save",
    "solve",
]

_HOMES = {
    "Case": "case",
    "ConvergenceError": "errors",
    "InputError": "errors",
    "Result": "result",
    "Sweep": "sweep_inputs",
    "load": "store",
    "read_sweep": "sweep_store",
    "run_sweep": "sweep",
    "save": "store",
    "solve": "solver",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
