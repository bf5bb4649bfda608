"""Fields of the source of a drive: its modulation, or a measured waveform."""

from __future__ import annotations

from ehlectric.app.fields.drive_rules import OF_CARRIER, SWITCHING
from ehlectric.app.fields.field import Field, Group, Way, fields_of
from ehlectric.app.inputs import Inputs
from ehlectric.quantities.alternatives import DESCRIBED, MEASURED
from ehlectric.quantities.inputs import form


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

_WAYS = {
    "source.dc_link": Field(
        "source.way",
        "Common-mode voltage",
        kind="ways",
        ways=(
            Way("Measured waveform", {}, "source.file", listed=False),
            Way("Described by its modulation", _SOURCE),
        ),
    ),
    "source.pole_pairs": Field(
        "source.frequency_way",
        "Fundamental frequency",
        kind="ways",
        ways=(
            Way("Follows the speed", {"source.pole_pairs": 2}, "source.pole_pairs"),
            Way("The same at all speeds", {"source.fundamental_frequency": "100 Hz"}),
        ),
        when=_described,
    ),
    "source.overshoot": Field(
        "source.ringing_way",
        "Ringing",
        kind="ways",
        ways=(
            Way("At the end of each edge", _RINGING, "source.overshoot"),
            Way("None", dict.fromkeys(_RINGING)),
        ),
        when=_described,
    ),
}
_SHOWN = {
    **{f"source.{key}": {"when": _described} for key in DESCRIBED},
    **{f"source.{key}": {"when": _measured} for key in MEASURED},
    **{f"source.{key}": {"when": _carrier} for key in OF_CARRIER},
    "source.pole_pairs": {"when": _follows},
    "source.fundamental_frequency": {"when": _fixed},
    **{key: {"when": _ringing} for key in _RINGING},
}

SOURCE = Group("Source", fields_of(form("drive")["Source"], _SHOWN, _WAYS))
