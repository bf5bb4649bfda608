"""Figures of oils: curves through the values of the tables, ends of ranges, and what is not known."""

import numpy as np
import pytest

from ehlectric.cases.oil_report import PROPERTIES, oil_report
from ehlectric.figures.oil_figures import over_pressure, over_temperature, save_oil
from ehlectric.figures.style import figure_of

LARSSON = {"thermal_conductivity_law": "larsson", "thermal_conductivity": 0.137}
LARSSON |= {"larsson_c1": "1.72 1/GPa", "larsson_c2": "0.54 1/GPa"}


def panel(axes, word):
    (ax,) = (ax for ax in axes if ax.get_ylabel().startswith(word))
    return ax


def curves(ax):
    return {line.get_label(): line for line in ax.get_lines() if not line.get_label().startswith("_")}


def at(line, x):
    """Value of a curve at a position between its nodes, by its logarithm."""
    return np.exp(np.interp(x, line.get_xdata(), np.log(line.get_ydata())))


def test_curves_over_pressure_are_the_values_of_the_table():
    report = oil_report("fva-3", (), ["1 GPa"])
    axes = over_pressure(report)
    lines = {(line.of.name, line.pressure): line.values for line in report.lines}
    assert len(axes) == 3
    for word, name in (
        ("viscosity", "viscosity"),
        ("density", "density"),
        ("relative", "relative_permittivity"),
    ):
        drawn = curves(panel(axes, word))
        assert list(drawn) == ["40 °C", "60 °C", "80 °C", "100 °C"]
        for pressure in (0.0, 1e9):
            values = [at(line, 1e-9 * pressure) for line in drawn.values()]
            assert values == pytest.approx(lines[name, pressure], rel=1e-9), (name, pressure)
    assert panel(axes, "viscosity").get_yscale() == "log"
    title = figure_of(axes[0]).get_label()
    assert "Not known: volumetric heat capacity" in title
    assert panel(axes, "viscosity").get_title(loc="left") == "modulus: fitted"
    assert panel(axes, "density").get_title(loc="left") == "dowson-higginson: assumed"


@pytest.mark.slow
def test_curves_are_the_laws_at_random_pressures():
    """Direct values at 200 pressures: curves between their nodes are within 0.5 %."""
    places = np.sort(np.random.default_rng(56).uniform(0.0, 1.9e9, 200))
    report = oil_report("fva-3", (), [])
    axes = over_pressure(report)
    for word, key in (
        ("viscosity", "viscosity"),
        ("density", "density"),
        ("relative", "relative_permittivity"),
    ):
        for oil, line in zip(report.oils, curves(panel(axes, word)).values(), strict=True):
            one = PROPERTIES["density_ratio" if key == "density" and oil.density is None else key]
            within = places[places < 1e9 * line.get_xdata()[-1]]
            direct = [one.value(oil, pressure) for pressure in within.tolist()]
            np.testing.assert_allclose(at(line, 1e-9 * within), direct, rtol=5e-3, err_msg=key)


def test_a_curve_is_dotted_from_the_end_of_its_range():
    """N100 at 40 degC is capped at 1.25 GPa; the density has no end."""
    report = oil_report("n100", ["40 degC"])
    axes = over_pressure(report)
    end = 1e-9 * report.oils[0].range_end("viscosity_law")
    viscosity = panel(axes, "viscosity")
    (solid,) = (line for line in viscosity.get_lines() if line.get_linestyle() == "-")
    (dotted,) = (line for line in viscosity.get_lines() if line.get_linestyle() == ":")
    assert solid.get_xdata()[-1] <= end
    assert dotted.get_xdata()[0] == pytest.approx(end)
    assert dotted.get_xdata()[-1] == pytest.approx(2.0)
    assert np.ptp(np.log(dotted.get_ydata())) < 1e-9
    density = panel(axes, "density")
    assert all(line.get_linestyle() != ":" for line in density.get_lines())
    assert "end of the law's range" in [text.get_text() for text in density.get_legend().get_texts()]
    # Its permittivity is not known, and has no panel.
    assert len(axes) == 2


def test_a_high_pressure_widens_the_figure():
    axes = over_pressure(oil_report("fva-3", ["40 degC"], ["3 GPa"]))
    assert axes[0].get_xlim()[1] == pytest.approx(3.3)


def test_thermal_conductivity_is_drawn_where_it_changes_with_pressure():
    table = {"base": "iso-vg-46"}
    assert len(over_pressure(oil_report(table))) == 3
    axes = over_pressure(oil_report(table | LARSSON, ["40 degC"]))
    drawn = curves(panel(axes, "thermal"))["40 °C"]
    assert drawn.get_ydata()[0] == pytest.approx(0.137)
    # 1 + c1 p/(1 + c2 p) at 1 GPa.
    assert at(drawn, 1.0) == pytest.approx(0.137 * (1.0 + 1.72 / 1.54), rel=1e-9)


def test_curves_over_temperature_pass_through_the_values_of_the_table():
    report = oil_report("fva-3", ["40 degC", "90 degC"])
    axes = over_temperature(report)
    assert [round(end) for end in axes[0].get_xlim()] == [20, 110]
    lines = {line.of.name: line.values for line in report.lines}
    factors = {"viscosity": 1e3, "density": 1.0, "relative": 1.0}
    for word, factor in factors.items():
        name = "relative_permittivity" if word == "relative" else word
        curve, dots = panel(axes, word).get_lines()
        assert dots.get_ydata() == pytest.approx(factor * np.array(lines[name]))
        assert at(curve, np.array([40.0, 90.0])) == pytest.approx(dots.get_ydata(), rel=2e-3)
    of_alpha = panel(axes, r"$\alpha^*$")
    star, dots, slope, _ = of_alpha.get_lines()
    assert np.all(star.get_ydata() < slope.get_ydata())
    assert dots.get_ydata() == pytest.approx(1e9 * np.array(lines["alpha_star"]))


def test_no_temperature_outside_a_table_is_drawn():
    """The conductivity was measured from 40 to 70 degC: the curves end there."""
    table = {"temperature": ["40 degC", "70 degC"], "conductivity": ["1e-12 S/m", "5e-12 S/m"]}
    axes = over_temperature(oil_report({"base": "fva-3", "conductivity_table": table}))
    curve = panel(axes, "conductivity").get_lines()[0]
    drawn = curve.get_xdata()[np.isfinite(curve.get_ydata())]
    assert drawn.min() >= 40.0 - 1e-9
    assert drawn.max() <= 70.0 + 1e-9


@pytest.mark.slow
def test_an_oil_without_temperature_has_one_figure(tmp_path):
    (file,) = save_oil(oil_report("paper"), tmp_path, ["svg"])
    assert file.name == "oil_over_pressure.svg"
    axes = over_pressure(oil_report("paper"))
    assert axes[1].get_ylabel().startswith("density over ambient")
    assert axes[1].get_legend() is None


@pytest.mark.slow
def test_files_have_the_look_of_all_figures(tmp_path, monkeypatch):
    """A program that calls it outside of any style gets no overlapping titles either."""
    sizes = []
    monkeypatch.setattr(
        "ehlectric.figures.oil_figures.save_figure",
        lambda figure, *_: (
            sizes.append((figure.get_layout_engine(), figure.axes[0].xaxis.label.get_size())) or []
        ),
    )
    save_oil(oil_report("n100", ["40 degC"]), tmp_path)
    assert all(engine is not None and size == 9.0 for engine, size in sizes)
    assert len(sizes) == 2


@pytest.mark.slow
def test_formats_of_the_files(tmp_path):
    files = save_oil(oil_report("n100", ["40 degC"]), tmp_path, ["svg", "pdf"])
    stems = ("oil_over_pressure", "oil_over_temperature")
    assert [file.name for file in files] == [f"{stem}.{kind}" for stem in stems for kind in ("svg", "pdf")]
    assert all(file.is_file() for file in files)
