"""Table `bearing.coating` of a bearing file: an insulating coating on a ring, in series with the films."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal, Self

import numpy as np
from pydantic import model_validator

from ehlectric.arrays import Numbers, any_of, as_float
from ehlectric.cases import library
from ehlectric.cases.oil_inputs import library_name
from ehlectric.cases.table import Table
from ehlectric.constants import EPSILON_0
from ehlectric.errors import InputError, shown


def _named(name: str) -> str:
    """Name of a coating of the library that replaces its table."""
    names = library.coating_names()
    if name not in names:
        raise InputError(
            got=shown(name),
            takes=f"a name of the library: {', '.join(map(repr, names))}; or the table [bearing.coating] "
            "with ring, thickness and relative_permittivity",
        )
    return name


class Coating(Table, book="bearing.coating", named_by="base"):
    """Insulating coating between a ring and its seat; no property of it has a default."""

    base: str | None = None
    ring: Literal["inner", "outer"]
    thickness: float
    relative_permittivity: float
    over_moulded: bool = False
    area: float | None = None
    strength: float | None = None
    breakdown_voltage: float | None = None
    resistance: float | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_base(cls, table: Any) -> Any:
        """Values of the coating that ``base`` names in the library, replaced by the values of the file.

        A text instead of the table is such a name.
        """
        table = cls.of_name(table if not isinstance(table, str) else _named(table))
        if not isinstance(table, Mapping) or table.get("base") is None:
            return table
        base = library.coating(library_name(table["base"], library.coating_names()))
        if table.get("strength") is not None:
            base.pop("breakdown_voltage", None)
        return {**base, **table}

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.check_alternatives(("strength", "breakdown_voltage"), "one of the two")
        if self.over_moulded and (self.ring != "outer" or self.area is not None):
            got = "true with area" if self.area is not None else "true with ring 'inner'"
            takes = "ring 'outer' without area: outer_diameter and width are dimensions of the steel"
            raise InputError("over_moulded", got=got, takes=takes)
        return self

    @property
    def assumed(self) -> dict[str, float]:
        """Values by key, SI units, that the base in the library assumes and the file does not replace."""
        return {name: getattr(self, name) for name, assumed in self._of_base().items() if assumed}

    @property
    def any_assumed(self) -> Any:
        """Whether any value of the coating is ``assumed``, shape (...)."""
        return any_of(*self._of_base().values())

    def _of_base(self) -> dict[str, Any]:
        """Whether each value that the base in the library assumes is the value of this coating, by key."""
        if self.base is None:
            return {}
        names = library.tables("coating", self.base)["source"].get("assumed", ())
        base = type(self).from_dict({"base": self.base}) if names else self
        return {name: getattr(self, name) == getattr(base, name) for name in names}

    @property
    def voltage(self) -> float | None:
        """Breakdown voltage of only the coating [V]; None where the case does not give it."""
        if self.strength is not None:
            return self.strength * self.thickness
        return self.breakdown_voltage

    def capacitance(self, area: Numbers) -> Numbers:
        """Capacitance of the coating between ring and seat, eps0 eps_r A/d [F].

        The coating is thin compared with the diameter of the ring, so that it is a plate capacitor.

        ``area``, area A over which the coating lies between ring and seat [m^2].

        Examples
        --------
        The outer ring of a 6208, 80 mm in diameter and 18 mm wide, with 200 um of a permittivity of 9:

        >>> table = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0}
        >>> round(1e9 * Coating.from_dict(table).capacitance(4.524e-3), 2)
        1.8
        """
        return EPSILON_0 * self.relative_permittivity * area / self.thickness

    def capacitance_on(self, diameters: Mapping[str, Numbers | None], width: Numbers | None) -> Numbers:
        """Capacitance of the coating [F], by ``area_on`` its ring.

        A layer that is moulded over an outer ring with the diameter D and the width B is the cylinder
        capacitor 2 pi eps0 eps_r B/ln((D + 2 d)/D); its sides are neglected. The arguments and errors are
        the arguments and errors of ``area_on``.

        Examples
        --------
        A ring of 80 by 18 mm under 1 mm of a polymer with a permittivity of 4.2:

        >>> table = {"ring": "outer", "thickness": "1 mm", "relative_permittivity": 4.2, "over_moulded": True}
        >>> round(1e12 * Coating.from_dict(table).capacitance_on({"outer": 80e-3}, 18e-3), 1)
        170.3
        """
        plate = self.capacitance(self.area_on(diameters, width))
        diameter = diameters.get(self.ring)
        if not self.over_moulded or diameter is None:
            return plate
        part = 2.0 * self.thickness / diameter
        return as_float(plate * part / np.log1p(part))

    def area_on(self, diameters: Mapping[str, Numbers | None], width: Numbers | None) -> Numbers:
        """Area of the coating on its seat [m^2]: ``area``, or the area of the cylinder of the ring.
        ``diameters``, bore of the bearing under "inner", and its outside diameter under "outer" [m];
        ``width`` [m]. Raises InputError where neither the area nor diameter and width are known.
        """
        if self.area is not None:
            return self.area
        diameter = diameters[self.ring]
        if diameter is None or width is None:
            of_ring = {"inner": "bore", "outer": "outer_diameter"}[self.ring]
            if self.over_moulded:
                key = of_ring if diameter is None else "width"
                raise InputError.missing(key, "outer_diameter and width, which an over-moulded ring needs")
            raise InputError.missing("coating.area", f"it, or bearing.{of_ring} and bearing.width")
        return math.pi * diameter * width
