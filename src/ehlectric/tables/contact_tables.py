"""Rows of the tables of contacts: before and after the solution, heat, meter, discharge, and touching
surfaces.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.contact import (
    KINDS,
    Conditions,
    PointConditions,
    PointResult,
    Result,
    case_summary,
    digits_within,
    share_text,
)
from ehlectric.discharge.discharge_laws import LARGEST_PIT, MEAN_PIT
from ehlectric.film import pressure_error_text
from ehlectric.quantities.formats import CELSIUS, amount, scale_of
from ehlectric.quantities.result_bounds import bound_words, contact_bounds
from ehlectric.quantities.results import CONTACT_BOOK
from ehlectric.quantities.rows import Row, RowTexts, Summary, ValueWithNote, row_of, sheet_rows, value_at
from ehlectric.quantities.sheets import CHECK, CONTACT, CONTACT_ONLY, VALUES
from ehlectric.readable import formatted, readable
from ehlectric.tables.measured_tables import status_rows

# Relative error of the field up to which the table does not repeat it for the breakdown voltage.
_SMALL = 0.002

# Error of the oil balance below which it is not stated.
_LEAST_ERROR = 1e-4


def case_rows(case: Case, summary: Summary) -> list[Row]:
    """Rows of a contact before it is solved: its conditions, dry contact, and film thicknesses by formulas.

    ``summary`` is the result of ``contact.summary.case_summary``.
    """
    words = _WORDS | RowTexts(
        values={"grid.film": lambda _: _grid(case), "field.voltage": lambda _: case.electric.voltage},
        notes={"inputs.grid.side": lambda _: "semi-axes a"},
    )
    return list(sheet_rows(CHECK, CONTACT_BOOK[_geometry(summary)], summary, words))


def condition_rows(case: Case, conditions: Conditions | PointConditions) -> Iterator[Row]:
    """Rows of the operating conditions of a case, which decide film and field."""
    summary = case_summary(case, conditions)
    words = _WORDS | RowTexts(values={"field.voltage": lambda _: case.electric.voltage})
    return sheet_rows(CHECK[:1], CONTACT_BOOK[conditions.geometry], summary, words)


def result_rows(result: Result | PointResult) -> list[Row]:
    """Rows of a solved contact: its conditions, film, field and discharge, and the film by formulas."""
    summary = result.summary()
    book = CONTACT_BOOK[result.conditions.geometry]
    rows = sheet_rows(CONTACT, book, summary, _WORDS | _of_arrays(result), contact_bounds(book, summary))
    return [*status_rows(summary), *rows]


def _of_arrays(result: Result | PointResult) -> RowTexts:
    """Texts that need the arrays or the case of a result: what its summary does not have."""
    kind = KINDS[result.conditions.geometry]
    surfaces = getattr(result.film.heated, "surface_temperatures", None)
    highest = () if surfaces is None else tuple(float(surface.max()) for surface in surfaces)
    values: dict[str, Any] = {
        f"film.surface_temperature_{k}": partial(_same, value) for k, value in enumerate(highest, 1)
    }
    return RowTexts(
        values=values | {"regime": partial(_same, kind.regime(result.conditions.contact))},
        notes={
            "film.rheology": lambda _: _constants(result.case),
            "film.thermal": lambda _: _inlet(result.case),
        },
    )


def _same(value: Any, _: Summary) -> Any:
    """Value of any summary."""
    return value


def _geometry(summary: Summary) -> str:
    return str(summary["inputs"]["contact"]["geometry"])


def _touches(summary: Summary) -> bool:
    return bool(value_at(summary, "asperities.spots"))


def _axis_ratio(summary: Summary) -> float | None:
    hertz = summary["hertz"]
    return hertz["semi_axis_y"] / hertz["semi_axis_x"] if "semi_axis_x" in hertz else None


def _behaviour(summary: Summary) -> str:
    share = 100.0 * summary["asperities"]["time_share"]
    return f", at 10 kHz; a spot is there {readable(share)} % of the time"


def _grid(case: Case) -> str | tuple[str, str]:
    """Nodes of the film, or the error to which its grid is refined."""
    if case.grid.target is not None:
        return f"refined to an error of {100.0 * case.grid.target:g} %"
    if case.contact.geometry == "line":
        return str(case.grid.nodes), "nodes"
    return f"{case.first_grid.nodes_along} x {case.first_grid.nodes_across}", "nodes"


def _speeds(summary: Summary) -> str:
    """Note with the speeds of both surfaces."""
    contact = summary["inputs"]["contact"]
    mean, half = contact["entrainment_speed"], 0.5 * contact["slide_to_roll_ratio"]
    if half == 0.0:
        return ", pure rolling"
    return f", surfaces at {readable(mean * (1.0 + half), 4)} and {readable(mean * (1.0 - half), 4)} m/s"


def _half_width(summary: Summary) -> float:
    hertz = summary["hertz"]
    return float(hertz["half_width"] if "half_width" in hertz else hertz["semi_axis_x"])


def _place(summary: Summary, key: str) -> str:
    """Position in half-widths, or in semi-axes b of a point contact, with the name of the axes."""
    position = value_at(summary, key)
    places = position if isinstance(position, Sequence) else (position,)
    texts = ", ".join(readable(place / _half_width(summary), 4) for place in places)
    return f"{'x/b, y/b' if len(places) > 1 else 'x/b'} = {texts}"


def _in_spot(summary: Summary) -> str:
    """Note of a value in the boundary film; empty where the surfaces do not touch."""
    return ", in the boundary film" if _touches(summary) else ""


def _zone(summary: Summary) -> str:
    return "Hertzian zone" if _geometry(summary) == "line" else "Hertzian ellipse"


def _pressure_error(summary: Summary) -> str:
    """Note with the error of the maximum pressure; empty if the error is unknown."""
    text = pressure_error_text(summary["film"]["max_pressure_error"])
    return f", {text}" if text else ""


def _film_grid(summary: Summary) -> str:
    """Note of the discretisation error: nodes, and the error that was asked for."""
    film = summary["film"]
    nodes = film["nodes"] if isinstance(film["nodes"], Sequence) else (film["nodes"],)
    target = film["target_error"]
    target_note = "" if target is None else f", {100.0 * target:g} % asked"
    touch = "with asperity contact" if _touches(summary) else ""
    return f"{touch}, {' x '.join(map(str, nodes))} nodes{target_note}"


def _iterations(summary: Summary) -> str:
    film = summary["film"]
    return f"after {film['newton_iterations']} {'V-cycles' if film['solver'] == 'paper' else 'Newton steps'}"


def _meniscus(summary: Summary) -> str | None:
    """Region where oil fills the gap; None without a supply of oil."""
    film = summary["film"]
    if "oil_layer" not in film:
        return None
    if film["meniscus"] is not None:
        return _place(summary, "film.meniscus")
    return "none: flooded" if film["film_ratio"] == 1.0 else "at the inlet edge on y = 0"


def _change(name: str) -> Callable[[Summary], str]:
    """Note with the effect of heat and shear on a film, divided by the isothermal, Newtonian film."""

    def note(summary: Summary) -> str:
        film = summary["film"]
        simple = film["isothermal"][f"{name}_thickness"]
        effect = "heat and shear" if film["thermal"] else "shear"
        if simple is None or not summary["converged"]:
            return ""
        if name == "minimum" and (summary.get("asperities") or {}).get("load_share"):
            # The minimum is the boundary film with heat and without.
            return ", asperities are in contact"
        return f", {100.0 * (film[f'{name}_thickness'] / simple - 1.0):+.2g} % by {effect}"

    return note


def _constants(case: object) -> str:
    """Note with the constants of the rheology of a case."""
    if not isinstance(case, Case) or case.film is None:
        return ""
    # Units of keys come from the tables of all kinds of files, which take longer to load than to print.
    from ehlectric.cases.input_keys import unit_of

    given = case.film.constants(case.lubricant).items()
    texts = (f"{key} {amount(value, unit_of(f'lubricant.{key}'))}".rstrip() for key, value in given)
    return "".join(f", {text}" for text in texts)


def _inlet(case: object) -> str:
    """Note with the temperatures of the oil in the inlet and of the bodies."""
    if not isinstance(case, Case) or case.contact.temperature is None:
        return ""
    contact = case.contact
    temperatures = {
        "oil": contact.temperature,
        "body 1": contact.temperature_1,
        "body 2": contact.temperature_2,
    }
    known = {name: value for name, value in temperatures.items() if value is not None}
    return "".join(f", {name} at {CELSIUS.text(value)}" for name, value in known.items())


def _temperature(summary: Summary) -> str | None:
    thermal = summary["film"].get("thermal")
    return None if thermal is None else "computed" if thermal else "temperature of the inlet"


def _reached(summary: Summary) -> str:
    """Note of a temperature of a film that is not converged."""
    return "" if summary["converged"] else ", not converged: last iteration"


def _temperature_error(summary: Summary) -> str:
    if not summary["converged"]:
        return _reached(summary)
    error = summary["film"]["temperature_rise_error"]
    return "" if error is None else f", error {readable(error, 1)} K"


def _load_share(summary: Summary) -> ValueWithNote:
    """Load share with no more digits than its change from a coarser grid leaves, and this change.

    An upper bound has no error.
    """
    asperities = summary["asperities"]
    share, before = asperities["load_share"], asperities["load_share_coarser"]
    shown, note = share_text(share, before), ", not known on a coarser grid"
    if before is not None:
        error = formatted(100.0 * abs(share - before), ".2g")
        within = "" if shown.startswith("<") else f"± {error} percentage points by the grid: "
        note = f", {within}{share_text(before, share)} % on half the nodes"
    return ValueWithNote((shown, "%"), note)


def _film_around(key: str) -> Callable[[Summary], ValueWithNote]:
    """Film outside of the spots with the digits that the change of its mean from a coarser grid leaves."""

    def shown(summary: Summary) -> ValueWithNote:
        asperities = summary["asperities"]
        value, mean, before = asperities[key], asperities["mean_film"], asperities.get("mean_film_coarser")
        if value is None or mean is None or before is None:
            return ValueWithNote(value, "")
        change = abs(mean - before) / mean
        note = f", in the Hertzian zone, ± {readable(100.0 * change, 2)} % by the grid"
        text = readable(1e9 * value, digits_within(change))
        return ValueWithNote((text, "nm"), note if key == "mean_film" else "")

    return shown


def _area_error(summary: Summary) -> str:
    """Note of the real area of contact: what it is a part of, and its error by the grid."""
    error = summary["asperities"]["contact_area_error"]
    part = "width" if _geometry(summary) == "line" else "area"
    within = "" if error is None else f", ± {min(100.0 * error, 100.0):.0f} % of it by the grid"
    return f", of the Hertzian {part}{within}"


def _spots(summary: Summary) -> ValueWithNote:
    asperities = summary["asperities"]
    strips = ", strips along the contact" if _geometry(summary) == "line" else ""
    single = (
        f", {asperities['spots_of_one_node']} of a single node" if asperities["spots_of_one_node"] else ""
    )
    return ValueWithNote(str(asperities["spots"]), strips + single)


def _oil_error(summary: Summary) -> Any:
    error = value_at(summary, "asperities.mass_error")
    if error is None or error >= _LEAST_ERROR:
        return error
    return f"< {100.0 * _LEAST_ERROR:g}", "%"


def _resistance_note(summary: Summary) -> str:
    electric, line = summary["inputs"]["electric"], _geometry(summary) == "line"
    if summary["asperities"]["resistance"] is None:
        missing = (
            "resistivity of the bodies" if electric.get("resistivity") is None else "length of the contact"
        )
        return f": give the {missing}"
    layer = "with their tribofilm" if electric.get("tribofilm_resistance") else "of metal"
    return f", {layer}" + (", ridges along the whole length" if line else "")


def _rough_columns(summary: Summary) -> Any:
    """Columns of the field of a rough line contact, whose number follows from the roughness."""
    rough_line = "roughness" in summary and _geometry(summary) == "line"
    return (str(summary["field"]["columns"]), "columns") if rough_line else None


def _field_place(summary: Summary) -> str:
    wall = f", {summary['field']['max_strength_wall']}" if "roughness" in summary else ""
    place = f" at {_place(summary, 'field.max_strength_position')}{_in_spot(summary)}{wall}"
    return f"{place}, with {readable(summary['field']['voltage'], 4)} V across the film"


def _strength(summary: Summary) -> ValueWithNote | None:
    """Dielectric strength and its law; that it is not given where there is no law."""
    discharge = summary.get("discharge")
    if discharge is None:
        return None
    if discharge["strength_law"] is None:
        return ValueWithNote("not given", ", no breakdown voltage is computed")
    return ValueWithNote(discharge["dielectric_strength"], f", {discharge['strength_law']}")


def _breakdown_note(summary: Summary) -> str:
    strength = summary["discharge"]["dielectric_strength"]
    condition = "63.2 % probability" if strength is None else f"{readable(strength / 1e6, 4)} V/µm"
    return "; ".join(filter(None, [f", at {condition}", bound_words(summary)]))


def _breakdown_error(summary: Summary) -> Any:
    error = value_at(summary, "discharge.breakdown_field_error")
    return None if error is None or error <= _SMALL else error


def _breakdown_range(summary: Summary) -> Any:
    discharge = summary.get("discharge", {})
    low, high = discharge.get("breakdown_voltage_low"), discharge.get("breakdown_voltage_high")
    return None if low is None or high is None else (f"{readable(low, 4)} to {readable(high, 4)}", "V")


def _probability(summary: Summary) -> Any:
    weibull = value_at(summary, "discharge.strength_law") == "weibull"
    return summary["discharge"]["probability"] if weibull else None


def _zone_place(summary: Summary) -> str | None:
    return _place(summary, "discharge.zone_position") if "discharge" in summary else None


def _beyond(summary: Summary) -> str:
    discharge = summary["discharge"]
    beyond = 100.0 * discharge["capacitance_beyond"] / discharge["capacitance"]
    return (
        f", over {_domain(summary)}; a domain twice as large in every direction would add "
        f"{readable(beyond, 2)} % if full of oil"
    )


def _domain(summary: Summary) -> str:
    """Domain of the film, from its inlet to its outlet and to its sides."""
    grid = summary["inputs"]["grid"]
    along = f"{readable(grid['inlet'])} to {readable(grid['outlet'])}".replace("-", "−")
    if _geometry(summary) == "line":
        return f"x = {along} half-widths"
    return f"x = {along} and y = ±{readable(grid['side'])} semi-axes"


def _by_outlet(summary: Summary) -> Any:
    """Range of the capacitance between oil in layers and a full outlet."""
    discharge = summary.get("discharge")
    if discharge is None:
        return None
    return _between(discharge, ("layers", "full"), "nF/m" if _geometry(summary) == "line" else "pF")


def _meter_range(summary: Summary) -> Any:
    meter = summary.get("meter")
    return meter and _between(meter, ("air", "oil"), "pF")


def _between(table: Summary, names: tuple[str, str], unit: str) -> tuple[str, str]:
    """Range of capacitances of a table."""
    ends = (formatted(scale_of(unit).of(table[f"capacitance_{name}"]), ".4g") for name in names)
    return " to ".join(ends), unit


def _share(name: str) -> Callable[[Summary], str]:
    return lambda summary: f", {100.0 * summary['meter'][f'share_of_{name}']:.0f} %"


def _limits(summary: Summary) -> str:
    limits = summary["discharge"]["current_density_limits"] or ()
    return ", published limits " + ", ".join(f"{limit / 1e6:g}" for limit in limits)


def _formula_rows(key: str) -> Callable[[Summary], Iterator[Row]]:
    """Rows of a film thickness by each formula that gives it, next to the solved one."""

    def rows(summary: Summary) -> Iterator[Row]:
        about = CONTACT_BOOK[_geometry(summary)][f"film_formulas.*.{key}"]
        formulas: Mapping[str, Any] = KINDS[_geometry(summary)].formulas
        for name, film in summary["film_formulas"].items():
            if film[key] is not None:
                note = _range_note(summary, name, key) + _difference_note(summary, key, film[key])
                row = row_of(f"film_formulas.{name}.{key}", about, film[key], note)
                yield replace(row, name=f"{key.replace('_thickness', ' film')} ({formulas[name].name})")

    return rows


def _range_note(summary: Summary, name: str, key: str) -> str:
    """Note of a formula outside its range; empty within it, and for results of earlier versions."""
    reason = value_at(summary, f"film_formula_ranges.{name}.{key}")
    return f", outside its range: {reason}" if reason else ""


def _difference_note(summary: Summary, key: str, value: float) -> str:
    """Note with the difference of a formula film from the solved film, or from the film of smooth surfaces.

    Where surfaces touch, the minimum film is the boundary film, and the centre may lie in a spot.
    """
    if not summary.get("converged"):
        return ""
    if not _touches(summary):
        return f", {100.0 * (value / summary['film'][key] - 1.0):+.0f} % vs. solved film"
    smooth = value_at(summary, "roughness.smooth_minimum_thickness")
    if smooth is None or key != "minimum_thickness":
        return ""
    return f", {100.0 * (value / smooth - 1.0):+.0f} % vs. film of smooth surfaces"


def _formula_error(summary: Summary) -> Any:
    if _touches(summary):
        return ValueWithNote("none: asperities are in contact", ", and formulas hold for smooth surfaces")
    given = [
        value_at(summary, f"film_formula_ranges.{name}.{key}")
        for name, film in summary["film_formulas"].items()
        for key in film
        if film[key] is not None
    ]
    if all(given):
        return ValueWithNote("unknown", ", the contact is outside the range of all formulas")
    if any(given):
        return ValueWithNote("up to 40 %", ", of formulas within their range")
    return "up to 40", "%"


_WORDS = RowTexts(
    notes={
        "inputs.contact.slide_to_roll_ratio": _speeds,
        "lubricant.temperature": lambda s: f", {s['lubricant']['name']}" if s["lubricant"]["name"] else "",
        "film.minimum_thickness": lambda s: f" at {_place(s, 'film.minimum_position')}{_in_spot(s)}",
        "film.mean_thickness": lambda s: f", in the {_zone(s)}",
        "film.max_pressure": _pressure_error,
        "film.discretisation_error": _film_grid,
        "film.residual": _iterations,
        "film.isothermal.minimum_thickness": _change("minimum"),
        "film.isothermal.central_thickness": _change("central"),
        "film.max_temperature_rise": _temperature_error,
        "film.surface_temperature_1": _reached,
        "film.surface_temperature_2": _reached,
        "roughness.lambda_ratio": lambda s: (
            f", {'boundary' if _touches(s) else 'minimum'} film / combined Rq"
        ),
        "asperities.electrical_behaviour": _behaviour,
        "asperities.contact_area_share": _area_error,
        "asperities.resistance": _resistance_note,
        "field.max_strength": _field_place,
        "discharge.zone_size": lambda _: (
            f", above 95 %; published pits {MEAN_PIT * 1e6:g}, at most {LARGEST_PIT * 1e6:g}"
        ),
        "discharge.capacitance": _beyond,
        "discharge.capacitance_outlet": lambda s: f", filling: {s['discharge']['outlet']}",
        "discharge.current_density": _limits,
        "discharge.breakdown_voltage": _breakdown_note,
        "meter.capacitance": lambda s: f", {s['meter']['bodies']}",
        "meter.capacitance_domain": _share("domain"),
        "meter.capacitance_hertz": _share("hertz"),
        "meter.capacitance_outside": _share("outside"),
    },
    values={
        "hertz.axis_ratio": _axis_ratio,
        "film.meniscus": _meniscus,
        "film.rheology": lambda s: VALUES["rheology"].get(value_at(s, "film.rheology")),
        "film.thermal": _temperature,
        "asperities.load_share": _load_share,
        "asperities.spots": _spots,
        "asperities.mean_film": _film_around("mean_film"),
        "asperities.film_5": _film_around("film_5"),
        "asperities.mass_error": _oil_error,
        "field.columns": _rough_columns,
        "discharge.zone_position": _zone_place,
        "discharge.capacitance_by_outlet": _by_outlet,
        "discharge.dielectric_strength": _strength,
        "discharge.breakdown_field_error": _breakdown_error,
        "discharge.breakdown_range": _breakdown_range,
        "discharge.probability": _probability,
        "meter.capacitance_by_gap": _meter_range,
        "formula_error": _formula_error,
        "seconds.both": lambda s: s["seconds"]["film"] + s["seconds"]["field"],
    },
    alarms={"discharge.margin": lambda s: bool(s["discharge"]["margin"] < 1.0)},
    holds={
        "touching": _touches,
        "not touching": lambda s: not _touches(s),
        "film around the spots": lambda s: value_at(s, "asperities.film_5") is not None,
    },
    only=CONTACT_ONLY,
    rows={f"film_formulas.*.{key}": _formula_rows(key) for key in ("minimum_thickness", "central_thickness")},
)
