"""Film factors that explain measured capacitances, of a case of any kind."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.cases.defaults import QUICK, Contacts
from ehlectric.cases.measurements import BACKGROUND, UNCERTAINTY, parsed_option
from ehlectric.errors import InputError, shown
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    import pandas as pd

    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.cases.film_factors import FilmFactors
    from ehlectric.cases.measurements import Measurement


@dataclass(frozen=True)
class MeasuredFile:
    """Measurement that a command was given, with its options."""

    rows: Measurement
    background: str | None = None
    uncertainty: str | None = None

    @classmethod
    def of(cls, path: Path | None, background: str | None, uncertainty: str | None) -> MeasuredFile | None:
        """Measurement of the options of a command; None without a file. Raises InputError if the file cannot
        be read, or an option is wrong or stands without it.
        """
        given = {"--background": background, "--uncertainty": uncertainty}
        for option, value in given.items():
            if value == "":
                raise InputError(option, got="an empty text", takes="a value, or no such option")
            if value is not None and path is None:
                raise InputError.worded(option, "is used with --measured only")
        if path is None:
            return None

        from ehlectric.cases.measurements import read_measurement

        if background is not None:
            parsed_option(BACKGROUND, "--background", background)
        if uncertainty is not None:
            parsed_option(UNCERTAINTY, "--uncertainty", uncertainty, takes='a part in per cent, as "2 %"')
        return cls(read_measurement(path), background, uncertainty)

    def factors(
        self, case: BearingCase | Case, progress: Progress, workers: int | None = None
    ) -> FilmFactors:
        """Film factors of a case."""
        return film_factors(
            case,
            self.rows,
            background=self.background,
            uncertainty=self.uncertainty,
            progress=progress,
            workers=workers,
        )


def film_factors(
    case: BearingCase | Case,
    measured: str | Path | pd.DataFrame | Measurement,
    *,
    background: str | float | None = None,
    uncertainty: str | float | None = None,
    contacts: str | None = None,
    progress: Progress = silent,
    workers: int | None = None,
) -> FilmFactors:
    """Compute the film factors that explain a measurement: capacitance of a bearing, or film of a contact.

    The film factor is the film thickness divided by the isothermal, fully flooded film thickness. It contains
    heat, starvation and grease; ``film_factor`` and ``supply`` of the case are not used. Other than the key
    ``film_factor`` of a bearing file it may be above 1, where a film is thicker than computed.

    Parameters
    ----------
    case : BearingCase or Case
        Bearing for a measured capacitance; contact for a measured central film thickness.
    measured : str, Path or pandas.DataFrame
        Text file or table with columns such as ``speed [rpm]`` and ``capacitance [pF]``, or ``entrainment
        speed [m/s]`` and ``film [nm]``. An ``uncertainty`` is one standard deviation.
    background : str or float, optional
        Capacitance of leads, cage and fixture in parallel, such as "1.31 pF" or a number in farads; it is
        taken off every row.
    uncertainty : str or float, optional
        Relative standard uncertainty, such as "5 %", where the measurement has no such column.
    contacts : str, optional
        "atlas", "formula" or "solved". By default ``contacts`` of a bearing file, and "solved" for a contact.
    progress : callable, optional
        Called with the number of parts done, the number of all parts, and a text.
    workers : int, optional
        Number of processes for solved contacts of a bearing.

    Returns
    -------
    FilmFactors
        Film factor of every row, their mean with its 95 % interval, and warnings.

    Raises
    ------
    InputError
        If the measurement cannot be read, does not belong to the case, or an option is wrong.
    ConvergenceError
        If a film does not converge.

    Examples
    --------
    A film log of a rig, with a film 10 % thinner than computed:

    >>> import ehlectric, pandas as pd
    >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
    >>> case = ehlectric.Case.point(**ball, entrainment_speed="1 m/s", lubricant="paper")
    >>> log = pd.DataFrame({"entrainment speed [m/s]": [0.5, 1.0], "film [nm]": [151.0, 241.0]})
    >>> factors = ehlectric.film_factors(case, log, contacts="formula", uncertainty="3 %")
    >>> round(factors.mean.value, 2), factors.mean.rows
    (0.9, 2)
    """
    from ehlectric.bearing import bearing_factors
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.measurements import Measurement, read_measurement
    from ehlectric.contact import contact_factors

    if contacts not in (None, "atlas", "formula", "solved"):
        raise InputError("contacts", got=shown(contacts), takes="'atlas', 'formula' or 'solved'")
    options: dict[str, Any] = {"progress": progress}
    if uncertainty is not None:
        options["uncertainty"] = parsed_option(UNCERTAINTY, "uncertainty", uncertainty)
    rows = measured if isinstance(measured, Measurement) else read_measurement(measured)
    if isinstance(case, BearingCase):
        if background is not None:
            options["background"] = parsed_option(BACKGROUND, "background", background)
        case = case if contacts is None else case.replace({"contacts": contacts})
        return bearing_factors(case, rows, workers=workers, **options)
    if background is not None:
        raise InputError.worded("background", "is taken off a capacitance, and a film has none")
    way: Contacts = next((quick for quick in QUICK if quick == contacts), "solved")
    return contact_factors(case, rows, contacts=way, **options)
