"""The film command: films of a smooth contact from the atlas."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING

import typer

from ehlectric.commands.options import command
from ehlectric.commands.terminal import print_rows, user_errors
from ehlectric.errors import InputError
from ehlectric.readable import readable

if TYPE_CHECKING:
    from ehlectric.film.atlas.atlas_films import AtlasFilm, ContactFilm
    from ehlectric.film.atlas.atlas_groups import Groups
    from ehlectric.quantities.rows import Row

# Options of a contact in numbers with units: name, SI unit.
_UNITS = {"radius": "m", "radius_across": "m", "modulus": "Pa", "speed": "m/s"}

_FILMS = {"central": "central film", "minimum": "minimum film", "mean": "mean film over the Hertz zone"}


@command("film")
def film(
    m: float | None = None,
    l: float | None = None,  # noqa: E741
    k: float | None = None,
    oil: str | None = None,
    temperature: str | None = None,
    radius: str | None = None,
    radius_across: str | None = None,
    modulus: str | None = None,
    load: str | None = None,
    speed: str | None = None,
    as_json: bool = False,
) -> None:
    """Print the films of a smooth contact at once, interpolated between solved ones, each with its error.

    The contact is given by --m, --l and --k, or by --oil, --radius, --modulus, --load and --speed. Films are
    isothermal and fully flooded. Outside the range of the atlas nothing is printed but the range.
    """
    with user_errors():
        given = {"radius": radius, "radius_across": radius_across, "modulus": modulus, "speed": speed}
        if m is not None or l is not None or k is not None:
            given_too = {"oil": oil, "temperature": temperature, "load": load} | given
            for name, value in given_too.items():
                if value is not None:
                    flag = f"--{name.replace('_', '-')}"
                    raise InputError(flag, got="it beside --m, --l or --k", takes="one way of the two")
            groups, result, found = _by_groups(m, l, k)
        else:
            found = _by_numbers(given, load, oil, temperature)
            groups, result = found.groups, found.film
    if as_json:
        typer.echo(json.dumps(_summary(groups, result, found), indent=2))
    else:
        print_rows(_rows(groups, result, found), "film from the atlas")


def _by_groups(m: float | None, l: float | None, k: float | None) -> tuple[Groups, AtlasFilm, None]:  # noqa: E741
    """Film of Moes' groups."""
    from ehlectric.film.atlas.atlas_films import atlas_film
    from ehlectric.film.atlas.atlas_groups import Groups

    for name, value in (("--m", m), ("--l", l), ("--k", k)):
        if (value is None and name != "--k") or (value is not None and not 0.0 < value < math.inf):
            raise InputError(name, got="nothing" if value is None else f"{value:g}", takes="a number above 0")
    assert m is not None
    assert l is not None
    groups = Groups(m, l, k)
    return groups, atlas_film(groups), None


def _by_numbers(
    given: dict[str, str | None], load: str | None, oil: str | None, temperature: str | None
) -> ContactFilm:
    """Film of a contact in SI units and an oil."""
    from ehlectric.cases import case_oil
    from ehlectric.film.atlas.atlas_films import contact_film
    from ehlectric.formulas.film_line import LineContact
    from ehlectric.formulas.film_point import PointContact

    if oil is None:
        raise InputError("--oil", got="nothing", takes="an oil, or --m and --l")
    at = case_oil.oil(oil, temperature)
    point = given["radius_across"] is not None
    needed = [name for name in _UNITS if point or name != "radius_across"]
    values = {name: _number(name, given[name], _UNITS[name]) for name in needed}
    force = _number("load", load, "N" if point else "N/m")
    common = (values["modulus"], force, values["speed"], at.viscosity, 0.0)
    if point:
        return contact_film(PointContact(values["radius"], values["radius_across"], *common), at)
    return contact_film(LineContact(values["radius"], *common), at)


def _number(name: str, text: str | None, unit: str) -> float:
    """Number above zero in an SI unit."""
    from ehlectric.cases.amounts import Amount

    flag = f"--{name.replace('_', '-')}"
    if text is None:
        raise InputError(flag, got="nothing", takes=f"a number in {unit}")
    try:
        return Amount(unit=unit, above=0.0).parse(text, written=True)
    except InputError as error:
        raise error.retold(flag, error.text) from None


def _rows(groups: Groups, film: AtlasFilm, found: ContactFilm | None) -> Iterator[Row]:
    """Rows of the film: in nm for a contact in SI units, else in Moes' unit."""
    from ehlectric.quantities.rows import Row

    yield Row("Moes' M", groups.moes_m)
    yield Row("Moes' L", groups.moes_l, note=", with the coefficient of the atlas")
    if groups.ratio is not None:
        yield Row("ratio of the semi-axes k", groups.ratio)
    for name, title in _FILMS.items():
        error = f", ± {readable(100.0 * film.errors[name], 2)} %"
        if found is None:
            yield Row(f"{title}, Moes' unit", getattr(film, name), note=error, digits=".4g")
        else:
            yield Row(title, getattr(found, f"{name}_thickness"), "nm", error, digits=".4g")
    yield Row("minimum at x/b", film.minimum_at[0])
    if groups.ratio is not None:
        yield Row("minimum at y/a", film.minimum_at[1])


def _summary(groups: Groups, film: AtlasFilm, found: ContactFilm | None) -> dict[str, object]:
    """Numbers for ``--json``, films in Moes' unit, and in m for a contact in SI units."""
    numbers: dict[str, object] = asdict(groups) | asdict(film)
    if found is not None:
        numbers |= {f"{name}_thickness": getattr(found, f"{name}_thickness") for name in _FILMS}
    return numbers
