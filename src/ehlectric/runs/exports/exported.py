"""Results that can be exported."""

from __future__ import annotations

from typing import TypeAlias

from ehlectric.runs.results import AnyResult
from ehlectric.sweep.results import SweepResults

Exported: TypeAlias = AnyResult | SweepResults
