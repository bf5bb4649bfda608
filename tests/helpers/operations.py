"""Operations of bearings from the numbers of a test in a fixed order."""

from ehlectric.bearing.loads.ring import Operation

_ORDER = ("radial_load", "axial_load", "inner_speed", "outer_speed", "cage_angle")


def operation_in_order(*numbers, **others):
    """Operation with radial load, axial load, speeds of both rings and angle of the cage, as far as given."""
    return Operation(**dict(zip(_ORDER, numbers, strict=False)), **others)
