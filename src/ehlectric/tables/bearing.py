"""Rows of the totals of a bearing, and tables of the contacts of its elements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.bearing.margin.sensitivity import OF_TABLE
from ehlectric.cases.bearings.ways import HOW
from ehlectric.cases.input_keys import unit_of
from ehlectric.discharge.verdict import ratio_text
from ehlectric.quantities.bearing_results import BEARING_KEYS
from ehlectric.quantities.formats import Scale, amount, scale_for
from ehlectric.quantities.quantity import Bound
from ehlectric.quantities.rows import Row, amount_row, rows_of
from ehlectric.quantities.units import rpm_text
from ehlectric.tables.bearing_asperities import duty_rows
from ehlectric.tables.bearing_bounds import bounds_of
from ehlectric.tables.bearing_films import film_factors, friction_rows
from ehlectric.tables.bearing_meter import outside_rows, shaft_rows

if TYPE_CHECKING:
    from rich.table import Table


def loads_table(summary: Mapping[str, Any]) -> Table:
    """Table of the loads and dry contacts of all elements with both rings."""
    heads = ("position\n[deg]", "load\n[N]", "angle\n[deg]", "Hertz p\n[GPa]", "semi-axes\n[µm]")
    rows = (
        (
            f"{math.degrees(row['position']):.0f}",
            f"{row['load']:.4g}",
            # "z" prints an angle that is rounded to zero without a sign.
            f"{math.degrees(row['contact_angle']):z.1f}",
            _number(row["max_pressure"], 1e-9, ".3f"),
            " x ".join(filter(None, [_number(row[f"semi_axis_{axis}"], 1e6, ".4g") for axis in "xy"])),
        )
        for row in summary["contacts"]
    )
    return _contacts_table(summary, heads, rows)


def films_table(summary: Mapping[str, Any]) -> Table:
    """Table of the films, capacitances and voltages of all elements with both rings."""
    driven = summary["bearing"]["shaft_voltage"] is not None
    heads = ("h_min\n[µm]", "h central\n[µm]", "lambda", "C\n[pF]", "V share\n[%]")
    rows = (
        (
            f"{row['minimum_thickness'] * 1e6:.4g}",
            f"{row['central_thickness'] * 1e6:.4g}",
            f"{row['lambda_ratio']:.3g}",
            _number(row["capacitance"], 1e12, ".4g"),
            _number(row["voltage_share"], 100.0, ".1f"),
            _number(row["max_strength" if driven else "strength_per_volt"], 1e-6, ".3g"),
            _number(row["breakdown_voltage"], 1.0, ".3g"),
        )
        for row in summary["contacts"]
    )
    bounds = bounds_of(summary)
    field = "E\n{} [V/µm]" if driven else "E/V\n{} [1/µm]"
    field = field.format(bounds.get(f"bearing.{'max_strength' if driven else 'strength_per_volt'}", ""))
    return _contacts_table(summary, (*heads, field.replace(" \n", "\n"), "breakdown\n≤ [V]"), rows)


def _contacts_table(
    summary: Mapping[str, Any], heads: Sequence[str], rows: Iterable[tuple[str, ...]]
) -> Table:
    """Table with a row for each element and ring, and these columns."""
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=None, padding=(0, 2, 0, 0))
    for head in ("", "ring", *heads):
        # Rich would read a unit of small letters in brackets as a style.
        table.add_column(escape(head), justify="right", no_wrap=True)
    for row, texts in zip(summary["contacts"], rows, strict=True):
        table.add_row(str(row["element"]), row["ring"], *texts)
    return table


def _number(value: float | None, factor: float, digits: str) -> str:
    """Number of a cell as text; empty where it is None."""
    return "" if value is None else f"{value * factor:{digits}}"


def total_rows(summary: Mapping[str, Any]) -> list[Row]:
    """Rows of a bearing: the inputs that decide, its totals, and what moves its margin.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, as ``BearingResult.summary`` gives it.

    Returns
    -------
    list of Row
        Values in SI units; the first one is an alarm if a film is not converged.
    """
    return [*_status(summary), *input_rows(summary), *outcome_rows(summary)]


def _status(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Row that warns of films that are not converged."""
    if not summary["converged"]:
        yield Row("NOT CONVERGED", note="the film of a contact: do not use these numbers", alarm=True)


def outcome_rows(summary: Mapping[str, Any]) -> list[Row]:
    """Rows of the totals of a bearing, and of what moves its margin; values in SI units."""
    totals = summary["bearing"]
    first = f", {totals['first_break_at']}" if totals["first_break_at"] else ""
    films = (
        *film_factors(summary),
        ("discretisation error of the films", "bearing.discretisation_error", "%"),
        ("interpolation error over the load", "bearing.interpolation_error", "%"),
        *_film_error(totals),
    )
    capacitances = (
        ("capacitance of the bearing", "bearing.capacitance", "pF"),
        ("capacitance, oil in all gaps", "bearing.capacitance_oil", "pF"),
        ("capacitance, air around the films", "bearing.capacitance_air", "pF"),
        ("capacitance / parallel plates", "bearing.capacitance_ratio", ""),
        ("capacitance, rough films", "bearing.capacitance_rough", "pF"),
    )
    voltages = (
        ("bearing voltage ratio", "bearing.bearing_voltage_ratio", "%", ", shaft / common-mode"),
        ("shaft voltage", "bearing.shaft_voltage", "V", ", by the capacitive divider"),
        ("max field per volt on the bearing", "bearing.strength_per_volt", "1/µm"),
        ("max field at the shaft voltage", "bearing.max_strength", "V/µm"),
        ("ring-to-ring breakdown voltage", "bearing.through_breakdown", "V"),
        ("ring-to-ring, mean over cage positions", "bearing.through_breakdown_mean", "V"),
        ("margin (ring-to-ring / shaft voltage)", "bearing.through_margin", ""),
        ("first breakdown, mean over cage positions", "bearing.first_break_mean", "V"),
        ("first breakdown voltage", "bearing.first_break", "V", first),
    )
    coated, bounds = totals.get("coating_capacitance") is not None, bounds_of(summary)
    return [
        Row(f"films, contacts {HOW[totals['contacts']]}"),
        _lambda_ratio(totals),
        *rows_of(BEARING_KEYS, summary, films),
        Row("computing time", summary["seconds"], "s", digits=".3g"),
        *friction_rows(summary),
        *duty_rows(summary),
        Row("capacitance"),
        *rows_of(BEARING_KEYS, summary, capacitances, bounds),
        *outside_rows(summary),
        Row("breakdown"),
        *rows_of(BEARING_KEYS, summary, voltages, bounds),
        *(shaft_rows(summary) if coated else ()),
        *_intermittent(totals["lubrication"]),
        *_margin(summary),
        *_leakage(summary),
        *_costs(summary),
    ]


def _lambda_ratio(totals: Mapping[str, Any]) -> Row:
    """Row of the smallest lambda ratio, with what it means."""
    state, ratio = totals["lubrication"], totals["lambda_ratio"]
    if state not in _TOUCH:
        return Row("minimum lambda ratio", ratio, note=state)
    return Row("minimum lambda ratio", ratio, note=_TOUCH[state], digits=".3g", alarm=True)


# What a lambda ratio below 1 means, by the state of lubrication.
_TOUCH = {
    "conducting": ", surfaces touch (no voltage computed)",
    "touching": ", surfaces touch",
}


def _intermittent(state: str) -> Iterator[Row]:
    """Row that says where no voltage is computed, so that nothing reads as safe."""
    if state == "conducting":
        note = ", lambda below 1: contacts open and close and discharge at a low voltage"
        yield Row("first breakdown voltage", "not computed", note=note, alarm=True)
    elif state == "partial film":
        note = "lambda below 3, discharges at a lower voltage as contacts open are not computed"
        yield Row("contacts of asperities", "at times", note=note)


def _leakage(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the decay of the shaft voltage through the oil, beside the period of the inverter."""
    totals, frequency = summary["bearing"], summary["inputs"].get("motor", {}).get("switching_frequency")
    if totals.get("shaft_time_constant") is None:
        return
    yield Row("leakage through the oil")
    yield amount_row("charge relaxation time of the oil", totals["relaxation_time"], "s")
    period = ", compared with 50 to 250 µs of typical inverters"
    if frequency is not None:
        period = f", compared with a period of {amount(1.0 / frequency, 's')} of the inverter"
    yield amount_row("time constant of the shaft voltage", totals["shaft_time_constant"], "s", period)
    if totals.get("coating_capacitance") is not None:
        yield amount_row("time constant of the films", totals["film_time_constant"], "s", period)
    lines = (
        ("shaft voltage after an edge", "bearing.shaft_voltage_after_rise", "V"),
        ("shaft voltage after a period", "bearing.shaft_voltage_after_period", "V"),
    )
    yield from rows_of(BEARING_KEYS, summary, lines)


def _costs(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the energy of a discharge, its pit, and the current density."""
    totals = summary["bearing"]
    # The energy of a voltage that is an upper bound is an upper bound too, although a thinner film has a
    # higher capacitance: it grows as 1/h at most, and the square of the voltage falls as h^2.
    bounds: Mapping[str, Bound] = {"breakdown_energy": "≤", "breakdown_pit_diameter": "≤"}
    texts = (
        ("energy at the shaft voltage", "discharge_energy", "J", ", all that is connected to the shaft"),
        ("energy at the first breakdown", "breakdown_energy", "J", ""),
        ("pit diameter at the shaft voltage", "pit_diameter", "m", ", hemisphere of the melted volume"),
        ("pit diameter at the first breakdown", "breakdown_pit_diameter", "m", ""),
    )
    rows = [
        amount_row(name, totals[key], unit, note, bound=bounds.get(key, ""))
        for name, key, unit, note in texts
        if totals.get(key) is not None
    ]
    density = totals.get("current_density")
    if density is not None:
        low, high = (f"{1e-6 * totals['current_density_limits'][k]:g}" for k in (0, -1))
        over = density > totals["current_density_limits"][0]
        note, name = f", published limits {low} to {high} A/mm²", "apparent current density"
        rows.append(Row(name, density, "A/mm²", note, digits=".3g", alarm=over))
        one = totals["element_current_density"]
        rows.append(Row("through one element alone", one, "A/mm²", digits=".3g"))
    if rows:
        yield Row("discharge")
        yield from rows


def _film_error(totals: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """Row of the error of films that are not solved, which results of earlier versions do not have."""
    known = totals["contacts"] != "solved" and totals.get("film_error") is not None
    return [("error of the films", "bearing.film_error", "%")] if known else []


def input_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the inputs that decide about breakdown."""
    bearing, oil = summary["inputs"]["bearing"], summary["lubricant"]
    celsius = f"{oil['temperature'] - 273.15:.4g}"
    given = summary["inputs"]["lubricant"]
    over_temperature = "viscosity" not in given or "atmospheric_law" in given
    yield Row("operating conditions")
    yield Row("speed of the inner ring", bearing["inner_speed"], "rpm")
    for name in ("radial", "axial"):
        if bearing[f"{name}_load"]:
            yield Row(f"{name} load", bearing[f"{name}_load"], "N")
    yield Row("temperature", celsius, "°C", "" if over_temperature else ", without effect on the viscosity")
    yield Row(f"viscosity at {celsius} °C" if over_temperature else "viscosity", oil["viscosity"], "mPa s")
    if oil.get("alpha_star"):
        ambient = f"{1e9 * oil['pressure_viscosity_coefficient']:.4g} 1/GPa"
        note = f", reciprocal asymptotic; α = {ambient} at ambient pressure"
        yield Row("pressure-viscosity coefficient α*", oil["alpha_star"], "1/GPa", note)
    yield from _rings(oil, over_temperature=over_temperature)
    if bearing.get("radial_clearance") is not None:
        yield Row("radial clearance", bearing["radial_clearance"], "µm")
    yield from _clearances(summary)
    if bearing.get("contact_angle") is not None:
        yield Row("free contact angle", bearing["contact_angle"], "deg")
    yield _strength(summary["inputs"].get("discharge", {}))


def _rings(oil: Mapping[str, Any], *, over_temperature: bool) -> Iterator[Row]:
    """Rows of the rings whose temperature is not that of the oil."""
    for name in ("inner", "outer"):
        temperature = oil.get(f"{name}_temperature", oil["temperature"])
        if temperature != oil["temperature"]:
            yield Row(f"temperature of the {name} ring", f"{temperature - 273.15:.4g}", "°C")
            if over_temperature:
                yield Row(f"viscosity at the {name} ring", oil[f"{name}_viscosity"], "mPa s")


def _clearances(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the clearance of a bearing with fits: before mounting, mounted, and in operation."""
    totals = summary.get("bearing", {})
    if totals.get("unmounted_clearance") is None:
        return
    yield Row("radial clearance before mounting", totals["unmounted_clearance"], "µm")
    yield Row("radial clearance, mounted", totals["mounted_clearance"], "µm")
    running = totals["running_clearance"]
    note = ", a preload" if running < 0.0 else ""
    yield Row("radial clearance in operation", running, "µm", note)


def _strength(discharge: Mapping[str, Any]) -> Row:
    """Row of the dielectric strength."""
    name = "dielectric strength"
    if "dielectric_strength" in discharge:
        return Row(name, discharge["dielectric_strength"], "V/µm", ", as assumed")
    if "weibull" in discharge:
        law = discharge["weibull"]
        return Row(f"{name}, Weibull scale", law["scale"], "V/µm", f", shape {law['shape']:g}")
    if "strength_table" in discharge:
        table = discharge["strength_table"]
        low, high = (f"{end / 1e6:.4g}" for end in (min(table["strength"]), max(table["strength"])))
        over = "pressure" if "pressure" in table else "temperature"
        return Row(name, f"{low} to {high}", "V/µm", f", table over {over}")
    return Row(name, "not given", note=", no breakdown voltage is computed")


def _margin(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the margin, the critical speed, and the effects of the inputs, the largest first."""
    margin, analysis = summary["bearing"]["margin"], summary.get("margin")
    if margin is None:
        return
    yield Row("margin (first breakdown / shaft voltage)", margin, alarm=margin < 1.0, bound="≤")
    # Results of earlier versions lack this key.
    probability = summary["bearing"].get("breakdown_probability")
    if probability is not None:
        note = ", while the films insulate"
        bound = bounds_of(summary).get("bearing.breakdown_probability", "")
        yield Row("breakdown at the shaft voltage", probability, "%", note, digits=".2g", bound=bound)
    if analysis is None:
        return
    if analysis["low"] is not None:
        stated = _between(analysis["low"], analysis["high"])
        yield Row("margin within the stated ranges", stated, bound="≤")
    yield from _speeds(analysis, broken=margin < 1.0)
    if analysis["effects"] or analysis["left_out"]:
        yield Row("margin if one input changes")
    for effect in analysis["effects"]:
        margins = _between(effect["low_margin"], effect["high_margin"])
        name, _, beside = effect["label"].partition(" (")
        note = f", {beside.removesuffix(')')}" if beside else ""
        yield Row(f"{name}, {input_range(effect)}", margins, note=note, bound="≤")
    for text in analysis["left_out"]:
        yield Row("not computed", note=text)


def _speeds(analysis: Mapping[str, Any], *, broken: bool) -> Iterator[Row]:
    """Rows of the speeds at which the margin crosses 1, or that none of those computed is one."""
    lowest, highest = analysis["lowest_speed"], analysis["highest_speed"]
    lower, upper = analysis["critical_speed"], analysis.get("upper_critical_speed")
    if lower is not None:
        yield Row("critical speed", rpm_text(lower), "rpm", ", breakdown below")
    if upper is not None:
        yield Row("upper critical speed", rpm_text(upper), "rpm", ", breakdown above")
    if lower is None and upper is None and lowest is not None and lowest < highest:
        low, high = rpm_text(lowest), rpm_text(highest)
        beyond = f"above {high}" if broken else f"below {low}"
        yield Row("critical speed", beyond, "rpm", f", none from {low} to {high} rpm")
    if analysis["touching_speed"] is not None:
        note = ", contacts open and close, discharges are likely"
        yield Row("surfaces touch below", rpm_text(analysis["touching_speed"]), "rpm", note)


def _between(low: float, high: float) -> str:
    """Two margins as text, in this order."""
    return f"{ratio_text(low)} to {ratio_text(high)}"


def input_range(effect: Mapping[str, Any]) -> str:
    """Range of the input of an effect as text, in the unit that is printed.

    Parameters
    ----------
    effect : mapping
        Effect as in ``margin.effects`` of a summary.

    Examples
    --------
    >>> input_range({"key": "bearing.temperature", "low_input": 333.15, "high_input": 353.15})
    '60 to 80 °C'
    >>> input_range({"key": "discharge.dielectric_strength", "low_input": 12e6, "high_input": 18e6})
    '12 to 18 V/µm'
    """
    ends, unit = (effect["low_input"], effect["high_input"]), unit_of(effect["key"])
    if effect["key"] == OF_TABLE:
        unit = ""
    if unit == "K":
        return "{:.4g} to {:.4g} °C".format(*(end - 273.15 for end in ends))
    scale = _SCALES.get(unit) or scale_for(max(map(abs, ends)), unit)
    low, high = (f"{end * scale.factor:.4g}" for end in ends)
    return f"{low} to {high} {scale.unit}".rstrip()


# Units that are printed for lengths and strengths of bearings, whatever their size.
_SCALES = {
    "rad": Scale(180.0 / math.pi, "deg"),
    "V/m": Scale(1e-6, "V/µm"),
    "N": Scale(1.0, "N"),
    "m**2/s": Scale(1e6, "mm²/s"),
}
