"""Rows of the discharge of a contact."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ehlectric.contact.results import PointResult, Result
from ehlectric.discharge.breakdown import Breakdown, BreakdownZone
from ehlectric.discharge.capacitance import Capacitances
from ehlectric.discharge.energy import DischargeCosts
from ehlectric.discharge.laws import LARGEST_PIT, MEAN_PIT
from ehlectric.discharge.leakage import Leakage
from ehlectric.quantities.rows import Row

# Unit of a capacitance by the geometry of the contact: a line has it per length.
_CAPACITANCE = {"line": "nF/m", "point": "pF"}

# Relative error of the field up to which the table does not repeat it for the breakdown voltage.
_SMALL = 0.002


def discharge_rows(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the discharge of a solved contact; none where its case has no discharge."""
    discharge = result.discharge
    if discharge is None:
        return
    yield Row("discharge")
    # Where surfaces touch, this is the breakdown of the boundary film; that around the spots is with them.
    touching, costs = result.spots is not None, discharge.costs
    if not touching:
        yield from _zone(discharge.zone, result.conditions.half_width)
    yield from _capacitances(discharge.capacitances, _CAPACITANCE[result.conditions.geometry])
    yield from _costs(replace(costs, breakdown_energy=None) if touching else costs)
    yield from _leakage(discharge.leakage)
    if not touching:
        yield from _breakdown(discharge.breakdown, result.field.voltage)


def _breakdown(breakdown: Breakdown, applied: float) -> Iterator[Row]:
    voltage, strength = breakdown.breakdown_voltage, breakdown.dielectric_strength
    if voltage is None or breakdown.margin is None or breakdown.probability is None:
        yield Row("dielectric strength", "not given", note=", no breakdown voltage is computed")
        return
    condition = "63.2 % probability" if strength is None else f"{strength / 1e6:.4g} V/µm"
    yield Row("applied voltage", applied, "V")
    yield Row("breakdown voltage", voltage, "V", f", at {condition}", bound="≤")
    error = breakdown.breakdown_field_error
    if error is not None and error > _SMALL:
        yield Row("breakdown voltage, error by the field", error, "%", digits=".1g")
    low, high = breakdown.breakdown_voltage_low, breakdown.breakdown_voltage_high
    if low is not None and high is not None:
        yield Row("breakdown voltage, 5 to 95 %", f"{low:.4g} to {high:.4g}", "V", bound="≤")
    yield Row("margin (breakdown / applied)", breakdown.margin, alarm=breakdown.margin < 1.0, bound="≤")
    if breakdown.strength_law == "weibull":
        note = "at the applied voltage"
        yield Row("probability of breakdown", breakdown.probability, note=note, digits=".3g")


def _zone(zone: BreakdownZone, half_width: float) -> Iterator[Row]:
    position = zone.zone_position
    places = position if isinstance(position, tuple) else (position,)
    at = ", ".join(f"{place / half_width:.3g}" for place in places)
    axes = "x/b, y/b" if len(places) > 1 else "x/b"
    yield Row("breakdown zone, position", at, note=axes)
    pits = f"published pits {MEAN_PIT * 1e6:g}, at most {LARGEST_PIT * 1e6:g}"
    yield Row("breakdown zone, size", zone.zone_size, "µm", f", above 95 %; {pits}")


def _capacitances(capacitances: Capacitances, unit: str) -> Iterator[Row]:
    beyond = 100.0 * capacitances.capacitance_beyond / capacitances.capacitance
    note = f", a domain twice as large would add {beyond:.2g} % if full of oil"
    yield Row("capacitance of the whole film", capacitances.capacitance, unit, note)
    yield Row("capacitance / parallel plates", capacitances.capacitance_ratio)
    zones = {
        "Hertz zone": capacitances.capacitance_hertz,
        "inlet": capacitances.capacitance_inlet,
        "outlet": capacitances.capacitance_outlet,
        "sides": capacitances.capacitance_sides,
    }
    for zone, value in zones.items():
        if value is not None:
            filling = f", filling: {capacitances.outlet}" if zone == "outlet" else ""
            yield Row(f"capacitance of the {zone}", value, unit, filling)
    least, most = (
        Row("", value, unit).shown
        for value in (capacitances.capacitance_layers, capacitances.capacitance_full)
    )
    note = ", assumption: layers to full"
    yield Row("capacitance by outlet filling", f"{least} to {most}", unit, note)


def _costs(costs: DischargeCosts) -> Iterator[Row]:
    rows = (
        Row("energy stored in the contact", costs.contact_energy, "nJ"),
        Row("energy of a discharge", costs.discharge_energy, "nJ"),
        Row("energy at the breakdown voltage", costs.breakdown_energy, "nJ", bound="≤"),
        Row("diameter of the pit it melts", costs.pit_diameter, "µm", "; assumption: a hemisphere"),
    )
    yield from (row for row in rows if row.value is not None)
    if costs.current_density is not None and costs.current_density_limits is not None:
        limits = ", ".join(f"{limit / 1e6:g}" for limit in costs.current_density_limits)
        yield Row(
            "current density", costs.current_density, "A/mm²", f", published limits {limits}", digits=".3g"
        )


def _leakage(leakage: Leakage) -> Iterator[Row]:
    if leakage.relaxation_time is not None and leakage.corner_frequency is not None:
        note = ", at ambient pressure"
        yield Row("charge relaxation time of the oil", leakage.relaxation_time, "s", note, digits=".3g")
        yield Row("film is capacitive above", leakage.corner_frequency, "Hz", digits=".3g")
