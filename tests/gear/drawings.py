"""Random drawings of gear pairs: any, usual, and spoilt ones."""

from hypothesis import strategies as st

from tests.gear.pairs import FZG_C_CASE

# Drawings of which most cannot run.
ANY = st.fixed_dictionaries(
    {
        "normal_module": st.floats(0.3e-3, 20e-3),
        "teeth": st.tuples(st.integers(4, 80), st.integers(-120, 200).filter(lambda z: abs(z) >= 4)),
        "normal_pressure_angle": st.floats(0.1, 0.75),
        "helix_angle": st.floats(0.0, 0.9),
        "face_width": st.floats(1e-3, 0.2),
        "centre_distance": st.none() | st.floats(2e-3, 0.8),
        "profile_shift": st.lists(st.floats(-2.0, 2.0), min_size=1, max_size=2),
        "tip_diameter": st.none() | st.lists(st.floats(2e-3, 1.5), min_size=2, max_size=2),
    }
)

# Standard gears without undercut.
USUAL = st.fixed_dictionaries(
    {
        "normal_module": st.floats(1e-3, 8e-3),
        "teeth": st.tuples(st.integers(18, 40), st.integers(20, 120)),
        "normal_pressure_angle": st.floats(0.33, 0.44),
        "helix_angle": st.just(0.0) | st.floats(1e-9, 0.6),
        "face_width": st.floats(5e-3, 60e-3),
        "profile_shift": st.lists(st.floats(0.0, 0.3), min_size=2, max_size=2),
    }
)

LAWS = st.sampled_from(["stiffness", "rigid", "iso", "tip-relief"])

# Values that no key of a drawing may have.
_WRONG = st.sampled_from(
    ["", "wide", "2,5 mm", "20 parsec", "-3 mm", "20 kg", -1.0, 0, True, [], [[1]], {"value": 1}]
) | st.floats(1e3, 1e300)

_KEYS = ("normal_module", "teeth", "normal_pressure_angle", "helix_angle", "face_width")


def _spoilt(drawing, key, value):
    return {**drawing, key: value}


# Usual drawings of which one key has a wrong value, and any drawings.
SPOILT = ANY | st.builds(_spoilt, USUAL, st.sampled_from(_KEYS), _WRONG)


def tables_of_drawing(drawing, law):
    """Tables of a gear file with a drawing, by a law of load sharing."""
    numbers = {key: value for key, value in drawing.items() if value is not None}
    operation = {**FZG_C_CASE["gear"]["operation"], "load_sharing": law}
    gear = {"flank_ra": "0.3 um", "material": "steel", "operation": operation, **numbers}
    return {**FZG_C_CASE, "gear": gear}
