"""All figures of a drive, by their names."""

from __future__ import annotations

from ehlectric.app.answers.bearing import Figure
from ehlectric.app.figures.drives.discharges import distributions
from ehlectric.app.figures.drives.remedies import remedies_figure
from ehlectric.app.figures.drives.spectrum import spectrum_figure
from ehlectric.app.figures.drives.voltages import histogram_figure, voltages_figure
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive.spectrum import has_spectrum


def drive_figures(result: DriveResult) -> dict[str, Figure]:
    """Figures of a simulated drive; those with nothing to show are left out."""
    found = {}
    if len(result.solution.record.trace) > 1:
        found["voltages"] = voltages_figure(result)
    if result.remedies:
        found["remedies"] = remedies_figure(result)
    found["histogram"] = histogram_figure(result)
    if has_spectrum(result):
        found["spectrum"] = spectrum_figure(result)
    return {**found, **distributions(result)}
