"""Film and electric field of lubricated contacts, and breakdown of the film in bearings.

A public name is imported when it is first used, so ``import ehlectric`` takes hardly any time.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from ehlectric.version import __version__

if TYPE_CHECKING:
    from ehlectric.bearing import BearingResult, solve_bearing
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case, LineCase, PointCase
    from ehlectric.cases.case_oil import oil
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.cases.film_factors import FilmFactors
    from ehlectric.contact import PointResult, Result
    from ehlectric.drive import DriveResult, solve_drive, write_drive_netlist, write_netlist
    from ehlectric.errors import ConvergenceError, InputError, LostError
    from ehlectric.figures.result_figures import figure, figure_names, save_figures
    from ehlectric.motion.result import MotionResult
    from ehlectric.motion.run import run_motion
    from ehlectric.motion.stored_run import read_motion
    from ehlectric.quantities.result_warnings import ResultWarning
    from ehlectric.quantities.verdict import Verdict
    from ehlectric.report.written_report import write_report
    from ehlectric.runs.example_files import example
    from ehlectric.runs.exports import export
    from ehlectric.runs.lookups import bearings, check, film, formulas, oils, surface
    from ehlectric.runs.measured_film_factors import film_factors
    from ehlectric.runs.solve import Solved, load, save, solve, solve_many, solve_motion
    from ehlectric.sweep import Sweep, SweepResults, evaluate, read_sweep, run_sweep

# In the order of their use, in which the pages of the API list them.
__all__ = [  # noqa: RUF022
    "solve",
    "solve_many",
    "solve_bearing",
    "solve_drive",
    "solve_motion",
    "evaluate",
    "film_factors",
    "Case",
    "LineCase",
    "PointCase",
    "BearingCase",
    "DriveCase",
    "check",
    "film",
    "formulas",
    "surface",
    "oil",
    "oils",
    "bearings",
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
    "solve_many": "runs.solve",
    "solve_bearing": "bearing.result",
    "solve_motion": "runs.solve",
    "evaluate": "sweep.evaluation",
    "film_factors": "runs.measured_film_factors",
    "Case": "cases.case",
    "LineCase": "cases.case",
    "PointCase": "cases.case",
    "BearingCase": "cases.bearing_case",
    "check": "runs.lookups",
    "film": "runs.lookups",
    "formulas": "runs.lookups",
    "surface": "runs.lookups",
    "oil": "cases.case_oil",
    "oils": "runs.lookups",
    "bearings": "runs.lookups",
    "example": "runs.example_files",
    "Sweep": "sweep.sweep_inputs",
    "run_sweep": "sweep.run",
    "run_motion": "motion.run",
    "read_sweep": "sweep.store",
    "read_motion": "motion.stored_run",
    "load": "runs.solve",
    "save": "runs.solve",
    "figure": "figures.result_figures",
    "figure_names": "figures.result_figures",
    "save_figures": "figures.result_figures",
    "write_report": "report.written_report",
    "export": "runs.exports",
    "write_drive_netlist": "drive.drive_netlist_files",
    "write_netlist": "drive.netlist_files",
    "Result": "contact.result",
    "PointResult": "contact.result",
    "BearingResult": "bearing.result",
    "DriveResult": "drive.result",
    "solve_drive": "drive.result",
    "DriveCase": "cases.drive_case",
    "MotionResult": "motion.result",
    "SweepResults": "sweep.result",
    "Laws": "lubricant.python_laws",
    "FilmFactors": "cases.film_factors",
    "Solved": "runs.solve",
    "Verdict": "quantities.verdict",
    "ResultWarning": "quantities.result_warnings",
    "InputError": "errors",
    "ConvergenceError": "errors",
    "LostError": "errors",
}


class _Package(ModuleType):
    """Package whose functions have priority over its subpackages of the same names, such as ``film``.

    An import of a subpackage would otherwise replace the function.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in _HOMES or not isinstance(value, ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    home = _HOMES[name]
    if home.startswith(("figures.", "report.")):
        from ehlectric.runtime.values import import_matplotlib

        import_matplotlib()
    value = getattr(import_module(f"{__name__}.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
