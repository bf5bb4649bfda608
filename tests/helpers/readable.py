"""Numbers as the outputs show them."""

import re

_NUMBER = re.compile(
    r"(?P<digits>-?(?:\d{1,3}(?:[\xa0 ]\d{3})+(?!\d)|\d+)(?:\.\d+)?)(?P<million>[\xa0 ]million)?"
)


def number_in(text):
    """Number at the beginning of a text, in the unit of the text: "60 000 1/s" is 60000."""
    found = _NUMBER.match(text)
    return float(re.sub(r"[\xa0 ]", "", found["digits"])) * (1e6 if found["million"] else 1.0)


def grouped(value, digits=3):
    """Text of a number from 10 000 to below a million, with groups of three digits."""
    return f"{float(f'{value:.{digits}g}'):,.0f}".replace(",", "\xa0")


def verdict_line(printed):
    """First line of the verdict in the output of a command: further lines of it are indented, and no lines
    but those on files follow.
    """
    lines = [line for line in printed.splitlines() if line and not line.startswith((" ", "written"))]
    return lines[-1]
