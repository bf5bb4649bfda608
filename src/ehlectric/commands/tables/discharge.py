"""Rows of the discharge of a contact."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.row import Row
from ehlectric.contact.results import PointResult, Result
from ehlectric.discharge.breakdown import Breakdown, BreakdownZone
from ehlectric.discharge.capacitance import Capacitances
from ehlectric.discharge.energy import DischargeCosts
from ehlectric.discharge.laws import LARGEST_PIT, MEAN_PIT
from ehlectric.discharge.leakage import Leakage

# Unit of a capacitance by the geometry of the contact: a line has it per length.
_CAPACITANCE = {"line": "nF/m", "point": "pF"}


def discharge_rows(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the discharge of a solved contact; none where its case has no discharge."""
    discharge = result.discharge
    if discharge is None:
        return
    yield Row("discharge")
    yield from _breakdown(discharge.breakdown)
    yield from _zone(discharge.zone, result.conditions.half_width)
    yield from _capacitances(discharge.capacitances, _CAPACITANCE[result.conditions.geometry])
    yield from _costs(discharge.costs)
    yield from _leakage(discharge.leakage)


def _breakdown(breakdown: Breakdown) -> Iterator[Row]:
    voltage, strength = breakdown.breakdown_voltage, breakdown.dielectric_strength
    if voltage is None or breakdown.margin is None or breakdown.probability is None:
        return
    condition = "63.2 %" if strength is None else f"{strength / 1e6:.4g} V/µm"
    yield Row("breakdown voltage", voltage, "V", f", at {condition}")
    low, high = breakdown.breakdown_voltage_low, breakdown.breakdown_voltage_high
    if low is not None and high is not None:
        yield Row("  5 to 95 %", f"{low:.4g} to {high:.4g}", "V")
    yield Row("  over the voltage", breakdown.margin)
    yield Row("  probability of breakdown", breakdown.probability, note="at the voltage", digits=".3g")


def _zone(zone: BreakdownZone, half_width: float) -> Iterator[Row]:
    position = zone.zone_position
    places = position if isinstance(position, tuple) else (position,)
    at = ", ".join(f"{place / half_width:.3g}" for place in places)
    yield Row("zone that breaks first, at", at, note="x/b, y/b" if len(places) > 1 else "x/b")
    pits = f"published pits {MEAN_PIT * 1e6:g}, at most {LARGEST_PIT * 1e6:g}"
    yield Row("  across", zone.zone_size, "µm", f", above 95 %; {pits}")


def _capacitances(capacitances: Capacitances, unit: str) -> Iterator[Row]:
    yield Row("capacitance, whole film", capacitances.capacitance, unit)
    yield Row("  over that of plates", capacitances.capacitance_ratio)
    zones = {
        "hertz": capacitances.capacitance_hertz,
        "inlet": capacitances.capacitance_inlet,
        "outlet": capacitances.capacitance_outlet,
        "sides": capacitances.capacitance_sides,
    }
    for zone, value in zones.items():
        if value is not None:
            yield Row(f"  {zone}", value, unit, f", {capacitances.outlet}" if zone == "outlet" else "")
    least, most = (
        Row("", value, unit).shown
        for value in (capacitances.capacitance_layers, capacitances.capacitance_full)
    )
    yield Row("  whole, by outlet", f"{least} to {most}", unit, ", assumption: layers to full")


def _costs(costs: DischargeCosts) -> Iterator[Row]:
    rows = (
        ("energy of the contact", costs.contact_energy, "nJ"),
        ("energy of a discharge", costs.discharge_energy, "nJ"),
        ("  at the breakdown voltage", costs.breakdown_energy, "nJ"),
        ("pit it melts", costs.pit_diameter, "µm", "; assumption: a hemisphere"),
    )
    yield from (Row(name, value, *unit) for name, value, *unit in rows if value is not None)
    if costs.current_density is not None and costs.current_density_limits is not None:
        limits = ", ".join(f"{limit / 1e6:g}" for limit in costs.current_density_limits)
        yield Row(
            "current density", costs.current_density, "A/mm²", f", published limits {limits}", digits=".3g"
        )


def _leakage(leakage: Leakage) -> Iterator[Row]:
    if leakage.relaxation_time is not None and leakage.corner_frequency is not None:
        yield Row("relaxation time", leakage.relaxation_time, "s", ", at ambient pressure", digits=".3g")
        yield Row("  a capacitor above", leakage.corner_frequency, "Hz", digits=".3g")
