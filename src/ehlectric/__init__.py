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
    from ehlectric.cases.bearings.case import BearingCase
    from ehlectric.cases.case import Case, LineCase, PointCase
    from ehlectric.cases.drives.case import DriveCase
    from ehlectric.cases.measurements.factors import FilmFactors
    from ehlectric.cases.oils.named import oil
    from ehlectric.contact.results import PointResult, Result
    from ehlectric.discharge.verdict import Verdict
    from ehlectric.drive.result import DriveResult, solve_drive
    from ehlectric.drive.spice.drive import write_drive_netlist
    from ehlectric.drive.spice.files import write_netlist
    from ehlectric.errors import ConvergenceError, InputError, LostError, ResultWarning
    from ehlectric.figures.results import figure, figure_names, save_figures
    from ehlectric.motion.result import MotionResult
    from ehlectric.motion.run import run_motion
    from ehlectric.motion.stored_run import read_motion
    from ehlectric.report.files import write_report
    from ehlectric.runs.example_files import example
    from ehlectric.runs.exports.files import export
    from ehlectric.runs.film_factors import film_factors
    from ehlectric.runs.results import load, save
    from ehlectric.runs.solve import solve, solve_motion
    from ehlectric.runs.solve_many import Solved, solve_many
    from ehlectric.sweep.inputs import Sweep
    from ehlectric.sweep.results import SweepResults
    from ehlectric.sweep.run import run_sweep
    from ehlectric.sweep.store import read_sweep

# In the order of their use, in which the pages of the API list them.
__all__ = [  # noqa: RUF022
    "solve",
    "solve_many",
    "solve_bearing",
    "solve_drive",
    "solve_motion",
    "film_factors",
    "Case",
    "LineCase",
    "PointCase",
    "BearingCase",
    "DriveCase",
    "oil",
    "example",
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
    "write_report",
    "export",
    "write_drive_netlist",
    "write_netlist",
    "Result",
    "PointResult",
    "BearingResult",
    "DriveResult",
    "MotionResult",
    "SweepResults",
    "Laws",
    "FilmFactors",
    "Solved",
    "Verdict",
    "ResultWarning",
    "InputError",
    "ConvergenceError",
    "LostError",
    "__version__",
]

_HOMES = {
    "solve": "runs.solve",
    "solve_many": "runs.solve_many",
    "solve_bearing": "bearing.solver",
    "solve_motion": "runs.solve",
    "film_factors": "runs.film_factors",
    "Case": "cases.case",
    "LineCase": "cases.case",
    "PointCase": "cases.case",
    "BearingCase": "cases.bearings.case",
    "oil": "cases.oils.named",
    "example": "runs.example_files",
    "Sweep": "sweep.inputs",
    "run_sweep": "sweep.run",
    "run_motion": "motion.run",
    "read_sweep": "sweep.store",
    "read_motion": "motion.stored_run",
    "load": "runs.results",
    "save": "runs.results",
    "figure": "figures.results",
    "figure_names": "figures.results",
    "save_figures": "figures.results",
    "write_report": "report.files",
    "export": "runs.exports.files",
    "write_drive_netlist": "drive.spice.drive",
    "write_netlist": "drive.spice.files",
    "Result": "contact.results",
    "PointResult": "contact.results",
    "BearingResult": "bearing.result",
    "DriveResult": "drive.result",
    "solve_drive": "drive.result",
    "DriveCase": "cases.drives.case",
    "MotionResult": "motion.result",
    "SweepResults": "sweep.results",
    "Laws": "lubricant.own",
    "FilmFactors": "cases.measurements.factors",
    "Solved": "runs.solve_many",
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
