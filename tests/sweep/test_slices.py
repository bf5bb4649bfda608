"""Which points of a sweep a figure shows, what lies between them, and what its axes are called."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.quantities.formats import scale_for
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.points import Range
from ehlectric.sweep.slices import select_slice, spaced_log, surface_of
from ehlectric.sweep.sweep_inputs import CONTACT
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, POTENTIAL, SPEED, breakdown, case, grid, paired, sobol

VALUE = "discharge.breakdown_voltage"
SPEEDS, LOADS, VOLTS = (0.5, 2.0, 3.0, 7.0), (2e5, 9e5, 2e6), (1.0, 4.0)


def cube(**how):
    return grid({SPEED: SPEEDS, LOAD: LOADS, POTENTIAL: VOLTS}, **how)


@each("text", ["4 V", "4", "4000 mV", "3.2 V"])
def test_the_nearest_value_is_held(text):
    taken = select_slice(cube(), SPEED, LOAD, VALUE, {POTENTIAL: text})
    assert taken.at == {POTENTIAL: 4.0}
    assert {point.inputs[POTENTIAL] for point in taken.points} == {4.0}
    assert len(taken.points) == 12
    np.testing.assert_array_equal(taken.voltage, 5.0)
    xs, ys, numbers = taken.grid()
    assert (tuple(xs), tuple(ys)) == (SPEEDS, LOADS)
    for i, speed in enumerate(SPEEDS):
        for j, load in enumerate(LOADS):
            inputs = taken.points[numbers[i, j]].inputs
            assert (inputs[SPEED], inputs[LOAD]) == (speed, load)


def test_a_key_of_one_value_is_held_by_itself():
    taken = select_slice(grid({SPEED: SPEEDS, LOAD: LOADS, POTENTIAL: (3.0,)}), SPEED, LOAD, VALUE)
    assert taken.at == {POTENTIAL: 3.0}
    assert select_slice(grid({SPEED: SPEEDS, LOAD: (1e6,)}), SPEED, None, VALUE).at == {LOAD: 1e6}
    ends = grid({SPEED: SPEEDS, "grid.field_range": ([-1.0, 1.0],)})
    assert select_slice(ends, SPEED, None, VALUE).at == {"grid.field_range": "[-1.0, 1.0]"}


def test_a_design_that_holds_nothing_says_so():
    span = {SPEED: Range(1.0, 4.0), LOAD: Range(2e5, 2e6, "log"), POTENTIAL: Range(1.0, 4.0)}
    taken = select_slice(sobol(span, 4, breakdown), SPEED, LOAD, VALUE)
    assert (taken.free, len(taken.points)) == ((POTENTIAL,), 20)
    assert taken.grid() is None
    assert surface_of(taken, log_x=False, log_y=True) is None


def test_texts_are_lines_and_no_map():
    oils = ("paper", "turbine", "gear")
    taken = select_slice(grid({SPEED: SPEEDS, "lubricant.base": oils}), SPEED, "lubricant.base", VALUE)
    assert [value for value, _ in taken.series()] == list(oils)
    assert all(list(taken.along[numbers]) == list(SPEEDS) for _, numbers in taken.series())
    with pytest.raises(InputError, match="a map needs numbers"):
        taken.check_numeric()
    held = select_slice(
        grid({SPEED: SPEEDS, "lubricant.base": oils}), SPEED, None, VALUE, {"lubricant.base": "gear"}
    )
    assert held.at == {"lubricant.base": "gear"}


@each(
    "arguments, key, names",
    [
        (("contact.speed", LOAD, VALUE), "x", ["'contact.speed'", "contact."]),
        ((SPEED, SPEED, VALUE), "y", [SPEED]),
        ((SPEED, LOAD, "discharge.breakdown"), "value", [VALUE]),
        ((SPEED, LOAD, "film"), "value", ["'film'", "film.minimum_th"]),
        ((SPEED, LOAD, VALUE), "at", [POTENTIAL, "1, 4 V"]),
        ((SPEED, None, VALUE), "at", [LOAD, POTENTIAL]),
        ((SPEED, LOAD, VALUE, {POTENTIAL: "9 V"}), "at", [f"{POTENTIAL}=9 V", "1 to 4 V"]),
        ((SPEED, LOAD, VALUE, {POTENTIAL: "4 m"}), f"at: {POTENTIAL}", ["'4 m'", "in V"]),
        ((SPEED, LOAD, VALUE, {"electric.potential_1": "4 V"}), "at", [POTENTIAL]),
        ((SPEED, LOAD, VALUE, {SPEED: "1 m/s"}), "at", [SPEED]),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_one_line(arguments, key, names):
    with pytest.raises(InputError) as refused:
        select_slice(cube(), *arguments)
    text = str(refused.value)
    assert text.startswith(f"{key}: ")
    assert [name for name in names if name not in text] == []
    assert "\n" not in text


@each("text", ["9" * 5000, "9" * 299, "9" * 5000 + " m/s", "1 " + "m*" * 3000 + "m", "nan"])
@each("key", [SPEED, "grid.nodes"])
def test_hostile_values_to_hold_are_refused_in_a_short_line(key, text):
    results = grid({SPEED: (1.0, 2.0), LOAD: (1e6, 2e6), "grid.nodes": (401, 801)})
    with pytest.raises(InputError, match=r"^at: ") as refused:
        select_slice(results, LOAD, None, CONTACT.value, {key: text})
    assert len(str(refused.value)) < 500


def test_other_refusals():
    for results, key, message in (
        (cube(status=lambda _: "failed"), VALUE, "no point of 24 is solved"),
        (grid({SPEED: SPEEDS}, lambda _: {"film": {"x": 1.0}}), VALUE, r"the case has no \[discharge\]"),
    ):
        with pytest.raises(InputError, match=message):
            select_slice(results, SPEED, None, key)
    with pytest.raises(InputError, match="expected one of paper, gear"):
        select_slice(
            grid({SPEED: SPEEDS, "lubricant.base": ("paper", "gear")}),
            *(SPEED, None, VALUE),
            {"lubricant.base": "geer"},
        )
    with pytest.raises(InputError, match="a sobol design has no two points alike"):
        select_slice(
            sobol({SPEED: Range(1, 2), LOAD: Range(1, 2)}, 4, breakdown), SPEED, None, VALUE, {LOAD: "1"}
        )


def test_margin_is_the_ratio_of_the_voltages():
    def without(inputs):
        summary = breakdown(inputs)
        del summary["discharge"]["margin"]
        return summary

    np.testing.assert_allclose(CONTACT.margins(cube()), CONTACT.margins(cube(model=without)), rtol=1e-15)


positive = st.lists(st.floats(1e-3, 1e3), min_size=2, max_size=6, unique_by=lambda v: round(np.log(v), 3))


@pytest.mark.slow
@given(xs=positive, ys=positive, logs=st.tuples(st.booleans(), st.booleans()), seed=st.integers(0, 99))
def test_what_is_linear_in_the_axes_is_met_between_the_points(xs, ys, logs, seed):
    """On any grid, however it is spaced; its bounds are those of the points."""
    a, b, c = np.random.default_rng(seed).normal(size=3)

    def plane(x, y):
        return a + b * (np.log(x) if logs[0] else x) + c * (np.log(y) if logs[1] else y)

    taken = select_slice(grid({SPEED: xs, LOAD: ys}), SPEED, LOAD, VALUE)
    surface = surface_of(taken, log_x=logs[0], log_y=logs[1])
    values = plane(taken.along, np.array(taken.across))
    nodes, whole = surface.at_nodes(values)
    assert np.all(whole)
    np.testing.assert_allclose(
        nodes, plane(surface.x, surface.y), rtol=1e-9, atol=1e-9 * np.abs(values).max()
    )
    assert nodes.min() >= values.min()
    assert nodes.max() <= values.max()
    np.testing.assert_allclose(surface.weights.sum(axis=1), 1.0, rtol=1e-12)


def test_powers_are_met_on_logarithmic_axes():
    """The breakdown voltage of the model is a product of powers: its logarithm is linear."""
    taken = select_slice(grid({SPEED: SPEEDS, LOAD: LOADS}), SPEED, LOAD, VALUE)
    surface = surface_of(taken, log_x=True, log_y=True)
    nodes, _ = surface.at_nodes(taken.values, log=True)
    np.testing.assert_allclose(nodes, 10.0 * (surface.x / 4.0) ** 0.7 * (surface.y / 1e6) ** -0.1, rtol=1e-12)


def area(surface, whole):
    """Of the triangles that have a value throughout."""
    x, y = surface.x[surface.triangles[whole]], surface.y[surface.triangles[whole]]
    sides = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    return 0.5 * np.abs(sides).sum()


def test_a_point_that_is_not_solved_leaves_the_cells_around_it_out():
    xs, ys = (1.0, 2.0, 4.0, 5.0), (1.0, 1.5, 3.0, 4.0)
    results = grid(
        {SPEED: xs, LOAD: ys}, status=lambda i: "failed" if i[SPEED] == 2.0 and i[LOAD] == 3.0 else "solved"
    )
    taken = select_slice(results, SPEED, LOAD, VALUE)
    surface = surface_of(taken, log_x=False, log_y=False)
    _, whole = surface.at_nodes(taken.values)
    # The four cells between x = 1 and 4 and y = 1.5 and 4.
    assert area(surface, whole) == pytest.approx(4.0 * 3.0 - 3.0 * 2.5, rel=1e-12)
    middle_x = surface.x[surface.triangles[whole]].mean(axis=1)
    middle_y = surface.y[surface.triangles[whole]].mean(axis=1)
    assert not np.any((middle_x < 4.0) & (middle_y > 1.5))
    # Solved, but with no cell beside the hole: the corner at (1, 4) and its neighbours on the edges.
    alone = np.array(taken.points, dtype=object)[surface.alone(taken.values)]
    assert {(p.inputs[SPEED], p.inputs[LOAD]) for p in alone} == {(1.0, 4.0), (1.0, 3.0), (2.0, 4.0)}


def test_scattered_points_have_triangles_between_them():
    rng = np.random.default_rng(0)
    xs = np.concatenate([[1.0, 1.0, 9.0, 9.0], rng.uniform(1.0, 9.0, 40)])
    ys = np.concatenate([[1.0, 100.0, 1.0, 100.0], 10.0 ** rng.uniform(0.0, 2.0, 40)])
    taken = select_slice(paired({SPEED: list(xs), LOAD: list(ys)}), SPEED, LOAD, VALUE)
    surface = surface_of(taken, log_x=False, log_y=True)
    values = 3.0 + xs - 2.0 * np.log(ys)
    nodes, whole = surface.at_nodes(values)
    np.testing.assert_allclose(nodes, 3.0 + surface.x - 2.0 * np.log(surface.y), atol=1e-9)
    assert np.all(whole)
    logarithmic = surface_of(taken, log_x=False, log_y=False)
    assert area(logarithmic, logarithmic.at_nodes(values)[1]) == pytest.approx(8.0 * 99.0)
    values[20] = np.nan
    _, whole = surface.at_nodes(values)
    # Nothing is left that has the point among its own corners or within.
    assert 0 < whole.sum() < whole.size
    assert not np.any((surface.x == xs[20])[surface.triangles[whole]])
    assert not np.any(surface.corners[whole] == 20)


def test_points_on_a_line_have_nothing_between_them():
    speeds = [1.0, 2.0, 4.0]
    for loads in ([1e5, 1e5, 1e5], [1e5, 2e5, 4e5]):
        taken = select_slice(paired({SPEED: speeds, LOAD: loads}), SPEED, LOAD, VALUE)
        assert surface_of(taken, log_x=True, log_y=True) is None


@each(
    ("values", "log"),
    [((1.0, 2.0, 4.0), True), ((1.0, 2.0, 3.0), False), ((-1.0, 2.0, 9.0), False), ((1.0, 100.0), False)],
)
def test_axes_are_logarithmic_where_their_values_are_even_so(values, log):
    results = grid({SPEED: values}, lambda _: {})
    assert spaced_log(results, SPEED, np.array(values)) is log


def test_ranges_say_how_their_axes_are():
    results = sobol({SPEED: Range(1.0, 4.0, "log"), LOAD: Range(1.0, 4.0)}, 4, breakdown)
    assert spaced_log(results, SPEED, np.array([1.0, 2.0, 3.0]))
    assert not spaced_log(results, LOAD, np.array([1.0, 2.0, 4.0]))


@each(
    ("key", "values", "label", "text"),
    [
        (LOAD, [2e5, 2e6], "$w$ [MN/m]", "0.2 MN/m"),
        ("lubricant.pressure_viscosity_coefficient", [15e-9, 22e-9], r"$\alpha$ [1/GPa]", "15 1/GPa"),
        ("lubricant.viscosity", [0.04], r"$\eta_0$ [mPa s]", "40 mPa s"),
        ("lubricant.relative_permittivity", [2.4], r"$\varepsilon_\mathrm{r}$", "2.4"),
        ("roughness.1.rescale_rq", [3e-8], "[nm]", "30 nm"),
        ("inputs.contact.reduced_radius", [0.0141], "$R$ [mm]", "14.1 mm"),
        (VALUE, [0.05], r"$V_\mathrm{b}$ [mV]", "50 mV"),
        ("film.minimum_thickness", [6.4e-7], r"$h_\mathrm{min}$ [µm]", "0.64 µm"),
        ("field.max_strength", [1.6e7], r"$|E|_\mathrm{max}$ [V/µm]", "16 V/µm"),
        ("hertz.max_pressure", [2e9], r"$p_\mathrm{h}$ [GPa]", "2 GPa"),
        ("discharge.capacitance_hertz", [40e-9], r"$C_\mathrm{H}$ [nF/m]", "40 nF/m"),
        ("discharge.capacitance_ratio", [1.4], "", "1.4"),
        ("discharge.contact_energy", [2e-9], "[nJ]", "2 nJ"),
        ("discharge.zone_area", [4e-12], "[µm²]", "4 µm²"),
        ("discharge.some_area", [4e-12], "", "4e-12"),  # no key of a result
        ("field.max_strength_position.1", [1e-4], "[mm]", "0.1 mm"),
        ("seconds.film", [12.0], "[s]", "12 s"),
        ("film.nodes", [3201.0], "", "3201"),
        ("discharge.breakdown_energy", [2e-9], r"$W_\mathrm{b}$ [nJ]", "2 nJ"),
        ("discharge.pit_volume", [3e-18], "[µm³]", "3 µm³"),
        ("discharge.pit_diameter", [2e-6], "[µm]", "2 µm"),
        ("discharge.zone_size", [2e-5], "[µm]", "20 µm"),
        ("discharge.zone_position.1", [2e-5], "[µm]", "20 µm"),
        ("discharge.zone_over_half_width", [0.04], "", "0.04"),
        ("discharge.capacitance", [40e-9], "$C$ [nF/m]", "40 nF/m"),
        ("discharge.capacitance_plate", [30e-9], "A_\\mathrm{H}/h(0)$ [nF/m]", "30 nF/m"),
        ("discharge.current_density", [3e5], "$J$ [A/mm²]", "0.3 A/mm²"),
        ("discharge.corner_frequency", [7.5], r"$f_\mathrm{c}$ [Hz]", "7.5 Hz"),
        ("discharge.outlet", [], "", None),
        ("roughness.combined.ra", [3e-9], "[nm]", "3 nm"),
    ],
)
def test_labels_have_the_unit_that_suits(key, values, label, text):
    found = label_of(key, case())
    scale = found.scaled(np.array(values))
    assert found.axis(scale).endswith(label)
    assert ("[" in found.axis(scale)) == ("[" in label)
    assert text is None or scale.text(values[0]) == text


def test_capacitances_of_point_contacts_are_no_line_s():
    point = {
        "geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa",
        "load": "10 N", "entrainment_speed": "1 m/s",
    }  # fmt: skip
    ball = case().from_dict({"contact": point, "lubricant": {"base": "paper"}})
    assert label_of("discharge.capacitance_hertz", ball).unit == "F"
    zone = label_of("field.capacitance_by_zone.hertz", ball)
    assert zone.scaled(np.array([2e-12])).text(2e-12) == "2 pF"
    assert label_of("discharge.capacitance_hertz", case()).unit == "F/m"


@given(st.floats(1e-9, 1e9), st.sampled_from(["V", "N/m", "Pa*s", "1/Pa", "m**2", "J/m**3", "m"]))
def test_prefixes_are_what_they_say(value, unit):
    """Read back by pint, as a case would write it."""
    from ehlectric.quantities.units import to_si

    scale = scale_for(value, unit)
    written = f"{value * scale.factor!r} {scale.unit}".replace("1/", "/", 1) if unit == "1/Pa" else ""
    written = written or f"{value * scale.factor!r} {scale.unit}"
    assert to_si(written, unit) == pytest.approx(value, rel=1e-12)
