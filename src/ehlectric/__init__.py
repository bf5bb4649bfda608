"""Film and electric field of lubricated contacts.

A public name is imported when it is first used, so ``import ehlectric`` takes hardly any time.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ehlectric.version import __version__

if TYPE_CHECKING:
    from ehlectric.bearing.solver import solve_bearing
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.commands.runs import load
    from ehlectric.contact.files import save
    from ehlectric.contact.results import Result
    from ehlectric.contact.solver import solve
    from ehlectric.errors import ConvergenceError, InputError
    from ehlectric.figures.results import figure, save_figures
    from ehlectric.motion.run import run_motion
    from ehlectric.motion.stored_run import read_motion
    from ehlectric.sweep.inputs import Sweep
    from ehlectric.sweep.run import run_sweep
    from ehlectric.sweep.store import read_sweep

__all__ = [
    "BearingCase",
    "Case",
    "ConvergenceError",
    "InputError",
    "Result",
    "Sweep",
    "__version__",
    "figure",
    "load",
    "read_motion",
    "read_sweep",
    "run_motion",
    "run_sweep",
    "save",
    "save_figures",
    "solve",
    "solve_bearing",
]

_HOMES = {
    "BearingCase": "cases.bearing_case",
    "Case": "cases.case",
    "ConvergenceError": "errors",
    "InputError": "errors",
    "Result": "contact.results",
    "Sweep": "sweep.inputs",
    "load": "commands.runs",
    "read_motion": "motion.stored_run",
    "read_sweep": "sweep.store",
    "run_motion": "motion.run",
    "run_sweep": "sweep.run",
    "save": "contact.files",
    "figure": "figures.results",
    "save_figures": "figures.results",
    "solve": "contact.solver",
    "solve_bearing": "bearing.solver",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
