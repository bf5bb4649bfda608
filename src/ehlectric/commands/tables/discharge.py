"""Rows of a result's table on its discharge."""

from __future__ import annotations

from rich.table import Table

from ehlectric.contact.results import PointResult, Result
from ehlectric.discharge.laws import LARGEST_PIT, MEAN_PIT
from ehlectric.discharge.parts import Breakdown, BreakdownZone, Capacitances, DischargeCosts


def add_discharge(table: Table, result: Result | PointResult) -> None:
    """Rows of the discharge, where the case has one."""
    found = result.discharge
    if found is None:
        return
    table.add_section()
    table.add_row("discharge")
    _add_breakdown(table, found.breakdown)
    _add_zone(table, found.zone, result.conditions.half_width)
    unit = (1e12, "pF") if isinstance(result, PointResult) else (1e9, "nF/m")
    _add_capacitance(table, found.capacitances, *unit)
    _add_costs(table, found.costs)
    leakage = found.leakage
    if leakage.relaxation_time is not None and leakage.corner_frequency is not None:
        table.add_row("relaxation time", f"{leakage.relaxation_time:.3g}", "s, at ambient pressure")
        table.add_row("  a capacitor above", f"{leakage.corner_frequency:.3g}", "Hz")


def _add_breakdown(table: Table, found: Breakdown) -> None:
    if found.breakdown_voltage is None or found.margin is None or found.probability is None:
        return
    of_law = "63.2 %" if found.dielectric_strength is None else f"{found.dielectric_strength / 1e6:.4g} V/µm"
    table.add_row("breakdown voltage", f"{found.breakdown_voltage:.4g}", f"V, at {of_law}")
    if found.breakdown_voltage_low is not None and found.breakdown_voltage_high is not None:
        band = f"{found.breakdown_voltage_low:.4g} to {found.breakdown_voltage_high:.4g}"
        table.add_row("  5 to 95 %", band, "V")
    table.add_row("  over the voltage", f"{found.margin:.4g}")
    table.add_row("  probability of breakdown", f"{found.probability:.3g}", "at the voltage")


def _add_zone(table: Table, found: BreakdownZone, half_width: float) -> None:
    position = found.zone_position
    places = position if isinstance(position, tuple) else (position,)
    at = ", ".join(f"{place / half_width:.3g}" for place in places)
    table.add_row("zone that breaks first, at", at, "x/b, y/b" if len(places) > 1 else "x/b")
    pits = f"published pits {MEAN_PIT * 1e6:g}, at most {LARGEST_PIT * 1e6:g}"
    table.add_row("  across", f"{found.zone_size * 1e6:.4g}", f"µm, above 95 %; {pits}")


def _add_capacitance(table: Table, found: Capacitances, scale: float, unit: str) -> None:
    table.add_row("capacitance, whole film", f"{found.capacitance * scale:.4g}", unit)
    table.add_row("  over that of plates", f"{found.capacitance_ratio:.4g}")
    zones = {
        "hertz": found.capacitance_hertz,
        "inlet": found.capacitance_inlet,
        "outlet": found.capacitance_outlet,
        "sides": found.capacitance_sides,
    }
    for zone, value in zones.items():
        if value is not None:
            about = f", {found.outlet}" if zone == "outlet" else ""
            table.add_row(f"  {zone}", f"{value * scale:.4g}", unit + about)
    least, most = found.capacitance_layers * scale, found.capacitance_full * scale
    table.add_row("  whole, by outlet", f"{least:.4g} to {most:.4g}", f"{unit}, assumption: layers to full")


def _add_costs(table: Table, found: DischargeCosts) -> None:
    rows = (
        ("energy of the contact", found.contact_energy, 1e9, "nJ"),
        ("energy of a discharge", found.discharge_energy, 1e9, "nJ"),
        ("  at the breakdown voltage", found.breakdown_energy, 1e9, "nJ"),
        ("pit it melts", found.pit_diameter, 1e6, "µm; assumption: a hemisphere"),
    )
    for name, value, scale, unit in rows:
        if value is not None:
            table.add_row(name, f"{value * scale:.4g}", unit)
    if found.current_density is not None and found.current_density_limits is not None:
        limits = ", ".join(f"{limit / 1e6:g}" for limit in found.current_density_limits)
        table.add_row(
            "current density", f"{found.current_density / 1e6:.3g}", f"A/mm², published limits {limits}"
        )
