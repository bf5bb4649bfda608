"""Spellings of units in the heads of columns."""

from __future__ import annotations

# Units as oscilloscopes and people write them, in small letters.
_WORDS = (
    dict.fromkeys(("s", "sec", "secs", "second", "seconds"), "s")
    | dict.fromkeys(("ms", "millisecond", "milliseconds"), "ms")
    | dict.fromkeys(("us", "µs", "usec", "microsecond", "microseconds"), "us")
    | dict.fromkeys(("ns", "nanosecond", "nanoseconds"), "ns")
    | dict.fromkeys(("ps", "picosecond", "picoseconds"), "ps")
    | dict.fromkeys(("v", "volt", "volts"), "V")
    | dict.fromkeys(("uv", "µv", "microvolt", "microvolts"), "uV")
    | dict.fromkeys(("kv", "kilovolt", "kilovolts"), "kV")
    | dict.fromkeys(("a", "amp", "amps", "ampere", "amperes"), "A")
    | {"millivolt": "mV", "millivolts": "mV"}
)
TIMES = ("s", "ms", "us", "ns", "ps")
VOLTAGES = ("V", "mV", "uV", "kV")

# "Unit" of a column that numbers the samples, and names of such columns.
NUMBERING = "sequence"
NUMBERINGS = ("nr", "no", "no.", "#", "index", "sample", "samples", "point", "points", NUMBERING)
TIME_NAMES = ("time", "t", "zeit", "temps", "tiempo", "tempo", "x-axis", "x", "timestamp")


def parts(head: str) -> tuple[str, str]:
    """Name and unit of a head such as "Time (us)", "CH1 [kV]", "C1 in V" or "time_ms".

    Examples
    --------
    >>> parts("Time (us)"), parts("C1 in V"), parts("time_ms"), parts("Channel A")
    (('Time', 'us'), ('C1', 'V'), ('time', 'ms'), ('Channel A', ''))
    """
    text = " ".join(head.split())
    for opening, closing in (("[", "]"), ("(", ")")):
        start = text.rfind(opening)
        if start >= 0 and text.endswith(closing):
            return text[:start].strip(), spelled(text[start:])
    words = text.replace("_", " ").replace("/", " ").split()
    if not words:
        return "", ""
    last = spelled(words[-1])
    if len(words) > 1 and words[-2].lower() == "in" and last:
        return " ".join(words[:-2]), last
    if len(words) == 1 and last in (*TIMES, *VOLTAGES) and len(text) > 1:
        return text, last
    # "Channel A" is a name: of bare words, only those that no channel has are units.
    of_time = words[0].lower() in TIME_NAMES and last in TIMES
    if len(words) > 1 and (of_time or last in VOLTAGES):
        return " ".join(words[:-1]), last
    return text, ""


def spelled(text: str) -> str:
    """Unit in the spelling of pint; a text in brackets that is none as it stands, other texts as ""."""
    enclosed = text[:1] + text[-1:] in ("()", "[]")
    inner = (text[1:-1] if enclosed else text).strip().replace("\u03bc", "µ")
    # Capitals count in mV and MV, and in ms and Ms: no oscilloscope writes mega.
    if inner[:1] == "M" and inner[1:2] in ("V", "s", "S"):
        return inner
    if inner.lower() == "mv":
        return "mV"
    if inner.lower() == NUMBERING:
        return NUMBERING
    known = _WORDS.get(inner.lower(), "")
    return known or (inner if enclosed else "")


def unit_of(text: str) -> str:
    """Unit that a user gave, in the spelling of pint."""
    return spelled(f"({text})")
