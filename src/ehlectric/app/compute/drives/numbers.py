"""Numbers and tables of a drive as its page shows them, from its summary."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.answers.bearing import Number, Table
from ehlectric.app.answers.told import Told, beside
from ehlectric.cases.drives.case import ENDS
from ehlectric.quantities.drive_results import NAMES_OF_ENDS
from ehlectric.quantities.formats import UNITS, amount, number_text
from ehlectric.quantities.units import unit_for
from ehlectric.tables.drive import end_cells, remedy_cells

_NONE = "none"


def prepared_numbers(summary: Mapping[str, Any], told: tuple[Told, ...]) -> tuple[Number, ...]:
    """Numbers of a drive that is not simulated: of its source, its circuit and its films.

    Parameters
    ----------
    summary : mapping
        Tables of ``drive.summary.checked_summary``.
    told : tuple of Told
        Warnings.
    """
    return _told(
        [
            _of_ends(summary, "Bearing voltage at the peak", "voltage_at_peak", "V"),
            _breakdown(summary),
            _of_ends(summary, "Bearing capacitance", "capacitance", "F"),
            _of_ends(summary, "Capacitive divider", "voltage_ratio", "%"),
            _source(summary),
            *_machine(summary),
        ],
        told,
    )


def simulated_numbers(summary: Mapping[str, Any], told: tuple[Told, ...]) -> tuple[Number, ...]:
    """Numbers of a simulated drive.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.
    told : tuple of Told
        Warnings.
    """
    found = [
        _of_ends(summary, "Discharges per second", "events_per_second", "1/s", _bounds),
        _of_ends(summary, "Largest bearing voltage", "peak_voltage", "V"),
        _breakdown(summary),
        _of_ends(summary, "Mean voltage of a discharge", "voltage_mean", "V"),
        _of_ends(summary, "Mean energy of a discharge", "energy_mean", "J"),
        _of_ends(summary, "Power of the discharges", "power", "W"),
        _of_ends(summary, "Current density over the Hertz areas", "current_density", "A/mm²"),
        _of_ends(summary, "Bearing capacitance", "capacitance", "F"),
        _source(summary),
    ]
    if not summary["converged"]:
        note = "not converged: do not use this value"
        found = [replace(one, note=note, known=False) for one in found]
    return _told(found, told)


def merged(told: Iterable[Told]) -> tuple[Told, ...]:
    """Warnings of which those of one code, as of both bearings, are one with both texts."""
    found: dict[str, Told] = {}
    for one in told:
        before = found.get(one.code)
        found[one.code] = one if before is None else replace(before, text=f"{before.text}. {one.text}")
    return tuple(found.values())


def ends_table(summary: Mapping[str, Any]) -> Table:
    """Numbers of both bearings side by side, as the command prints them."""
    rows = ((_indented(name), *cells) for name, *cells in end_cells(summary))
    return Table("As the command prints them", ("", *NAMES_OF_ENDS.values(), ""), tuple(rows))


def _indented(name: str) -> str:
    """Name whose leading spaces a browser shows."""
    bare = name.lstrip()
    return "\u2003" * (len(name) > len(bare)) + bare


def remedies_table(summary: Mapping[str, Any]) -> Table | None:
    """The drive and its remedies side by side; None without remedies."""
    if not summary["remedies"]:
        return None
    (_, *heads), *rows = remedy_cells(summary)
    return Table("Worse bearing of each", ("", *heads), tuple(rows))


def _of_ends(summary: Mapping[str, Any], label: str, key: str, unit: str, note: Any = None) -> Number:
    """Number of both bearings: that of the drive end, and the other one as its note where it differs."""
    values, name = [summary[end][key] for end in ENDS], f"end.{key}"
    texts = [text_of(value, unit) for value in values]
    notes = [note(summary[end]) if note is not None else "" for end in ENDS]
    first, second = NAMES_OF_ENDS.values()
    if texts[0] == texts[1] and notes[0] == notes[1]:
        words = "; ".join(filter(None, [notes[0], "each of both bearings"]))
        return Number(name, label, texts[0], note=words, known=values[0] is not None)
    own = f"{first}{', ' if notes[0] else ''}{notes[0]}"
    other = f"{second}: {texts[1]}{', ' if notes[1] else ''}{notes[1]}"
    return Number(name, label, texts[0], note=f"{own}; {other}", known=values[0] is not None)


def _bounds(end: Mapping[str, Any]) -> str:
    low, high = (_short(end[f"events_per_second_{bound}"]) for bound in ("low", "high"))
    return f"{low} to {high} at 95 %"


def _breakdown(summary: Mapping[str, Any]) -> Number:
    found = _of_ends(summary, "Breakdown voltage", "breakdown_voltage", "V")
    if all(summary[end]["breakdown_voltage"] is None for end in ENDS):
        return replace(found, note="ceramic elements insulate")
    shapes = {summary[end]["weibull_shape"] for end in ENDS} - {None}
    scatter = " at a probability of 63.2 %" if shapes else ""
    return replace(found, bound="≤", note=f"upper bound{scatter}, weakest position; {found.note}")


def _source(summary: Mapping[str, Any]) -> Number:
    edges = summary["source"]["edges_per_second"]
    note = "measured waveform" if edges is None else f"peak, {_short(edges)} edges per second"
    return Number("source.peak", "Common-mode voltage", amount(summary["source"]["peak"], "V"), note=note)


def _machine(summary: Mapping[str, Any]) -> Iterator[Number]:
    """Capacitances of the machine as one number, that of winding and rotor."""
    circuit = summary["circuit"]
    names = {
        "rotor_frame_capacitance": "rotor to frame",
        "winding_frame_capacitance": "winding to frame",
    }
    others = [f"{words} {amount(circuit[key], 'F')}" for key, words in names.items() if key in circuit]
    text = amount(circuit["winding_rotor_capacitance"], "F")
    yield Number("circuit.winding_rotor_capacitance", "Winding to rotor", text, note="; ".join(others))


def _told(numbers: Iterable[Number], told: tuple[Told, ...]) -> tuple[Number, ...]:
    return tuple(replace(one, told=beside(told, one.name)) for one in numbers)


def text_of(value: float | None, unit: str) -> str:
    r"""Value with its unit and three digits; "none" where there is none.

    Examples
    --------
    >>> text_of(4.6321, "V"), text_of(1.7e-8, "J"), text_of(0.0461, "%"), text_of(28600.0, "1/s")
    ('4.63 V', '17 nJ', '4.61 %', '28\u202f600')
    """
    if value is None:
        return _NONE
    if unit == "1/s":
        return _short(value)
    if unit in UNITS and UNITS[unit][1] != 1.0:
        return f"{number_text(value * UNITS[unit][1])} {unit}"
    factor, prefixed = unit_for(abs(value), unit, least=1.0) if value else (1.0, unit)
    return f"{factor * value:.3g} {prefixed}"


def _short(value: float) -> str:
    """Number with three digits, and groups of three of them where it is large."""
    rounded = float(f"{value:.3g}")
    return f"{rounded:,.0f}".replace(",", "\u202f") if rounded >= 1000.0 else f"{rounded:.12g}"
