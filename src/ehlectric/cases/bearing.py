"""Tables of a bearing file: bearing with load and speed, lubricant over temperature, discharge, motor."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, model_validator

from ehlectric.cases import library
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.library.clearance import BORE, ClearanceClass, with_class, with_clearance
from ehlectric.cases.library.grade import Grade
from ehlectric.cases.lubricant import Lubricant, law_parameters, library_name, with_lubricant
from ehlectric.cases.quantity import Count, Quantity
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.temperature import Walther, density
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS
from ehlectric.lubricant.viscosity_index import grade_middle, viscosity_at_100
from ehlectric.runtime.values import is_number

ROLLERS = "cylindrical roller"
ANGULAR = "angular-contact ball"
_Length = Annotated[float, BORE]
_Groove = Annotated[float, Quantity("", above=0.5, most=1.0, reason="groove radius over ball diameter")]
_Capacitance = Annotated[float, Quantity("F", above=0.0, most=1e-3, reason="of an electric machine")]
_Viscosity = Annotated[float, Quantity("m**2/s", least=1e-7, most=1.0, reason="kinematic")]
_Absolute = Annotated[float, Quantity("Pa*s", least=1e-7, most=1e6, reason="at ambient pressure")]
_Load = Annotated[float, Quantity("N", least=0.0, most=1e8, reason="on the inner ring")]

# Keys that only ball bearings have, and keys that only roller bearings have.
_OF_BALLS = ("inner_groove", "outer_groove", "shoulder_height", "contact_angle")
_OF_ROLLERS = ("roller_length", "profile")

# Keys that each kind of bearing needs.
_NEEDED = {
    "deep-groove ball": ("inner_groove", "outer_groove", "shoulder_height", "radial_clearance"),
    ANGULAR: ("inner_groove", "outer_groove", "shoulder_height", "contact_angle"),
    ROLLERS: ("roller_length", "profile", "radial_clearance"),
}

# What a message says of a needed key that is missing, where a few words help.
_CHOICES = {
    "profile": "'none' or 'logarithmic'",
    "radial_clearance": "the clearance in operation, or clearance_class with bore",
}


def _material(name: str) -> str:
    names = library.solid_names()
    if name not in names:
        raise InputError(got=shown(name), takes=f"one of the library: {', '.join(names)}")
    return name


def _film_factor(value: Any) -> float | str:
    if value in ("none", "inlet-shear"):
        return str(value)
    if not is_number(value) or not 0.0 < value <= 1.0:
        raise InputError(got=shown(value), takes="'none', 'inlet-shear', or a number above 0 and at most 1")
    return float(value)


_Material = Annotated[str, AfterValidator(_material)]


def _bearing_name(base: Any) -> str:
    """Name of a bearing of the library; the error for another name tells how to do without the library."""
    try:
        return library_name(base, library.bearing_names())
    except InputError as error:
        keys = "kind, elements, element_diameter, pitch_diameter and the other keys of the bearing"
        text = f"{error.text}; or leave base out and give {keys}"
        raise error.retold(error.key, text) from None


class Bearing(Table):
    """Internal geometry, materials, load, speed and temperature of a rolling bearing."""

    base: str | None = None
    kind: Literal["deep-groove ball", "angular-contact ball", "cylindrical roller"]
    elements: Annotated[int, Count(3, 1000, "rolling elements of one row")]
    bore: _Length | None = None
    element_diameter: _Length
    pitch_diameter: _Length
    inner_groove: _Groove | None = None
    outer_groove: _Groove | None = None
    roller_length: _Length | None = None
    profile: Literal["none", "logarithmic"] | None = None
    shoulder_height: (
        Annotated[float, Quantity("", above=0.0, most=0.5, reason="of the element diameter")] | None
    ) = None
    radial_clearance: (
        Annotated[float, Quantity("m", least=-1e-3, most=1e-2, reason="full diametral play")] | None
    ) = None
    clearance_class: ClearanceClass | None = None
    contact_angle: (
        Annotated[float, Quantity("rad", above=0.0, below=0.5 * math.pi, reason="free of load")] | None
    ) = None
    element_material: _Material = "steel"
    ring_material: _Material = "steel"
    element_capacitance: _Capacitance | None = None
    radial_load: _Load = 0.0
    axial_load: _Load = 0.0
    inner_speed: Annotated[float, Quantity("rad/s", above=0.0, most=1e5, reason="of the inner ring")]
    temperature: Annotated[float, Quantity("K", least=200.0, most=600.0, reason="absolute, of the oil")]
    composite_rq: Annotated[float, Quantity("m", above=0.0, most=1e-4, reason="of both surfaces together")]
    fill: Literal["oil", "air"] = "oil"
    film_factor: Annotated[float | str, BeforeValidator(_film_factor)] = "none"

    @model_validator(mode="before")
    @classmethod
    def _from_base(cls, table: Any) -> Any:
        """Values of the bearing that ``base`` names in the library, replaced by those of the file."""
        if not isinstance(table, Mapping):
            return table
        table = with_class(table)
        if table.get("base") is None:
            return with_clearance(table)
        name = _bearing_name(table["base"])
        base = library.bearing(name)
        if table.get("clearance_class") is not None:
            base.pop("radial_clearance", None)
        return with_clearance({**base, **table})

    @model_validator(mode="after")
    def _check(self) -> Self:
        self._check_kind()
        if self.radial_load == 0.0 and self.axial_load == 0.0:
            raise InputError.missing("radial_load", "a load, radial or axial")
        ceramic = not library.solid(self.element_material)["conducting"]
        if self.element_capacitance is not None and not ceramic:
            raise InputError.worded(
                "element_capacitance", "is only for ceramic elements; that of conducting ones is computed"
            )
        if not library.solid(self.ring_material)["conducting"]:
            raise InputError("ring_material", got=shown(self.ring_material), takes="one that conducts")
        return self

    def _check_kind(self) -> None:
        rollers = self.kind == ROLLERS
        needed = _NEEDED[self.kind]
        for key in needed:
            if getattr(self, key) is None:
                choices = f": {_CHOICES[key]}" if key in _CHOICES else ""
                text = f"missing; a bearing of kind {self.kind!r} needs it{choices}"
                raise InputError.worded(key, text, takes=_CHOICES.get(key))
        for key in (*_OF_BALLS, *_OF_ROLLERS, "radial_clearance", "clearance_class"):
            of_kind = "radial_clearance" if key == "clearance_class" else key
            if of_kind not in needed and getattr(self, key) is not None:
                raise InputError.worded(key, f"is not used by a bearing of kind {self.kind!r}")
        if self.bore is not None and self.bore >= self.pitch_diameter - self.element_diameter:
            raise InputError(
                "bore",
                got=f"{self.bore:g} m",
                takes=f"less than the inner raceway, {self.pitch_diameter - self.element_diameter:g} m",
            )
        if rollers and self.axial_load:
            raise InputError(
                "axial_load",
                got=f"{self.axial_load:g} N",
                takes="0 in a cylindrical roller bearing, whose rollers carry none",
            )


class OilTemperature(Table):
    """Viscosity, density, thermal expansion and thermal conductivity of an oil over temperature."""

    kinematic_viscosity_40: _Viscosity | None = None
    iso_vg: Annotated[int, Grade()] | None = None
    kinematic_viscosity_100: _Viscosity | None = None
    viscosity_index: (
        Annotated[
            float,
            Quantity("", least=0.0, most=400.0, reason="ASTM D2270; 95 to 100 is usual for mineral oils"),
        ]
        | None
    ) = None
    density_15: Annotated[float, Quantity("kg/m**3", least=500.0, most=2000.0, reason="of an oil")]
    # D. Dowson and G. R. Higginson, Elasto-Hydrodynamic Lubrication, Pergamon, 1966, as later works quote it.
    expansion: Annotated[float, Quantity("1/K", least=1e-5, most=2e-3, reason="thermal, of an oil")] = 6.5e-4
    thermal_conductivity: (
        Annotated[float, Quantity("W/m/K", least=0.01, most=1.0, reason="of an oil")] | None
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
            return viscosity_at_100(self.at_40(), self.viscosity_index)
        except ValueError as error:
            got = f"{self.viscosity_index:g} ({error})"
            raise InputError(
                "viscosity_index", got=got, takes="kinematic_viscosity_100 in its place"
            ) from None


class BearingLubricant(Lubricant):
    """Lubricant of a bearing.

    With the table ``temperature``, its viscosity is computed at the temperature of the bearing.
    """

    viscosity: _Absolute | None = None  # type: ignore[assignment]
    temperature: OilTemperature | None = None

    @classmethod
    def _with_base(cls, table: Any) -> Any:
        """Values of the lubricant that ``base`` names in the library, replaced by those of the file.

        With the table ``temperature``, the viscosity of the library and the parameters that derive from the
        viscosity are left out, because they are computed.
        """
        full = with_lubricant(table)
        if not isinstance(table, Mapping) or table.get("temperature") is None or full is table:
            return full
        derived = [name for name, parameter in law_parameters().items() if parameter.derivation]
        over_temperature = ("viscosity", *derived)
        return {key: value for key, value in full.items() if key in table or key not in over_temperature}

    @model_validator(mode="after")
    def _check(self) -> Self:
        if (self.viscosity is None) == (self.temperature is None):
            both = None if self.viscosity is None else "viscosity and temperature together"
            raise InputError("viscosity", got=both, takes="either viscosity or [lubricant.temperature]")
        return self

    def at(self, temperature: float) -> Lubricant:
        """Return the lubricant at a temperature.

        Parameters
        ----------
        temperature : float
            Absolute temperature [K].

        Returns
        -------
        Lubricant
            Lubricant with the viscosity and the parameters of its laws at this temperature.

        Raises
        ------
        InputError
            If the viscosity at this temperature is not valid, or a parameter of a law is missing.
        """
        table = self.model_dump(exclude_none=True, exclude={"temperature", "base"})
        oil = self.temperature
        if oil is not None:
            viscosity = self.walther().viscosity(temperature) * density(
                oil.density_15, oil.expansion, temperature
            )
            table["viscosity"] = viscosity
            table |= self._derived(viscosity)
        try:
            return Lubricant.from_dict(table)
        except InputError as error:
            raise error.under("lubricant") from None

    def walther(self) -> Walther:
        """Walther's law of kinematic viscosity over temperature, through the values at 40 and 100 degC."""
        assert self.temperature is not None
        return Walther.of(self.temperature.at_40(), self.temperature.at_100())

    def _derived(self, viscosity: float) -> dict[str, float]:
        """Parameters of the viscosity law that the file lacks, computed from the viscosity [Pa s]."""
        derived = {}
        for parameter in VISCOSITY_LAWS[self.viscosity_law].parameters:
            rule = parameter.derivation
            if rule is None or self.parameter(parameter.name) is not None:
                continue
            values = [value for value in map(self.parameter, rule.parameters) if value is not None]
            if len(values) < len(rule.parameters):
                raise InputError.missing(
                    f"lubricant.{parameter.name}",
                    f"it, or {' and '.join(rule.parameters)}, from which it follows at the temperature",
                )
            derived[parameter.name] = rule.function(viscosity, *values)
        return derived


# Inputs of a discharge that a bearing reads itself, and not at the temperature of its films.
_OF_WHOLE_BEARING = {"external_capacitance", "peak_current", "pit"}


class BearingDischarge(Discharge):
    """Discharge of a bearing; a strength table over temperature is read at the bearing's temperature."""

    def _check_pit(self) -> None:
        """Accept a pit without an external capacitance: a motor may give what is connected to the shaft."""

    def _check_temperature(self) -> None:
        if self.temperature is not None:
            raise InputError(
                "temperature",
                got=f"{self.temperature:g} K for a bearing",
                takes="bearing.temperature in its place, at which the strength is taken",
            )

    def at(self, temperature: float) -> Discharge:
        """Return the inputs of the discharge at a temperature.

        Parameters
        ----------
        temperature : float
            Absolute temperature [K].

        Returns
        -------
        Discharge
            Inputs of the discharge, with this temperature for a strength table over temperature.

        Raises
        ------
        InputError
            If the temperature is outside a strength table over temperature.

        Examples
        --------
        >>> table = {"temperature": ["20 degC", "120 degC"], "strength": ["20 V/um", "10 V/um"]}
        >>> BearingDischarge.from_dict({"strength_table": table}).at(343.15).temperature
        343.15
        """
        table = self.model_dump(exclude_none=True, exclude=_OF_WHOLE_BEARING)
        if self.strength_table is not None and self.strength_table.over == "temperature":
            table["temperature"] = temperature
        try:
            return Discharge.from_dict(table)
        except InputError as error:
            raise error.under("bearing") from None


class Motor(Table):
    """Common-mode voltage and capacitances of the motor around the bearing."""

    common_mode_voltage: Annotated[float, Quantity("V", above=0.0, most=1e6, reason="peak")]
    winding_rotor_capacitance: _Capacitance
    rotor_frame_capacitance: _Capacitance
    second_bearing_capacitance: _Capacitance | None = None
    switching_frequency: (
        Annotated[float, Quantity("Hz", least=1.0, most=1e8, reason="of the inverter")] | None
    ) = None
    rise_time: (
        Annotated[float, Quantity("s", least=1e-11, most=1.0, reason="of an edge of the inverter")] | None
    ) = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.switching_frequency is not None and self.rise_time is not None:
            period = 1.0 / self.switching_frequency
            if self.rise_time >= period:
                raise InputError(
                    "rise_time",
                    got=f"{self.rise_time:g} s",
                    takes=f"less than {period:.3g} s, a period of motor.switching_frequency",
                )
        return self
