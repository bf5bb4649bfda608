"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

CaseFile = Annotated[Path, typer.Argument(help="Case file, TOML.", show_default=False)]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No table, progress or warnings.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]
