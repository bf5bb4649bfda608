"""Figure of the spectrum of the shaft voltage of a drive."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.app.answers.bearing import Figure, Table
from ehlectric.app.figures.look import axis, plot, values
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive import findings
from ehlectric.figures.drive.looks import voltage_unit
from ehlectric.figures.drive.spectrum import highest_lines, shown_range
from ehlectric.quantities.palette import BLUE

_HEIGHT = 380

# Lines of the table, the largest ones.
_TOLD = 12


def spectrum_figure(result: DriveResult) -> Figure:
    """Amplitude spectrum of the shaft voltage, with both axes logarithmic."""
    frequencies, amplitudes = highest_lines(result)
    factor, unit = voltage_unit(float(np.max(amplitudes)))
    curve = {
        "type": "scatter",
        "mode": "lines",
        "x": values(frequencies, 6),
        "y": values(factor * amplitudes, 4),
        "name": "shaft voltage",
        "line": {"color": BLUE, "width": 1.5},
        "hovertemplate": f"%{{y:.3g}} {unit} at %{{x:.5g}} Hz<extra></extra>",
    }
    shown = [math.log10(factor * end) for end in shown_range(amplitudes)]
    figure = plot(
        [curve],
        height=_HEIGHT,
        xaxis=axis("frequency [Hz]", type="log", exponentformat="SI"),
        yaxis=axis(
            f"amplitude of the shaft voltage [{unit}]",
            type="log",
            exponentformat="power",
            dtick=1,
            range=shown,
        ),
    )
    largest = np.argsort(-amplitudes, kind="stable")[:_TOLD]
    rows = tuple((f"{frequencies[k]:.6g}", f"{factor * amplitudes[k]:.4g}") for k in largest)
    return Figure(
        "Spectrum of the shaft voltage",
        f"Amplitude of the shaft voltage over the frequency. {findings.spectrum(result)}.",
        figure,
        Table("Largest lines", ("frequency [Hz]", f"amplitude [{unit}]"), rows),
        f"{findings.spectrum(result)}. Amplitudes are peak values, without a window.",
    )
