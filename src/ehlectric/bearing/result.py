"""Solution of a whole rolling bearing by `solve_bearing`, and its result."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, ClassVar

from ehlectric.bearing.bearing_discharges import shaft_voltage
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.duty_cycle import DutyResult, check_duty, run_duty
from ehlectric.bearing.margin import MarginAnalysis, QuickMargins, analyse_margin
from ehlectric.bearing.preparation import largest_load, prepare_bearing
from ehlectric.bearing.quick_contacts import heat_by_formula
from ehlectric.bearing.ring_contacts import check_contact
from ehlectric.bearing.solution import BearingSolution, capacitance, capacitance_is_bound
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.speed_curves import capacitive_speed
from ehlectric.bearing.stored import dataset_of
from ehlectric.bearing.summary import breaks, contact_rows, summary_of
from ehlectric.bearing.uncertainty import (
    MarginBand,
    Uncertainty,
    margin_band,
    uncertainty_of_result,
    without_spread,
)
from ehlectric.bearing.verdict_rule import bearing_verdict
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.discharge.discharge_laws import known
from ehlectric.errors import InputError, shown
from ehlectric.quantities.formats import amount, speed_text
from ehlectric.quantities.former_keys import warning_tables, with_former_keys
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.results import BEARING_KEYS, ELEMENT_KEYS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.runtime.display import ResultKind, Shown, headline, is_number, read_only_property
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


# Columns of the table of contacts that are no numbers with a unit.
_LABELS = ("element", "ring", "lubrication_state", "regime", "solved")


@dataclass(frozen=True, eq=False, repr=False)
class BearingResult(Shown):
    """Result of a bearing: its solution, and the summary, contacts and warnings from it.

    Attributes
    ----------
    solution : BearingSolution
        Loads, films, fields and circuits.
    stored_duty : DutyResult, optional
        Result of the duty cycle that was stored with the solution.

    Examples
    --------
    >>> from ehlectric import BearingCase, solve_bearing
    >>> case = BearingCase.from_dict(
    ...     {
    ...         "contacts": "formula",
    ...         "bearing": {
    ...             "base": "6208", "radial_clearance": "10 um", "radial_load": "1 kN",
    ...             "inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.03 um",
    ...         },
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...         "discharge": {"dielectric_strength": "15 V/um"},
    ...     }
    ... )
    >>> result = solve_bearing(case, workers=1)
    >>> result.converged, result.breaks()["first_break_at"]
    (True, 'inner contact of element 0')
    """

    result_kind: ClassVar[ResultKind] = "bearing"

    solution: BearingSolution
    stored_duty: DutyResult | None = field(default=None, compare=False)

    @property
    def case(self) -> BearingCase:
        """Case of the bearing that was solved."""
        return self.solution.case

    @property
    def converged(self) -> bool:
        """Whether the films of all contacts are converged."""
        return self.solution.converged

    @property
    def shaft_voltage(self) -> float | None:
        """Shaft voltage by the capacitive divider of the motor [V].

        None without a motor, where surfaces conduct, and for ceramic elements without a given capacitance.
        """
        return known(float, shaft_voltage(self.solution))

    def capacitance(self, fill: float | str | None = None) -> float:
        """Return the capacitance from ring to ring with smooth films, mean over cage positions.

        Parameters
        ----------
        fill : str or float, optional
            "oil" or "air" around the films, or the part of the area filled with oil, from 0 to 1; by default
            ``bearing.fill`` of the case.

        Returns
        -------
        float
            Capacitance [F]; of ceramic elements the capacitance of the elements, or an upper bound.

        Raises
        ------
        InputError
            If ``fill`` is none of these.
        """
        part = is_number(fill) and 0.0 <= fill <= 1.0
        if fill not in (None, "oil", "air") and not part:
            takes = "'oil', 'air', a part from 0 to 1, or None for the fill of the case"
            raise InputError("fill", got=shown(fill), takes=takes)
        return float(capacitance(self.solution, fill))

    def breaks(self) -> dict[str, Any]:
        """Return breakdown voltages over cage positions [V], and their ratios to the shaft voltage.

        Values are None where there is no breakdown voltage or no shaft voltage.
        """
        return breaks(self.solution)

    @property
    def margin(self) -> float | None:
        """Margin: shaft voltage of the first breakdown over the shaft voltage, dimensionless.

        Below 1 breakdown is expected. None without a shaft voltage or without a breakdown voltage, as
        without ``[motor]`` or a dielectric strength. Its range and its critical speed are given by
        ``margin_analysis``.
        """
        margin: float | None = self.breaks()["margin"]
        return margin

    @read_only_property
    def warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about where the result is unreliable, each once."""
        return tuple(bearing_warnings(self.solution))

    def contacts(self) -> list[dict[str, Any]]:
        """Table of contacts, a row per element and ring, with the cage at its first position, SI units.

        ``breakdown_voltage`` is a voltage on the contact itself; ``bearing_breakdown_voltage`` is the bearing
        voltage at which it breaks down, to be compared with the shaft voltage. ``strength_per_volt`` and
        ``max_strength`` refer to the bearing voltage.
        """
        return contact_rows(self.solution)

    @read_only_property
    def margin_analysis(self) -> MarginAnalysis:
        """Critical speed, effects of the inputs on the margin, and its range from ``ranges``.

        It solves about thirty bearings with contacts from the atlas when it is first asked for: half a
        second, compared with a minute for a bearing with solved contacts.
        """
        return analyse_margin(self.solution)

    @property
    def uncertainty(self) -> Uncertainty | None:
        """Distribution of the margin over the uncertainty of the inputs and the films, with its probability
        of breakdown; None where there is no margin, or none at any other inputs, as ``summary`` then reports.

        It evaluates 512 to 2048 bearings with contacts from the atlas when it is first asked for, until their
        number cannot change the level of the verdict.
        """
        return self._uncertainty_or_reason[0]

    @read_only_property
    def _uncertainty_or_reason(self) -> tuple[Uncertainty | None, str]:
        """Distribution of the margin, or the reason for which it could not be computed."""
        try:
            return uncertainty_of_result(self.solution), ""
        except InputError as error:
            return None, str(error)

    @property
    def all_warnings(self) -> tuple[ResultWarning, ...]:
        """Warnings about the bearing, its breakdown probability and its duty cycle, each once.

        It computes the probability and the duty cycle when it is first asked for.
        """
        uncertain = () if self.uncertainty is None else self.uncertainty.warnings
        of_cycle = () if self.duty is None else self.duty.warnings
        return (*self.warnings, *uncertain, *of_cycle)

    @read_only_property
    def margin_band(self) -> MarginBand | None:
        """Margin over the speed within the uncertain inputs; None where it is known at no speed.

        It evaluates 1536 bearings with contacts from the atlas when it is first asked for: about two seconds.
        """
        if self.uncertainty is None or self.margin is None:
            return None
        band = margin_band(self.solution, QuickMargins.of(self.solution))
        return band if band.speed.size else None

    @read_only_property
    def verdict(self) -> Verdict:
        """Verdict: whether breakdown is expected at the shaft voltage, and where the margin is below 1."""
        uncertainty, why = self._uncertainty_or_reason
        chance = None if uncertainty is None else uncertainty.chance
        verdict = bearing_verdict(
            self.solution, self.margin_analysis, chance, unknown=why, warnings=self.warnings
        )
        cycle = None if self.duty is None else self.duty.statement
        return verdict if cycle is None else replace(verdict, reasons=(*verdict.reasons, cycle))

    @read_only_property
    def capacitive_speed(self) -> float | None:
        """Speed of the inner ring from which the bearing is capacitive at its temperature [rad/s].

        None where it is so at all speeds that are looked at, or at none, and for insulated bearings. It
        solves some bearings with contacts from the atlas when it is first asked for.
        """
        return capacitive_speed(self.solution)

    @read_only_property
    def duty(self) -> DutyResult | None:
        """Result of the duty cycle of the case, lubrication and margins over time; None without one.

        It is computed when it is first asked for, at a millisecond for each operating point. Raises an
        InputError where the file of the cycle cannot be used.
        """
        return run_duty(self.case) if self.stored_duty is None else self.stored_duty

    def summary(self, *, probable: bool = True) -> dict[str, Any]:
        """Return the results nested as in summary.json, SI units; None instead of NaN.

        Without ``probable`` the table ``uncertainty`` is None and the verdict does not follow the
        probability of breakdown, which saves a second or two.
        """
        analysis, uncertainty = self.margin_analysis, self.uncertainty if probable else None
        verdict = (
            self.verdict if probable else bearing_verdict(self.solution, analysis, warnings=self.warnings)
        )
        summary: dict[str, Any] = {}

        def table_of(name: str, values: Mapping[str, Any]) -> Any:
            return plain(with_former_keys(values, name, BEARING_KEYS))

        for key, value in summary_of(self.solution, self.warnings).items():
            if key == "mechanics":
                speed = {"capacitive_speed": self.capacitive_speed}
                table = analysis.summary()
                if probable and self._uncertainty_or_reason[1]:
                    table["left_out"].append(without_spread(self._uncertainty_or_reason[1]))
                summary["margin"] = table_of("margin", {"level": verdict.level, **table, **speed})
                spread = None if uncertainty is None else table_of("uncertainty", uncertainty.summary())
                summary["uncertainty"] = spread
            summary[key] = value
            if key == "warning_codes":
                summary |= verdict.as_data()
            if key == "mechanics" and self.duty is not None:
                summary["duty"] = table_of("duty", self.duty.summary())
        if probable:
            summary |= texts_and_codes(self.all_warnings)
        elif self.duty is not None:
            summary |= texts_and_codes((*self.warnings, *self.duty.warnings))
        return warning_tables(summary, BEARING_KEYS)

    def to_xarray(self) -> xr.Dataset:
        """Return loads, films, capacitances and voltages over cage positions, rings and elements.

        Returns
        -------
        xarray.Dataset
            Variables in SI units, the same as bearing.nc; the case is an attribute, as TOML.
        """
        return dataset_of(self.solution, self.duty)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the contacts as a table of pandas, a row per element and ring, cage at its first position.

        Returns
        -------
        pandas.DataFrame
            Columns as in contacts.csv, SI units, angles in radians; NaN where a contact has no value.
            ``attrs["units"]`` has the unit of each column of numbers, ``attrs["descriptions"]`` the meaning
            of each column. ``breakdown_voltage`` is a voltage on the contact itself,
            ``bearing_breakdown_voltage`` the bearing voltage at which it breaks down.
        """
        import pandas as pd

        frame = pd.DataFrame(self.contacts())
        units = contact_units()
        numbers = [name for name in frame if name in units]
        frame[numbers] = frame[numbers].astype(float)
        frame.attrs["units"] = {str(name): units[str(name)] for name in numbers}
        frame.attrs["descriptions"] = {str(name): ELEMENT_KEYS[str(name)].meaning for name in frame}
        return frame

    def key_numbers(self) -> tuple[str | None, ...]:
        """Return designation, speed, capacitance, voltages and state as texts."""
        voltage, shaft = self.breaks()["first_break"], self.shaft_voltage
        capacitance = amount(self.capacitance(), "F")
        if capacitance_is_bound(self.solution):
            capacitance = BEARING_KEYS["bearing.capacitance"].with_sign(capacitance)
        breaks = None if voltage is None else f"{readable(voltage, 4)} V"
        if breaks and (self.case.bearing.bounding or "partial-film" in {at.code for at in self.warnings}):
            breaks = BEARING_KEYS["bearing.first_break"].with_sign(breaks)
        return (
            self.case.bearing.name or self.case.bearing.kind,
            speed_text(self.case.bearing.inner_speed, 4),
            f"capacitance {capacitance}",
            None if breaks is None else f"first breakdown {breaks}",
            None if shaft is None else f"shaft voltage {readable(shaft, 4)} V",
            "converged" if self.converged else "NOT CONVERGED",
        )

    def _headline(self) -> str:
        """Title, speed, capacitance, first breakdown voltage and shaft voltage on one line, with bounds.

        The verdict is omitted: it takes seconds, and a line must not depend on what was asked before.
        """
        return headline(self.case.title, *self.key_numbers())


def contact_units() -> dict[str, str]:
    """Return the SI unit of each numeric column in the contact table; empty for a dimensionless one."""
    return {name: quantity.unit for name, quantity in ELEMENT_KEYS.items() if name not in _LABELS}


def solve_bearing(
    case: BearingCase,
    *,
    progress: Progress | None = None,
    workers: int | None = None,
) -> BearingResult:
    """Solve a whole rolling bearing: loads, films, fields and the electrical circuit.

    Contacts with each ring are solved at five loads, contacts of rollers at ten, and at the loads of light
    elements; the contacts of all elements are interpolated between them.

    Parameters
    ----------
    case : BearingCase
        Bearing file.
    progress : callable, optional
        Called with the number of solved contacts, the number of all contacts, and a text.
    workers : int, optional
        Number of processes; the number of cores if not given.

    Returns
    -------
    BearingResult
        Result with its summary, its tables and its warnings.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or a contact cannot be solved.
    LostError
        Where the process of a contact was killed four times, as by a system out of memory.
    ConvergenceError
        Where the film that ``film_factor`` "solved" needs does not converge.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> result = ehlectric.solve_bearing(case.replace(contacts="atlas"))
    >>> round(1e12 * result.summary()["bearing"]["capacitance"]), result.converged
    (234, True)
    """
    return BearingResult(solution_of(case, progress=progress, workers=workers))


def check_bearing(case: BearingCase) -> None:
    """Refuse a bearing that cannot be solved, before a folder is made for its results. Raises InputError as
    ``solve_bearing`` does, for the most loaded contacts at the first position of the cage, and where the file
    of a duty cycle cannot be used.
    """
    check_duty(case)
    prepared = prepare_bearing(heat_by_formula(case), 1)
    # The outer ring comes first, as when the contacts are solved, so that both give one reason.
    for ring in reversed(prepared.rings):
        contact = kind_of(ring).contact(ring, largest_load(prepared, ring))
        check_contact(contact, contact.grid)
