"""Film factor at which a capacitance that falls with the film has a measured value."""

from __future__ import annotations

import math
from collections.abc import Callable

from scipy.optimize import brentq

from ehlectric.errors import InputError
from ehlectric.quantities.formats import amount

# Film factors that are looked at: a film of a hundredth, and of three times the flooded isothermal one.
LEAST, MOST = 0.01, 3.0

# Tolerance of the logarithm of a film factor, and the step of differences.
_TOLERANCE, _STEP = 1e-9, 0.01

# Step of the search below which the end of the films that can be computed counts as reached.
_CLOSE = 1e-3

# Places beside the first film factor that are tried where its film cannot be computed, in logarithms.
_SHIFTS = (0.0, 0.5, -0.5, 1.0, -1.0, -2.0, -3.0)

# Usual slope of ln(capacitance) over ln(film factor), with which the search starts.
_USUAL = 0.5


class NoFactorError(ValueError):
    """Error of a capacitance that no film factor explains; the text says why."""


def film_factor_of(capacitance: Callable[[float], float], target: float, guess: float = 1.0) -> float:
    """Film factor at which a capacitance has a value.

    Parameters
    ----------
    capacitance : callable
        Film factor -> capacitance [F], falling.
    target : float
        Capacitance that is looked for [F].
    guess : float
        Film factor to start from.

    Returns
    -------
    float
        Film factor between 0.01 and 3, dimensionless.

    Raises
    ------
    NoFactorError
        Where the capacitance is above that of a film of a hundredth, or below that of a film three times as
        thick as the isothermal, fully flooded one; where the films cannot be computed.

    Examples
    --------
    >>> round(film_factor_of(lambda factor: 2e-10 * factor**-0.6, 2.5e-10), 6)
    0.689419
    >>> film_factor_of(lambda factor: 2e-10 * factor**-0.6, 1e-11)
    Traceback (most recent call last):
    ehlectric.bearing.measured.inverse.NoFactorError: below 103.5 pF, that of a film 3 times as thick as \
computed for isothermal, fully flooded oil
    """
    least, most = math.log(LEAST), math.log(MOST)

    def excess(x: float) -> float:
        return math.log(_computed(capacitance, x) / target)

    x = min(max(math.log(guess), least), most)
    x, y = _first(excess, x)
    step = 1.2 * abs(y) / _USUAL + 1e-4
    while y != 0.0:
        further = min(max(x + math.copysign(step, y), least), most)
        if further == x:
            raise NoFactorError(_out_of_reach(_computed(capacitance, x), x))
        try:
            other = excess(further)
        except NoFactorError:
            # A film between both may still be one that can be computed.
            step *= 0.5
            if step < _CLOSE:
                raise
            continue
        if (other < 0.0) != (y < 0.0) or other == 0.0:
            low, high = sorted((x, further))
            return math.exp(float(brentq(excess, low, high, xtol=_TOLERANCE, rtol=1e-12)))
        x, y, step = further, other, 2.0 * step
    return math.exp(x)


def _first(excess: Callable[[float], float], x: float) -> tuple[float, float]:
    """Place near ``x`` at which the film can be computed, and the value there."""
    failed: NoFactorError | None = None
    for shift in _SHIFTS:
        try:
            return x + shift, excess(x + shift)
        except NoFactorError as error:
            failed = failed or error
    assert failed is not None
    raise failed


def slope_at(capacitance: Callable[[float], float], factor: float) -> float:
    """Slope d ln(capacitance)/d ln(film factor) at a film factor, by a difference to one side.

    Examples
    --------
    >>> round(slope_at(lambda factor: 2e-10 * factor**-0.6, 0.7), 6)
    -0.6
    """
    further = _computed(capacitance, math.log(factor) + _STEP)
    return math.log(further / capacitance(factor)) / _STEP


def _computed(capacitance: Callable[[float], float], x: float) -> float:
    try:
        return capacitance(math.exp(x))
    except InputError as error:
        raise NoFactorError(f"its film cannot be computed: {error}") from None


def _out_of_reach(end: float, x: float) -> str:
    if x > 0.0:
        return (
            f"below {amount(end, 'F')}, that of a film {MOST:g} times as thick as computed for isothermal, "
            "fully flooded oil"
        )
    return f"above {amount(end, 'F')}, that of a film of {LEAST:g} of the isothermal, fully flooded one"
