"""Errors that end a request, and warnings that a result carries."""

from __future__ import annotations

import reprlib
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal, Self

# Largest length of a value in a message, and of an error's key, which may be a path, and text [characters].
_MOST_SHOWN, _LONGEST_LINE = 80, 2000

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60
_SHORT.maxlevel = 3

# Unicode categories of characters that are not seen, or that change how the text around them is seen: control
# and format characters (bidirectional controls, characters of no width), line separators, parts of pairs.
_UNSEEN = frozenset({"Cc", "Cf", "Zl", "Zp", "Cs"})

# "severe": the numbers must not be used. "note": the numbers are valid, and the text tells how they were
# obtained.
Severity = Literal["note", "warning", "severe"]

# First words of a warning by its severity, as a page or a report shows it.
SEVERITY_WORDS: Mapping[str, str] = MappingProxyType(
    {"note": "Note", "warning": "Warning", "severe": "Do not use"}
)


def unseen(letter: str) -> bool:
    """Whether a character is a control or format character, or a line separator.

    A terminal obeys such characters, and readers do not see them. Spaces of any width are none of them.
    """
    return unicodedata.category(letter) in _UNSEEN


def printable(text: str) -> str:
    r"""Text on one line, with the characters that a terminal obeys or that are not seen as escapes. Returns
    text without control characters, format characters and line separators; a text without them is unchanged,
    and so is a text that is already printable.

    Examples
    --------
    >>> print(printable("6208\x1b[31m\nfilm"))
    6208\x1b[31m\nfilm
    """
    if text.isprintable():
        return text
    return "".join(repr(letter)[1:-1] if unseen(letter) else letter for letter in text)


def short(text: str, most: int = _MOST_SHOWN) -> str:
    """Text of at most ``most`` characters: the middle of a longer one is left out.

    Examples
    --------
    >>> short("1" * 500, 10)
    '1111...111'
    """
    if len(text) <= most:
        return text
    tail = (most - 3) // 2
    return f"{text[: most - 3 - tail]}...{text[len(text) - tail :]}"


def _line(text: str) -> str:
    """Text on one line: line breaks become spaces, other control characters are escaped.

    The middle of a text that would fill a screen is left out.
    """
    return short(printable(" ".join(text.splitlines())), _LONGEST_LINE)


class InputError(ValueError):
    """Error of a wrong input: one line that names the key, its value, and the values that are allowed.

    The line is ``key: got VALUE; expected TAKES``, or ``key: missing; expected TAKES`` without a value. A
    single argument is the whole line of an error without a key.

    Parameters
    ----------
    key : object, optional
        Dotted key of the wrong input, or name of an option or a file.
    says : str, optional
        Text in place of "got VALUE".
    got : object, optional
        Value of the input, as the line shows it.
    takes : str, optional
        Values that are allowed.

    Attributes
    ----------
    key : str or None
        Name of the wrong input; None if the error is not about a single input.
    text : str
        The line without the key.
    got : object
        Value of the input, or the text in its place; None if the line has neither.
    takes : str or None
        Values that are allowed; None if the line does not state them.
    several : tuple of InputError
        Errors that the line joins; empty for the error of one input.

    Examples
    --------
    >>> error = InputError("contact.radius_x", got="-1 m", takes="above 0 m")
    >>> str(error)
    'contact.radius_x: got -1 m; expected above 0 m'
    >>> error.key, error.got, error.takes
    ('contact.radius_x', '-1 m', 'above 0 m')
    >>> str(InputError("rough.csv", "has 3 points", takes="at least 16"))
    'rough.csv: has 3 points; expected at least 16'
    """

    key: str | None
    text: str
    got: object
    takes: str | None
    several: tuple[InputError, ...] = ()

    def __init__(
        self, key: object = None, says: str | None = None, /, *, got: object = None, takes: str | None = None
    ) -> None:
        if says is None and got is None and takes is None:
            key, wrong = None, "" if key is None else str(key)
        else:
            wrong = says if says is not None else "missing" if got is None else f"got {got}"
            got = says if got is None else got
        self.text = _line(wrong if takes is None else f"{wrong.removesuffix(';')}; expected {takes}")
        self.key = None if key is None else short(printable(str(key)), _LONGEST_LINE)
        self.got = got.removesuffix(";") if isinstance(got, str) else got
        self.takes = takes
        super().__init__(self.text if self.key is None else f"{self.key}: {self.text}")

    @classmethod
    def missing(cls, key: str, takes: str) -> Self:
        """Error of a required key that is missing."""
        return cls(key, takes=takes)

    @property
    def is_missing(self) -> bool:
        """Whether the error is that of a value that is missing."""
        return self.text.startswith("missing")

    @classmethod
    def unknown(cls, key: str, nearest: str) -> Self:
        """Error of a key that does not exist; ``nearest`` is the existing key with the most similar name."""
        return cls.worded(short(key), f"unknown key; the nearest known one is {nearest}", takes=nearest)

    @classmethod
    def worded(cls, key: object, text: str, *, got: object = None, takes: str | None = None) -> Self:
        """Error whose line has a free text after the key; ``got`` and ``takes`` are attributes only."""
        error = cls(key, text)
        error.got, error.takes = got, takes
        return error

    def retold(self, key: str | None, text: str) -> Self:
        """Copy of the error with another key and text, but the same ``got`` and ``takes``."""
        return self.worded(key, text, got=self.got, takes=self.takes)

    @classmethod
    def together(cls, errors: Sequence[InputError]) -> InputError:
        """Error with the key of the first of several errors, whose line also has what the others say.

        Examples
        --------
        >>> wrong = InputError("contact.load", got="'20 V'", takes="a force")
        >>> print(InputError.together([wrong, InputError.missing("lubricant", "a table")]))
        contact.load: got '20 V'; expected a force; also missing: lubricant
        """
        each = [one for error in errors for one in error.several or (error,)]
        first, *others = several = {(error.key, error.text): error for error in each}.values()
        missing = [error.key or "" for error in others if error.is_missing]
        further = [str(error) for error in others if not error.is_missing]
        text = first.text + "".join(f"; also {line}" for line in further)
        if missing:
            text += f"; also missing: {', '.join(dict.fromkeys(missing))}"
        joined = first.retold(first.key, text)
        joined.several = tuple(several) if others else ()
        return joined

    def under(self, table: str) -> Self:
        """Copy of the error with its key in a table; an error without a key gets the table as its key.

        Examples
        --------
        >>> str(InputError("width", got="2 m", takes="less").under("roughness"))
        'roughness.width: got 2 m; expected less'
        """
        if self.several:
            joined: Any = self.together([error.under(table) for error in self.several])
            return joined  # type: ignore[no-any-return]
        return self.retold(".".join(filter(None, [table, self.key])) or None, self.text)


class MemoryLimitError(InputError):
    """Error of a solution that does not fit into the available memory; with more of it, it may be solved."""


class WriteError(InputError):
    """Error of a file that cannot be written, as on a full disk."""


class DamagedError(InputError):
    """Error of a stored file that is not as it was written, or does not hold what it must."""

    @classmethod
    def of(cls, path: object, what: str) -> Self:
        """Error of a file, with what is wrong in it.

        Examples
        --------
        >>> str(DamagedError.of("result.nc", "pressure is missing"))
        'result.nc: is damaged: pressure is missing; compute it again'
        """
        return cls(path, f"is damaged: {what}; compute it again")


class LostError(RuntimeError):
    """Error of a solution that lost its worker processes, its cluster or its memory."""


class ConvergenceError(RuntimeError):
    """Error of an iteration that did not converge, where only a converged solution is of use."""


def shown(value: object) -> str:
    """Representation of a value, short enough for a one-line message."""
    try:
        text = _SHORT.repr(value)
    except ValueError:
        # Python writes no whole number of more than some thousand digits.
        text = f"a whole number of {value.bit_length()} bits" if isinstance(value, int) else "a value"
    return short(text)


@dataclass(frozen=True)
class Cause:
    """Meaning of a warning code in one sentence, severity, and keys of the quantities that it concerns.

    Outputs show a warning beside those quantities; one without any concerns the whole result. The keys of
    both bearings of a drive begin with "end".
    """

    meaning: str
    severity: Severity = "warning"
    concerns: tuple[str, ...] = ()


# Quantities that many warnings concern, of contacts, of bearings, and of the bearings at the ends of a drive.
_FILM = ("film.minimum_thickness", "film.central_thickness")
_FIRST = ("bearing.first_break", "bearing.margin", "end.breakdown_voltage")
_OF_BEARINGS = ("bearing.lambda_ratio", *_FIRST)
_EVERY_FILM = (*_FILM, *_OF_BEARINGS)
_BREAKDOWN = ("discharge.breakdown_voltage", *_FIRST)
_CAPACITANCE = ("bearing.capacitance", "end.capacitance")
_PEAK = ("end.voltage_at_peak", "end.peak_voltage")
_ALL = (
    *_EVERY_FILM,
    *_CAPACITANCE,
    "film.max_pressure",
    "field.max_strength",
    "field.capacitance",
    "discharge.breakdown_voltage",
    "bearing.shaft_voltage",
)

CODES: Mapping[str, Cause] = MappingProxyType(
    {
        # Contact, known before its film is computed
        "regime": Cause(
            "The lubrication regime is outside the validity of most film formulas.", concerns=_EVERY_FILM
        ),
        "radius-large": Cause("A radius above 1 m was probably given in the wrong unit."),
        "modulus-low": Cause("A modulus of rubber was probably given in the wrong unit."),
        "ambient-pressure": Cause(
            "The ambient pressure carries more than 1 % of the load.", concerns=("hertz.max_pressure",)
        ),
        "plastic-deformation": Cause(
            "The Hertz pressure deforms bearing steel permanently.",
            concerns=(*_OF_BEARINGS, "hertz.max_pressure"),
        ),
        "hardness-low": Cause(
            "The hardness of the surfaces is below the Hertz pressure.",
            concerns=(*_OF_BEARINGS, "hertz.max_pressure"),
        ),
        "law-range": Cause(
            "A law of the lubricant is not reliable at this Hertz pressure.",
            concerns=(*_OF_BEARINGS, "hertz.max_pressure"),
        ),
        "roelands-z": Cause(
            "The exponent roelands_z does not fit the viscosity and its coefficient.", concerns=_EVERY_FILM
        ),
        "estimated-alpha": Cause(
            "The pressure-viscosity coefficient is estimated from the base oil.", concerns=_EVERY_FILM
        ),
        # Rough surfaces
        "spacing-irregular": Cause("Samples may be missing in a file of heights."),
        "voids-filled": Cause("Voids in a measured surface were filled.", "note"),
        "heights-cut": Cause("The key truncate cuts a large share of the heights."),
        "roughness-continued": Cause("A rough surface is shorter than the domain and was continued."),
        "roughness-unresolved": Cause(
            "The grid does not resolve a rough surface.",
            concerns=(*_EVERY_FILM, "film.max_pressure", "field.max_strength", "discharge.breakdown_voltage"),
        ),
        "variance-missed": Cause(
            "Some of the variance of a rough surface is too fine for the grid.",
            concerns=(*_EVERY_FILM, "film.max_pressure", "field.max_strength", "discharge.breakdown_voltage"),
        ),
        "seed-repeated": Cause("Rough surfaces have the same seed and depend on each other."),
        # Film
        "not-converged": Cause("The iteration of the film did not converge.", "severe", concerns=_ALL),
        "surfaces-touch": Cause(
            "The surfaces of the computed film would touch in places.",
            concerns=(*_OF_BEARINGS, "film.minimum_thickness", "discharge.breakdown_voltage"),
        ),
        "asperities-touch": Cause(
            "Asperities touch, carry a part of the load and conduct.",
            concerns=(
                *_OF_BEARINGS,
                "film.minimum_thickness",
                "field.capacitance",
                "field.max_strength",
                "discharge.breakdown_voltage",
            ),
        ),
        "load-share-unresolved": Cause(
            "The load share of asperities changes with the grid.", concerns=("asperities.load_share",)
        ),
        "oil-not-conserved": Cause(
            "The film makes or loses above 0.1 % of the oil that flows through it.", concerns=_EVERY_FILM
        ),
        "thinner-than-atom": Cause(
            "The film is thinner than an atom in places.",
            concerns=(
                *_OF_BEARINGS,
                "film.minimum_thickness",
                "field.max_strength",
                "discharge.breakdown_voltage",
            ),
        ),
        "error-out-of-reach": Cause(
            "The error of the film that is asked for is probably out of reach.", concerns=_EVERY_FILM
        ),
        "refine-not-reached": Cause(
            "The error of the film that was asked for was not reached.", concerns=_EVERY_FILM
        ),
        "error-unknown": Cause(
            "The discretisation error of a rough contact's film is unknown.",
            concerns=(*_OF_BEARINGS, "film.minimum_thickness"),
        ),
        "coarser-grid-unsolved": Cause(
            "The discretisation error is unknown and probably large.",
            "severe",
            concerns=(
                *_EVERY_FILM,
                "film.max_pressure",
                "field.max_strength",
                "field.capacitance",
                "discharge.breakdown_voltage",
            ),
        ),
        "grid-too-coarse": Cause(
            "The estimated discretisation error of the film is large.", concerns=_EVERY_FILM
        ),
        "grid-far-too-coarse": Cause(
            "The discretisation error of the film is above 10 %.", "severe", concerns=_ALL
        ),
        "local-plastic-deformation": Cause(
            "The local pressure deforms bearing steel permanently.",
            concerns=(*_OF_BEARINGS, "film.max_pressure"),
        ),
        "outlet-too-short": Cause("The film does not cavitate within the domain.", concerns=_OF_BEARINGS),
        "inlet-too-short": Cause(
            "Some of the inlet pressure builds up upstream of the domain.", concerns=_EVERY_FILM
        ),
        "inlet-far-too-short": Cause(
            "Above 20 % of the inlet pressure builds up upstream.", "severe", concerns=_ALL
        ),
        "domain-too-small": Cause("The domain is too small for the contact.", concerns=_EVERY_FILM),
        "domain-far-too-small": Cause(
            "The domain of a point contact is far too small.", "severe", concerns=_ALL
        ),
        "oil-layer-thick": Cause(
            "The layer of oil is thicker than what the contact takes.", "note", concerns=_EVERY_FILM
        ),
        "meniscus-at-edge": Cause(
            "The meniscus is at the edge of the domain or of the Hertz zone.", concerns=_EVERY_FILM
        ),
        "film-ratio-missed": Cause(
            "No layer of oil was found that gives the ratio of films asked for.", concerns=_EVERY_FILM
        ),
        "layer-table-short": Cause(
            "The layer of oil over y does not reach the sides of the contact.", concerns=_EVERY_FILM
        ),
        "flooded-film-wrong": Cause("The flooded film beside a starved one is wrong or not known."),
        "shear-constant-unused": Cause("Constants of another law of shear are given.", "note"),
        "newtonian-traction": Cause(
            "The law between stress and shear rate has no limit at high pressure.",
            concerns=("film.traction_coefficient", "film.max_temperature_rise", "film.power_loss"),
        ),
        "film-temperature-range": Cause(
            "The film is hotter or colder than the laws of the oil are known.",
            concerns=(*_EVERY_FILM, "film.max_temperature_rise"),
        ),
        "film-very-hot": Cause(
            "The film is hotter than oils stand.", concerns=(*_EVERY_FILM, "film.max_temperature_rise")
        ),
        "isothermal-unsolved": Cause("The isothermal film beside that with heat or shear did not converge."),
        "heat-unresolved": Cause(
            "The grid does not resolve the heat in the film.",
            concerns=(*_EVERY_FILM, "film.max_temperature_rise"),
        ),
        "slow-body": Cause(
            "A surface moves too slowly for the model of its temperature.",
            concerns=(*_EVERY_FILM, "film.max_temperature_rise"),
        ),
        # Electric field and discharge
        "field-grid-too-coarse": Cause(
            "The grid of the field is coarser than that of the film.",
            concerns=(*_BREAKDOWN, "field.max_strength", "field.capacitance"),
        ),
        "field-unresolved": Cause(
            "The estimated error of the maximum field is above 2 %, or unknown.",
            concerns=(*_BREAKDOWN, "field.max_strength"),
        ),
        "field-range-too-narrow": Cause(
            "The maximum field is at an edge of the field range.",
            concerns=(*_BREAKDOWN, "field.max_strength"),
        ),
        "field-above-insulators": Cause(
            "The maximum field is higher than any insulator withstands.",
            concerns=("field.max_strength", "bearing.shaft_voltage", "bearing.margin"),
        ),
        "breakdown-expected": Cause(
            "The margin is below 1: breakdown is expected.",
            concerns=("discharge.breakdown_voltage", "bearing.margin"),
        ),
        "strength-above-liquids": Cause(
            "No liquid has a dielectric strength as high as the given one.", concerns=_BREAKDOWN
        ),
        "tunnelling": Cause(
            "The film is so thin that electrons tunnel through it.",
            concerns=(*_BREAKDOWN, "field.max_strength"),
        ),
        "strength-table-exceeded": Cause(
            "The film pressure exceeds the range of discharge.strength_table.", concerns=_BREAKDOWN
        ),
        "roughness-factor-rough": Cause(
            "The film is too thin for a roughness factor of its capacitance.",
            concerns=(*_CAPACITANCE, "field.capacitance"),
        ),
        "coating-in-series": Cause(
            "Field and discharge are those of the film, without its coating.",
            "note",
            concerns=(
                "field.max_strength",
                "discharge.breakdown_voltage",
                "bearing.first_break",
                "end.breakdown_voltage",
            ),
        ),
        # Transient contacts
        "stationary-differs": Cause("The moving roughness differs from the stationary one."),
        "stationary-not-converged": Cause("The film with stationary roughness did not converge."),
        "stationary-error": Cause("The stationary film has a discretisation error above 1 %."),
        "steps-too-long": Cause("The time steps of a motion do not resolve the waves that pass the oil."),
        "steps-halved": Cause("Some time steps had to be halved.", "note"),
        # Bearings
        "formula-contacts": Cause(
            "The contacts of the bearing are computed by formulas.", concerns=(*_OF_BEARINGS, *_CAPACITANCE)
        ),
        "atlas-contacts": Cause(
            "Contacts have the films of the atlas.", "note", concerns=(*_OF_BEARINGS, *_CAPACITANCE)
        ),
        "atlas-left": Cause(
            "The atlas has no film of a contact, which is computed by formula.",
            concerns=(*_OF_BEARINGS, *_CAPACITANCE),
        ),
        "atlas-left-light": Cause("A light contact beyond the atlas is computed by formula.", "note"),
        "isothermal-film": Cause(
            "The films are isothermal and fully flooded.",
            "note",
            concerns=(*_OF_BEARINGS, "discharge.breakdown_voltage", "bearing.regime"),
        ),
        "temperature-unused": Cause(
            "The films use a given viscosity at any temperature.", "note", concerns=_EVERY_FILM
        ),
        "viscosity-of-base": Cause(
            "The viscosity is that of a lubricant of the library at any temperature.", concerns=_EVERY_FILM
        ),
        "temperature-low": Cause("The viscosity is extrapolated to below 0 °C.", concerns=_EVERY_FILM),
        "speed-high": Cause("The speed is above that of ordinary bearings of this size."),
        "load-low": Cause("The load is tiny for a bearing of this size."),
        "temperature-extreme": Cause("Bearing steel or oil do not stand this temperature."),
        "viscosity-high": Cause("The oil is so viscous that it hardly flows.", concerns=_EVERY_FILM),
        "clearance-class": Cause("The clearance is that of a class, before the bearing is mounted."),
        "clearance-negative": Cause("Fits and temperatures preload the bearing.", "note"),
        "fit-loose": Cause("A ring that is fitted tight is loose at the temperatures of operation."),
        "viscosity-grade": Cause(
            "The viscosity is the middle of a grade, 10 % either way.", "note", concerns=_EVERY_FILM
        ),
        "clearance-taken-up": Cause(
            "The films are not small compared with the clearance.", concerns=_OF_BEARINGS
        ),
        "shoulder-reached": Cause(
            "A contact ellipse extends beyond the shoulder of its groove.", concerns=(*_FIRST, *_CAPACITANCE)
        ),
        "touching": Cause(
            "The lambda ratio is below 1: contacts touch, and discharge as they open.",
            concerns=(*_EVERY_FILM, *_CAPACITANCE, "bearing.regime"),
        ),
        "partial-film": Cause(
            "The lambda ratio is below 3: surfaces may touch, and discharge then.",
            concerns=(*_EVERY_FILM, "bearing.regime"),
        ),
        "smooth-film": Cause(
            "The films are smooth, with the film factor of the case.",
            "note",
            concerns=(*_OF_BEARINGS, "discharge.breakdown_voltage"),
        ),
        "supply-rule": Cause(
            "A rule for the rolling friction gives the supply of oil to the films.", concerns=_EVERY_FILM
        ),
        "film-factor-low": Cause(
            "The film factor is so low that films differ from it by its exponent.", concerns=_EVERY_FILM
        ),
        "supply-low": Cause(
            "The supply of oil leaves less than half of the flooded film.", concerns=_EVERY_FILM
        ),
        "film-decays": Cause(
            "The film halves soon if no oil returns to its track.", "note", concerns=_EVERY_FILM
        ),
        "shaft-leaks": Cause(
            "The oil discharges the shaft within a period of the inverter.",
            concerns=("bearing.shaft_voltage", "bearing.margin"),
        ),
        "coating-assumed": Cause(
            "Thickness or permittivity of a coating are assumed.",
            "note",
            concerns=(*_PEAK, "bearing.shaft_voltage"),
        ),
        "coating-breakdown": Cause(
            "The shaft voltage is above the breakdown voltage of the coating.",
            concerns=(*_PEAK, "bearing.shaft_voltage"),
        ),
        "current-density-high": Cause(
            "The apparent current density is above the lowest of the published limits.",
            concerns=("end.current_density",),
        ),
        "capacitance-bound": Cause(
            "The capacitance of a bearing with ceramic elements is an upper bound.",
            concerns=(*_CAPACITANCE, "field.capacitance", "bearing.shaft_voltage"),
        ),
        "weibull-voltage": Cause(
            "Breakdown voltages are those at a probability of 63.2 %.", "note", concerns=_BREAKDOWN
        ),
        "speed-left-out": Cause("The figures over speed leave out a speed that cannot be computed."),
        # Sweeps
        "points-with-warnings": Cause("Solved points of a sweep have warnings."),
        "points-with-notes": Cause("Solved points of a sweep have notes.", "note"),
        "points-not-usable": Cause("Solved points of a sweep have films that must not be used."),
        "points-of-another-version": Cause("Another version of the program solved points.", "note"),
        "rows-dropped": Cause("Rows of a Sobol design were left out of its sensitivity indices."),
        "rows-not-usable": Cause("Rows of a Sobol design use films that must not be used."),
        "intervals-wide": Cause("The confidence intervals of sensitivity indices are wide."),
        # Measurements beside a case
        "formula-films": Cause(
            "The films beside a measurement are those of a formula.", concerns=_EVERY_FILM
        ),
        "columns-ignored": Cause("Columns of a measurement are not known and were ignored.", "note"),
        "rows-without-factor": Cause("Rows of a measurement have no film factor."),
        "scatter-only": Cause("The interval of a film factor is from the scatter of the rows only."),
        "scatter-large": Cause("Film factors scatter more than the measurement states."),
        "factor-varies": Cause("The film factor changes with the speed."),
        "range-left-out": Cause("The uncertainty of a film factor leaves out the range of an input."),
        # Measured waveforms
        "units-assumed": Cause(
            "A file of a waveform states no units; seconds and volts were taken.",
            "note",
            concerns=("source.peak",),
        ),
        "samples-missing": Cause(
            "Samples may be missing in a file of a waveform.", concerns=("source.peak",)
        ),
        "waveform-clipped": Cause(
            "The range of the oscilloscope was probably exceeded.", concerns=("source.peak",)
        ),
        "waveform-coarse": Cause(
            "A measured waveform has few different voltages.", concerns=("source.peak",)
        ),
        "edges-unresolved": Cause(
            "A waveform has edges with fewer than three samples.", concerns=("source.peak",)
        ),
        "record-repeated": Cause(
            "A measured waveform is repeated, with a jump from its end to its start.",
            concerns=("source.peak",),
        ),
        "circuit-undamped": Cause(
            "An oscillation of the circuit of a drive is hardly damped.", concerns=_PEAK
        ),
        "capacitances-estimated": Cause(
            "Capacitances of a machine follow from its geometry.",
            "note",
            concerns=("circuit.winding_rotor_capacitance", "end.voltage_at_peak"),
        ),
        "edges-faster-than-oil": Cause(
            "The edges of a drive are faster than its oil conducts.",
            "note",
            concerns=("end.voltage_at_peak", "end.events_per_second"),
        ),
        "both-ends-discharge": Cause(
            "Both bearings of a drive discharge at the same edges.",
            "note",
            concerns=("end.events_per_second",),
        ),
        "threshold-constant": Cause(
            "Films of a drive break down at the same voltage each time.",
            concerns=("end.breakdown_voltage", "end.events_per_second"),
        ),
        "arc-burns-on": Cause(
            "After breakdowns, films of a drive conduct for much of the time.",
            concerns=("end.events_per_second",),
        ),
        "few-discharges": Cause(
            "A drive discharged too seldom in the simulated time for a certain rate.",
            concerns=("end.events_per_second",),
        ),
        # Files of other versions
        "not-usable": Cause(
            "Another version of the program says not to use the numbers.", "severe", concerns=_ALL
        ),
        "unclassified": Cause("Another version of the program gave this warning."),
    }
)


@dataclass(frozen=True)
class ResultWarning:
    """Warning of a result: a code for programs, and a text for people.

    Programs should use ``code`` and ``severity``, because the words of ``text`` may change.

    Parameters
    ----------
    code : str
        Code of the warning, one of ``CODES``, such as "grid-too-coarse".
    text : str
        One line that says what is unreliable and what to do about it.

    Raises
    ------
    ValueError
        If the code is not in ``CODES``.

    Examples
    --------
    >>> warning = ResultWarning("not-converged", "do not use this film, it is no solution")
    >>> print(warning)
    do not use this film, it is no solution
    >>> warning.severity
    'severe'
    """

    code: str
    text: str

    def __post_init__(self) -> None:
        if self.code not in CODES:
            raise ValueError(f"{self.code!r} is no code of a warning; expected one of {', '.join(CODES)}")

    def __str__(self) -> str:
        return self.text

    @property
    def severity(self) -> Severity:
        """Severity of the code: "note", "warning", or "severe" if the numbers must not be used."""
        return CODES[self.code].severity


# Keys of summary.json, and attributes of files, with the texts of warnings and their codes.
TEXTS, CODES_OF_TEXTS = "warnings", "warning_codes"


def texts_and_codes(warnings: Iterable[ResultWarning]) -> dict[str, list[str]]:
    """Entries of a summary for warnings: their texts and their codes, lists of equal length.

    >>> texts_and_codes([ResultWarning("regime", "rigid-piezoviscous regime")])
    {'warnings': ['rigid-piezoviscous regime'], 'warning_codes': ['regime']}
    """
    listed = tuple(warnings)
    return {TEXTS: [str(one) for one in listed], CODES_OF_TEXTS: [one.code for one in listed]}


def warnings_of(table: Mapping[str, Any]) -> tuple[ResultWarning, ...]:
    """Warnings of a summary; raises a ValueError where there are more or fewer codes than texts.

    A later version may give codes that this one does not know: they become "not-usable" where the text says
    "do not use", else "unclassified".
    """
    pairs = zip(table.get(CODES_OF_TEXTS, ()), table.get(TEXTS, ()), strict=True)
    return tuple(ResultWarning(code if code in CODES else _foreign(text), text) for code, text in pairs)


def _foreign(text: str) -> str:
    return "not-usable" if "do not use" in text else "unclassified"
