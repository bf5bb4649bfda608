"""What a solved bearing says: its totals, its voltages, and a row for every contact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.ball_equilibrium import BallEquilibrium
from ehlectric.bearing_circuit import Circuit, bearing_voltage_ratio, series
from ehlectric.bearing_solver import BearingSolution
from ehlectric.discharge import relaxation_time
from ehlectric.solution import plain
from ehlectric.typing import Array
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
        """Whether the elements do not conduct: capacitances are upper bounds, and nothing breaks down."""
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
        """By the lambda ratio: "conducting" below 1, "partial film" up to 3, "full film" above."""
        if self.lambda_ratio < CONDUCTING:
            return "conducting"
        return "partial film" if self.lambda_ratio < PARTIAL else "full film"

    @property
    def bearing_voltage_ratio(self) -> float | None:
        """Part of the common-mode voltage on the bearing; None without a motor."""
        motor = self.solution.case.motor
        if motor is None:
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
        """Of the capacitive divider [V]; None without a motor."""
        motor, ratio = self.solution.case.motor, self.bearing_voltage_ratio
        return None if motor is None or ratio is None else ratio * motor.common_mode_voltage

    def breaks(self) -> dict[str, Any]:
        """Voltages of breakdown over the positions [V], None where there are none."""
        fill = self.solution.case.bearing.fill
        circuits = self.circuits(fill)
        first = np.array([circuit.first_break for circuit in circuits])
        through = np.array([circuit.through_breakdown for circuit in circuits])
        none = self.ceramic or self.lubrication == "conducting" or not np.all(np.isfinite(through))
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
        if self.ceramic or self.lubrication == "conducting":
            return None
        fill = self.solution.case.bearing.fill
        return max(
            float(np.max(share * race.strength_per_volt))
            for position in self.solution.positions
            for inner_share in (position.circuit(fill).inner_share,)
            for share, race in ((inner_share, position.inner), (1.0 - inner_share, position.outer))
        )

    def plate(self) -> float:
        """Capacitance by plates of the Hertz areas, h(0) apart, mean over the positions [F]."""
        totals = []
        for position in self.solution.positions:
            inner, outer = position.inner.plate, position.outer.plate
            loaded = (inner > 0.0) & (outer > 0.0)
            totals.append(float(np.sum(series(inner[loaded], outer[loaded]))))
        return float(np.mean(totals))

    def warnings(self) -> list[str]:
        """What a user should know before using it, each text once."""
        return list(dict.fromkeys(self._warnings()))

    def _warnings(self) -> Iterator[str]:
        solution = self.solution
        if solution.case.contacts == "formula":
            yield "contacts by formula: films may be 30 % off, and fields are voltages over the minimum film"
        if solution.duty.film_factor == 1.0:
            yield "film_factor none: the film is isothermal and fully flooded, voltages are upper bounds"
        if solution.case.lubricant.temperature is not None and solution.case.bearing.temperature < _COLD:
            cold = solution.case.bearing.temperature - 273.15
            yield f"bearing.temperature is {cold:.3g} °C: the viscosity from 40 and 100 °C may be far off"
        if self.lubrication == "conducting":
            yield f"lambda is {self.lambda_ratio:.2g}: surfaces touch and conduct, nothing breaks down"
        elif self.lubrication == "partial film":
            yield f"lambda is {self.lambda_ratio:.2g}: surfaces may touch, voltages are upper bounds"
        if self.ceramic and solution.case.bearing.element_capacitance is None:
            yield "the elements are ceramic: the capacitance is an upper bound, that of conducting ones"
        for name, curve in (("inner", solution.inner_curve), ("outer", solution.outer_curve)):
            for contact in curve.solutions:
                where = f"{name} contact at {contact.load:.4g} N: "
                yield from (where + text for text in contact.warnings)

    def contacts(self) -> list[dict[str, Any]]:
        """A row for every element and ring, cage at its first position, SI units."""
        solution = self.solution
        position, fill = solution.positions[0], solution.case.bearing.fill
        at, circuit = position.equilibrium, position.circuit(fill)
        insulating = not self.ceramic and self.lubrication != "conducting"
        shaft = self.shaft_voltage
        rows = []
        for k in range(at.position.size):
            for name, race, share in (
                ("inner", position.inner, circuit.inner_share),
                ("outer", position.outer, 1.0 - circuit.inner_share),
            ):
                strength = share[k] * race.strength_per_volt[k] if insulating else None
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
                        "capacitance": race.capacitance(fill)[k],
                        "voltage_share": share[k],
                        "strength_per_volt": strength,
                        "max_strength": None if strength is None or shaft is None else strength * shaft,
                        "breakdown_voltage": race.breakdown_voltage[k] if insulating else None,
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
        case, duty, at = solution.case, solution.duty, solution.positions[0].equilibrium
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
            "warnings": self.warnings(),
            "inputs": case.to_dict(),
            "lubricant": {
                "temperature": case.bearing.temperature,
                "viscosity": duty.lubricant.viscosity,
                "pressure_viscosity_coefficient": duty.lubricant.pressure_viscosity_coefficient,
            },
            "bearing": {
                "contacts": case.contacts,
                "capacitance": capacitance,
                "capacitance_oil": self.capacitance("oil"),
                "capacitance_air": self.capacitance("air"),
                "capacitance_plate": plate,
                "capacitance_ratio": capacitance / plate,
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
            "mechanics": {
                "max_load": np.max(at.outer_load),
                "radial_displacement": at.radial_displacement,
                "axial_displacement": getattr(at, "axial_displacement", None),
                "moment": getattr(at, "moment", None),
                "centrifugal_force": at.centrifugal_force,
                "gyroscopic_moment": _largest(getattr(at, "gyroscopic_moment", None)),
                "cage_speed": getattr(at, "cage_speed", None),
                "entrainment_speed": float(np.max(at.speeds.inner_entrainment)),
                "residual": at.residual,
            },
            "contacts": self.contacts(),
            "seconds": solution.seconds,
        }
        found: dict[str, Any] = plain(summary)
        return found


def _largest(values: Array | None) -> float | None:
    return None if values is None else float(np.max(values))


def _weakest(circuit: Circuit) -> str:
    """Which contact of which element breaks first."""
    k = int(np.argmin(circuit.first_breaks))
    return f"{'inner' if circuit.inner_first[k] else 'outer'} contact of element {k}"
