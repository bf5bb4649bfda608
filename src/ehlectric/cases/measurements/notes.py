"""Warnings about the film factors of a measurement."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ehlectric.cases.measurements.average import RAISED, SCATTER, MeanFactor
from ehlectric.cases.measurements.reading import Measurement
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.oils.resolution import viscosity_over_temperature
from ehlectric.errors import ResultWarning

# Number of rows and of columns that a warning names.
_NAMED = 3

# Ratio of the scatter to the stated uncertainty above which a warning tells it.
_LARGE = 1.5

# Slope over the speed, and its ratio to its uncertainty, above which a film factor counts as no constant.
_STEEP, _CERTAIN = 0.02, 3.0


def measurement_warnings(
    measured: Measurement,
    reasons: Sequence[str],
    mean: MeanFactor | None,
    slope: tuple[float, float] | None,
    speed: str,
) -> Iterator[ResultWarning]:
    """Warnings about columns, rows, scatter and trend of a measurement.

    Parameters
    ----------
    measured : Measurement
        Rows as read.
    reasons : sequence of str, length n
        For each row "" or why it has no film factor.
    mean : MeanFactor or None
        Mean film factor.
    slope : tuple of float or None
        Slope d ln(factor)/d ln(speed), and its standard uncertainty.
    speed : str
        Name of the speed.
    """
    if measured.ignored:
        yield ResultWarning("columns-ignored", f"{measured.source}: ignored {_some(measured.ignored)}")
    without = [(line, why) for line, why in zip(measured.lines, reasons, strict=True) if why]
    if without:
        lines = _some([f"line {line} ({why})" for line, why in without])
        yield ResultWarning(
            "rows-without-factor", f"{len(without)} of {len(reasons)} rows have no film factor: {lines}"
        )
    if mean is None:
        return
    if mean.basis == SCATTER:
        text = "the measurement states no uncertainty: the interval of the film factor is from scatter only"
        yield ResultWarning("scatter-only", f"{text}, and hides what all rows share")
    if mean.basis == RAISED and mean.scatter is not None and mean.scatter > _LARGE:
        text = f"the film factors scatter {mean.scatter:.2g} times as much as the measurement states"
        yield ResultWarning("scatter-large", f"{text}; the interval was raised to the scatter")
    if slope is not None and abs(slope[0]) > max(_STEEP, _CERTAIN * slope[1]):
        text = f"the film factor is no constant: it changes as {speed}^{slope[0]:.2g} (+-{slope[1]:.1g})"
        yield ResultWarning("factor-varies", f"{text}; its mean holds for the measured speeds only")


def temperature_warnings(measured: Measurement, oil: Properties) -> Iterator[ResultWarning]:
    """Note about measured temperatures that do not change the films, because the viscosity is a given one.

    Parameters
    ----------
    measured : Measurement
        Rows as read.
    oil : Properties
        Table of the oil in the case.
    """
    if measured.has("temperature") and viscosity_over_temperature(oil) is None:
        yield ResultWarning(
            "temperature-unused",
            f"{measured.source}: the measured temperatures do not change the viscosity, which is a given "
            "one; give [lubricant.temperature] or lubricant.atmospheric_law, or film factors hold its error",
        )


def _some(texts: Sequence[str]) -> str:
    more = len(texts) - _NAMED
    return ", ".join(texts[:_NAMED]) + (f" and {more} more" if more > 0 else "")
