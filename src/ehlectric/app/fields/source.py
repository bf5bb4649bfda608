"""Fields of the source of a drive: its modulation, or a measured waveform."""

from __future__ import annotations

from ehlectric.app.fields.drive_rules import SWITCHING
from ehlectric.app.fields.field import Field, Group, Way
from ehlectric.app.inputs import Inputs


def _number(key: str, label: str, unit: str, ends: tuple[float, float], **more: object) -> Field:
    """Field of a number with the ends of its slider."""
    return Field(key, label, unit, *ends, **more)  # type: ignore[arg-type]


def _measured(inputs: Inputs) -> bool:
    return inputs.value("source.file") is not None


def _described(inputs: Inputs) -> bool:
    return not _measured(inputs)


def _carrier(inputs: Inputs) -> bool:
    return _described(inputs) and inputs.value("source.modulation") != "six-step"


def _follows(inputs: Inputs) -> bool:
    return _described(inputs) and inputs.value("source.pole_pairs") is not None


def _fixed(inputs: Inputs) -> bool:
    return _described(inputs) and inputs.value("source.pole_pairs") is None


def _ringing(inputs: Inputs) -> bool:
    return _described(inputs) and inputs.value("source.overshoot") is not None


# Source of the example.
_SOURCE = {
    "source.dc_link": "560 V",
    "source.modulation": "space-vector",
    SWITCHING: "10 kHz",
    "source.pole_pairs": 2,
    "source.modulation_index": 0.9,
    "source.base_frequency": "100 Hz",
    "source.rise_time": "100 ns",
}
_RINGING = {
    "source.overshoot": "20 %",
    "source.ringing_frequency": "2 MHz",
    "source.ringing_time": "1 us",
}

SOURCE = Group(
    "Source",
    (
        Field(
            "source.way",
            "Common-mode voltage",
            kind="ways",
            ways=(
                Way("Measured waveform", {}, "source.file", listed=False),
                Way("Described by its modulation", _SOURCE),
            ),
        ),
        _number("source.dc_link", "DC link", "V", (24.0, 1500.0), log=True, when=_described),
        Field(
            "source.modulation",
            "Modulation",
            kind="choice",
            choices=("space-vector", "sinusoidal", "six-step"),
            when=_described,
        ),
        _number(SWITCHING, "Switching frequency", "kHz", (1.0, 100.0), log=True, when=_carrier),
        Field(
            "source.frequency_way",
            "Fundamental frequency",
            kind="ways",
            ways=(
                Way("Follows the speed", {"source.pole_pairs": 2}, "source.pole_pairs"),
                Way("The same at all speeds", {"source.fundamental_frequency": "100 Hz"}),
            ),
            when=_described,
        ),
        Field("source.pole_pairs", "Pairs of poles", low=1, high=12, kind="count", when=_follows),
        _number(
            "source.fundamental_frequency",
            "Fundamental frequency",
            "Hz",
            (1.0, 150.0),
            log=True,
            when=_fixed,
        ),
        _number("source.modulation_index", "Modulation index", "", (0.0, 1.15), when=_carrier),
        _number(
            "source.base_frequency",
            "It holds from this frequency on",
            "Hz",
            (10.0, 1000.0),
            log=True,
            when=_carrier,
            optional=True,
        ),
        _number("source.rise_time", "Rise time of an edge", "ns", (1.0, 2000.0), log=True, when=_described),
        Field(
            "source.ringing_way",
            "Ringing",
            kind="ways",
            ways=(
                Way("At the end of each edge", _RINGING, "source.overshoot"),
                Way("None", dict.fromkeys(_RINGING)),
            ),
            when=_described,
        ),
        _number("source.overshoot", "Overshoot", "%", (0.0, 100.0), when=_ringing),
        _number("source.ringing_frequency", "Ringing frequency", "MHz", (0.1, 20.0), log=True, when=_ringing),
        _number("source.ringing_time", "Time of its decay", "us", (0.1, 20.0), log=True, when=_ringing),
        Field("source.column", "Column of the voltage", low=1, high=8, kind="count", when=_measured),
        Field("source.value_unit", "Unit of the voltages", kind="text", when=_measured),
        _number("source.scale", "Factor on the voltages", "", (0.1, 1000.0), log=True, when=_measured),
        Field(
            "source.time_column",
            "Column of the time",
            low=1,
            high=8,
            kind="count",
            when=_measured,
            optional=True,
        ),
        Field("source.time_unit", "Unit of the times", kind="text", when=_measured, optional=True),
        _number(
            "source.step",
            "Or sampling interval",
            "ns",
            (1.0, 1000.0),
            log=True,
            when=_measured,
            optional=True,
        ),
        _number(
            "source.resample",
            "Resample to",
            "ns",
            (10.0, 10_000.0),
            log=True,
            when=_measured,
            optional=True,
        ),
    ),
)
