"""Table ``source`` of a drive file: the common-mode voltage, described or measured."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import DESCRIBED, MEASURED

_Hertz = Amount("Hz", least=1e-3, most=1e9, reason="of an inverter")
_Time = Amount("s", least=1e-12, most=1.0, reason="of an edge of an inverter")

# What a described source needs; six-step operation switches at the fundamental frequency and has no index.
_NEEDED = ("dc_link", "modulation", "rise_time")
_NEEDED_BY_CARRIER = ("switching_frequency", "modulation_index")
_ONLY_BY_CARRIER = (*_NEEDED_BY_CARRIER, "base_frequency")
_RINGING = ("ringing_frequency", "overshoot", "ringing_time")


class Source(Table):
    """Common-mode voltage of the inverter: from its modulation, or a measured waveform."""

    dc_link: Annotated[float, Amount("V", above=0.0, most=1e6, reason="voltage of the DC link")] | None = None
    modulation: Literal["sinusoidal", "space-vector", "six-step"] | None = None
    switching_frequency: Annotated[float, _Hertz] | None = None
    fundamental_frequency: Annotated[float, _Hertz] | None = None
    pole_pairs: Annotated[int, Count(least=1, most=1000, reason="of the machine")] | None = None
    modulation_index: (
        Annotated[float, Amount("", least=0.0, most=1.5, reason="1 without overmodulation")] | None
    ) = None
    base_frequency: Annotated[float, _Hertz] | None = None
    rise_time: Annotated[float, Amount("s", least=0.0, most=1.0, reason="of an edge")] | None = None
    ringing_frequency: Annotated[float, _Hertz] | None = None
    overshoot: (
        Annotated[float, Amount("", least=0.0, most=1.0, reason="part of the step", fraction=True)] | None
    ) = None
    ringing_time: Annotated[float, _Time] | None = None
    file: str | None = None
    column: str | int | None = None
    time_column: str | int | None = None
    step: Annotated[float, _Time] | None = None
    time_unit: str | None = None
    value_unit: str | None = None
    scale: Annotated[float, Amount("", least=-1e9, most=1e9, reason="such as that of a probe")] = 1.0
    resample: Annotated[float, _Time] | None = None

    @property
    def measured(self) -> bool:
        """Whether the source is a file."""
        return self.file is not None

    def at_speed(self, speed: float) -> Self:
        """Source at a speed of the rotor: its frequency and its modulation index follow the speed.

        With ``pole_pairs`` p the frequency is p n of a synchronous machine, without the slip of an induction
        machine. With ``base_frequency`` the index is ``modulation_index`` from this frequency on, and below
        it falls in proportion to the frequency, for a constant flux.

        Parameters
        ----------
        speed : float
            Speed of the rotor [rad/s].

        Returns
        -------
        Source
            Source with its frequency and its index, and without those two keys.

        Raises
        ------
        InputError
            If the frequency or an edge does not fit the carrier.
        """
        frequency, index, base = self.fundamental_frequency, self.modulation_index, self.base_frequency
        if self.pole_pairs is not None:
            # Without the rounding of a speed in rpm, so that 50 Hz are exactly that.
            frequency = float(f"{self.pole_pairs * abs(speed) / (2.0 * math.pi):.12g}")
        if base is not None and frequency is not None and index is not None:
            index *= min(frequency / base, 1.0)
        own = {"fundamental_frequency": frequency, "modulation_index": index}
        table = self.model_dump(exclude_none=True, exclude={"pole_pairs", "base_frequency"}) | own
        return self.from_dict({key: value for key, value in table.items() if value is not None})

    @model_validator(mode="after")
    def _check(self) -> Self:
        given = [key for key in DESCRIBED if getattr(self, key) is not None]
        if self.measured:
            if given:
                raise InputError(
                    given[0], got="it beside file", takes="a described source, or a measured one"
                )
            return self
        other = [key for key in MEASURED if key != "scale" and getattr(self, key) is not None]
        if other:
            raise InputError.worded("file", f"missing; {other[0]} belongs to a measured source")
        self._check_modulation()
        self._check_edges()
        return self

    def _check_modulation(self) -> None:
        """Check that a described source is complete, and has one frequency."""
        carrier = () if self.modulation == "six-step" else _NEEDED_BY_CARRIER
        for key in (*_NEEDED, *carrier):
            if getattr(self, key) is None:
                raise InputError.missing(key, "a value; or file, a measured waveform")
        if self.fundamental_frequency is None and self.pole_pairs is None:
            takes = "a value; or pole_pairs, with which it follows the speed; or file, a measured waveform"
            raise InputError.missing("fundamental_frequency", takes)
        if self.fundamental_frequency is not None and self.pole_pairs is not None:
            raise InputError.worded("pole_pairs", "is given beside fundamental_frequency; give one of them")
        if self.modulation == "six-step":
            for key in _ONLY_BY_CARRIER:
                if getattr(self, key) is not None:
                    raise InputError.worded(key, "is not used by six-step modulation")

    def _check_edges(self) -> None:
        """Check the ringing, and times against the period of the carrier."""
        ringing = [key for key in _RINGING if getattr(self, key) is not None]
        if ringing and len(ringing) < len(_RINGING):
            missing = next(key for key in _RINGING if key not in ringing)
            raise InputError.worded(missing, f"missing; {ringing[0]} needs it")
        fundamental, carrier, rise = self.fundamental_frequency, self.switching_frequency, self.rise_time
        if fundamental is not None and carrier is not None and carrier < 6.0 * fundamental:
            raise InputError(
                "switching_frequency",
                got=f"{carrier:g} Hz",
                takes=f"at least six times the fundamental frequency of {fundamental:g} Hz",
            )
        period = 1.0 / (carrier or 6.0 * (fundamental or 1.0))
        if rise is not None and rise >= 0.5 * period:
            raise InputError(
                "rise_time", got=f"{rise:g} s", takes=f"less than half of the period {period:.3g} s"
            )
