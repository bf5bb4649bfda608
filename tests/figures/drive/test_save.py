"""Figures of a drive: what they show, and what they leave out."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.text import Text

from ehlectric import DriveCase, InputError, example, figure, figure_names, save_figures, solve_drive
from ehlectric.app.charts.drive_charts import drive_figures
from ehlectric.drive.drive_record import ENERGY, FILM, ON, VOLTAGE
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive_figures import shares_above
from ehlectric.figures.figure_names import (
    DRIVE_DUTY_FIGURE,
    DRIVE_FIGURE_FILES,
    DRIVE_FORCES_FIGURE,
    FORMATS,
    in_formats,
)
from ehlectric.figures.shaft_forces import forces_on_rotor
from ehlectric.readable import readable
from tests.helpers.drives import drive_with_remedy
from tests.helpers.statics import by_vectors
from tests.helpers.titles import title_of

VOLTAGES, HISTOGRAM, SPECTRUM, DISCHARGES, REMEDIES, DUTY, FORCES = (
    name.removesuffix(".png") for name in DRIVE_FIGURE_FILES
)


@pytest.fixture(scope="module")
def drive():
    return solve_drive(drive_with_remedy(), workers=1)


@pytest.fixture(scope="module")
def grounded(drive):
    """The drive with a ring, whose bearings do not discharge."""
    return DriveResult(drive.remedies[0][2])


def one_sided(drive):
    """The drive without the discharges of its drive end."""
    record = drive.solution.record
    counts = record.counts * np.array([[0], [1]])
    own = replace(record, counts=counts, events=record.events[record.events[:, FILM] == 1])
    return replace(drive, solution=replace(drive.solution, record=own))


def markers(ax, label):
    """Places of the markers of an entry of the legend."""
    return [line for line in ax.get_lines() if line.get_label() == label]


@pytest.mark.slow
def test_names_are_those_of_the_files(drive, grounded):
    assert figure_names(drive) == [VOLTAGES, HISTOGRAM, SPECTRUM, DISCHARGES, REMEDIES]
    assert figure_names(grounded) == [VOLTAGES, HISTOGRAM, SPECTRUM]
    with pytest.raises(InputError, match=r"^figure: .*'drive_remedies'.* drive_voltages"):
        figure(grounded, REMEDIES)
    assert title_of(drive.plot()) == title_of(figure(drive, VOLTAGES))


@pytest.mark.slow
def test_the_spectrum_is_drawn_with_its_largest_lines(drive):
    """Every line where they are far apart, and the largest of its neighbours elsewhere."""
    table = drive.spectrum()
    (ax,) = figure(drive, SPECTRUM).axes
    (curve,) = ax.get_lines()
    frequency, amplitude = curve.get_data()
    assert frequency[:20] == pytest.approx(table["frequency"][1:21].to_numpy())
    scale = {"V": 1.0, "mV": 1e3}[ax.get_ylabel().split("[")[1].rstrip("]")]
    assert np.max(amplitude) == pytest.approx(scale * np.max(table["shaft_voltage"][1:]))
    known = table.set_index("frequency")["shaft_voltage"]
    shown = amplitude > 2e-6 * np.max(amplitude)
    assert amplitude[shown] == pytest.approx(scale * known[frequency[shown]].to_numpy())
    record = replace(drive.solution.record, spectrum=np.zeros(0))
    earlier = replace(drive, solution=replace(drive.solution, record=record))
    assert SPECTRUM not in figure_names(earlier)


@pytest.mark.slow
def test_a_file_of_each_format_is_written(drive, tmp_path):
    files = save_figures(drive, tmp_path, FORMATS)
    absent = (DRIVE_DUTY_FIGURE, DRIVE_FORCES_FIGURE)
    without = [file for file in DRIVE_FIGURE_FILES if file not in absent]
    assert [file.name for file in files] == list(in_formats(without, FORMATS))
    assert all(file.is_file() for file in files)


@pytest.mark.slow
def test_a_figure_of_a_journal_has_the_width_of_its_column(drive):
    assert figure(drive, VOLTAGES, style="journal").get_figwidth() == pytest.approx(84.0 / 25.4)


@pytest.mark.slow
def test_discharges_are_marked_where_they_happen(drive):
    source, *panels = figure(drive, VOLTAGES).axes
    trace = drive.solution.record.trace
    assert source.get_lines()[0].get_ydata() == pytest.approx(trace[:, 1])
    begin, end = trace[0, 0], trace[-1, 0]
    events = drive.solution.record.events
    here = events[(events[:, ON] >= begin) & (events[:, ON] <= end)]
    assert len(here) > 2
    for b, ax in enumerate(panels):
        own = here[here[:, FILM] == b]
        (dots,) = markers(ax, "discharge")
        assert dots.get_ydata() == pytest.approx(own[:, VOLTAGE])
        assert dots.get_xdata() == pytest.approx(1e6 * (own[:, ON] - begin), abs=1e-6)
        (threshold,) = markers(ax, "breakdown, weakest position (63 %)")
        assert threshold.get_ydata()[0] == pytest.approx(
            np.min(drive.solution.elements[b].breakdown), rel=1e-12
        )
    title = " ".join(title_of(figure(drive, VOLTAGES)))
    # The mean of the discharges of both bearings.
    mean = np.mean([abs(event["voltage"]) for event in drive.events()])
    assert f"mean of all {readable(mean)} V" in title
    assert "3000 rpm" in title


@pytest.mark.slow
def test_no_discharge_is_said(grounded):
    drawn = figure(grounded, VOLTAGES)
    assert not any(markers(ax, "discharge") for ax in drawn.axes)
    assert title_of(drawn)[0].startswith("No discharge in 5 ms: at most 9")
    assert "mV" in drawn.axes[1].get_ylabel()
    assert title_of(figure(grounded, HISTOGRAM))[0].startswith("Low bearing voltage: at most 9")


@pytest.mark.slow
def test_shares_of_time_are_those_of_the_summary(drive):
    upper, lower = figure(drive, HISTOGRAM).axes
    assert (upper.get_yscale(), lower.get_yscale()) == ("log", "log")
    record = drive.solution.record
    edges, shares = shares_above(drive)
    assert shares[:, 0] == pytest.approx(np.full(2, 100.0))
    for b, end in enumerate(("drive_end", "non_drive_end")):
        told = {float(limit): 100.0 * share for limit, share in drive.summary()[end]["time_above"].items()}
        dots = [line for line in lower.get_lines() if line.get_marker() == "os"[b]]
        drawn = dict(zip(*(map(float, values) for values in dots[0].get_data()), strict=True))
        assert drawn == pytest.approx({limit: share for limit, share in told.items() if share > 0.0})
        # Between two edges of bins, the share is between those above both of them.
        for limit, share in told.items():
            if limit < record.edges[-1]:
                k = int(np.searchsorted(edges, limit))
                assert shares[b, k] - 1e-9 <= share <= shares[b, k - 1] + 1e-9


@pytest.mark.slow
def test_distributions_hold_every_discharge(drive):
    drawn = figure(drive, DISCHARGES)
    assert [ax.get_xlabel().partition(" [")[0] for ax in drawn.axes] == [
        "voltage of a discharge", "charge of a discharge", "energy of a discharge", "peak arc current",
    ]  # fmt: skip
    events = drive.solution.record.events
    for ax in drawn.axes:
        assert [float(np.sum(line.get_ydata())) for line in ax.get_lines()] == pytest.approx([100.0, 100.0])
    edges, shares = drawn.axes[2].get_lines()[-1].get_data()
    middles = 0.5 * (edges[1:] + edges[:-1])
    mean = 1e9 * float(np.mean(events[events[:, FILM] == 1, ENERGY]))
    width = float(np.max(np.diff(edges)))
    assert float(np.sum(0.01 * shares[:-1] * middles)) == pytest.approx(mean, abs=width)


@pytest.mark.slow
def test_a_bearing_without_discharges_is_left_out(drive):
    drawn = figure(one_sided(drive), DISCHARGES)
    (entry,) = drawn.axes[0].get_legend().get_texts()
    assert entry.get_text().startswith("non-drive end: ")
    assert "none (drive end)" in title_of(drawn)[0]


@pytest.mark.slow
def test_many_discharges_are_drawn(drive):
    record = drive.solution.record
    events = np.tile(record.events, (100_000 // len(record.events) + 1, 1))
    result = replace(drive, solution=replace(drive.solution, record=replace(record, events=events)))
    for name in (VOLTAGES, DISCHARGES):
        drawn = figure(result, name)
        assert drawn.axes
        assert sum(len(ax.patches) for ax in drawn.axes) < 20


@pytest.mark.slow
def test_remedies_are_beside_the_drive_as_it_is(drive):
    rates, energies = figure(drive, REMEDIES).axes
    assert [label.get_text() for label in rates.get_yticklabels()] == ["as it is", "Grounding ring"]
    summary = drive.summary()
    drawn = [line.get_xdata()[0] for line in rates.get_lines() if line.get_marker() in ("o", "s", "D")]
    ends = ("drive_end", "non_drive_end", "drive")
    assert drawn == pytest.approx([summary[end]["events_per_second"] for end in ends])
    bounds = [line.get_xdata() for line in rates.get_lines() if line.get_marker() == "<"]
    assert [one[0] for one in bounds] == pytest.approx(
        [summary["remedies"][0][end]["events_per_second_high"] for end in ends]
    )
    means = [line.get_xdata()[0] for line in energies.get_lines() if line.get_marker() in ("o", "s")]
    assert means == pytest.approx([1e9 * summary[end]["energy_mean"] for end in ends[:2]])
    assert "no discharge" in [text.get_text() for text in energies.findobj(Text)]
    assert title_of(figure(drive, REMEDIES))[0].startswith("No discharge with Grounding ring; ")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "on_page", "panel"),
    [
        (HISTOGRAM, "histogram", 0),
        (SPECTRUM, "spectrum", 0),
        (DISCHARGES, "discharge-voltage", 0),
        (DISCHARGES, "discharge-charge", 1),
        (DISCHARGES, "discharge-energy", 2),
        (DISCHARGES, "discharge-current", 3),
        (REMEDIES, "remedies", 0),
    ],
)
def test_page_and_file_show_the_same_values(drive, name, on_page, panel):
    """Curves by their names with colours and values, and both axes with their units."""
    ax, plot = figure(drive, name).axes[panel], drive_figures(drive)[on_page].plot
    layout = plot["layout"]
    named = {line.get_label(): line for line in ax.get_lines() if not line.get_label().startswith("_")}
    traces = [trace for trace in plot["data"] if trace["showlegend"] and trace["yaxis"] == "y"]
    assert traces
    if name != SPECTRUM:
        assert {trace["name"] for trace in traces} == {name for name in named if "breakdown" not in name}
    for trace in traces:
        line = named.get(trace["name"], ax.get_lines()[0])
        shown = np.array(trace["y"], dtype=float)
        x, y = (np.asarray(values)[: shown.size] for values in line.get_data())
        assert shown == pytest.approx(y, rel=1e-6, nan_ok=True)
        assert np.array(trace["x"]) == pytest.approx(x, rel=1e-6)
        assert to_hex(line.get_color()) in (trace.get("line") or trace["marker"])["color"]
    assert ax.get_xlabel().replace("\n", " ") == layout["xaxis"]["title"]["text"].replace("<br>", " ")
    if name != REMEDIES:
        assert ax.get_ylabel().replace("\n", " ") == layout["yaxis"]["title"]["text"].replace("<br>", " ")
        window, ends = ax.get_xlim(), ax.get_ylim()
        on_x, on_y = (np.array(layout[axis]["range"]) for axis in ("xaxis", "yaxis"))
        assert (10.0**on_x if ax.get_xscale() == "log" else on_x) == pytest.approx(window)
        assert (10.0**on_y if ax.get_yscale() == "log" else on_y) == pytest.approx(ends)


@pytest.mark.slow
def test_a_drive_that_is_not_converged_says_so(drive):
    result = replace(drive, solution=replace(drive.solution, converged=False))
    assert title_of(figure(result, HISTOGRAM))[0] == "NOT CONVERGED"
    assert "NOT CONVERGED" in repr(result)
    assert "NOT CONVERGED" in result._repr_html_()


def test_a_notebook_shows_a_drive_and_its_case_as_tables(drive):
    shown = drive._repr_html_()
    assert "discharges per second" in shown
    assert "peak arc current, mean" in shown
    assert "source.dc_link" in drive.case._repr_html_()


def test_the_forces_on_a_rotor_are_in_balance():
    """Weight, belt and the reactions that a separate program of statics gives."""
    case = DriveCase.from_toml(example("belt_drive.toml"))
    changed = case.replace({"force.1.y": "-200 N", "force.1.z": "150 N", "rotor.locating": "drive_end"})
    placed = {each.name: each.forces[0] for each in forces_on_rotor(changed)}
    assert np.sum([*placed.values()], axis=0) == pytest.approx(0.0, abs=1e-9)
    weight = np.array([0.0, -18.0 * 9.80665, 0.0])
    first, second = np.split(
        by_vectors([(weight, 0.09), (np.array([800.0, -200.0, 150.0]), -0.06)], (0.0, 0.18)), [3]
    )
    assert placed["drive end"] == pytest.approx(first, rel=1e-9)
    assert placed["non-drive end"][:2] == pytest.approx(second, rel=1e-9)
    result = solve_drive(changed.replace({"drive.duration": "0.5 ms"}), workers=1)
    panels = figure(result, FORCES).axes
    labels = [label.get_text() for label in panels[0].get_xticklabels()]
    assert labels[0] == "force 1\nat -60 mm\n825 N"
    assert "at the drive end" in title_of(figure(result, FORCES))[0]
    assert forces_on_rotor(drive_with_remedy()) == []
