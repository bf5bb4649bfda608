"""Film and electric field of lubricated contacts, and breakdown of the film in bearings.

A public name is imported when it is first used, so ``import ehlectric`` takes hardly any time.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ehlectric.version import __version__

if TYPE_CHECKING:
    from ehlectric.bearing.result import BearingResult
    from ehlectric.bearing.solver import solve_bearing
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case, LineCase, PointCase
    from ehlectric.commands.results import load, save
    from ehlectric.commands.solve import solve, solve_motion
    from ehlectric.commands.solve_many import Solved, solve_many
    from ehlectric.contact.results import PointResult, Result
    from ehlectric.discharge.verdict import Verdict
    from ehlectric.errors import ConvergenceError, InputError, LostError, ResultWarning
    from ehlectric.figures.results import figure, figure_names, save_figures
    from ehlectric.motion.result import MotionResult
    from ehlectric.motion.run import run_motion
    from ehlectric.motion.stored_run import read_motion
    from ehlectric.sweep.inputs import Sweep
    from ehlectric.sweep.results import SweepResults
    from ehlectric.sweep.run import run_sweep
    from ehlectric.sweep.store import read_sweep

# In the order of their use, in which the pages of the API list them.
__all__ = [  # noqa: RUF022
    "solve",
    "solve_many",
    "solve_bearing",
    "solve_motion",
    "Case",
    "LineCase",
    "PointCase",
    "BearingCase",
    "Sweep",
    "run_sweep",
    "run_motion",
    "read_sweep",
    "read_motion",
    "load",
    "save",
    "figure",
    "figure_names",
    "save_figures",
    "Result",
    "PointResult",
    "BearingResult",
    "MotionResult",
    "SweepResults",
    "Solved",
    "Verdict",
    "ResultWarning",
    "InputError",
    "ConvergenceError",
    "LostError",
    "__version__",
]

_HOMES = {
    "solve": "commands.solve",
    "solve_many": "commands.solve_many",
    "solve_bearing": "bearing.solver",
    "solve_motion": "commands.solve",
    "Case": "cases.case",
    "LineCase": "cases.case",
    "PointCase": "cases.case",
    "BearingCase": "cases.bearing_case",
    "Sweep": "sweep.inputs",
    "run_sweep": "sweep.run",
    "run_motion": "motion.run",
    "read_sweep": "sweep.store",
    "read_motion": "motion.stored_run",
    "load": "commands.results",
    "save": "commands.results",
    "figure": "figures.results",
    "figure_names": "figures.results",
    "save_figures": "figures.results",
    "Result": "contact.results",
    "PointResult": "contact.results",
    "BearingResult": "bearing.result",
    "MotionResult": "motion.result",
    "SweepResults": "sweep.results",
    "Solved": "commands.solve_many",
    "Verdict": "discharge.verdict",
    "ResultWarning": "errors",
    "InputError": "errors",
    "ConvergenceError": "errors",
    "LostError": "errors",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
