"""Table ``lubricant.temperature`` of a case: the data sheet of an oil, with viscosities and density."""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated, Literal, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount
from ehlectric.cases.library.grade import Grade
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.lubricant.viscosity_index import grade_middle, viscosity_at_100

_Viscosity = Annotated[float, Amount("m**2/s", least=1e-7, most=1.0, reason="kinematic")]

# Keys that give the viscosity.
SHEET_VISCOSITY = ("kinematic_viscosity_40", "iso_vg", "kinematic_viscosity_100", "viscosity_index")

# A root is found for each oil, and a case asks for it many times.
_at_100 = lru_cache(maxsize=64)(viscosity_at_100)


class OilTemperature(Table):
    """Viscosity, density, thermal expansion and thermal conductivity of an oil over temperature."""

    kinematic_viscosity_40: _Viscosity | None = None
    iso_vg: Annotated[int, Grade()] | None = None
    kinematic_viscosity_100: _Viscosity | None = None
    viscosity_index: (
        Annotated[
            float,
            Amount("", least=0.0, most=400.0, reason="ASTM D2270; 95 to 100 is usual for mineral oils"),
        ]
        | None
    ) = None
    density_15: Annotated[float, Amount("kg/m**3", least=500.0, most=2000.0, reason="of an oil")]
    # D. Dowson and G. R. Higginson, Elasto-Hydrodynamic Lubrication, Pergamon, 1966, as later works quote it.
    expansion: Annotated[float, Amount("1/K", least=1e-5, most=2e-3, reason="thermal, of an oil")] = 6.5e-4
    base_oil: Literal["mineral-paraffinic", "mineral-naphthenic", "pao", "ester", "polyglycol"] | None = None
    thermal_conductivity: (
        Annotated[float, Amount("W/m/K", least=0.01, most=1.0, reason="of an oil")] | None
    ) = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        for keys, hint in (
            (("kinematic_viscosity_40", "iso_vg"), ""),
            (
                ("kinematic_viscosity_100", "viscosity_index"),
                "; an index of 95 to 100 is usual for mineral oils",
            ),
        ):
            given = [key for key in keys if getattr(self, key) is not None]
            if len(given) == 2:
                raise InputError(
                    keys[0],
                    got=" and ".join((*keys, "")).removesuffix(" and ") + " together",
                    takes="one of the two",
                )
            if not given:
                raise InputError.missing(keys[0], f"either {keys[0]} or {keys[1]}{hint}")
        self.at_100()
        return self

    def at_40(self) -> float:
        """Kinematic viscosity at 40 degC [m^2/s]: the given one, or the middle of the ISO viscosity grade."""
        if self.kinematic_viscosity_40 is not None:
            return self.kinematic_viscosity_40
        assert self.iso_vg is not None
        return grade_middle(self.iso_vg)

    def at_100(self) -> float:
        """Kinematic viscosity at 100 degC [m^2/s]: the given one, or that of the viscosity index.

        Raises
        ------
        InputError
            If an oil with this index is too thin for ASTM D2270.
        """
        if self.kinematic_viscosity_100 is not None:
            return self.kinematic_viscosity_100
        assert self.viscosity_index is not None
        try:
            return _at_100(self.at_40(), self.viscosity_index)
        except ValueError as error:
            got = f"{self.viscosity_index:g} ({error})"
            raise InputError(
                "viscosity_index", got=got, takes="kinematic_viscosity_100 in its place"
            ) from None
