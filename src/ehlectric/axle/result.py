"""Result of an axle, as ``solve_axle`` returns it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar

from ehlectric.axle.axle_discharges import AxleDischarges, simulate_axles
from ehlectric.axle.axle_duty import AxleDuty, check_axle_duty, run_axle_duty
from ehlectric.axle.axle_verdict import axle_verdict
from ehlectric.axle.solution import AxleSolution, elements_of, solve_films
from ehlectric.axle.stored import layout_of
from ehlectric.axle.summary import axle_summary, tables_of_point
from ehlectric.axle.uncertainty import AxleUncertainty, has_chance, uncertainty_of
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.drive_case import within_remedy
from ehlectric.cases.library.estimated_bearings import is_estimated
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.results import AXLE_ELEMENT_KEYS
from ehlectric.quantities.unused_keys import given_keys, unused_note
from ehlectric.quantities.verdict import Verdict
from ehlectric.runtime.display import ResultKind, Shown, headline, read_only_property
from ehlectric.runtime.netcdf import Layout
from ehlectric.runtime.progress import Progress, silent
from ehlectric.version import __version__

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

SCHEMA = "ehlectric.axle/1"

# Columns of the table of elements that are texts.
_TEXTS = ("element", "state")


@dataclass(frozen=True, eq=False, repr=False)
class AxleResult(Shown):
    """Result of an axle: loads, films and voltages of all of its bearings and meshes right after an edge.

    Attributes
    ----------
    solution : AxleSolution
        Elements with their loads, capacitances and breakdown voltages, and their network.
    remedies : tuple of AxleSolution
        Solutions with the remedies of the case, in their order.
    seconds : float
        Computing time [s].
    version : str
        Version of ehlectric that solved it.
    probable : bool
        Whether the verdict and the summary contain the probabilities of all elements, which take several
        seconds.
    stored_duty : AxleDuty, optional
        Result of the duty cycle that was stored with the solution.
    simulated : tuple of AxleDischarges, optional
        Discharges over time of the solution and of each remedy; empty where they are not simulated yet.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.AxleCase.from_toml(ehlectric.example("e_axle.toml")).replace(remedies=[])
    >>> result = ehlectric.solve_axle(case)
    >>> result.solution.ranking()[0][0], result.solution.breakdown_voltages.keys() >= {"bearing 1 of rotor"}
    ('mesh of rotor and intermediate', True)
    """

    result_kind: ClassVar[ResultKind] = "axle"

    solution: AxleSolution
    remedies: tuple[AxleSolution, ...] = ()
    seconds: float = field(default=0.0, compare=False)
    version: str = __version__
    probable: bool = True
    stored_duty: AxleDuty | None = field(default=None, compare=False)
    simulated: tuple[AxleDischarges | None, ...] = field(default=(), compare=False)

    @property
    def case(self) -> AxleCase:
        """Case of the axle."""
        return self.solution.case

    @property
    def converged(self) -> bool:
        """Whether the films of all bearings and meshes are converged."""
        return self.solution.converged

    @property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about where the result is unreliable, each with the name of its bearing or mesh, and notes
        about given keys that it does not use.
        """
        return (*self.solution.warnings, *unused_keys(self.case))

    @property
    def warnings_of_remedies(self) -> tuple[ResultWarning, ...]:
        """Warnings of remedies with codes that the axle itself lacks, each with the title of its remedy."""
        codes = {warning.code for warning in self.solution.warnings}
        return tuple(
            replace(warning, text=f"{remedy.title}: {warning.text}")
            for (_, remedy), solution in zip(self.case.numbered_remedies, self.remedies, strict=False)
            for warning in solution.warnings
            if warning.code not in codes
        )

    @property
    def all_warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about the axle and its duty cycle."""
        return (*self.warnings, *(() if self.duty is None else self.duty.warnings))

    @read_only_property
    def duty(self) -> AxleDuty | None:
        """Result of the duty cycle of the case; None without one.

        It is computed when it is first asked for, at some milliseconds for each operating point. Raises an
        InputError where the file of the cycle cannot be used.
        """
        return run_axle_duty(self.case) if self.stored_duty is None else self.stored_duty

    @read_only_property
    def discharges(self) -> AxleDischarges | None:
        """Discharges over the simulated time; None without ``drive.duration``, and in previews.

        They are simulated when they are first asked for. Raises InputError if an element lacks a value that
        discharges need.
        """
        return self._all_discharges[0] if self._all_discharges else None

    @property
    def remedied_discharges(self) -> tuple[AxleDischarges | None, ...]:
        """Discharges over the simulated time with each remedy, from random numbers of the same seed; empty as
        ``discharges`` is None.
        """
        return self._all_discharges[1:]

    @read_only_property
    def _all_discharges(self) -> tuple[AxleDischarges | None, ...]:
        """Discharges of the axle and with each remedy."""
        if self.case.drive.duration is None or not self.probable:
            return ()
        return self.simulated or simulate_axles((self.solution, *self.remedies))

    @read_only_property
    def verdict(self) -> Verdict:
        """Verdict: the element that breaks down first, and when another one is first."""
        pending = not self.probable and has_chance(self.case)
        verdict = axle_verdict(self.solution, self.uncertainty, pending=pending)
        cycle = None if self.duty is None else self.duty.statement
        return verdict if cycle is None else replace(verdict, reasons=(*verdict.reasons, cycle))

    @property
    def uncertainty(self) -> AxleUncertainty | None:
        """Probabilities of all elements, and the margin of the first one, within the uncertain inputs and
        films; None without a strength.

        It evaluates 512 to 2048 axles with films from the atlas when it is first asked for.
        """
        return self._uncertainty_or_reason[0]

    @read_only_property
    def _uncertainty_or_reason(self) -> tuple[AxleUncertainty | None, str]:
        """Distribution of the margin, or the reason for which it could not be computed."""
        if not (self.probable and has_chance(self.case)):
            return None, ""
        try:
            return uncertainty_of(self.solution), ""
        except InputError as error:
            return None, str(error)

    def summary(self) -> dict[str, Any]:
        """Return the results nested as in summary.json, SI units."""
        return {
            "schema": SCHEMA,
            "converged": self.converged,
            **self._heads(self.all_warnings),
            **axle_summary(self.solution),
            **({} if self.uncertainty is None else {"uncertainty": self.uncertainty.summary()}),
            **({} if self.duty is None else {"duty": self.duty.summary()}),
            **({} if self.discharges is None else {"simulation": self.discharges.summary()}),
            "remedies": [*self._remedies()],
            "seconds": self.seconds,
        }

    def _remedies(self) -> Iterator[dict[str, Any]]:
        """Tables ``remedies`` of the summary."""
        in_time = self.remedied_discharges or (None,) * len(self.remedies)
        titles = [remedy.title for _, remedy in self.case.numbered_remedies]
        for title, solution, discharges in zip(titles, self.remedies, in_time, strict=False):
            simulation = {} if discharges is None else {"simulation": discharges.summary()}
            yield {
                "title": title,
                **texts_and_codes(solution.warnings),
                **axle_summary(solution),
                **simulation,
            }

    def _heads(self, warnings: Sequence[ResultWarning]) -> dict[str, Any]:
        """Title, warnings, verdict and inputs of a summary."""
        return {
            "version": self.version,
            "title": self.case.title,
            **texts_and_codes(warnings),
            **self.verdict.as_data(),
            "inputs": self.case.to_dict(),
        }

    def point_summary(self) -> dict[str, Any]:
        """Return the results of a point of a sweep, SI units: elements and shafts by their keys.

        Notes about keys without an effect are omitted, as a varied key differs from the value of a gear file.
        """
        heads = self._heads(self.solution.warnings)
        return {"schema": SCHEMA, **heads, **tables_of_point(self.solution), "seconds": self.seconds}

    def layout(self) -> Layout:
        """Return variables and attributes of axle.nc."""
        solutions = (self.solution, *self.remedies)
        return layout_of(
            solutions,
            self.seconds,
            self.version,
            probable=self.probable,
            duty=self.duty,
            discharges=self._all_discharges,
        )

    def to_xarray(self) -> xr.Dataset:
        """Return the dataset of the result, as axle.nc contains it; SI units."""
        return self.layout().dataset()

    def to_dataframe(self) -> pd.DataFrame:
        """Return all bearings and meshes as a table of pandas; ``attrs["units"]`` contains the units."""
        import pandas as pd

        frame = pd.DataFrame(axle_summary(self.solution)["elements"])
        frame.attrs["units"] = {
            name: about.unit for name, about in AXLE_ELEMENT_KEYS.items() if name not in _TEXTS
        }
        return frame

    def key_numbers(self) -> tuple[str, ...]:
        """Return the number of elements and the first of them as texts."""
        count = f"{len(self.solution.elements)} bearings and meshes"
        if not self.converged:
            return count, "NOT CONVERGED"
        ranking = self.solution.discharging()
        return (count, f"{ranking[0][0]} discharges first") if ranking else (count,)

    def _headline(self) -> str:
        return headline(self.case.title, *self.key_numbers(), verdict=axle_verdict(self.solution))


# Keys that the result of an axle does not use: of all bearings, of the drive file, and of the files of gears.
_NOT_OF_BEARINGS = ("summits.radius", "coating.breakdown_voltage", "coating.strength")
_NOT_OF_AXLES = tuple(f"discharge.{key}" for key in ("external_capacitance", "peak_current", "pit"))
# Keys that act behind an inductance: of the winding, and of frame and earth.
_BEHIND_INDUCTANCES = (
    *(
        f"circuit.{key}"
        for key in ("winding_frame_capacitance", "frame_earth_capacitance", "cable_capacitance")
    ),
    *(f"circuit.machine.liner_{key}" for key in ("width", "thickness", "permittivity")),
)
_NOT_OF_PAIRS = (
    *("gear.contact.voltage", "gear.contact.weibull_shape", "gear.operation.boundary_friction"),
    *("ranges", "duty", "measured"),
)


def _unused_of_axle(case: AxleCase) -> Iterator[ResultWarning]:
    """Notes about keys of the drive, the circuit and the discharges that the result does not use."""
    inductive, ground = case.circuit.inductive, case.circuit.ground_inductance
    unused = {
        "axle": _NOT_OF_AXLES,
        "inductance": () if inductive else _BEHIND_INDUCTANCES,
        "ground": ("circuit.frame_earth_capacitance",) if inductive and ground is None else (),
        "mass": () if any(shaft.mass for shaft in case.shaft) else ("drive.gravity_direction",),
    }
    for situation, listed in unused.items():
        if keys := given_keys(case, listed):
            yield unused_note(situation, keys)


def unused_keys(case: AxleCase) -> Iterator[ResultWarning]:
    """Yield notes about given keys that the result of an axle does not use."""
    yield from _unused_of_axle(case)
    for name, bearing in zip(case.names_of_bearings(), case.tables_of_bearings, strict=True):
        if bearing.life is not None:
            # Load ratings also determine the geometry of a bearing that the library lacks.
            used = ("dynamic_rating", "static_rating") if is_estimated(bearing.base) else ()
            given = given_keys(bearing.life, [*type(bearing.life).model_fields])
            if unused := [f"life.{key}" for key in given if key not in used]:
                yield unused_note("life", unused, name)
        if unused := given_keys(bearing, _NOT_OF_BEARINGS):
            yield unused_note("axle", unused, name)
    for name, mesh in zip(case.names_of_meshes(), case.mesh, strict=True):
        pair, contacts = mesh.pair, case.drive.contacts
        replaced = {
            "lubricant": pair.lubricant != case.lubricant,
            "discharge": given_keys(pair.discharge, [*Discharge.model_fields])
            and dict(pair.discharge) != dict(case.discharge),
            "contacts": contacts not in (None, pair.contacts) and given_keys(pair, ["contacts"]),
        }
        if any(replaced.values()):
            yield unused_note("pair", [key for key, differs in replaced.items() if differs], name)
        if unused := given_keys(pair, _NOT_OF_PAIRS):
            yield unused_note("pair_alone", unused, name)


def solve_axle(
    case: AxleCase, *, progress: Progress = silent, remedies: bool = True, probable: bool = True
) -> AxleResult:
    """Solve the films of all bearings and meshes of an axle, and the voltages right after an edge.

    Parameters
    ----------
    case : AxleCase
        Shafts, bearings, meshes and links, with inverter, machine and oil.
    progress : callable, optional
        Called with the number of solved bearings and meshes, the number of all, and a text.
    remedies : bool, optional
        Whether to solve also the axle with each of its remedies.
    probable : bool, optional
        Whether the verdict and the summary contain the probabilities of all elements, which take several
        seconds.

    Returns
    -------
    AxleResult
        Result with its summary and its verdict.

    Raises
    ------
    InputError
        If a bearing cannot carry its load, gears cannot run together, the oil has no value at its
        temperature, or the file of a duty cycle cannot be used.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.AxleCase.from_toml(ehlectric.example("e_axle.toml")).replace(remedies=[])
    >>> solution = ehlectric.solve_axle(case).solution
    >>> {shaft: round(voltage, 1) for shaft, voltage in solution.potentials().items()}
    {'rotor': 13.6, 'intermediate': 2.7, 'output': 2.7}
    """
    check_axle_duty(case)
    start = time.perf_counter()
    variants = case.variants()
    every = [solve_films(case, progress)]
    for (number, _), variant in zip(case.numbered_remedies, variants if remedies else (), strict=False):
        with within_remedy(number):
            every.append(solve_films(variant, progress))
    solution, *changed = map(elements_of, every)
    timed = probable and case.drive.duration is not None
    simulated = simulate_axles((solution, *changed), every, progress) if timed else ()
    seconds = time.perf_counter() - start
    return AxleResult(solution, tuple(changed), seconds=seconds, probable=probable, simulated=simulated)
