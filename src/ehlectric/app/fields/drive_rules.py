"""Rules of the inputs of a drive: keys that exclude each other, and those that others need."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.app.inputs import Inputs
from ehlectric.quantities.alternatives import ALTERNATIVES, DESCRIBED, MEASURED, dotted
from ehlectric.quantities.units import rounded, split

# Groups of alternatives of a drive: inputs have the keys of one row of each.
DRIVE_ALTERNATIVES = (
    *dotted("source", ((DESCRIBED, MEASURED), *ALTERNATIVES["source"])),
    *dotted("breakdown", ALTERNATIVES["breakdown"]),
)

# Keys of a described source that six-step modulation has not, with first values of those that others need.
OF_CARRIER = {"switching_frequency": "10 kHz", "modulation_index": 0.9, "base_frequency": None}

SWITCHING = "source.switching_frequency"

# Title of the remedy whose frequency follows that of the drive.
HALF = "Half the switching frequency"

# Usual remedies by their titles, with what they change; those of the example have its values.
PRESETS: Mapping[str, Mapping[str, Any]] = {
    "Grounding ring": {"circuit.grounding_ring_resistance": "1 ohm"},
    "Ceramic balls": {
        "bearings.bearing.element_material": "silicon-nitride",
        "bearings.bearing.element_capacitance": "5 pF",
    },
    "Coated rings": {
        "bearings.bearing.coating.base": "schaeffler-j20aa",
        "bearings.bearing.coating.relative_permittivity": 9.0,
    },
    "Common-mode choke": {
        "circuit.common_mode_inductance": "5 mH",
        "circuit.common_mode_resistance": "500 ohm",
    },
    HALF: {},
}


def fitted_to_source(inputs: Inputs) -> dict[str, Any]:
    """Changes that the modulation of a described source needs.

    Examples
    --------
    >>> fitted_to_source(Inputs({"source": {"modulation": "six-step", "modulation_index": 0.9}}))
    {'source.modulation_index': None}
    """
    modulation = inputs.value("source.modulation")
    given = {key: inputs.value(f"source.{key}") for key in OF_CARRIER}
    if modulation == "six-step":
        return {f"source.{key}": None for key, value in given.items() if value is not None}
    if modulation is None:
        return {}
    lacking = {key: first for key, first in OF_CARRIER.items() if given[key] is None and first is not None}
    return {f"source.{key}": first for key, first in lacking.items()}


def half_of(value: object) -> str | None:
    """Half of a frequency as a person writes it; None where it is no number with a unit.

    Examples
    --------
    >>> half_of("10 kHz"), half_of("fast"), half_of(None)
    ('5 kHz', None, None)
    """
    found = split(str(value))
    return f"{rounded(0.5 * found[0])} {found[1]}" if found is not None and found[1] else None


def remedies_of(inputs: Inputs) -> dict[str, Mapping[str, Any]]:
    """Changes of the remedies of a drive by their titles; what is no remedy is left out."""
    given = inputs.value("remedies")
    found = {}
    for one in given if isinstance(given, list) else []:
        changes = one.get("changes") if isinstance(one, Mapping) else None
        if isinstance(changes, Mapping):
            found[str(one.get("title", ""))] = changes
    return found


def changes_of(inputs: Inputs, title: str) -> Mapping[str, Any] | None:
    """Changes of a usual remedy; None where the inputs do not have what it changes.

    Examples
    --------
    >>> changes_of(Inputs({"source": {"switching_frequency": "10 kHz"}}), HALF)
    {'source.switching_frequency': '5 kHz'}
    """
    if title != HALF:
        return PRESETS[title]
    half = half_of(inputs.value(SWITCHING))
    return None if half is None else {SWITCHING: half}


def with_remedy(inputs: Inputs, title: str, changes: Mapping[str, Any]) -> list[Any]:
    """List of the remedies with a further one."""
    given = inputs.value("remedies")
    return [*(given if isinstance(given, list) else []), {"title": title, "changes": dict(changes)}]


def without_remedy(inputs: Inputs, title: str) -> list[Any]:
    """List of the remedies without those of a title."""
    given = inputs.value("remedies")
    return [
        one
        for one in (given if isinstance(given, list) else [])
        if not isinstance(one, Mapping) or str(one.get("title", "")) != title
    ]


def with_fitted_remedies(before: Inputs, after: Inputs) -> Inputs:
    """Inputs whose remedy with half the switching frequency follows a new frequency.

    Parameters
    ----------
    before, after : Inputs
        Inputs before and after a change.
    """
    old, new = before.value(SWITCHING), after.value(SWITCHING)
    remedies = after.value("remedies")
    if old == new or not isinstance(remedies, list):
        return after
    return after.changed({"remedies": [_fitted(one, half_of(old), half_of(new)) for one in remedies]})


def _fitted(remedy: Any, old: str | None, new: str | None) -> Any:
    """Remedy with another frequency where it had half the old one and nothing else."""
    own = remedy.get("changes") if isinstance(remedy, Mapping) else None
    if not isinstance(own, Mapping) or old is None or new is None or dict(own) != {SWITCHING: old}:
        return remedy
    return {**remedy, "changes": {SWITCHING: new}}
