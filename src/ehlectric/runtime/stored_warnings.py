"""Warnings in files: texts beside codes, and codes for files of earlier versions, which have texts only."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from ehlectric.errors import CODES, ResultWarning

# Keys of summary.json, and names of attributes in NetCDF files.
TEXTS, CODES_OF_TEXTS = "warnings", "warning_codes"

# Words that occur in the warnings of one code only, in the order in which they are searched for.
_WORDS = (
    ("on this grid; do not use it", "grid-far-too-coarse"),
    ("it is no solution: ", "not-converged"),
    ("the next coarser grid was not solved", "coarser-grid-unsolved"),
    ("before it, do not use this film; lower grid.inlet", "inlet-far-too-short"),
    ("which makes the film too thin, do not use it", "domain-far-too-small"),
    ("do not use", "not-usable"),
    (" regime: the ", "regime"),
    ("the ambient pressure carries", "ambient-pressure"),
    ("bearing steel deforms permanently", "plastic-deformation"),
    ("Barus' law overstates", "law-range"),
    ("Roelands' own relation gives", "roelands-z"),
    ("positions are written in steps of their spacing", "spacing-irregular"),
    ("voids within it were filled", "voids-filled"),
    ("truncate cuts", "heights-cut"),
    ("it was continued by extend", "roughness-continued"),
    ("does not resolve the", "roughness-unresolved"),
    ("% of the variance of surface", "variance-missed"),
    ("rough surfaces have the seed", "seed-repeated"),
    ("the surfaces would touch at", "surfaces-touch"),
    ("the film is thinner than an atom", "thinner-than-atom"),
    ("grid.refine: ", "refine-not-reached"),
    ("nothing is known of the discretisation error", "error-unknown"),
    ("on this grid; take more grid.nodes", "grid-too-coarse"),
    ("the film does not cavitate before", "outlet-too-short"),
    ("the inlet is too short", "inlet-too-short"),
    ("the domain is too small", "domain-too-small"),
    ("is coarser than the film, which has", "field-grid-too-coarse"),
    ("the largest field is at an e", "field-range-too-narrow"),
    ("no insulator withstands more", "field-above-insulators"),
    ("breakdown is expected: ", "breakdown-expected"),
    ("electrons tunnel through it", "tunnelling"),
    ("leaves discharge.strength_table", "strength-table-exceeded"),
    ("the roughness that moves is up to", "stationary-differs"),
    ("the same roughness", "stationary-not-converged"),
    ("and moving about as much", "stationary-error"),
    ("time steps had to be halved", "steps-halved"),
    ("contacts by formula: ", "formula-contacts"),
    ("the film is isothermal and fully flooded", "isothermal-film"),
    ("bearing.temperature has no part in the films", "temperature-unused"),
    ("the viscosity from 40 and 100 °C", "temperature-low"),
    ("loads are those of dry contacts", "clearance-taken-up"),
    ("the shoulder cuts it off", "shoulder-reached"),
    (": surfaces touch", "touching"),
    (": surfaces may touch", "partial-film"),
    ("the elements are ceramic: the capacitance", "capacitance-bound"),
    ("at a probability of 63.2 % (Weibull)", "weibull-voltage"),
)


def texts_and_codes(warnings: Iterable[ResultWarning]) -> dict[str, list[str]]:
    """Entries of a summary for warnings: their texts and their codes, lists of equal length.

    Examples
    --------
    >>> texts_and_codes([ResultWarning("regime", "rigid-piezoviscous regime")])
    {'warnings': ['rigid-piezoviscous regime'], 'warning_codes': ['regime']}
    """
    listed = tuple(warnings)
    texts, codes = [str(warning) for warning in listed], [warning.code for warning in listed]
    return {TEXTS: texts, CODES_OF_TEXTS: codes}


def warnings_of(table: Mapping[str, Any]) -> tuple[ResultWarning, ...]:
    """Warnings of a summary.

    Parameters
    ----------
    table : mapping
        Summary with ``warnings`` and ``warning_codes``, as ``texts_and_codes`` makes them. ``code_of_text``
        gives the codes where ``warning_codes`` is missing, as in files of earlier versions, and where this
        version does not know a code.

    Returns
    -------
    tuple of ResultWarning
        Warnings in the order of their texts.

    Raises
    ------
    ValueError
        Where there are more or fewer codes than texts.

    Examples
    --------
    >>> (warning,) = warnings_of({"warnings": ["the inlet is too short"], "warning_codes": ["not-converged"]})
    >>> warning.severity
    'severe'
    """
    texts = table.get(TEXTS, ())
    codes = table.get(CODES_OF_TEXTS, texts)  # a text is never a code
    return tuple(
        ResultWarning(code if code in CODES else code_of_text(text), text)
        for text, code in zip(texts, codes, strict=True)
    )


def code_of_text(text: str) -> str:
    """Code of a warning that an earlier version wrote without one.

    This is the only place where words of a warning decide anything, and only for files that lack codes.

    Parameters
    ----------
    text : str
        Warning of a contact, bearing or transient contact.

    Returns
    -------
    str
        One of ``CODES``; "not-usable" for other texts that say "do not use", else "unclassified".

    Examples
    --------
    >>> code_of_text("inner contact at 20 N: the film may be 32 % off or more on this grid; do not use it")
    'grid-far-too-coarse'
    >>> code_of_text("mind the gap")
    'unclassified'
    """
    return next((code for words, code in _WORDS if words in text), "unclassified")


def as_attributes(warnings: Iterable[ResultWarning]) -> dict[str, str]:
    """Attributes of a NetCDF file for warnings: texts and codes, each as JSON."""
    return {name: json.dumps(values) for name, values in texts_and_codes(warnings).items()}


def of_attributes(attributes: Mapping[Any, Any]) -> tuple[ResultWarning, ...]:
    """Warnings in the attributes of a NetCDF file, read as by ``warnings_of``.

    Examples
    --------
    >>> of_attributes({"warnings": '["the inlet is too short: 2 % of the pressure"]'})[0].code
    'inlet-too-short'
    """
    return warnings_of({n: json.loads(attributes[n]) for n in (TEXTS, CODES_OF_TEXTS) if n in attributes})
