"""Table ``inlet`` of a case: oil that is supplied to a starved contact."""

from __future__ import annotations

from collections.abc import Collection
from typing import Annotated, Self

from pydantic import model_validator

from ehlectric.cases.amounts import Amount, Amounts
from ehlectric.cases.contact import Contact
from ehlectric.cases.table import Table
from ehlectric.errors import InputError
from ehlectric.quantities.alternatives import ALTERNATIVES

_THICKNESS = Amount("m", least=1e-9, most=1e-2, reason="of the oil on both surfaces together")
_ACROSS = Amount("m", least=-1.0, most=1.0, reason="across entrainment, from the centre of the contact")


class LayerTable(Table):
    """Layer of oil at the inlet of a point contact over the position across entrainment, linear between."""

    y: Annotated[tuple[float, ...], Amounts(_ACROSS, least=2)]
    thickness: Annotated[tuple[float, ...], Amounts(_THICKNESS, least=2)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if any(b <= a for a, b in zip(self.y, self.y[1:], strict=False)):
            raise InputError("y", got=list(self.y), takes="increasing values")
        if len(self.thickness) != len(self.y):
            got = f"{len(self.thickness)} values over {len(self.y)} of y"
            raise InputError("thickness", got=got, takes="as many")
        return self


class Inlet(Table):
    """Oil that is supplied to a contact: a layer on its surfaces, or the film that it gives without motion.

    Examples
    --------
    >>> Inlet.from_dict({"oil_layer": "200 nm"}).oil_layer
    2e-07
    """

    oil_layer: Annotated[float, _THICKNESS] | None = None
    layer_table: LayerTable | None = None
    film_ratio: (
        Annotated[
            float,
            Amount("", least=1e-3, most=1.0, reason="starved over flooded central film", fraction=True),
        ]
        | None
    ) = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = [row[0] for row in ALTERNATIVES["inlet"][0]]
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) != 1:
            together = f"{' and '.join(given)} together" if given else None
            raise InputError(names[0], got=together, takes=f"one of {', '.join(names)}")
        return self

    def check(self, contact: Contact, *, beside: Collection[str]) -> None:
        """Check that the table fits the other tables of its case.

        Parameters
        ----------
        contact : Contact
            Table ``contact`` of the case.
        beside : collection of str
            Names of the other tables of the case.

        Raises
        ------
        InputError
            If a line contact has a layer over y, surfaces move in opposite directions, a contact with motion
            has a ratio of films, or the case has the table ``meter`` or ``film``.
        """
        if contact.opposed:
            raise InputError(
                "inlet",
                got="[inlet] with surfaces that move in opposite directions",
                takes="a slide-to-roll ratio from -2 to 2: one of the surfaces carries its oil away",
            )
        if self.layer_table is not None and contact.geometry == "line":
            raise InputError("inlet.layer_table", got="that of a line contact", takes="inlet.oil_layer")
        if "motion" in beside and self.film_ratio is not None:
            raise InputError(
                "inlet.film_ratio",
                got=f"{self.film_ratio:g} beside [motion], in which the film changes with time",
                takes="inlet.oil_layer or inlet.layer_table; the same case without [motion] finds the layer",
            )
        for table in ("meter", "film"):
            if table in beside:
                raise InputError("inlet", got=f"[inlet] beside [{table}]", takes="a flooded contact there")
