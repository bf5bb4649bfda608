"""The film command: films of a smooth contact from the atlas."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING

import typer

from ehlectric.commands.options import command
from ehlectric.commands.terminal import print_rows, user_errors
from ehlectric.readable import readable

if TYPE_CHECKING:
    from ehlectric.quantities.rows import Row
    from ehlectric.runs.lookups import LookedUp

_FILMS = {"central": "central film", "minimum": "minimum film", "mean": "mean film over the Hertzian zone"}


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
    composite_rq: str | None = None,
    composite_ra: str | None = None,
    as_json: bool = False,
) -> None:
    """Print the films of a smooth contact at once, interpolated between solved ones, each with its error.

    The contact is given by --m, --l and --k, or by --oil, --radius, --modulus, --load and --speed. Films are
    isothermal and fully flooded. Outside the range of the atlas only the range is printed.
    """
    given = {
        "m": m, "l": l, "k": k, "oil": oil, "temperature": temperature, "load": load, "speed": speed,
        "radius": radius, "radius_across": radius_across, "modulus": modulus,
        "composite_rq": composite_rq, "composite_ra": composite_ra,
    }  # fmt: skip
    with user_errors():
        from ehlectric.runs.lookups import film_of, film_summary

        looked_up = film_of(given, options=True)
    if as_json:
        typer.echo(json.dumps(film_summary(looked_up), indent=2))
    else:
        print_rows(_rows(looked_up), "film from the atlas")


def _rows(looked_up: LookedUp) -> Iterator[Row]:
    """Rows of the film: in nm for a contact in SI units, else in Moes' unit."""
    from ehlectric.quantities.rows import Row

    groups, film, contact = looked_up.groups, looked_up.film, looked_up.contact
    yield Row("Moes' M", float(groups.moes_m))
    if looked_up.moes_l is not None:
        yield Row("Moes' L", looked_up.moes_l, note=", with alpha* of the oil")
    yield Row("Moes' L of the atlas", float(groups.moes_l), note=", with the film coefficient")
    if groups.ratio is not None:
        yield Row("ratio of the semi-axes k", float(groups.ratio))
    for name, title in _FILMS.items():
        error = f", ± {readable(float(100.0 * film.errors[name]), 2)} %"
        if contact is None:
            yield Row(f"{title}, Moes' unit", getattr(film, name), note=error, digits=".4g")
        else:
            yield Row(title, getattr(contact, f"{name}_thickness"), "nm", error, digits=".4g")
    if looked_up.lambda_ratio is not None:
        note = ", minimum film / composite Rq"
        yield Row("lambda ratio", looked_up.lambda_ratio, note=note, digits=".3g")
    yield Row("minimum at x/b", float(film.minimum_at[0]))
    if groups.ratio is not None:
        yield Row("minimum at y/a", float(film.minimum_at[1]))
