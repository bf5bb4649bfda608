"""Fields for a gear pair, in the order of a drawing, and the lists with values of both gears."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from typing import Any, Literal

from ehlectric.app.form_fields.field import (
    VEHICLE,
    VEHICLE_TABLE,
    always,
    equal,
    given,
    group_of,
    unequal,
)
from ehlectric.app.form_fields.oil_fields import oil
from ehlectric.app.page_inputs import Inputs, example_inputs
from ehlectric.quantities.inputs import form, key_of_list
from ehlectric.quantities.units import in_unit, rounded, split

_BULK = "gear.operation.bulk_temperature"
_sheet = given("lubricant.temperature")

# When fields are shown.
_SHOWN: dict[str, dict[str, Any]] = {
    **{f"gear.flank_ra.{n}": {"when": given("gear.flank_ra")} for n in (1, 2)},
    "gear.rq_over_ra": {"when": given("gear.flank_ra")},
    _BULK: {"when": unequal(_BULK, None, "iso"), "strict": True},
    "gear.contact.reference_area": {"when": equal("gear.contact.conduction", None, "by-film")},
}

# When groups are shown.
_GROUPS = {VEHICLE: given(VEHICLE_TABLE)}

GEAR_GROUPS = tuple(
    oil("gear", **{"temperature.thermal_conductivity": {"when": _sheet}})
    if title == "Oil"
    else group_of("gear", title, _SHOWN, when=_GROUPS.get(title, always))
    for title in form("gear")
)


def with_lists(inputs: Inputs, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Changes in which a value of one gear is a change of its list; a single value holds for both gears.

    Examples
    --------
    >>> with_lists(Inputs({"gear": {"profile_shift": [0.3]}}), {"gear.profile_shift.2": 0.1})
    {'gear.profile_shift': [0.3, 0.1]}
    >>> with_lists(Inputs({"gear": {"tip_relief": "8 um"}}), {"gear.tip_relief.1": None})
    {'gear.tip_relief': None}
    """
    result: dict[str, Any] = {}
    for key, value in changes.items():
        name = key_of_list(key)
        if name == key:
            result[key] = value
            continue
        before = result.get(name, inputs.value(name))
        listed = before if isinstance(before, list) else [] if before is None else [before]
        pair = [*listed, "", ""][:2]
        pair[int(key[-1]) - 1] = "" if value is None else value
        while pair and pair[-1] == "":
            pair.pop()
        result[name] = pair or None
    return result


Gears = Literal["helical", "spur"]

# Examples with which the form of each kind of gear pair begins.
GEAR_EXAMPLES: Mapping[Gears, str] = {"helical": "gear_pair", "spur": "gear_spur"}


def gears_of(inputs: Inputs) -> Gears:
    """Kind of a gear pair by its helix angle.

    Examples
    --------
    >>> gears_of(Inputs({"gear": {"helix_angle": "25 deg"}})), gears_of(Inputs({"gear": {"helix_angle": 0}}))
    ('helical', 'spur')
    """
    amount = split(str(inputs.value(_HELIX) or 0))
    return "helical" if amount is None or amount[0] else "spur"


# Inputs that stay if the kind of the gear pair changes.
_STAY = ("lubricant", "discharge", "gear.contact", "gear.operation")


def of_gears(kind: Gears, inputs: Inputs) -> Inputs:
    """Inputs with the drawing and the flanks of the example of a kind of gear pair.

    Oil, strength, voltage and operating point are the present ones. The load shares of relieved spur pairs
    are removed, because helical pairs have none.
    """
    result = example_inputs(GEAR_EXAMPLES[kind]).changed({key: inputs.value(key) for key in _STAY})
    return result.changed({_SHARING: None}) if result.value(_SHARING) == "tip-relief" else result


def rq_of_flanks(inputs: Inputs) -> str | None:
    """Composite Rq of both flanks from Ra of each; None if the inputs do not contain heights without a range.

    Examples
    --------
    >>> rq_of_flanks(Inputs({"gear": {"flank_ra": ["0.3 um", "0.4 um"], "rq_over_ra": 1.2}}))
    '0.6 um'
    """
    # The server loads no tables of cases before a roughness is changed.
    from ehlectric.cases.mean_heights import rq_of

    ra, factor = inputs.value("gear.flank_ra"), inputs.value("gear.rq_over_ra")
    listed = [ra] if isinstance(ra, str) else ra if isinstance(ra, list) else []
    heights = [in_unit(str(height), "um") for height in listed]
    known = [height for height in heights if height is not None]
    ratio = None if factor is None else split(str(factor))
    if not known or known != heights or len(known) > 2 or (factor is not None and ratio is None):
        return None
    return f"{rounded(float(rq_of(math.hypot(known[0], known[-1]), ratio and ratio[0])))} um"


_SHARING = "gear.operation.load_sharing"
_HELIX = "gear.helix_angle"

# Examples whose drawings pages show first: gear pairs, and meshes of the axle.
_DRAWINGS = (*GEAR_EXAMPLES.values(), "e_axle_stage_1", "e_axle_stage_2")

# Inputs that a new drawing changes first, and inputs of the example that do not hold for a new drawing.
_NEW = ("gear.normal_module", "gear.teeth", "gear.normal_pressure_angle", _HELIX)
_FOLLOWING = ("gear.centre_distance", "gear.profile_shift", "gear.tip_diameter", "title")


def of_the_example(before: Inputs, changes: Mapping[str, Any], set_by_user: Collection[str]) -> Iterator[str]:
    """Title and keys of the drawing of an example that a new drawing does not have, so that values follow.

    ``changes``, new values by dotted key; ``set_by_user``, keys that the user has set, whose values stay.

    Examples
    --------
    >>> spur = example_inputs("gear_spur")
    >>> list(of_the_example(spur, {"gear.normal_module": "2 mm"}, {"gear.tip_diameter.1"}))
    ['gear.centre_distance', 'gear.profile_shift', 'title']
    """
    new = {
        key: value
        for key, value in changes.items()
        if key in _NEW and _is_drawn(key, value) and value != before.value(key)
    }
    for example in map(example_inputs, _DRAWINGS):
        if new and all(before.value(key) == example.value(key) for key in _NEW):
            stay = {*changes, *map(key_of_list, set_by_user)}
            yield from (
                key for key in _FOLLOWING if key not in stay and before.value(key) == example.value(key)
            )


def _is_drawn(key: str, value: Any) -> bool:
    """Whether a value is a number or a list of numbers; a drawing of spur gears has no helix angle."""
    if value is None:
        return key == _HELIX
    return all(split(str(each)) is not None for each in (value if isinstance(value, list) else [value]))
