"""Calibration of a case and its files: summary.json, compared.csv and the calibrated case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ehlectric.calibration.calibrated_files import kept_text
from ehlectric.calibration.range_update import calibrate
from ehlectric.calibration.result import Calibration
from ehlectric.runtime.files import write_together
from ehlectric.runtime.folders import alone_in
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.reading import read_text
from ehlectric.runtime.result_names import CALIBRATED
from ehlectric.runtime.result_names import OF_CALIBRATIONS as FILES

UNEXPLAINED = "nothing within the ranges explains the measurement; no calibrated file is written"


def calibrate_to_folder(
    case: Any,
    folder: str | Path,
    progress: Progress = silent,
    *,
    measured: Path | None = None,
    background: str | None = None,
    uncertainty: str | None = None,
    file: Path | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[Calibration]:
    """Calibrate a case, and write summary.json, compared.csv and calibrated.toml.

    The outcome has a ``failure``, and there is no calibrated.toml, if nothing within the ranges explains the
    measurement. ``file``, file of the case, whose units and comments calibrated.toml keeps. Files of an
    earlier result in the folder are removed, also the ``others``.
    """
    names = (*FILES, *others)
    with alone_in(folder, names) as folder:
        result = calibrate(case, measured, background=background, uncertainty=uncertainty, progress=progress)
        text = None
        if file is not None and result.case is not None:
            text = kept_text(read_text(file), case, result.case, folder.absolute() / CALIBRATED)
        files = write_together(folder, result.contents(text), names)
    failure = None if result.explained else UNEXPLAINED
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)
