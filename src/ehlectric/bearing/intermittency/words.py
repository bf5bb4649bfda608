"""Shares of time in words."""

from __future__ import annotations

# Share of time below which a text gives no number: a hundredth of a per cent.
SELDOM = 1e-4

# End of all texts.
OF_TIME = " of the time"


def time_text(share: float) -> str:
    """Share of time as text.

    Examples
    --------
    >>> time_text(0.0257), time_text(3e-9), time_text(0.99999)
    ('2.57 % of the time', 'less than 0.01 % of the time', 'more than 99.99 % of the time')
    """
    if share < SELDOM:
        return f"less than 0.01 %{OF_TIME}"
    if share > 1.0 - SELDOM:
        return f"more than 99.99 %{OF_TIME}"
    digits = ".3g" if share < 0.99 else ".4g"
    return f"{100.0 * share:{digits}} %{OF_TIME}"
