"""Tables of a gear file: the drawing of a gear pair, its operating point, and the electrical contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, GetJsonSchemaHandler, model_validator
from pydantic_core import CoreSchema

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount, AmountOrWord, Amounts, Count, amount_at, with_bounds
from ehlectric.cases.mean_heights import rq_of
from ehlectric.cases.oil_inputs import library_choice
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown, within
from ehlectric.quantities.inputs import inputs

Sharing = Literal["stiffness", "rigid", "iso", "tip-relief"]
Conduction = Literal["by-film", "always", "never"]

# Numbers of teeth of a gear and of a ring.
_LEAST_TEETH, _MOST_TEETH = 4, 2000


@dataclass(frozen=True)
class OfBothGears(Amounts):
    """Pydantic annotation for numbers of gear 1 and of gear 2, parsed to a tuple of one or two floats, or to
    a float that holds for both.
    """

    numbered: ClassVar[bool] = True

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        both = {**super().__get_pydantic_json_schema__(core, handler), "maxItems": 2}
        each = self.each.__get_pydantic_json_schema__(core, handler)
        return {"anyOf": [each, both]} if self.single else both

    @property
    def several(self) -> str:
        """Numbers of values that are allowed, for messages and the documentation."""
        number = "two values" if self.least == 2 else "one or two values"
        value = "one value for both gears, or " if self.single else ""
        return f"{value}a list of {number}, of gear 1 and of gear 2"

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"{self.several}, each {self.each.takes}"

    def parse(self, entry: object, *, written: bool = False) -> float | tuple[float, ...]:
        """Convert an entry of a case to values in SI units. Raises InputError for another number of values,
        and for a value that is not valid.
        """
        several = isinstance(entry, list | tuple) or getattr(entry, "ndim", 0) == 1
        if self.single and not several:
            return self.each.parse(entry, written=written)
        if not several or not self.least <= len(entry) <= 2:  # type: ignore[arg-type]
            raise InputError(got=shown(entry), takes=self.takes)
        values = []
        for number, item in enumerate(entry, 1):  # type: ignore[arg-type, var-annotated]
            with within(str(number)):
                values.append(self.each.parse(item, written=written))
        return tuple(values)


def _both(key: str, least: int = 1, *, single: bool = False) -> OfBothGears:
    """Annotation of the numbers of both gears of a key."""
    return OfBothGears(with_bounds(Amount, inputs()["gear"][key]), least, single)


def _teeth(entry: object) -> tuple[int, int]:
    """Numbers of teeth of both gears; the second one is negative for a ring."""
    takes = "two whole numbers, of gear 1 and of gear 2; of a ring as gear 2 a negative one, as [20, -70]"
    if not isinstance(entry, list | tuple) or len(entry) != 2:
        raise InputError(got=shown(entry), takes=takes)
    with within("1"):
        first = Count(_LEAST_TEETH, _MOST_TEETH, "teeth of gear 1").parse(entry[0])
    ring = isinstance(entry[1], int) and entry[1] < 0
    with within("2"):
        second = Count(_LEAST_TEETH, _MOST_TEETH, "teeth of gear 2").parse(-entry[1] if ring else entry[1])
    return first, -second if ring else second


def conducting_solids() -> list[str]:
    """Names of the solids of the library that conduct: the film is the only insulation of a mesh."""
    return library.solid_names(conducting=True)


_BULK = amount_at("gear.operation.bulk_temperature")


class GearOperation(Table, book="gear.operation"):
    """Operating point of a gear pair."""

    pinion_torque: float
    pinion_speed: float
    oil_temperature: float
    bulk_temperature: Annotated[float | str, AmountOrWord(_BULK, "iso")] = "iso"
    friction_coefficient: float | None = None
    boundary_friction: float | None = None
    load_sharing: Sharing = "stiffness"
    application_factor: float = 1.0
    dynamic_factor: float = 1.0
    face_load_factor: float = 1.0
    transverse_load_factor: float = 1.0

    @property
    def load_factor(self) -> float:
        """Product of all load factors."""
        return (
            self.application_factor
            * self.dynamic_factor
            * self.face_load_factor
            * self.transverse_load_factor
        )

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.checked()

    def checked(self) -> Self:
        """Table itself. Raises InputError for a missing temperature of the flanks, and without a torque."""
        if self.bulk_temperature == "iso" and self.friction_coefficient is None:
            raise InputError.worded(
                "bulk_temperature",
                "missing; give the temperature of the flanks, or friction_coefficient, with which "
                "ISO/TS 6336-22 estimates it",
            )
        if self.pinion_torque == 0.0:
            raise InputError("pinion_torque", got="0", takes="a torque; its sign says which gear drives")
        return self


class GearContact(Table, book="gear.contact"):
    """Electrical contact of the flanks."""

    voltage: float | None = None
    conduction: Conduction = "by-film"
    contact_resistance: float | None = None
    reference_area: float | None = None
    weibull_shape: float = 10.0


# Key that is missing next to a given one of tip relief, with what is usual.
_WITHOUT_RELIEF = ("tip_relief", "tip_relief_length", "")
_WITHOUT_LENGTH = (
    "tip_relief_length",
    "tip_relief",
    (
        ": a length from the tip along the path of contact. Long relief reaches the point of single contact, "
        "(transverse contact ratio - 1) times the base pitch; short relief reaches half as far"
    ),
)


class Gear(Table, book="gear"):
    """Drawing of a gear pair, with its operating point."""

    normal_module: float
    teeth: Annotated[tuple[int, int], BeforeValidator(_teeth)]
    normal_pressure_angle: float
    helix_angle: float = 0.0
    hand: Literal["left", "right"] | None = None
    centre_distance: float | None = None
    profile_shift: Annotated[tuple[float, ...], _both("profile_shift")] | None = None
    face_width: float
    tip_diameter: Annotated[tuple[float, ...], _both("tip_diameter", 2)] | None = None
    normal_backlash: float | None = None
    flank_ra: Annotated[float | tuple[float, ...], _both("flank_ra", single=True)] | None = None
    composite_rq: float | None = None
    rq_over_ra: float | None = None
    summit_height: float = 2.0
    material: Annotated[str, library_choice(conducting_solids)]
    tip_relief: Annotated[float | tuple[float, ...], _both("tip_relief", single=True)] | None = None
    tip_relief_length: float | None = None
    lead_crowning: float = 0.0
    operation: GearOperation
    contact: GearContact = GearContact()

    @property
    def rq(self) -> float:
        """Composite roughness Rq of both flanks [m]."""
        if self.composite_rq is not None:
            return self.composite_rq
        assert self.flank_ra is not None
        first, second = both(self.flank_ra)
        return float(rq_of(math.hypot(first, second), self.rq_over_ra))

    @model_validator(mode="after")
    def _check(self) -> Self:
        return self.checked()

    def checked(self) -> Self:
        """Table itself. Raises InputError for keys that exclude each other or need another one."""
        keys = ("composite_rq", "flank_ra")
        self.check_alternatives(keys, f"either {' or '.join(keys)}", needed=True)
        if self.rq_over_ra is not None and self.flank_ra is None:
            raise InputError("rq_over_ra", got="it without flank_ra", takes="flank_ra, which it converts")
        relief, length = self.tip_relief is not None, self.tip_relief_length is not None
        if relief != length:
            missing, given, usual = _WITHOUT_LENGTH if relief else _WITHOUT_RELIEF
            raise InputError.worded(missing, f"missing; {given} needs it{usual}")
        modified = relief or self.lead_crowning > 0.0
        if modified and self.operation.load_sharing != "stiffness":
            raise InputError(
                "operation.load_sharing",
                got=f"{self.operation.load_sharing!r} with relief or crowning",
                takes="'stiffness': the other laws do not use them",
            )
        return self


def both(values: float | tuple[float, ...]) -> tuple[float, float]:
    """Values of both gears; a single one holds for both."""
    return (values[0], values[-1]) if isinstance(values, tuple) else (values, values)
