"""What a solved bearing says: its totals, its voltages, and a row for every contact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.bearing.circuit import Circuit, bearing_voltage_ratio, series
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.totals import mechanics_of
from ehlectric.bearing.solver import BearingSolution
from ehlectric.bearing.warnings import clearance_warnings, contact_warnings, edge_warnings
from ehlectric.discharge.laws import relaxation_time
from ehlectric.errors import ResultWarning
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored_warnings import texts_and_codes
from ehlectric.version import __version__

SCHEMA = "ehlectric.bearing/1"

# Lambda ratios below which surfaces touch, and below which they do now and then.
CONDUCTING, PARTIAL = 1.0, 3.0

# Below it the viscosity from 40 and 100 degC is a bold extrapolation [K].
_COLD = 273.15


@dataclass(frozen=True)
class BearingResult:
    """A solved bearing with what follows from it.

    Attributes
    ----------
    solution : BearingSolution
        Loads, films, fields and circuits.
    """

    solution: BearingSolution

    @property
    def converged(self) -> bool:
        """Whether all contacts were solved."""
        curves = (self.solution.inner_curve, self.solution.outer_curve)
        return all(contact.converged for curve in curves for contact in curve.solutions)

    @property
    def ceramic(self) -> bool:
        """Whether the elements do not conduct: no film has all of a voltage, and nothing breaks down."""
        return not self.solution.duty.element.conducting

    def circuits(self, fill: str) -> list[Circuit]:
        """The circuit at each position, with oil or air around the films."""
        return [position.circuit(fill) for position in self.solution.positions]

    def capacitance(self, fill: str) -> float:
        """Mean over the positions [F]; of ceramic elements what the file gives, or an upper bound."""
        bearing = self.solution.case.bearing
        if bearing.element_capacitance is not None:
            return bearing.elements * bearing.element_capacitance
        return float(np.mean([circuit.capacitance for circuit in self.circuits(fill)]))

    @cached_property
    def lambda_ratio(self) -> float:
        """Least film of the loaded contacts over the roughness of both surfaces."""
        rq = self.solution.case.bearing.composite_rq
        films = [
            np.min(race.minimum_thickness[race.solved])
            for position in self.solution.positions
            for race in (position.inner, position.outer)
        ]
        return float(min(films)) / rq

    @property
    def lubrication(self) -> str:
        """By the lambda ratio: "conducting" below 1, "partial film" up to 3, "full film" above.

        Ceramic elements do not conduct where they touch: "touching" below 1.
        """
        if self.lambda_ratio < CONDUCTING:
            return "touching" if self.ceramic else "conducting"
        return "partial film" if self.lambda_ratio < PARTIAL else "full film"

    @property
    def insulating(self) -> bool:
        """Whether there are voltages on films: elements conduct, and surfaces do not touch."""
        return not self.ceramic and self.lubrication != "conducting"

    @property
    def bounded(self) -> bool:
        """Whether no more than an upper bound of the capacitance is known: of ceramic elements."""
        return self.ceramic and self.solution.case.bearing.element_capacitance is None

    @property
    def bearing_voltage_ratio(self) -> float | None:
        """Part of the common-mode voltage on the bearing.

        None without a motor, where surfaces touch and conduct, and of a capacitance that is a bound.
        """
        motor = self.solution.case.motor
        if motor is None or self.lubrication == "conducting" or self.bounded:
            return None
        own = self.capacitance(self.solution.case.bearing.fill)
        second = motor.second_bearing_capacitance
        return bearing_voltage_ratio(
            motor.winding_rotor_capacitance,
            motor.rotor_frame_capacitance,
            own,
            own if second is None else second,
        )

    @property
    def shaft_voltage(self) -> float | None:
        """Of the capacitive divider [V]; None where there is no ``bearing_voltage_ratio``."""
        motor, ratio = self.solution.case.motor, self.bearing_voltage_ratio
        return None if motor is None or ratio is None else ratio * motor.common_mode_voltage

    def breaks(self) -> dict[str, Any]:
        """Voltages of breakdown over the positions [V], None where there are none."""
        fill = self.solution.case.bearing.fill
        circuits = self.circuits(fill)
        first = np.array([circuit.first_break for circuit in circuits])
        through = np.array([circuit.through_breakdown for circuit in circuits])
        none = not self.insulating or not np.all(np.isfinite(through))
        least = int(np.argmin(first))
        shaft = self.shaft_voltage
        found = {
            "first_break": float(np.min(first)),
            "first_break_mean": float(np.mean(first)),
            "first_break_at": _weakest(circuits[least]),
            "through_breakdown": float(np.min(through)),
            "through_breakdown_mean": float(np.mean(through)),
            "margin": None if shaft is None else float(np.min(first)) / shaft,
            "through_margin": None if shaft is None else float(np.min(through)) / shaft,
        }
        return dict.fromkeys(found) if none else found

    @cached_property
    def strength_per_volt(self) -> float | None:
        """Largest field strength in the bearing over its voltage, over the positions [1/m].

        None of ceramic elements, and where surfaces touch.
        """
        if not self.insulating:
            return None
        fill = self.solution.case.bearing.fill
        return max(
            float(np.max(share * race.strength_per_volt))
            for position in self.solution.positions
            for inner_share in (position.circuit(fill).inner_share,)
            for share, race in ((inner_share, position.inner), (1.0 - inner_share, position.outer))
        )

    def plate(self) -> float | None:
        """Capacitance by plates of the Hertz areas, h(0) apart, mean over the positions [F].

        None of ceramic elements, which are no plate.
        """
        if self.ceramic:
            return None
        totals = []
        for position in self.solution.positions:
            inner, outer = position.inner.plate, position.outer.plate
            loaded = (inner > 0.0) & (outer > 0.0)
            totals.append(float(np.sum(series(inner[loaded], outer[loaded]))))
        return float(np.mean(totals))

    def warnings(self) -> list[ResultWarning]:
        """Warnings of films, voltages and contacts, each once."""
        return list(dict.fromkeys([*self._of_films(), *self._of_voltages(), *self._of_contacts()]))

    def _of_films(self) -> Iterator[ResultWarning]:
        """Warnings of the films of the whole bearing."""
        solution = self.solution
        if solution.case.contacts == "formula":
            text = "contacts by formula: films may be 30 % off, and fields are voltages over the minimum film"
            yield ResultWarning("formula-contacts", text)
        if solution.duty.film_factor == 1.0:
            given = solution.case.bearing.film_factor
            name = given if isinstance(given, str) else f"{given:g}"
            text = f"film_factor {name}: the film is isothermal and fully flooded, voltages are upper bounds"
            yield ResultWarning("isothermal-film", text)
        if solution.case.lubricant.temperature is None:
            text = "lubricant.viscosity is given: bearing.temperature has no part in the films"
            yield ResultWarning("temperature-unused", text)
        elif solution.case.bearing.temperature < _COLD:
            cold = solution.case.bearing.temperature - 273.15
            text = f"bearing.temperature is {cold:.3g} °C: the viscosity from 40 and 100 °C may be far off"
            yield ResultWarning("temperature-low", text)
        first = solution.positions[0]
        yield from clearance_warnings(solution.duty, first.equilibrium, first.inner, first.outer)

    def _of_voltages(self) -> Iterator[ResultWarning]:
        """Warnings of capacitance and voltages."""
        touching = f"lambda is {self.lambda_ratio:.2g}: surfaces"
        if self.lubrication == "conducting":
            text = f"{touching} touch and conduct, nothing breaks down, and no shaft voltage is stated"
            yield ResultWarning("touching", text)
        elif self.lubrication == "touching":
            yield ResultWarning("touching", f"{touching} touch, and the elements insulate")
        elif self.lubrication == "partial film":
            text = f"{touching} may touch" + ("" if self.ceramic else ", voltages are upper bounds")
            yield ResultWarning("partial-film", text)
        if self.bounded:
            yield ResultWarning(
                "capacitance-bound",
                "the elements are ceramic: the capacitance is an upper bound, that of conducting ones, and "
                "no shaft voltage follows from it; bearing.element_capacitance gives one",
            )
        if self.solution.case.discharge.weibull is not None and self.insulating:
            text = "first break and through breakdown are voltages at a probability of 63.2 % (Weibull)"
            yield ResultWarning("weibull-voltage", text)

    def _of_contacts(self) -> Iterator[ResultWarning]:
        """Warnings of single contacts, and of those at the edge of their groove."""
        solution = self.solution
        states = [(position.equilibrium, position.inner, position.outer) for position in solution.positions]
        yield from edge_warnings(solution.case.bearing, states)
        yield from contact_warnings(
            {"inner": solution.inner_curve.solutions, "outer": solution.outer_curve.solutions}
        )

    def contacts(self) -> list[dict[str, Any]]:
        """A row for every element and ring, cage at its first position, SI units."""
        solution = self.solution
        position, fill = solution.positions[0], solution.case.bearing.fill
        at, circuit = position.equilibrium, position.circuit(fill)
        shaft = self.shaft_voltage
        rows = []
        for k in range(at.position.size):
            for name, race, share in (
                ("inner", position.inner, circuit.inner_share),
                ("outer", position.outer, 1.0 - circuit.inner_share),
            ):
                strength = share[k] * race.strength_per_volt[k] if self.insulating else None
                angle = getattr(at, f"{name}_angle")[k] if isinstance(at, BallEquilibrium) else 0.0
                rows.append(
                    {
                        "element": k,
                        "ring": name,
                        "position": at.position[k],
                        "load": race.load[k],
                        "contact_angle": angle,
                        "max_pressure": race.max_pressure[k] or None,
                        "semi_axis_x": race.semi_axis_x[k] or None,
                        "semi_axis_y": race.semi_axis_y[k] or None,
                        "minimum_thickness": race.minimum_thickness[k],
                        "central_thickness": race.central_thickness[k],
                        "lambda_ratio": race.minimum_thickness[k] / solution.case.bearing.composite_rq,
                        "capacitance": None if self.ceramic else race.capacitance(fill)[k],
                        "voltage_share": share[k] if self.insulating else None,
                        "strength_per_volt": strength,
                        "max_strength": None if strength is None or shaft is None else strength * shaft,
                        "breakdown_voltage": race.breakdown_voltage[k] if self.insulating else None,
                        "solved": bool(race.solved[k]),
                    }
                )
        return [plain(row) for row in rows]

    def impedance_time(self) -> float | None:
        """Relaxation time of the oil [s], None without a conductivity."""
        sigma = self.solution.case.discharge.conductivity
        permittivity = self.solution.duty.lubricant.relative_permittivity
        return None if sigma is None else relaxation_time(permittivity, sigma)

    def summary(self) -> dict[str, Any]:
        """Totals, SI units, nested as summary.json; never NaN."""
        solution = self.solution
        case, duty, oil = solution.case, solution.duty, solution.case.lubricant.temperature
        fill = case.bearing.fill
        capacitance, plate = self.capacitance(fill), self.plate()
        strength, shaft = self.strength_per_volt, self.shaft_voltage
        curves = (solution.inner_curve, solution.outer_curve)
        errors = [contact.error for curve in curves for contact in curve.solutions]
        known = [error for error in errors if error is not None]
        summary = {
            "schema": SCHEMA,
            "version": __version__,
            "title": case.title,
            "converged": self.converged,
            **texts_and_codes(self.warnings()),
            "inputs": case.to_dict(),
            "lubricant": {
                "temperature": case.bearing.temperature,
                "viscosity": duty.lubricant.viscosity,
                "pressure_viscosity_coefficient": duty.lubricant.pressure_viscosity_coefficient,
                "expansion": None if oil is None else oil.expansion,
                "film_factor": duty.film_factor,
            },
            "bearing": {
                "contacts": case.contacts,
                "capacitance": capacitance,
                "capacitance_oil": self.capacitance("oil"),
                "capacitance_air": self.capacitance("air"),
                "capacitance_plate": plate,
                "capacitance_ratio": None if plate is None else capacitance / plate,
                "lambda_ratio": self.lambda_ratio,
                "lubrication": self.lubrication,
                "film_factor": duty.film_factor,
                **self.breaks(),
                "strength_per_volt": strength,
                "max_strength": None if strength is None or shaft is None else strength * shaft,
                "bearing_voltage_ratio": self.bearing_voltage_ratio,
                "shaft_voltage": shaft,
                "relaxation_time": self.impedance_time(),
                "discretisation_error": max(known) if len(known) == len(errors) else None,
                "interpolation_error": max(curve.interpolation_error for curve in curves),
            },
            "mechanics": mechanics_of(solution.positions[0].equilibrium),
            "contacts": self.contacts(),
            "seconds": solution.seconds,
        }
        found: dict[str, Any] = plain(summary)
        return found


def _weakest(circuit: Circuit) -> str:
    """Which contact of which element breaks first."""
    k = int(np.argmin(circuit.first_breaks))
    return f"{'inner' if circuit.inner_first[k] else 'outer'} contact of element {k}"
