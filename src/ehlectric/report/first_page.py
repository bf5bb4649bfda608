"""First page of a report: machine, verdict, numbers, figure, inputs or remedies, what to measure first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ehlectric.bearing import FILMS, MOTOR, OF_TABLE, changes_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import printable
from ehlectric.figures.figure_names import with_units_kept
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.quantities.inputs import ENDS, end_and_key
from ehlectric.quantities.quantity import unbroken
from ehlectric.quantities.result_bounds import bearing_bounds
from ehlectric.quantities.result_warnings import CODES
from ehlectric.quantities.results import BEARING_BOOK, NAMES_OF_ENDS
from ehlectric.quantities.rows import Row, Summary, placed
from ehlectric.quantities.sheets import FIRST_PAGE_OF_BEARING, FIRST_PAGE_OF_LIFE
from ehlectric.readable import capital, chance_text, ratio_text, readable
from ehlectric.report.appendix import given_inputs, input_text, named
from ehlectric.report.report_content import Block, Light, Numbers, Part, Picture, Section, Table, Text
from ehlectric.report.report_facts import alarms_of, pictures_of
from ehlectric.report.report_texts import SENTENCES, TEXTS
from ehlectric.tables.probability_rows import input_range
from ehlectric.version import __version__

# Largest numbers of large numbers, of inputs that decide a margin, and of assumptions.
_MOST, _CHANGES, _ASSUMPTIONS = 6, 4, 3

# Least ratio of the margins with an input as it is and at an end of its range for which it has a row.
_WORTH = 1.05

# Width of a figure that is as wide as the page [inches], and ratio of its height to that on the screen.
_WIDE, _LOW = 6.85, 0.75

# Warnings that say what the verdict says, and not how likely it is.
_IN_VERDICT = ("breakdown-expected",)


def first_section(result: Any, part: Part, path: Path) -> Section:
    """First page of a report of a stored result: all that a reader needs who reads nothing else."""
    return Section("Summary", tuple(_blocks(result, part, path)), single_page=True)


def _blocks(result: Any, part: Part, path: Path) -> Iterator[Block]:
    alarms = tuple(alarms_of(part.warnings, part.failure))
    yield from alarms
    yield Text(part.machine or part.lead)
    if part.verdict is None:
        yield Text(SENTENCES["no_verdict"])
    else:
        # The verdict with its first reason, and what it assumes.
        yield Light.of(part.verdict, reasons=1)
    # Numbers that must not be used do not stand large on a page.
    numbers, tables = ((), ()) if alarms else (part.first[:1], part.first[1:])
    yield from numbers
    drawn = pictures_of(result, converged=is_solved(result), names=part.figures)
    # The first figure that has something to show.
    picture = next((block for block in drawn if isinstance(block, Picture)), None)
    if picture is not None:
        if any(isinstance(block, Numbers) and block.columns > 1 for block in numbers):
            picture.figure.set_size_inches(_WIDE, _LOW * picture.figure.get_figheight())
        yield picture
    yield from tables
    meanings = dict.fromkeys(
        CODES[warning.code].meaning
        for warning in part.warnings
        if warning.severity == "warning" and warning.code not in _IN_VERDICT
    )
    if meanings:
        yield Text(f"Warnings: {' '.join(meanings)}", "small")
    given = f"Inputs of the file: {given_inputs(result.case, part.varied)}. {SENTENCES['all_others']}"
    yield Text(with_units_kept(given), "small")
    made = (
        f"Result {printable(f'{path.parent.name}/{path.name}')}, {part.details.get('result computed by', '')}"
    )
    yield Text(f"{made.rstrip(', ')}; report by ehlectric {__version__}.", "small")


def is_solved(result: Any) -> bool:
    """Whether figures of a result show a solution; figures of a sweep skip points without one."""
    return bool(getattr(result, "converged", True))


def numbers_of(
    rows: Iterable[Row], keys: Mapping[str, Iterable[str]], summary: Summary, place: str = ""
) -> tuple[tuple[str, str, str], ...]:
    """Large numbers of those keys that have a row, each with the rows of further keys in its note; labels
    state the operating point next to a duty cycle of the ``summary``. ``place``, name of the end of a drive.
    """
    known = {row.key: row for row in rows if row.key}
    return tuple(
        _number(key, keys[key], known, (placed("", key, summary).removeprefix(", "), place))
        for key in keys
        if key in known
    )[:_MOST]


def _number(
    key: str, further: Iterable[str], rows: Mapping[str, Row], places: tuple[str, ...]
) -> tuple[str, str, str]:
    """Label, value and note of a large number; ``places``, what the label names besides the quantity."""
    row = rows[key]
    row = replace(row, digits=".3g") if row.digits == ".4g" else row
    label = ", ".join(filter(None, [capital(row.name), *places]))
    below = [
        f"{rows[name].name.removeprefix(f'{row.name}, ')} {rows[name].bounded}{_unit(rows[name])}"
        for name in further
        if name in rows
    ]
    note = "; ".join(filter(None, [*below, row.note.lstrip(" ,;")]))
    # Margins have the digits that they have in sentences.
    of_ratio = key.endswith("margin") and isinstance(row.value, float)
    value = f"{row.bound} {ratio_text(row.value)}".strip() if of_ratio else row.bounded
    return label, unbroken(f"{value}{_unit(row)}"), with_units_kept(note)


def _unit(row: Row) -> str:
    """Unit after a number; none of a rate, whose label has it."""
    return f" {row.unit}" if row.unit and row.unit != "1/s" else ""


def bearing_blocks(case: BearingCase, summary: Mapping[str, Any], totals: Iterable[Row]) -> Iterator[Block]:
    """Numbers of a bearing, the inputs that decide its margin, and what to measure first."""
    totals = tuple(totals)
    shown = map(partial(_with_chance, summary), totals)
    yield Numbers(numbers_of(shown, FIRST_PAGE_OF_BEARING, summary))
    yield from life_texts({"": totals})
    given = flattened(case.to_dict())
    margin = summary["bearing"]["margin"]
    deciding = tuple(_deciding(case, summary))
    if deciding:
        caption = f"Inputs that decide the margin of {ratio_text(margin)}"
        caption = f"{placed(caption, 'margin.effects', summary)}, one changed at a time"
        heads, shares = ("input", "value", "range", "margin at these ends"), (0.42, 0.16, 0.2, 0.22)
        yield Table(caption, heads, deciding, (3,), shares=shares)
    elif margin is None:
        yield Text(SENTENCES["no_effects"])
    indices = (summary.get("uncertainty") or {}).get("indices", ())[:_ASSUMPTIONS]
    if indices:
        yield measure_first_table(
            (
                (
                    _name(index),
                    _value(case, index["key"], given.get(index["key"])),
                    "scatters" if index["low"] is None else with_units_kept(input_range(index)),
                    f"{_share_text(index)} of the spread of the margin; {_basis(index)}",
                )
                for index in indices
            ),
            ranked=True,
        )
        return
    broken = summary["bearing"]["first_break"] is not None
    yield measure_first_table(
        (named(key).text, input_text(case, key, given[key]), usual_range(case, key), why)
        for key, why in TEXTS["first_page"]["bearing" if broken else "no_voltage"].items()
        if key in given
    )


def _deciding(case: BearingCase, summary: Mapping[str, Any]) -> Iterator[tuple[str, str, str, str]]:
    """Rows of the inputs that change the margin most, with the margins at both ends of their ranges."""
    given, margin = flattened(case.to_dict()), summary["bearing"]["margin"]
    bound = bearing_bounds(BEARING_BOOK, summary).get("margin.effects", "")
    for effect in (summary.get("margin") or {}).get("effects", ())[:_CHANGES]:
        margins = effect["low_margin"], effect["high_margin"]
        if max(margins) > _WORTH * margin or margin > _WORTH * min(margins):
            ends = " to ".join(map(ratio_text, margins))
            value = _value(case, effect["key"], given.get(effect["key"]))
            yield _name(effect), value, with_units_kept(input_range(effect)), f"{bound} {ends}".strip()


def life_texts(bearings: Mapping[str, Iterable[Row]]) -> Iterator[Text]:
    """Sentences with the rating lives and the static safety of bearings, and with the numbers from which they
    follow, at the operating point and over a duty cycle; none if no row is a life.

    ``bearings``, rows of each bearing by its place, which the sentence names; bearings with equal numbers
    share a sentence.
    """
    rows = {
        place: {_bearing_key(row.key): row for row in of_bearing} for place, of_bearing in bearings.items()
    }
    for name, keys in FIRST_PAGE_OF_LIFE.items():
        texts = {place: _life_text(of_bearing, keys) for place, of_bearing in rows.items()}
        for text in filter(None, dict.fromkeys(texts.values())):
            places = " and ".join(place for place, other in texts.items() if place and other == text)
            about = ", ".join(filter(None, [SENTENCES[f"rating_life_{name}"], places]))
            yield Text(with_units_kept(f"{about}: {text}."), "small")


def _bearing_key(key: str) -> str:
    """Return the bearing key for a number at one end of a drive."""
    return key.removeprefix("end.").replace("duty_", "duty.", 1) if key.startswith("end.") else key


def _life_text(rows: Mapping[str, Row], keys: Iterable[str]) -> str:
    """Numbers of the rating life of a bearing with their symbols, and the sources of the load ratings."""
    known = {_symbol(key): rows[key] for key in keys if key in rows}
    texts = [f"{symbol} {_equals(row)}" for symbol, row in known.items()]
    notes = {symbol: row.note.lstrip(", ") for symbol, row in known.items() if symbol in ("C", "C0")}
    for source in dict.fromkeys(notes.values()):
        texts.append(f"{', '.join(symbol for symbol, note in notes.items() if note == source)} {source}")
    return "; ".join(texts)


def _symbol(key: str) -> str:
    """Symbol of a number of the rating life: the last word of its label at the operating point. A minimum
    over a duty cycle is named.
    """
    symbol = BEARING_BOOK[f"life.{key.partition('.')[2]}"].label.rpartition(" ")[2]
    return f"minimum {symbol}" if ", minimum " in BEARING_BOOK[key].label else symbol


def _equals(row: Row) -> str:
    """Value with its unit after the sign "=", or after the words or the sign of a bound."""
    return row.amount if row.bound or row.amount.startswith("above") else f"= {row.amount}"


def _with_chance(summary: Mapping[str, Any], row: Row) -> Row:
    """Row of a bearing; its probability as a sentence has it, which is not 0."""
    if row.key != "uncertainty.breakdown_probability":
        return row
    uncertainty = summary["uncertainty"]
    if uncertainty.get("failed"):
        return row
    text = chance_text(uncertainty["breakdown_probability"], uncertainty["breakdown_probability_error"])
    return replace(row, value=text.partition(" (")[0], unit="")


def _name(entry: Mapping[str, Any]) -> str:
    """Name of an input of the analysis of a margin."""
    return printable(entry["label"])


def _share_text(index: Mapping[str, Any]) -> str:
    return f"{readable(100.0 * index['total'], 2)}\xa0%"


def _basis(entry: Mapping[str, Any]) -> str:
    """Origin of the range of an uncertain input, in a few words."""
    reason: str = entry["reason"]
    return f"range: {reason.partition(':')[0]}" if reason else "range of the file"


def _value(case: BearingCase, key: str, value: Any) -> str:
    """Return the value of an input in the margin analysis; for films, the method."""
    if key == FILMS:
        return HOW[case.contacts]
    if isinstance(value, int | float) and key != OF_TABLE:
        return input_text(case, key, value)
    return "a table" if value is None or not isinstance(value, float) else f"{readable(value)} times"


def usual_range(case: BearingCase | DriveCase, key: str) -> str:
    """Return the usual range of a bearing input; a capacitance in a drive circuit has the range of a
    bearing's motor.
    """
    end, inner = end_and_key(key)
    bearing = case.bearings[ENDS.index(end) if end in ENDS else 0] if isinstance(case, DriveCase) else case
    ends = {change.key: change.ends for change in changes_of(bearing)}.get(inner)
    given = flattened(case.to_dict()).get(inner)
    if ends is None and given and inner.startswith("circuit.") and inner.endswith("_capacitance"):
        ends = (1.0 - MOTOR) * given, (1.0 + MOTOR) * given
    if ends is None:
        return "none known"
    return with_units_kept(input_range({"key": inner, "low": ends[0], "high": ends[1]}))


def measure_first_table(rows: Iterable[tuple[str, str, str, str]], *, ranked: bool = False) -> Table:
    """Table of the inputs to measure first; ``ranked``, whether they have the largest shares of a
    spread.
    """
    which = "the inputs that matter most" if ranked else "inputs behind the answer, not ranked"
    heads, shares = ("input", "value", "usual range", "why"), (0.26, 0.13, 0.17, 0.44)
    return Table(f"Measure first: {which}", heads, tuple(rows), shares=shares)


def machine_of(case: BearingCase | DriveCase, summary: Mapping[str, Any]) -> str:
    """Machine in a sentence: bearing, load, speed, temperature and oil, and inverter and motor if known."""
    given = flattened(case.to_dict())
    texts = {key: input_text(case, key, value) for key, value in given.items() if key in _SAID}
    if isinstance(case, BearingCase):
        sentence = _bearing(case, summary["lubricant"]["viscosity"])
        if case.motor is not None:
            voltage, *motor = (texts[key] for key in _MOTOR)
            sentence += f"; common-mode voltage {voltage} peak, {_motor(*motor)}"
    else:
        source = "Measured common-mode voltage"
        if not case.source.measured:
            at = f" at {texts['source.switching_frequency']}" if "source.switching_frequency" in texts else ""
            link = texts["source.dc_link"]
            source = f"Inverter with {case.source.modulation} modulation{at} on a DC link of {link}"
        names = ("winding_rotor_capacitance", "rotor_frame_capacitance")
        motor = [amount(case.circuit.capacitances[name], "F") for name in names]
        first, second = map(_bearing, case.bearings)
        both = f"two bearings: {first}"
        if first != second:
            both = "; ".join(
                f"{place}: {bearing}"
                for place, bearing in zip(NAMES_OF_ENDS.values(), (first, second), strict=True)
            )
        sentence = f"{source}, {_motor(*motor)}; {both}"
    if "duty" in summary:
        sentence += (
            f"; in addition to this operation a duty cycle of {readable(summary['duty']['duration'], 6)} s"
        )
    return with_units_kept(f"{capital(sentence)}.")


_MOTOR = (
    "motor.common_mode_voltage", "motor.winding_rotor_capacitance", "motor.rotor_frame_capacitance",
)  # fmt: skip
_SAID = (*_MOTOR, "source.switching_frequency", "source.dc_link")


def _motor(winding_rotor: str, rotor_frame: str) -> str:
    return f"motor with {winding_rotor} from winding to rotor and {rotor_frame} from rotor to frame"


def _bearing(case: BearingCase, viscosity: float | None = None) -> str:
    """Bearing with its load, speed, temperature and oil. ``viscosity`` at ambient pressure [Pa s]."""
    bearing, oil = case.bearing, case.lubricant.temperature
    number = "bearing" if bearing.pair is None else "bearings"
    name = " ".join(filter(None, [bearing.kind, number, printable(bearing.name or "")]))
    if bearing.pair is not None:
        name = f"pair of {name} in {bearing.pair.arrangement} arrangement"
    materials = (
        [] if bearing.element_material == "steel" else [f"{printable(bearing.element_material)} elements"]
    )
    materials += ["insulated"] if bearing.coating is not None else []
    loads = {"radial": bearing.radial_load, "axial": bearing.axial_load}
    load = " and ".join(f"{readable(value, 4)} N {way}" for way, value in loads.items() if value)
    lubricant = f"oil {printable(case.lubricant.base or '')}".strip()
    if oil is not None:
        table = {key: value for key, value in oil.model_dump().items() if value is not None}
        lubricant = "oil" if oil.iso_vg is None else f"oil ISO VG {oil.iso_vg}"
        points = [
            f"{readable(1e6 * table[f'kinematic_viscosity_{at}'], 4)} mm²/s at {at} °C"
            for at in (40, 100)
            if f"kinematic_viscosity_{at}" in table
        ]
        lubricant = " of ".join(filter(None, [lubricant, " and ".join(points)]))
    if bearing.supply == "grease":
        lubricant = f"grease with {lubricant}"
    at = "" if viscosity is None else f" ({readable(1e3 * viscosity)} mPa s in operation)"
    running = f"at {' and '.join(operating_point(bearing.inner_speed, bearing.oil_temperature))}"
    return ", ".join([name, *materials, f"{load} load", running, f"{lubricant}{at}"])
