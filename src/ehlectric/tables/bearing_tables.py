"""Rows of bearing totals: films, meter, asperities, bounds, and tables of the element contacts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ehlectric.cases.defaults import HOW
from ehlectric.cases.mean_heights import GAUSSIAN
from ehlectric.quantities.formats import (
    SELDOM,
    amount,
    rpm_text,
    scale_of,
    time_share_text,
)
from ehlectric.quantities.lubrication_states import BOUNDARY, FREQUENT, FULL, MIXED, is_shorted
from ehlectric.quantities.result_bounds import bearing_bounds, breakdown_words
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.rows import (
    Row,
    RowTexts,
    Summary,
    ValueWithNote,
    placed_rows,
    sheet_rows,
    shown_unit,
    value_at,
)
from ehlectric.quantities.sheets import (
    BEARING,
    BEARING_CHECK,
    BEARING_ONLY,
    FILM_COLUMNS,
    LOAD_COLUMNS,
    VALUES,
)
from ehlectric.readable import formatted, ratio_text, readable
from ehlectric.tables.duty_rows import alarms_of_cycle, stretch_rows, unless_zero, values_of_cycle
from ehlectric.tables.measured_tables import columns_table, status_rows
from ehlectric.tables.probability_rows import (
    input_range,
    left_out_of_probability,
    probability_note,
    probability_value,
    shares_of_spread,
)

if TYPE_CHECKING:
    from rich.table import Table


# Heat of a film factor, laws of the share of time of a contact, and what surfaces that touch mean.
_HEAT, _LAWS = (VALUES[name] for name in ("heat", "contact_model"))


def total_rows(summary: Summary) -> list[Row]:
    """Rows of a bearing: the inputs that decide, its totals, and what moves its margin.

    The first row is an alarm if a film is not converged.
    """
    rows = sheet_rows(BEARING, BEARING_BOOK, summary, _WORDS, bearing_bounds(BEARING_BOOK, summary))
    return [*status_rows(summary), *placed_rows(rows, summary)]


def check_rows(summary: Summary, words: RowTexts | None = None) -> list[Row]:
    """Rows of a bearing whose contacts are not solved, with further words next to its numbers."""
    bounds = bearing_bounds(BEARING_BOOK, summary)
    rows = sheet_rows(BEARING_CHECK, BEARING_BOOK, summary, _WORDS | (words or RowTexts()), bounds)
    return list(placed_rows(rows, summary))


def input_rows(summary: Summary) -> Iterator[Row]:
    """Rows of the inputs that decide about breakdown."""
    return sheet_rows(BEARING[:1], BEARING_BOOK, summary, _WORDS)


def loads_table(summary: Summary) -> Table:
    """Table of the loads and dry contacts of all elements with both rings."""
    return _contacts_table(summary, LOAD_COLUMNS)


def films_table(summary: Summary) -> Table:
    """Table of the films, capacitances and voltages of all elements with both rings."""
    driven = summary["bearing"]["shaft_voltage"] is not None
    other = "strength_per_volt" if driven else "max_strength"
    return _contacts_table(summary, tuple(key for key in FILM_COLUMNS if key != other))


def _contacts_table(summary: Summary, keys: tuple[str, ...]) -> Table:
    """Table with a row for each element and ring, and these columns."""
    heads = [f"{name}\n{unit}".strip() for name, unit in contact_heads(summary, keys)]
    rows = (contact_cells(row, keys) for row in summary["contacts"])
    return columns_table(heads, rows, left=(), padding=2)


def contact_heads(summary: Summary, keys: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Names of columns of the contacts, and their units in brackets after the sign of a bound."""
    bounds = bearing_bounds(BEARING_BOOK, summary)
    for key in keys:
        about = BEARING_BOOK[f"contacts.{key}"]
        unit = shown_unit(about, 1.0)
        yield about.head, " ".join(filter(None, [bounds.get(f"contacts.{key}"), f"[{unit}]" if unit else ""]))


def contact_cells(row: Mapping[str, Any], keys: tuple[str, ...]) -> list[str]:
    """Cells of a contact: numbers without units, and "gap" as the lambda ratio of a place without load."""
    return [_cell(row, key) for key in keys]


def _cell(row: Mapping[str, Any], key: str) -> str:
    value, about = row[key], BEARING_BOOK[f"contacts.{key}"]
    if key == "lambda_ratio" and not row["solved"]:
        return "gap"
    if value is None:
        return "none"
    if isinstance(value, str):
        return value
    return formatted(scale_of(shown_unit(about, value)).of(value), about.digits)


def _bearing(summary: Summary) -> Any:
    """Inputs of the table ``bearing``."""
    return summary["inputs"]["bearing"]


def _of_temperature(summary: Summary) -> bool:
    """Whether the viscosity depends on the temperature."""
    given = summary["inputs"]["lubricant"]
    return "viscosity" not in given or "atmospheric_law" in given


def _supply(summary: Summary) -> Any:
    return _bearing(summary).get("supply", "flooded")


def _coated(summary: Summary) -> bool:
    return value_at(summary, "bearing.coating_capacitance") is not None


def _ring_temperature(ring: str) -> Callable[[Summary], bool]:
    """Whether a ring has another temperature than the oil."""
    return lambda s: s["lubricant"].get(f"{ring}_temperature", _oil(s)) != _oil(s)


def _oil(summary: Summary) -> Any:
    """Temperature of the oil [K]."""
    return summary["lubricant"]["temperature"]


def _state(summary: Summary) -> Any:
    return value_at(summary, "bearing.lubrication_state")


def _alpha_star(summary: Summary) -> str:
    ambient = 1e9 * summary["lubricant"]["pressure_viscosity_coefficient"]
    return f", reciprocal asymptotic; α = {readable(ambient, 4)} 1/GPa at ambient pressure"


def _strength(summary: Summary) -> ValueWithNote:
    """Dielectric strength, the scale of its Weibull law, or its range, with its note."""
    discharge = summary["inputs"].get("discharge", {})
    if "dielectric_strength" in discharge:
        return ValueWithNote(discharge["dielectric_strength"], ", as given")
    if "weibull" in discharge:
        weibull = discharge["weibull"]
        return ValueWithNote(weibull["scale"], f", Weibull scale, shape {weibull['shape']:g}")
    if "strength_table" in discharge:
        table = discharge["strength_table"]
        ends = (readable(end / 1e6, 4) for end in (min(table["strength"]), max(table["strength"])))
        over = "pressure" if "pressure" in table else "temperature"
        return ValueWithNote((" to ".join(ends), "V/µm"), f", table over {over}")
    return ValueWithNote("not given", ", no breakdown voltage is computed")


def _loaded(ring: str, key: str, of: Callable[[Iterator[float]], float]) -> Callable[[Summary], Any]:
    """Extreme value of the loaded contacts with a ring; None without any."""

    def value(summary: Summary) -> float | None:
        rows = [row for row in summary["contacts"] if row["ring"] == ring and row["max_pressure"]]
        return of(row[key] for row in rows) if rows else None

    return value


def _how(summary: Summary) -> str:
    return HOW[summary["bearing"]["contacts"]]


def _ra_note(summary: Summary) -> str:
    """Note of a roughness Ra: the Rq that follows, and whether its factor is assumed."""
    given, factor = _bearing(summary), _bearing(summary).get("rq_over_ra")
    rq = readable(1e6 * given["composite_rq"], 4)
    how = "assumed for Gaussian heights" if factor is None else "given"
    return f", Rq = {rq} µm with the factor {readable(factor or GAUSSIAN, 4)}, {how}"


def _minimum_film(summary: Summary) -> float:
    ratio: float = summary["bearing"]["lambda_ratio"]
    return ratio * float(_bearing(summary)["composite_rq"])


def film_factor_note(summary: Summary) -> str:
    """Note of the film factor of a bearing: its parts."""
    supply = _supply(summary)
    if summary["bearing"]["film_factor"] == 1.0:
        return "(isothermal, fully flooded)"
    factor = _bearing(summary)["film_factor"]
    if supply == "flooded":
        return f"({_HEAT.get(factor, 'given')})"
    other = _HEAT.get(factor) or (
        f"given factor of {readable(factor)}" if factor not in ("none", 1.0) else ""
    )
    return f"({' and '.join(filter(None, (other, 'oil supply')))})"


def _supply_note(summary: Summary) -> str:
    supply = _supply(summary)
    return f"({supply}, by SKF's factor)" if isinstance(supply, str) else "(given)"


def _rolling_note(summary: Summary) -> str:
    supply, solved = _supply(summary), value_at(summary, "bearing.inner_solved_thickness")
    what = ""
    if supply != "flooded":
        by_rule = "by SKF's replenishment factor" if isinstance(supply, str) else "of starved contacts"
        what = f", {'of flooded contacts' if solved is None else by_rule}"
    return f"{what}, without spin, slip, cage, seals and churned oil"


def _rise_note(ring: str) -> Callable[[Summary], str]:
    """Note with the maximum temperature rise in the most loaded contact with a ring, and its error."""

    def note(summary: Summary) -> str:
        totals = summary["bearing"]
        error = totals[f"{ring}_temperature_rise_error"]
        known = "" if error is None else f" ± {readable(error, 1)}"
        return f", largest in the film {readable(totals[f'{ring}_max_temperature_rise'], 2)}{known} K"

    return note


def _rolling_coefficient(ring: str) -> Callable[[Summary], str]:
    return lambda s: f", rolling coefficient {readable(s['bearing'][f'{ring}_rolling_coefficient'], 2)}"


def _regime_note(summary: Summary) -> str:
    totals = summary["bearing"]
    if totals["contact_time_share"] == 0.0 and totals["touching_time_share"] > 0.0:
        return ", ceramic elements or a coating insulate"
    return f", contacts short it {time_share_text(totals['contact_time_share'])}"


def _time(key: str) -> Callable[[Summary], str]:
    return lambda summary: time_share_text(summary["bearing"][key])


def _asperity_shares(summary: Summary) -> tuple[str, str]:
    ends = (100.0 * summary["bearing"][f"asperity_share_{end}"] for end in ("low", "high"))
    return " to ".join(readable(end, 2) for end in ends), "%"


def _speed(name: str) -> Callable[[Summary], Any]:
    """A speed of the table ``margin``, rounded as all speeds that are searched."""

    def value(summary: Summary) -> tuple[str, str] | None:
        speed = value_at(summary, f"margin.{name}")
        return None if speed is None else (rpm_text(speed), "rpm")

    return value


def _searched(summary: Summary) -> bool:
    """Whether further speeds were searched for a margin of 1, and none has it."""
    margin = summary.get("margin") or {}
    lowest, highest = margin.get("lowest_speed"), margin.get("highest_speed")
    crossed = margin.get("critical_speed") is not None or margin.get("upper_critical_speed") is not None
    return not crossed and lowest is not None and highest is not None and bool(lowest < highest)


def _critical_speed(summary: Summary) -> ValueWithNote:
    """Critical speed, or the end of the searched speeds beyond which it lies."""
    if not _searched(summary):
        return ValueWithNote(_speed("critical_speed")(summary), ", breakdown below")
    low, high = (rpm_text(summary["margin"][f"{end}_speed"]) for end in ("lowest", "highest"))
    beyond = f"above {high}" if summary["bearing"]["margin"] < 1.0 else f"below {low}"
    return ValueWithNote((beyond, "rpm"), f", none from {low} to {high} rpm")


def _parallel(summary: Summary) -> ValueWithNote:
    """Capacitance next to the bearing, or that it is not given and taken as 0."""
    capacitance = value_at(summary, "bearing.parallel_capacitance")
    if capacitance or capacitance is None or "parallel_capacitance" in _bearing(summary):
        return ValueWithNote(capacitance, ", cage, shields and wiring")
    return ValueWithNote("not given", ", taken as 0 (cage, shields and wiring)")


def _meter(summary: Summary) -> ValueWithNote:
    """Capacitance that a meter reads; that it is not computed where asperities touch."""
    totals = summary["bearing"]
    if totals.get("meter_capacitance") is None:
        contact = _state(summary) not in (None, FULL.name)
        return ValueWithNote("not computed" if contact else None, f", {_state(summary)}")
    return ValueWithNote(
        totals["meter_capacitance"], "" if totals["roughness_factor"] is None else ", rough films"
    )


def _fatigue_limit_note(summary: Summary) -> str:
    given = value_at(summary, "inputs.bearing.life.fatigue_load_limit") is not None
    return ", given" if given else ", computed from C0 by ISO 281"


def _reliability_note(summary: Summary) -> str:
    share = value_at(summary, "inputs.bearing.life.reliability")
    return "" if share is None else f", reached by {readable(100.0 * share, 4)} % of bearings"


def of_reliability(prefix: str, lives: str) -> dict[str, Callable[[Summary], Any]]:
    """Numbers of the reliability by dotted key, which are shown only if it is not 90 %.

    ``prefix`` of the factor and the lives in the table, and ``lives``, prefix of lives of a duty cycle.
    """
    pairs = {"reliable_life": "basic_life", "reliable_reference_life": "reference_life"}

    def other(key: str, basic: str) -> Callable[[Summary], Any]:
        return lambda s: None if value_at(s, key) == value_at(s, basic) else value_at(s, key)

    return {
        f"{prefix}reliability_factor": lambda s: (
            None
            if value_at(s, f"{prefix}reliability_factor") == 1.0
            else value_at(s, f"{prefix}reliability_factor")
        ),
        **{
            f"{place}{key}": other(f"{place}{key}", f"{place}{basic}")
            for place in (prefix, lives)
            for key, basic in pairs.items()
        },
    }


def _viscosity_ratio(summary: Summary) -> ValueWithNote:
    """Viscosity ratio with the viscosity of the oil, or the reason why it is unknown."""
    life = summary["life"]
    if life["rated_viscosity"] is None:
        return ValueWithNote(None, "")
    if life["viscosity_ratio"] is None:
        return ValueWithNote("unknown", ", the density of the oil is not given")
    viscosity = 1e6 * life["viscosity_ratio"] * life["rated_viscosity"]
    return ValueWithNote(life["viscosity_ratio"], f", ν/ν1 with ν = {readable(viscosity)} mm²/s")


_OTHER_BEARING = "inputs.motor.second_bearing_capacitance"


def _shaft_note(summary: Summary) -> str:
    leaks = "shaft-leaks" in summary["warning_codes"]
    equal = value_at(summary, "inputs.motor") and value_at(summary, _OTHER_BEARING) is None
    other = " with an equal second bearing" if equal else ""
    return f", by the capacitive divider{other}{'; upper bound: the oil discharges it' if leaks else ''}"


def _first_break(summary: Summary) -> ValueWithNote:
    """First breakdown voltage; that none is computed where surfaces touch, so that nothing reads as safe."""
    if is_shorted(summary):
        return ValueWithNote("not computed", f", {_state(summary)}: discharges at a low voltage")
    bearing = summary["bearing"]
    return ValueWithNote(bearing["first_break"], f", {bearing['first_break_at']}; {breakdown_words(summary)}")


def _period(summary: Summary) -> str:
    """Note of a time constant, compared with the period of the inverter."""
    frequency = summary["inputs"].get("motor", {}).get("switching_frequency")
    if frequency is None:
        return ", compared with 50 to 250 µs of typical inverters"
    return f", compared with a period of {amount(1.0 / frequency, 's')} of the inverter"


def _limits(summary: Summary) -> str:
    low, *_, high = (f"{1e-6 * limit:g}" for limit in summary["bearing"]["current_density_limits"])
    return f", published limits {low} to {high} A/mm²"


def _over_limits(summary: Summary) -> bool:
    totals = summary["bearing"]
    return bool(totals["current_density"] > totals["current_density_limits"][0])


def _range(summary: Summary) -> str | None:
    margin = summary.get("margin") or {}
    return None if margin.get("low") is None else _between(margin["low"], margin["high"])


def _between(low: float, high: float) -> str:
    """Two margins as text, in this order."""
    return f"{ratio_text(low)} to {ratio_text(high)}"


def _effects(summary: Summary) -> Iterator[Row]:
    """Rows of the margins if one input changes, the largest effect first."""
    bound = bearing_bounds(BEARING_BOOK, summary).get("margin.effects", "")
    for effect in (summary.get("margin") or {}).get("effects", ()):
        margins = _between(effect["low_margin"], effect["high_margin"])
        name, _, remark = effect["label"].partition(" (")
        note = f", {remark.removesuffix(')')}" if remark else ""
        name = f"{name}, {input_range(effect)}"
        yield Row(name, margins, note=note, bound=bound, key=f"margin.effects.{effect['key']}")


def _margin_range(summary: Summary) -> str | None:
    """Interval of the margin; that it is not known if points without a result leave an end open."""
    uncertainty = summary.get("uncertainty")
    if not uncertainty:
        return None
    if uncertainty.get("failed") and not (uncertainty["margin_low"] and uncertainty["margin_high"]):
        return "not known"
    return _between(uncertainty["margin_low"], uncertainty["margin_high"])


def _median_note(summary: Summary) -> str:
    uncertainty = summary["uncertainty"]
    least = "at least " if uncertainty.get("failed") else ""
    median = f", median {least}{ratio_text(uncertainty['margin_median'])}"
    error = uncertainty.get("margin_error")
    # Results of earlier versions have no error.
    return median if error is None else f"{median}, sampling error {readable(100.0 * error, 2)} %"


def _left_out(summary: Summary) -> Iterator[Row]:
    for text in (summary.get("margin") or {}).get("left_out", ()):
        yield Row("not computed", note=text, key="margin.left_out")


def _stretches(summary: Summary) -> Iterator[Row]:
    """Rows of the worst stretches of a duty cycle, the worst first."""
    return stretch_rows(BEARING_BOOK, summary, bearing_bounds(BEARING_BOOK, summary))


_WORDS = RowTexts(
    notes={
        "lubricant.temperature": lambda s: "" if _of_temperature(s) else ", without effect on the viscosity",
        "lubricant.alpha_star": _alpha_star,
        "bearing.running_clearance": lambda s: (
            ", a preload" if s["bearing"]["running_clearance"] < 0.0 else ""
        ),
        "rings.inner.minimum_thickness": lambda s: f", {_how(s)}",
        "rings.outer.minimum_thickness": lambda s: f", {_how(s)}",
        "bearing.lambda_ratio": lambda s: f", {_state(s)}{' (no voltage computed)' if is_shorted(s) else ''}",
        "bearing.film_factor": film_factor_note,
        "bearing.supply_factor": _supply_note,
        "bearing.rolling_power_loss": _rolling_note,
        "bearing.inner_contact_power_loss": _rolling_coefficient("inner"),
        "bearing.outer_contact_power_loss": _rolling_coefficient("outer"),
        "bearing.inner_inlet_temperature_rise": _rise_note("inner"),
        "bearing.outer_inlet_temperature_rise": _rise_note("outer"),
        "inputs.bearing.composite_ra": _ra_note,
        "bearing.electrical_behaviour": _regime_note,
        "bearing.inner_contact_time_share": lambda s: f", by {_LAWS[s['bearing']['contact_model']]}",
        "bearing.outer_contact_time_share": lambda s: f", by {_LAWS[s['bearing']['contact_model']]}",
        "bearing.shaft_voltage": _shaft_note,
        "bearing.shaft_time_constant": _period,
        "bearing.film_time_constant": _period,
        "bearing.current_density": _limits,
        "life.dynamic_rating": lambda s: f", {s['life']['dynamic_rating_source']}",
        "life.static_rating": lambda s: f", {s['life']['static_rating_source']}",
        "life.fatigue_load_limit": _fatigue_limit_note,
        "life.reliable_life": _reliability_note,
        "life.reliable_reference_life": _reliability_note,
        "uncertainty.breakdown_probability": probability_note,
        "uncertainty.margin_range": _median_note,
    },
    values={
        "inputs.discharge.dielectric_strength": _strength,
        **{
            f"rings.{ring}.{key}": _loaded(ring, key, of)
            for ring in ("inner", "outer")
            for key, of in (("load", max), ("max_pressure", max), ("minimum_thickness", min))
        },
        "bearing.contacts": _how,
        "bearing.minimum_thickness": _minimum_film,
        **{
            f"bearing.{key}": _time(key)
            for key in (
                *("inner_contact_time_share", "outer_contact_time_share"),
                *("clarke_time_share", "insulating_time_share"),
            )
        },
        "bearing.asperity_share_range": _asperity_shares,
        "bearing.parallel_capacitance": _parallel,
        "bearing.meter_capacitance": _meter,
        "bearing.first_break": _first_break,
        "life.viscosity_ratio": _viscosity_ratio,
        **of_reliability("life.", "duty."),
        "margin.range": _range,
        "uncertainty.margin_range": _margin_range,
        "uncertainty.breakdown_probability": probability_value("uncertainty.breakdown_probability"),
        **values_of_cycle(),
        **{
            f"duty.{name}_share": unless_zero(f"duty.{name}_share")
            for name in ("low_viscosity", "low_film", "unsolved")
        },
        "margin.critical_speed": _critical_speed,
        **{
            f"margin.{name}": _speed(name)
            for name in ("capacitive_speed", "upper_critical_speed", "asperity_contact_speed")
        },
    },
    alarms={
        "bearing.lambda_ratio": lambda s: _state(s) in (BOUNDARY.name, FREQUENT.name),
        "bearing.electrical_behaviour": lambda s: bool(s["bearing"]["electrical_behaviour"] != "capacitive"),
        "bearing.first_break": is_shorted,
        "bearing.margin": lambda s: bool(s["bearing"]["margin"] < 1.0),
        "bearing.current_density": _over_limits,
        **alarms_of_cycle(),
    },
    rows={
        "margin.effects": _effects,
        "margin.left_out": _left_out,
        "uncertainty.indices": shares_of_spread,
        "uncertainty.left_out": left_out_of_probability,
        "duty.stretches": _stretches,
    },
    holds={
        "radial load": lambda s: bool(_bearing(s)["radial_load"]),
        "axial load": lambda s: bool(_bearing(s)["axial_load"]),
        "inner ring of another temperature": _ring_temperature("inner"),
        "outer ring of another temperature": _ring_temperature("outer"),
        "viscosity over temperature": _of_temperature,
        "mounted": lambda s: value_at(s, "bearing.unmounted_clearance") is not None,
        "starved": lambda s: bool(_supply(s) != "flooded"),
        "solved heat": lambda s: bool(_bearing(s)["film_factor"] == "solved"),
        "probability": lambda s: bool(s.get("uncertainty")),
        "asperity contact": lambda s: bool(value_at(s, "uncertainty.asperity_contact_probability")),
        "quick contacts": lambda s: value_at(s, "bearing.contacts") != "solved",
        "touching": lambda s: (value_at(s, "bearing.touching_time_share") or 0.0) >= SELDOM,
        "law other than Clarke's": lambda s: value_at(s, "bearing.contact_model") != "clarke",
        "further capacitance": lambda s: bool(value_at(s, "bearing.parallel_capacitance")) or _coated(s),
        "coated": _coated,
        "mixed lubrication": lambda s: bool(_state(s) == MIXED.name),
        "margin": lambda s: value_at(s, "bearing.margin") is not None,
        "leakage": lambda s: value_at(s, "bearing.shaft_time_constant") is not None,
    },
    only=BEARING_ONLY,
)
