"""Characters and names of units as people type them, in the spelling that ``units.py`` and pint read."""

from __future__ import annotations

import re
import unicodedata

# Superscript exponents as in GPa⁻¹. NFKC would turn "5²" into the number 52, so that they are replaced first.
_SUPERSCRIPT = re.compile("[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+")
# A sign on the line before a raised digit, as Malvern writes "s-¹".
_SIGNED = re.compile("(?<=[A-Za-zµΩ])([+-])(?=[⁰¹²³⁴⁵⁶⁷⁸⁹])")
_NOT_RAISED = re.compile("[^⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+")
_DIGITS = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_RAISED_SIGNS = str.maketrans("+-", "⁺⁻")

# Characters that look alike and that NFKC does not join: degree signs, minus signs and signs of a product.
_BEFORE = str.maketrans(
    {
        "\N{MASCULINE ORDINAL INDICATOR}": "°",
        "\N{RING ABOVE}": "°",
        "\N{MINUS SIGN}": "-",
        "\N{EN DASH}": "-",
        "\N{HYPHEN}": "-",
        "\N{NON-BREAKING HYPHEN}": "-",
    }
)
_AFTER = str.maketrans(
    {
        "\N{GREEK SMALL LETTER MU}": "µ",
        "\N{DIVISION SLASH}": "/",
        "\N{DOT OPERATOR}": "·",
        "\N{BULLET OPERATOR}": "·",
        "\N{KATAKANA MIDDLE DOT}": "·",
    }
)

# A product in brackets after a slash, as in W/(m K), and what separates its factors.
_BRACKETS = re.compile(r"/\s*+\(([^()/]{1,60})\)")
_PRODUCT = re.compile(r"\s*[*·]\s*|\s+")

# Names of units with their letters, and the spelling of units.py and pint. A mil is a thousandth of an inch
# here; to pint it is an angle.
_LETTER = "[A-Za-zµΩ°ÅΔ_]"
_WORDS = [
    (re.compile(pattern.format(rf"(?<!{_LETTER})", rf"(?!{_LETTER})")), spelling)
    for pattern, spelling in (
        (r"{}(?:°|(?i:deg(?:rees?)?)\.?)[ _]*(?i:c(?:elsius)?|centigrade){}", "degC"),
        (r"{}(?:°|(?i:deg(?:rees?)?)\.?)[ _]*(?i:f(?:ahrenheit)?){}", "degF"),
        (r"{}(?:°|(?i:deg(?:rees?)?)\.?)[ _]*(?i:r(?:ankine)?){}", "degR"),
        (r"{}(?:°|(?i:deg(?:rees?)?)\.?)[ _]*(?i:k(?:elvins?)?){}", "K"),
        (r"{}(?i:grad|degr[eé]s?)[ _]*(?i:celsius|c){}", "degC"),
        (r"{}(?i:celsius|centigrade){}", "degC"),
        (r"{}(?i:fahrenheit){}", "degF"),
        (r"{}(?i:kelvins?){}", "K"),
        (r"{}(?:Δ|delta_?)(?:deg|°)(?=[CF]{})", "delta_deg"),
        (r"{}mils?{}", "thou"),
        (r"{}([mµu]?)Pas{}", r"\1Pa s"),
        (r"{}([kM]?)Nm{}", r"\1N m"),
        (r"{}kp{}", "kgf"),
        (r"{}Torr{}", "torr"),
        # To pint, a kmph is a thousand miles per hour.
        (r"{}(?i:kmph|kmh|kph|km/hr?){}", "km/h"),
        (r"(?i:ohms?){1}", "ohm"),
    )
]
_DOT = re.compile(rf"(?<={_LETTER})\.(?={_LETTER})")


def typed(text: str) -> str:
    """Text with one character for each meaning: compatibility forms after NFKC, except superscripts.

    Examples
    --------
    >>> typed("70 ℃"), typed("３ ㎛"), typed("46 ㎟/s"), typed("46 mm²/s"), typed("\N{MINUS SIGN}3 V")
    ('70 °C', '3 µm', '46 mm2/s', '46 mm²/s', '-3 V')
    """
    if text.isascii():
        return text
    return _NOT_RAISED.sub(
        lambda match: unicodedata.normalize("NFKC", match[0].translate(_BEFORE)).translate(_AFTER), text
    )


def plain(text: str) -> str:
    """Unit in the spelling of pint: exponents as digits, products without brackets, and known names.

    Examples
    --------
    >>> plain("GPa⁻¹"), plain("W/(m K)"), plain("V/mil"), plain("° F"), plain("s-¹")
    ('GPa^-1', 'W/m/K', 'V/thou', 'degF', 's^-1')
    """
    text = _SIGNED.sub(lambda match: match[0].translate(_RAISED_SIGNS), typed(text))
    text = _SUPERSCRIPT.sub(lambda match: "^" + match[0].translate(_DIGITS), text).strip()
    if text == "°":
        return "deg"
    text = _BRACKETS.sub(lambda match: "/" + "/".join(_PRODUCT.split(match[1].strip())), text)
    text = _DOT.sub("·", text)
    for pattern, spelling in _WORDS:
        text = pattern.sub(spelling, text)
    return text
