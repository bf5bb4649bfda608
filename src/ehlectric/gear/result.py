"""Result of a gear pair, as ``solve_gear`` returns it."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ehlectric.cases.gear_case import GearCase
from ehlectric.gear.gear_verdict import breakdown_margin, gear_verdict
from ehlectric.gear.mesh_duty import MeshDuty, check_mesh_duty, run_mesh_duty
from ehlectric.gear.solution import GearSolution
from ehlectric.gear.solving import solve_gear_pair
from ehlectric.gear.stored import layout_of
from ehlectric.gear.summary import gear_summary, point_summaries
from ehlectric.gear.uncertainty import MeshUncertainty, Spread, has_chance
from ehlectric.gear.warnings import gear_warnings
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.results import POINT_KEYS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.runtime.display import ResultKind, Shown, headline, read_only_property
from ehlectric.runtime.files import plain
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

SCHEMA = "ehlectric.gear/1"


@dataclass(frozen=True, eq=False, repr=False)
class GearResult(Shown):
    """Result of a gear pair: films, capacitance and breakdown voltage of its mesh.

    Attributes
    ----------
    solution : GearSolution
        Geometry, loads and films on the lines of contact over a phase of the mesh.
    seconds : float
        Computing time [s].
    probable : bool
        Whether the verdict and the summary contain the probability of breakdown, which takes several seconds.
    version : str
        Version of ehlectric that solved it.
    stored_duty : MeshDuty, optional
        Result of the duty cycle that was stored with the solution.
    stored_spread : Spread, optional
        Distribution of the margin that was stored with the solution.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.GearCase.from_toml(ehlectric.example("gear_pair.toml"))
    >>> result = ehlectric.solve_gear(case)
    >>> result.margin > 0.0, result.summary()["mesh"]["state"]
    (True, 'insulates')
    """

    result_kind: ClassVar[ResultKind] = "gear"

    solution: GearSolution
    seconds: float = field(default=0.0, compare=False)
    version: str = __version__
    probable: bool = True
    stored_duty: MeshDuty | None = field(default=None, compare=False)
    stored_spread: Spread | None = field(default=None, compare=False)

    @property
    def case(self) -> GearCase:
        """Case of the gear pair."""
        return self.solution.case

    @read_only_property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about where the result is unreliable, each once."""
        return tuple(gear_warnings(self.solution))

    @read_only_property
    def verdict(self) -> Verdict:
        """Verdict: the state of the mesh, and whether its film breaks down at the voltage of the case."""
        pending = not self.probable and has_chance(self.case)
        verdict = gear_verdict(self.solution, self.uncertainty, pending=pending)
        cycle = None if self.duty is None else self.duty.statement
        return verdict if cycle is None else replace(verdict, reasons=(*verdict.reasons, cycle))

    @read_only_property
    def duty(self) -> MeshDuty | None:
        """Result of the duty cycle of the case, states of the mesh and margins over time; None without one.

        It is computed when it is first asked for, at about a millisecond for each operating point. Raises an
        InputError where the file of the cycle cannot be used.
        """
        if self.stored_duty is not None:
            return self.stored_duty
        return run_mesh_duty(self.case, probable=self.probable)

    @property
    def all_warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about the gear pair and its duty cycle, each once."""
        return (*self.warnings, *(() if self.duty is None else self.duty.warnings))

    @property
    def uncertainty(self) -> MeshUncertainty | None:
        """Distribution of the margin over the uncertainty of the inputs and the films, with its probability
        of breakdown; None without a voltage, a strength, or a mesh that insulates at some inputs.

        It evaluates 512 to 2048 gear pairs with films from the atlas when it is first asked for.
        """
        return None if self.spread is None else self.spread.points

    @read_only_property
    def spread(self) -> Spread | None:
        """Distribution of the margin, or the reason for which it has none; None without a probability."""
        if not self.probable:
            return None
        return Spread.of(self.solution) if self.stored_spread is None else self.stored_spread

    @property
    def margin(self) -> float | None:
        """Breakdown voltage over the voltage between both gears; None without one of them."""
        return breakdown_margin(self.solution)

    def summary(self) -> dict[str, Any]:
        """Return the results nested as in summary.json, SI units."""
        return {
            "schema": SCHEMA,
            "version": self.version,
            "title": self.case.title,
            **texts_and_codes(self.all_warnings),
            **self.verdict.as_data(),
            "inputs": self.case.to_dict(),
            **gear_summary(self.solution),
            **self._uncertainty(),
            **self._duty(),
            "seconds": self.seconds,
        }

    def _uncertainty(self) -> dict[str, Any]:
        """Table ``uncertainty`` of the summary; none of a result without probability."""
        return {} if self.uncertainty is None else {"uncertainty": self.uncertainty.summary()}

    def _duty(self) -> dict[str, Any]:
        """Table ``duty`` of the summary; none without a duty cycle."""
        return {} if self.duty is None else {"duty": plain(self.duty.summary())}

    def points(self) -> list[dict[str, Any]]:
        """Table of the points A, B, C, D and E of the path of contact, SI units."""
        rows = point_summaries(self.solution)
        return [{"point": name, **row} for name, row in rows.items()]

    def to_dataframe(self) -> pd.DataFrame:
        """Return the points A to E as a table of pandas; ``attrs["units"]`` contains the units."""
        import pandas as pd

        frame = pd.DataFrame(self.points())
        frame.attrs["units"] = {name: about.unit for name, about in POINT_KEYS.items()}
        return frame

    def over_phase(self) -> dict[str, np.ndarray]:
        """Return capacitance [F], breakdown voltage [V] and share of time with metallic contact over the
        phase of the mesh, each of shape (p,); the voltage is NaN without a dielectric strength.

        The phases contain the extremes of the breakdown voltage. A mean over the phase is the sum of the
        values times ``phase_weight``, which is 0 at phases between the phases of the solution.
        """
        solution = self.solution
        nodes, over_phase = solution.loads.phases, solution.breakdown_voltage_over_phase
        phases, voltage = (nodes, np.full_like(nodes, np.nan)) if over_phase is None else over_phase
        weights = np.zeros_like(phases)
        weights[np.searchsorted(phases, nodes)] = solution.loads.weights
        return {
            "phase": phases,
            "phase_weight": weights,
            "capacitance": np.interp(phases, nodes, solution.capacitance, period=1.0),
            "breakdown_voltage": voltage,
            "contact_time_share": np.interp(phases, nodes, solution.contact_time_share(), period=1.0),
        }

    def to_xarray(self) -> xr.Dataset:
        """Return the dataset of the result, as gear.nc contains it; SI units."""
        return layout_of(
            self.solution, self.seconds, self.version, spread=self.spread, duty=self.duty
        ).dataset()

    def key_numbers(self) -> tuple[str, ...]:
        """Return teeth, capacitance and lambda ratio as texts."""
        mesh = gear_summary(self.solution)["mesh"]
        return (
            "/".join(map(str, self.case.gear.teeth)) + " teeth",
            f"capacitance {readable(1e9 * mesh['capacitance'])} nF",
            f"lambda {readable(mesh['lambda_ratio'])}",
        )

    def _headline(self) -> str:
        return headline(self.case.title, *self.key_numbers(), verdict=gear_verdict(self.solution))


def solve_gear(case: GearCase, *, probable: bool = True) -> GearResult:
    """Solve a gear pair at its operating point.

    Parameters
    ----------
    case : GearCase
        Drawing, load, oil and dielectric strength.
    probable : bool, optional
        Whether the verdict and the summary contain the probability of breakdown, which takes several seconds.

    Returns
    -------
    GearResult
        Films on all lines of contact over a phase of the mesh, its capacitance and breakdown voltage.

    Raises
    ------
    InputError
        If the gears cannot run together, the oil has no value at the temperature of the flanks,
        or the file of a duty cycle cannot be used.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.GearCase.from_toml(ehlectric.example("gear_pair.toml"))
    >>> mesh = ehlectric.solve_gear(case).summary()["mesh"]
    >>> round(mesh["margin"], 2)
    0.14
    """
    check_mesh_duty(case)
    start = time.perf_counter()
    solution = solve_gear_pair(case)
    return GearResult(solution, seconds=time.perf_counter() - start, probable=probable)
