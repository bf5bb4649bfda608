"""Measured source of a drive: its file, read and resampled, and the warnings about it."""

from __future__ import annotations

from ehlectric.cases.drives.source import Source
from ehlectric.drive.source.quality import edge_warnings, repeat_warnings
from ehlectric.drive.source.resampling import resample
from ehlectric.drive.source.waveform import Waveform
from ehlectric.drive.source.waveform_file import read_waveform
from ehlectric.errors import InputError, ResultWarning


def measured_source(
    source: Source, duration: float | None
) -> tuple[Waveform | None, tuple[ResultWarning, ...]]:
    """Measured waveform and the warnings about its file; None for a described source.

    Parameters
    ----------
    source : Source
        Table ``source`` of the drive.
    duration : float or None
        Time that is simulated [s]; None for that of the record.

    Raises
    ------
    InputError
        If the file cannot be read or resampled; its key begins with ``source``.
    """
    if source.file is None:
        return None, ()
    try:
        waveform, told = read_waveform(
            source.file,
            column=source.column,
            time_column=source.time_column,
            step=source.step,
            time_unit=source.time_unit,
            value_unit=source.value_unit,
            scale=source.scale,
        )
    except InputError as error:
        raise error.under("source") from None
    if source.resample is not None:
        waveform, told = _resampled(waveform, told, source.file, source.resample)
    return waveform, (*told, *repeat_warnings(source.file, waveform, duration))


def _resampled(
    waveform: Waveform, told: tuple[ResultWarning, ...], file: str, step: float
) -> tuple[Waveform, tuple[ResultWarning, ...]]:
    """Waveform at a coarser step, and the warnings about its samples: its own edges are judged."""
    try:
        coarse = resample(waveform, step)
    except InputError as error:
        raise error.retold("source.resample", error.text) from None
    others = (one for one in told if one.code != "edges-unresolved")
    return coarse, (*others, *edge_warnings(file, coarse))
