"""A bearing file of every kind with all of its tables, and its points of operation against each one alone."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric import evaluate, solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.runtime.display import is_number
from tests.helpers.bearings import OIL as SHEET_OIL
from tests.helpers.bearings import OTHERS

OIL = {**SHEET_OIL, "temperature": SHEET_OIL["temperature"] | {"thermal_conductivity": "0.137 W/m/K"}}
MOTOR = {
    **OTHERS["motor"],
    "second_bearing_capacitance": "150 pF",
    "switching_frequency": "10 kHz",
    "rise_time": "0.2 us",
    "voltage_slope": "5 V/ns",
}
DISCHARGE = {
    "dielectric_strength": "15 V/um",
    "conductivity": "1 pS/m",
    "peak_current": "1 A",
    "pit": {"efficiency": 0.2, "melting_energy": "10 GJ/m^3"},
}
LIFE = {"contamination_factor": 0.5, "roughened_rq": "0.3 um"}
POINT = {"inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.05 um"}

_RADIAL = {"radial_clearance": "10 um", "radial_load": "2 kN"}
_FITS = {
    "unmounted_clearance": "25 um",
    "shaft_interference": "10 um",
    "housing_interference": "-5 um",
    "shaft_bore": "10 mm",
    "housing_diameter": "120 mm",
    "housing_material": "cast-iron",
    "element_temperature": "72 degC",
    "shaft_temperature": "75 degC",
    "housing_temperature": "60 degC",
}
_PAIR = {"base": "7208-c", "radial_load": "1 kN", "axial_load": "200 N"}
_OVER_MOULDED = {
    "ring": "outer",
    "thickness": "1 mm",
    "relative_permittivity": 4.2,
    "over_moulded": True,
    "strength": "20 kV/mm",
}
_SUMMITS = {"density": "1e10 1/m^2", "radius": "20 um"}
_CERAMIC = {"element_material": "silicon-nitride"}

# Keys of the table ``bearing`` besides those of ``POINT``.
KINDS: Mapping[str, Mapping[str, Any]] = {
    "deep groove": {"base": "6208", "axial_load": "300 N", **_RADIAL},
    "deep groove with fits": {
        "base": "6208",
        "fits": _FITS,
        "radial_load": "2 kN",
        "axial_load": "300 N",
        "outer_ring_temperature": "60 degC",
        "inner_ring_temperature": "71 degC",
    },
    "deep groove with a coating": {
        "base": "6208",
        **_RADIAL,
        "coating": {"base": "alumina", "resistance": "1 Gohm", "breakdown_voltage": "1 kV"},
        "summits": {**_SUMMITS, "bandwidth": 5.0, "highest": 3.0},
        "parallel_capacitance": "20 pF",
        "contact_resistance": "1 ohm",
        "supply": "oil-air",
    },
    "deep groove with ceramic balls": {
        "base": "6208",
        **_RADIAL,
        **_CERAMIC,
        "element_capacitance": "5 pF",
    },
    "angular contact": {"base": "7208-c", "radial_load": "1 kN", "axial_load": "1 kN"},
    "preloaded pair": {**_PAIR, "pair": {"arrangement": "O", "preload": "300 N"}},
    "pair with play": {**_PAIR, "pair": {"arrangement": "X", "axial_clearance": "10 um"}},
    "four-point contact": {
        "base": "QJ 208",
        "radial_clearance": "20 um",
        "radial_load": "1 kN",
        "axial_load": "2 kN",
    },
    "thrust ball": {"base": "51208", "axial_load": "5 kN", "inner_speed": "1000 rpm"},
    "cylindrical": {
        "base": "nu-208",
        "profile": "logarithmic",
        "radial_clearance": "20 um",
        "radial_load": "4 kN",
    },
    "cylindrical with ceramic rollers": {
        "base": "nu-208",
        "profile": "logarithmic",
        "radial_clearance": "20 um",
        "radial_load": "4 kN",
        **_CERAMIC,
    },
    "tapered": {"base": "32208", "radial_load": "4 kN", "axial_load": "2 kN"},
    "tapered pair": {
        "base": "32208",
        "radial_load": "4 kN",
        "axial_load": "1 kN",
        "pair": {"arrangement": "O", "preload": "500 N"},
    },
    "needle": {"base": "HK 2020", "radial_clearance": "20 um", "radial_load": "1.5 kN"},
    "needle with a coating": {
        "base": "NK 20/20",
        "radial_clearance": "20 um",
        "radial_load": "1.5 kN",
        "composite_rq": "0.1 um",
        "summits": {**_SUMMITS, "height_deviation": "0.09 um"},
        "coating": _OVER_MOULDED,
    },
    "thrust needle": {"base": "AXK 4060", "axial_load": "5 kN", "inner_speed": "1000 rpm"},
}


def bearing_of(
    kind: str, *, contacts: str = "atlas", lubricant: Mapping[str, Any] = OIL, **tables: Any
) -> Any:
    """Case of a bearing of a kind of ``KINDS`` with life, discharge and motor."""
    parts = {"bearing": {**POINT, "life": LIFE, **KINDS[kind]}, "lubricant": lubricant}
    others = {"contacts": contacts, "discharge": DISCHARGE, "motor": MOTOR}
    return BearingCase.from_dict({**parts, **others, **tables})


def numbers_of(case: BearingCase) -> dict[str, float]:
    """Numbers of a case other than 0 that may differ between points, by dotted key."""
    inputs = flattened(case.to_dict())
    return {
        key: float(value)
        for key, value in inputs.items()
        if is_quantity(key) and is_number(value) and value != 0.0 and not key.startswith(("solver", "ranges"))
    }


# Keys whose numbers may only fall, as the dimensions of a designation leave no room.
_FALLING = (
    "bearing.bore",
    "bearing.element_diameter",
    "bearing.composite_rq",
    "motor.switching_frequency",
    "motor.rise_time",
)


def near(key: str, value: float, parts: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Values of a key that differ from one by relative parts, at least 0."""
    return value * (1.0 - parts if key in _FALLING else 1.0 + parts)


# Numbers that are rounding errors themselves: imbalance, and the error by a load that is left out.
_ROUNDING = ("mechanics.residual", "bearing.interpolation_error")

# Sizes that are rounding errors, of quantities that symmetry makes 0 [m, N m], and of shares of time near 1.
_SMALL = {
    "mechanics.radial_displacement": 1e-12,
    "mechanics.axial_displacement": 1e-12,
    "mechanics.lateral_displacement": 1e-12,
    "mechanics.moment": 1e-9,
    "mechanics.lateral_moment": 1e-9,
}
_OF_SHARES = 1e-14


def differences(
    case: BearingCase, given: Mapping[str, Sequence[Any] | np.ndarray[Any, Any]], points: Sequence[int] = ()
) -> list[tuple[Any, ...]]:
    """Values of ``evaluate`` that differ from those of ``solve_bearing`` of the same point, by 1e-8 or more.

    ``points``, places of the points that are compared; all by default.
    """
    found = evaluate(case, given)
    places = points or range(len(next(iter(given.values()))))
    return [(k, *each) for k in places for each in _at_point(case, given, found.isel(point=k), k)]


def _at_point(case: BearingCase, given: Mapping[str, Any], found: Any, k: int) -> Iterator[tuple[Any, ...]]:
    """Keys, values of a point and those of the bearing alone, where both differ."""
    changes = {key: _item(values[k]) for key, values in given.items()}
    reason = "" if found["converged"] else found["reason"].item()
    try:
        summary = summary_of(solve_bearing(case.replace(changes), workers=1).solution)
    except (InputError, ConvergenceError) as error:
        if reason != str(error):
            yield "reason", reason, str(error)
        return
    codes = set(filter(None, found["warning_codes"].item().split("; ")))
    if reason or codes != set(summary["warning_codes"]):
        yield "warning_codes", reason or codes, set(summary["warning_codes"])
    tables = {name: summary[name] for name in ("lubricant", "bearing", "mechanics", "life")}
    for key, value in flattened(tables).items():
        own = found[key].item() if key in found else None
        if not (key in _ROUNDING or key in given or _alike(key, own, value)):
            yield key, own, value


def _item(value: Any) -> Any:
    return value.item() if hasattr(value, "dtype") else value


def _alike(key: str, own: Any, value: Any) -> bool:
    """Whether a value of a point is the value of the bearing alone."""
    if is_number(value):
        least = _OF_SHARES if key.endswith("share") else _SMALL.get(key, 0.0)
        return own is not None and abs(own - value) <= max(least, 1e-8 * abs(value))
    if value is None:
        return own is None or own == "" or own != own
    # Names and lists of a bearing that are equal at all points are no columns.
    return own is None or own == value
