"""Answers without a solution, as the commands check, film, surface, oils and bearings give them, in SI units.

Numbers equal those that the commands print with ``--json``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.errors import InputError, shown, within
from ehlectric.runtime.display import is_number

if TYPE_CHECKING:
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.cases.keywords import Value
    from ehlectric.film import AtlasFilm, ContactFilm, Groups
    from ehlectric.formulas.film_line import Thickness
    from ehlectric.runs.preview import Preview
    from ehlectric.sweep import Sweep

# Films of the atlas, and arguments for Moes' groups.
_FILMS, _GROUPS = ("central", "minimum", "mean"), ("m", "l", "k")


def check(case: Case | BearingCase | DriveCase | Sweep | Mapping[str, Any] | str | Path) -> Preview:
    """Check a case of any kind without solving it, and return what it means, as ``ehlectric check`` does.

    Parameters
    ----------
    case : Case, BearingCase, DriveCase, Sweep, mapping, str or Path
        Case or sweep, its nested tables, or the path of its TOML file.

    Returns
    -------
    ehlectric.runs.preview.Preview
        ``summary``, nested tables of numbers in SI units: dry contact, groups and film formulas of a contact;
        loads, films and margin of a bearing; circuit of a drive; number of points of a sweep and its first
        point. ``rows`` of the table, ``warnings``, and ``verdict`` of a bearing with a dielectric strength.

    Raises
    ------
    InputError
        If the case cannot be solved; the message names the key, its value, and what is allowed.

    Examples
    --------
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
    >>> contact |= {"entrainment_speed": "4 m/s"}
    >>> preview = check({"contact": contact, "lubricant": "paper"})
    >>> round(preview.summary["hertz"]["half_width"] * 1e6, 1)
    249.6
    """
    from ehlectric.runs.by_kind import RUNS
    from ehlectric.runs.file_kinds import kind_of_tables, read_input
    from ehlectric.runs.preview import preview_of
    from ehlectric.runs.solve import case_of
    from ehlectric.sweep import Sweep

    if isinstance(case, Sweep):
        return preview_of(case)
    if isinstance(case, str | Path):
        file = read_input(case)
        return preview_of(RUNS[file.kind].read(file))
    if isinstance(case, Mapping) and kind_of_tables(case) == "sweep":
        return preview_of(Sweep.from_dict(case))
    return preview_of(case_of(case))


def formulas(case: Case | Mapping[str, Any] | str | Path) -> dict[str, Thickness]:
    """Compute the film thickness of a contact from each published formula, without solving it.

    Films are isothermal, fully flooded and smooth. ``check`` gives the ranges of the formulas.

    Parameters
    ----------
    case : Case, mapping, str or Path
        Case of a line or point contact, its nested tables, or the path of its TOML file.

    Returns
    -------
    dict of str to Thickness
        ``minimum_thickness`` and ``central_thickness`` [m] by the name of the formula; None for a thickness
        that a formula does not give.

    Raises
    ------
    InputError
        If the case is not valid, or not the case of a contact.

    Examples
    --------
    >>> ball = {"geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm", "load": "20 N"}
    >>> ball |= {"reduced_modulus": "226 GPa", "entrainment_speed": "2 m/s"}
    >>> films = formulas({"contact": ball, "lubricant": "paper"})
    >>> round(films["hamrock_dowson"].central_thickness * 1e9)
    422
    """
    from ehlectric.cases.case import Case
    from ehlectric.contact import formulas_of, prepare
    from ehlectric.runs.solve import case_of

    contact_case = case_of(case)
    if not isinstance(contact_case, Case):
        raise InputError(
            "case", got=type(contact_case).__name__, takes="the case of a contact; check takes any case"
        )
    return dict(formulas_of(prepare(contact_case).conditions))


def film(
    *,
    m: float | None = None,
    l: float | None = None,  # noqa: E741  # Moes' L
    k: float | None = None,
    oil: str | Path | Mapping[str, Any] | None = None,
    temperature: str | float | None = None,
    radius: Value | None = None,
    radius_across: Value | None = None,
    modulus: Value | None = None,
    load: Value | None = None,
    speed: Value | None = None,
    composite_rq: Value | None = None,
    composite_ra: Value | None = None,
) -> dict[str, Any]:
    """Interpolate the films of a smooth contact in the atlas of solved films, as ``ehlectric film`` does.

    The contact is given by Moes' groups, or by an oil, radii, modulus, load and speed. Films are isothermal
    and fully flooded. A number is a float in SI units, a text with its unit, or a quantity of pint.

    Parameters
    ----------
    m, l, k : float, optional
        Moes' load parameter M, material parameter L with the film coefficient, ``atlas_moes_l``, and the
        ratio of the semi-axes k of a point contact.
    oil : str, Path or mapping, optional
        Oil, as ``ehlectric.oil`` takes it.
    temperature : str or float, optional
        Temperature of the oil with its unit, or in kelvin.
    radius, radius_across : number, optional
        Reduced radius along entrainment, and across entrainment for a point contact [m].
    modulus : number, optional
        Reduced modulus E', with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa].
    load : number, optional
        Load [N], of a line contact per length [N/m].
    speed : number, optional
        Entrainment speed, mean speed of both surfaces [m/s].
    composite_rq : number, optional
        Composite root-mean-square roughness of both surfaces [m], with an oil.
    composite_ra : number, optional
        Composite mean roughness Ra [m] instead of ``composite_rq``: Rq = 1.2533 Ra, of Gaussian heights.

    Returns
    -------
    dict
        ``moes_m``, ``moes_l``, ``atlas_moes_l``, ``ratio``; ``central``, ``minimum`` and ``mean`` film in
        Moes' unit; ``errors``, relative error of each; and, with an oil, ``central_thickness``,
        ``minimum_thickness`` and ``mean_thickness`` [m]. ``moes_l`` is L with the reciprocal asymptotic
        coefficient of the oil, as in ``check`` and in summary.json; None without an oil. ``atlas_moes_l`` is
        L with the film coefficient, which the atlas uses. With ``composite_rq``, ``lambda_ratio`` is
        ``minimum_thickness`` divided by it.

    Raises
    ------
    InputError
        If a value is missing or wrong, both ways are mixed, or the contact is outside the atlas.

    Notes
    -----
    The atlas is on the page "Atlas of films" of the documentation, with its range and its errors.

    Examples
    --------
    >>> found = film(oil="fva-3", temperature="70 degC", radius=0.01, modulus=226e9, load=1e5, speed=5.0)
    >>> round(found["central_thickness"] * 1e9)
    652
    """
    given = {
        "m": m, "l": l, "k": k, "oil": oil, "temperature": temperature, "load": load, "speed": speed,
        "radius": radius, "radius_across": radius_across, "modulus": modulus,
        "composite_rq": composite_rq, "composite_ra": composite_ra,
    }  # fmt: skip
    return film_summary(film_of(given))


@dataclass(frozen=True)
class LookedUp:
    """Film of the atlas as ``film`` finds it."""

    groups: Groups  # M, L with the film coefficient, and k
    film: AtlasFilm  # films in Moes' unit
    # Films in m, and L with the reciprocal asymptotic coefficient; None without an oil.
    contact: ContactFilm | None = None
    moes_l: float | None = None
    lambda_ratio: float | None = None  # minimum film divided by the composite Rq; None without a roughness


def film_of(given: Mapping[str, Any], *, options: bool = False) -> LookedUp:
    """Films of the arguments of ``film``.

    Errors name ``options`` of the command if the arguments are texts of them, whose numbers have units.
    """
    groups: list[Any] = [given.get(name) for name in _GROUPS]
    others = {name: value for name, value in given.items() if name not in _GROUPS and value is not None}
    if all(value is None for value in groups):
        return _by_numbers(others, options=options)
    m, l, k = (_named(name, options=options) for name in _GROUPS)  # noqa: E741
    for name in others:
        got = f"it with {m}, {l} or {k}"
        raise InputError(_named(name, options=options), got=got, takes="one way of the two")
    for name, value in zip((m, l, k), groups, strict=True):
        if value is None and name == k:
            continue
        if not is_number(value) or not 0.0 < value < math.inf:
            raise InputError(name, got="nothing" if value is None else shown(value), takes="a number above 0")
    from ehlectric.film import Groups, atlas_film

    of_groups = Groups(*groups)
    return LookedUp(of_groups, atlas_film(of_groups))


def _named(name: str, *, options: bool) -> str:
    """Name of an argument, or of its option of the command."""
    return f"--{name.replace('_', '-')}" if options else name


# Numbers of a contact with an oil: name, SI unit.
_UNITS = {"radius": "m", "radius_across": "m", "modulus": "Pa", "speed": "m/s"}


def _by_numbers(given: Mapping[str, Any], *, options: bool) -> LookedUp:
    """Film of a contact in SI units and an oil."""
    from ehlectric.cases import case_oil
    from ehlectric.film import contact_film
    from ehlectric.formulas.film_line import LineContact
    from ehlectric.formulas.film_point import PointContact

    if "oil" not in given:
        oil, m, l = (_named(name, options=options) for name in ("oil", "m", "l"))  # noqa: E741
        raise InputError(oil, got="nothing", takes=f"an oil, or {m} and {l}")
    at = case_oil.oil(given["oil"], given.get("temperature"))
    point = "radius_across" in given
    needed = [name for name in _UNITS if point or name != "radius_across"]
    values = {name: _number(name, given, _UNITS[name], options=options) for name in needed}
    contact: PointContact | LineContact
    with _of_geometry(point=point, options=options):
        force = _number("load", given, "N" if point else "N/m", options=options)
        common = {
            "reduced_modulus": values["modulus"],
            "entrainment_speed": values["speed"],
            "viscosity": at.viscosity,
            "pressure_viscosity_coefficient": at.alpha_star,
        }
        if point:
            radii = {"radius_x": values["radius"], "radius_y": values["radius_across"]}
            contact = PointContact(**radii, **common, load=force)
        else:
            contact = LineContact(**common, reduced_radius=values["radius"], load_per_length=force)
        films = contact_film(contact, at)
    rq = _rq(given, options=options)
    ratio = None if rq is None else float(films.minimum_thickness) / rq
    return LookedUp(films.groups, films.film, films, float(contact.moes_l), ratio)


def _rq(given: Mapping[str, Any], *, options: bool) -> float | None:
    """Composite Rq [m], given or from Ra; None without either. Raises InputError for both."""
    from ehlectric.cases.mean_heights import rq_of

    names = [name for name in ("composite_rq", "composite_ra") if name in given]
    if not names:
        return None
    rq, *others = (_named(name, options=options) for name in names)
    if others:
        raise InputError(rq, got=f"{rq} and {others[0]} together", takes="one of them")
    height = _number(names[0], given, "m", options=options)
    return height if names[0] == "composite_rq" else float(rq_of(height, None))


@contextmanager
def _of_geometry(*, point: bool, options: bool) -> Iterator[None]:
    """Add to errors which contact was assumed, because only ``radius_across`` decides about it."""
    across, load = (_named(name, options=options) for name in ("radius_across", "load"))
    assumed = f"{across} is not given, so that a line contact was assumed, with {load} in N/m; for a point "
    assumed += f"contact, give {across} too, with {load} in N"
    if point:
        assumed = f"{across} is given, so that a point contact was assumed, with {load} in N; for a line "
        assumed += f"contact, omit {across}, with {load} in N/m"
    try:
        yield
    except InputError as error:
        raise InputError.worded(
            error.key, f"{error.text}; {assumed}", got=error.got, takes=error.takes
        ) from None


def _number(name: str, given: Mapping[str, Any], unit: str, *, options: bool) -> float:
    """Number above zero in an SI unit."""
    from ehlectric.cases.amounts import Amount

    key = _named(name, options=options)
    if name not in given:
        raise InputError(key, got="nothing", takes=f"a number in {unit}")
    with within(key):
        return Amount(unit=unit, above=0.0).parse(given[name], written=options)


def film_summary(looked_up: LookedUp) -> dict[str, Any]:
    """Numbers of a film of the atlas by name: in Moes' unit, and in m for a contact with an oil."""
    groups, films = looked_up.groups, looked_up.contact
    numbers = {"moes_m": groups.moes_m, "moes_l": looked_up.moes_l, "atlas_moes_l": groups.moes_l}
    numbers |= {"ratio": groups.ratio} | asdict(looked_up.film)
    if films is not None:
        numbers |= {f"{name}_thickness": getattr(films, f"{name}_thickness") for name in _FILMS}
    if looked_up.lambda_ratio is not None:
        numbers["lambda_ratio"] = looked_up.lambda_ratio
    return numbers


def surface(file: str | Path, *, whole: bool = False, **keys: Any) -> dict[str, Any]:
    """Read and process a surface file without solving a contact, as ``ehlectric surface`` does.

    Parameters
    ----------
    file : str or Path
        File of a profile or of a map of heights.
    whole : bool, optional
        Whether a map is described as a whole, instead of one line of it.
    **keys
        Keys of a table ``[[roughness]]``, such as ``form="line"``, ``cutoff_long="80 um"`` or
        ``rescale_rq=50e-9`` [m].

    Returns
    -------
    dict
        Format and sampling of the file, and ``steps``, statistics of the surface after each step, in SI
        units; ``summits``, density [1/m^2], radius [m] and height deviation [m] of the summits.

    Raises
    ------
    InputError
        If the file cannot be read, or a key is unknown or wrong.

    Examples
    --------
    >>> import ehlectric
    >>> found = surface(ehlectric.example("surfaces/dektak-1.csv"), form="line")
    >>> [step["step"] for step in found["steps"]], round(found["steps"][-1]["rq"] * 1e9)
    (['as read', 'form: line'], 94)
    """
    from ehlectric.cases.roughness_inputs import Roughness
    from ehlectric.surfaces.rough_surfaces import measured, whole_map
    from ehlectric.surfaces.surface_warnings import summit_statistics

    roughness = Roughness.from_dict({"surface": 1, "file": str(file), **keys})
    rough = whole_map(roughness) if whole else measured(roughness)
    return rough.describe() | {"summits": summit_statistics(rough.steps[-1][1])}


def oils() -> list[dict[str, Any]]:
    """List the oils of the library, as ``ehlectric oils`` does.

    Returns
    -------
    list of dict
        For each oil ``name``, a value of ``lubricant.base``, its ``title``, its ``temperature_range`` [K],
        and its properties, each None or a mapping of ``value``, ``unit`` and the ``kind`` of its source.

    See Also
    --------
    ehlectric.oil : one oil at a temperature, with its laws over pressure.

    Examples
    --------
    >>> [oil["name"] for oil in oils()][:3]
    ['e-axle-fluid', 'fva-3', 'iso-vg-32']
    """
    from ehlectric.cases.library.library_oils import library_oils
    from ehlectric.tables.oil_tables import listed_oil

    return [listed_oil(oil) for oil in library_oils()]


def bearings() -> list[dict[str, Any]]:
    """List the bearings of the library, as ``ehlectric bearings`` does.

    Returns
    -------
    list of dict
        For each bearing ``name``, a value of ``bearing.base``, its ``kind``, number and dimensions of its
        ``elements`` [m], its ``contact_angle`` [rad], and its printed ``dynamic_rating`` and
        ``static_rating`` [N], None without a printed rating.

    Notes
    -----
    ``bearing.base`` also accepts designations of the usual series, whose elements are estimated.

    Examples
    --------
    >>> next(bearing for bearing in bearings() if bearing["name"] == "6208")["static_rating"]
    17900.0
    """
    from ehlectric.cases.library.bearing_catalogue import bearing_catalogue
    from ehlectric.tables.oil_tables import described

    return [described(bearing) for bearing in bearing_catalogue()]
