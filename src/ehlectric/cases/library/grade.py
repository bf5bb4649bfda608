"""Viscosity grades of ISO 3448 as values of a case."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from ehlectric.cases.amounts import scalar
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.viscosity_index import GRADES
from ehlectric.runtime.values import is_number

_WRITTEN = re.compile(r"\s*(?:ISO[ -]?)?(?:VG[ -]?)?(\d{1,4})\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Grade:
    """Pydantic annotation of a viscosity grade: 46, "46", "VG 46" or "ISO VG 46"."""

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def __get_pydantic_json_schema__(self, _: CoreSchema, __: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"anyOf": [{"type": "integer", "enum": list(GRADES)}, {"type": "string"}]}

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"a viscosity grade of ISO 3448: {', '.join(map(str, GRADES))}"

    def parse(self, entry: object) -> int:
        """Grade as a whole number.

        Raises
        ------
        InputError
            If the entry is not a grade of ISO 3448.

        Examples
        --------
        >>> Grade().parse("ISO VG 46")
        46
        """
        item = scalar(entry)
        match = _WRITTEN.fullmatch(item) if isinstance(item, str) else None
        grade = int(match[1]) if match else item
        if not is_number(grade) or grade not in GRADES:
            raise InputError(got=shown(entry), takes=self.takes)
        return int(grade)
