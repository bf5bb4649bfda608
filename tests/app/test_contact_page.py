"""Page of a contact: line, point, measured surfaces and a movie, with the numbers of the command."""

import json
import os
import re
import signal
import tomllib

import pytest

from ehlectric.app.page_inputs import Inputs
from tests.app.driving import type_into
from tests.app.outputs import address_of, command, downloaded, fits, summary_by_command
from tests.helpers.places import DEKTAK, EXAMPLES, SURFACES
from tests.helpers.processes import alive, wait_until

pytestmark = pytest.mark.browser

_NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")

MEASURED = (DEKTAK, *(SURFACES / name for name in ("al3d-1.al3d", "hfm-1.hfm", "x3p-2-half.x3p")))


def example(name, **changes):
    """Tables of an example, with other values by dotted key."""
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8"))
    if "grid__nodes" in changes:
        table["grid"].pop("error", None)
    return dict(
        Inputs(table).changed({key.replace("__", "."): value for key, value in changes.items()}).table
    )


def smooth():
    """Address of a contact that is solved at once, before it has a rough surface."""
    return address_of("/contact", example("rough_contact", roughness=None, grid__nodes=801))


# Film by formula of the present inputs.
_FORMULA = (
    "[data-testid=answer][aria-busy=false] "
    "[data-testid^='number-film_formulas.'][data-testid$='.minimum_thickness']"
)
_FILM = "film.minimum_thickness"


def shown(page, name):
    """Value that the page shows of a quantity."""
    text = page.get_by_test_id(f"number-{name}").get_by_test_id("value").inner_text()
    return float(_NUMBER.search(text)[0])


def open_group(page, name):
    """Open a group of inputs that is folded away."""
    box = page.get_by_test_id(f"group-{name}")
    if box.get_attribute("open") is None:
        box.locator("summary").first.click()


def solve(page):
    """Solve the present inputs, once they have been checked: then the page knows how long it takes."""
    page.locator(_FORMULA).wait_for()
    page.get_by_test_id("solve").click()
    wait_until_solved(page)


def is_drawn(page, name):
    """Whether a figure comes to be drawn; Plotly draws it in several pictures."""
    drawn = page.get_by_test_id(f"figure-{name}").locator(".main-svg").filter(visible=True)
    return wait_until(lambda: drawn.count() > 0)


def wait_until_solved(page):
    page.locator("[data-testid=answer][data-solved=true][aria-busy=false]").wait_for()
    page.get_by_test_id("how").filter(has_text="Solved").wait_for()


@pytest.mark.slow
@pytest.mark.gate
def test_a_line_contact_is_drawn_with_the_numbers_of_the_command(open_page, app_server, tmp_path):
    page = open_page(app_server, "/contact")
    wait_until_solved(page)
    assert is_drawn(page, "profiles")
    summary = summary_by_command("run", downloaded(page, "download-toml", tmp_path), tmp_path)
    assert summary["film"]["target_error"] == 0.001
    film = 1e6 * summary["film"]["minimum_thickness"]
    assert shown(page, "film.minimum_thickness") == pytest.approx(film, rel=5e-4)
    before = page.get_by_test_id("number-film.minimum_thickness").inner_text()
    type_into(page, "contact.entrainment_speed", "2 m/s")
    page.wait_for_function(
        """before =>
            document.querySelector('[data-testid="number-film.minimum_thickness"]')?.innerText !== before""",
        arg=before,
    )
    wait_until_solved(page)
    film = summary_by_command("run", downloaded(page, "download-toml", tmp_path), tmp_path)["film"]
    assert shown(page, "film.minimum_thickness") == pytest.approx(1e6 * film["minimum_thickness"], rel=5e-4)


@pytest.mark.slow
def test_a_point_contact_is_solved_and_cut_where_a_slider_says(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/contact", example("ball_contact", grid__nodes=65)))
    assert fits(page)
    solve(page)
    summary = summary_by_command("run", downloaded(page, "download-toml", tmp_path), tmp_path)
    film = 1e6 * summary["film"]["minimum_thickness"]
    assert shown(page, "film.minimum_thickness") == pytest.approx(film, rel=5e-4)
    for name in ("film-map", "pressure-map", "field-map"):
        assert is_drawn(page, name)
    slider = page.get_by_test_id("slider-cut-x")
    before = slider.get_attribute("aria-valuetext")
    slider.focus()
    page.keyboard.press("Home")
    assert wait_until(lambda: slider.get_attribute("aria-valuetext") != before)
    ends = page.evaluate("s => [s.value, s.min]", slider.element_handle())
    assert float(ends[0]) == pytest.approx(float(ends[1]))


@pytest.mark.slow
def test_changing_between_line_and_point_asks_the_command_for_each(open_page, app_server, tmp_path):
    page = open_page(app_server, "/contact")
    for name, load in (("Point contact", "load"), ("Line contact", "load_per_length")):
        page.get_by_test_id("geometry").get_by_text(name).click()
        page.get_by_test_id(f"field-contact-{load}").wait_for()
        page.locator(
            "[data-testid=answer][aria-busy=false] [data-testid='number-hertz.max_pressure']"
        ).wait_for()
        path = downloaded(page, "download-toml", tmp_path)
        checked = json.loads(command("check", path, "--json", folder=tmp_path)[0])
        assert shown(page, "hertz.max_pressure") == pytest.approx(
            1e-9 * checked["hertz"]["max_pressure"], rel=5e-4
        )


# Inputs of surfaces that touch, as they are typed.
_OF_SPOTS = {
    "contact.boundary_friction": "0.12",
    "discharge.dielectric_strength": "15",
    "discharge.length": "10",
    "electric.resistivity": "2.2e-7",
    "electric.tribofilm_resistance": "1e-12",
}


@pytest.mark.slow
def test_surfaces_that_touch_are_marked_and_have_the_boundary_film_that_is_typed(
    open_page, app_server, tmp_path
):
    rough = {"surface": 1, "generator": "gaussian", "rq": "250 nm", "correlation_length": "20 um", "seed": 4}
    # Coarse: what the page shows of a film is that of the command on any grid.
    table = example("rough_contact", roughness=[rough], grid__nodes=401)
    table["contact"] |= {"load_per_length": "1.57 MN/m", "entrainment_speed": "0.05 m/s"}
    page = open_page(app_server, address_of("/contact", table))
    page.get_by_test_id("number-film_formulas.pan_hamrock.minimum_thickness").wait_for()
    assert_touching(page, tmp_path, micrometres=0.001)
    assert "give the resistivity" in page.get_by_test_id("number-asperities.resistance").inner_text()
    for group in ("contact", "voltage-and-breakdown"):
        open_group(page, f"{group}-more")
    for key, typed in {"contact.boundary_film": "2", **_OF_SPOTS}.items():
        type_into(page, key, typed)
    page.get_by_test_id("how").filter(has_text="earlier inputs").wait_for()
    found = assert_touching(page, tmp_path, micrometres=0.002)["asperities"]
    assert (
        found["electrical_behaviour"]
        in page.get_by_test_id("number-asperities.electrical_behaviour").inner_text()
    )
    assert shown(page, "asperities.spots") == found["spots"]
    assert shown(page, "asperities.contact_area") == pytest.approx(1e6 * found["contact_area"], rel=0.05)
    assert shown(page, "asperities.boundary_friction") == pytest.approx(found["boundary_friction"], rel=0.05)
    assert shown(page, "asperities.breakdown_5") == pytest.approx(found["breakdown_5"], rel=0.05)
    assert "Ω" in page.get_by_test_id("number-asperities.resistance").inner_text()
    assert fits(page)


def assert_touching(page, folder, *, micrometres):
    """Solve, compare the films of surfaces that touch with those of the command, and return its summary."""
    solve(page)
    assert shown(page, "film.minimum_thickness") == pytest.approx(micrometres, rel=1e-3)
    assert "boundary film" in page.get_by_test_id("number-film.minimum_thickness").inner_text()
    legend = page.get_by_test_id("figure-profiles").locator(".legendtext")
    legend.filter(has_text="contact spots").wait_for()
    legend.filter(has_text="pressure of asperities").wait_for()
    summary = summary_by_command("run", downloaded(page, "download-toml", folder), folder)
    mean = 1e6 * summary["film"]["mean_thickness"]
    assert shown(page, "film.mean_thickness") == pytest.approx(mean, rel=1e-3)
    return summary


def upload(page, path):
    """Upload a file of an instrument."""
    open_group(page, "rough-surfaces")
    page.get_by_test_id("upload-surface").set_input_files(path)


def statistics(page, name="surface-statistics"):
    """Rows of the table of statistics, or of another table of a surface, as texts."""
    table = page.get_by_test_id(name)
    table.wait_for()
    return table.evaluate("t => [...t.rows].map(r => [...r.cells].map(c => c.innerText))")


@pytest.mark.slow
@pytest.mark.parametrize("path", MEASURED, ids=lambda path: path.name)
def test_a_measured_surface_has_the_statistics_of_the_command(open_page, app_server, tmp_path, path):
    page = open_page(app_server, smooth())
    page.get_by_test_id("upload-surface").wait_for(state="attached")
    upload(page, path)
    statistics(page)
    box = page.get_by_test_id("field-roughness-form")
    box.select_option("line")
    page.locator("[data-testid=surface-statistics]", has_text="form: line").wait_for()
    told = json.loads(command("surface", path, "--form", "line", "--json", folder=tmp_path)[0])
    heads, *rows = statistics(page)
    assert [row[0] for row in rows] == [step["step"] for step in told["steps"]]
    column = next(number for number, head in enumerate(heads) if head.startswith("Rq"))
    for row, step in zip(rows, told["steps"], strict=True):
        assert float("".join(row[1].split())) == step["points"]
        assert float(row[column]) == pytest.approx(1e9 * step["rq"], rel=2e-3)
        assert float(row[column + 1]) == pytest.approx(1e9 * step["ra"], rel=2e-3)
    heads, *rows_of_summits = statistics(page, "surface-summits")
    for row, summits in zip(rows_of_summits, told["summits"], strict=True):
        assert float(row[0]) == pytest.approx(1e6 * summits["interval"], rel=5e-3)
        radius = row[next(number for number, head in enumerate(heads) if head.startswith("radius"))]
        assert float(radius) == pytest.approx(1e6 * summits["summit_radius"], rel=5e-3)
    figures = page.get_by_test_id("surface").locator(".js-plotly-plot")
    assert wait_until(lambda: figures.count() == len(rows))
    page.get_by_test_id("use-surface").click()
    page.get_by_test_id("surfaces-used").filter(has_text=path.name).wait_for()


@pytest.mark.slow
def test_an_answer_that_arrives_while_a_value_is_typed_leaves_it(open_page, app_server):
    page = open_page(app_server, smooth())
    page.get_by_test_id("upload-surface").wait_for(state="attached")
    upload(page, SURFACES / "hfm-1.hfm")
    statistics(page)
    box = page.get_by_test_id("field-roughness-rescale_rq")
    box.fill("20 nm")
    # The form is chosen while the focus stays in the box; its answer draws the page again.
    page.get_by_test_id("field-roughness-form").evaluate(
        "box => { box.value = 'parabola'; box.dispatchEvent(new Event('change')); }"
    )
    table = page.locator("[data-testid=surface-statistics]")
    table.filter(has_text="form: parabola").wait_for()
    assert box.input_value() == "20 nm"
    box.press("Tab")
    table.filter(has_text="20.0").wait_for()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("notes.csv", b"this is no profile\n"),
        ("broken.x3p", b"PK\x03\x04 no archive"),
        ("empty.csv", b""),
        ("script.html", b"<script>document.title = 'taken'</script>"),
    ],
)
def test_a_bad_file_is_refused_in_words_and_the_page_goes_on(open_page, app_server, tmp_path, name, content):
    page = open_page(app_server, smooth())
    bad = tmp_path / name
    bad.write_bytes(content)
    page.get_by_test_id("upload-surface").wait_for(state="attached")
    upload(page, bad)
    error = page.get_by_test_id("roughness").get_by_role("alert").filter(has_text=name)
    error.wait_for()
    _, told = command("surface", bad, folder=tmp_path, status=2)
    # The command names the file with its path, or as it was typed.
    line = " ".join(told.split()).partition(name)[2]
    assert " ".join(error.inner_text().split()).partition(name)[2][:60] in line
    assert "Traceback" not in page.inner_text("body")
    assert page.title() != "taken"
    assert page.get_by_test_id("use-surface").is_disabled()
    upload(page, SURFACES / "hfm-1.hfm")
    statistics(page)


@pytest.mark.slow
def test_large_file_that_is_still_read_does_not_replace_a_later_choice(open_page, own_server, tmp_path):
    server = own_server()
    page = open_page(server, smooth())
    large = tmp_path / "large.csv"
    lines = (f"{0.5 * k:.1f},{20.0 * (k % 7):.1f}" for k in range(1_000_000))
    large.write_text("x_um,z_nm\n" + "\n".join(lines) + "\n")
    # Smaller files are answered at once, without a job.
    assert large.stat().st_size > 4_000_000
    page.get_by_test_id("upload-surface").wait_for(state="attached")
    before = set(server.started())
    upload(page, large)
    # The process that reads it is held until the other surface is chosen, which ends it.
    assert wait_until(lambda: set(server.processes()) > before)
    (reader,) = set(server.processes()) - before
    os.kill(reader, signal.SIGSTOP)
    page.get_by_test_id("roughness").get_by_test_id("progress").wait_for()
    page.get_by_test_id("field-roughness-source").select_option("sinusoid")
    size = page.get_by_test_id("surface-size")
    size.filter(has_text="Exact shape").wait_for()
    page.get_by_test_id("roughness").get_by_test_id("progress").wait_for(state="hidden")
    assert wait_until(lambda: not alive(reader))
    # All that the server has told of the file came before its answer to a click.
    page.get_by_test_id("copy-link").click()
    page.get_by_test_id("toast").filter(has_text="link").wait_for()
    assert "Exact shape" in size.inner_text()
    assert page.get_by_test_id("use-surface").is_enabled()


@pytest.mark.slow
def test_page_begins_with_a_bound_and_without_a_list_of_other_inputs(open_page, app_server):
    page = open_page(app_server, "/contact", width=390, height=844)
    wait_until_solved(page)
    strip = page.get_by_test_id("strip").inner_text()
    assert "≤" in strip
    assert "Margin ≤" in strip
    others = page.get_by_test_id("other-inputs")
    assert re.search(r"Other inputs of the file \(\d+\)", others.inner_text())
    assert not others.get_by_role("button", name="Remove grid.wedge").is_visible()
    others.locator("summary").click()
    others.get_by_role("button", name="Remove grid.wedge").click()
    others.get_by_text("grid.wedge").wait_for(state="detached")


def moving(**changes):
    """Case whose waviness moves through the contact in tens of steps."""
    return example("moving_roughness", grid__nodes=401, **changes)


@pytest.mark.slow
def test_a_movie_is_computed_and_its_slider_goes_through_time(open_page, app_server, tmp_path):
    small = moving(motion={"passes": 0.1, "record": 5})
    page = open_page(app_server, address_of("/contact", small))
    page.get_by_test_id("solve-motion").click()
    page.get_by_test_id("motion-state").filter(has_text="All time steps are solved").wait_for()
    slider, text = page.get_by_test_id("movie-slider"), page.get_by_test_id("movie-text")
    # The slider follows the keys once the movie shows its first instant.
    text.filter(has_text=re.compile(r"\S")).wait_for()
    slider.focus()
    texts = []
    last = slider.get_attribute("max")
    for key, instant in (("Home", "0"), ("ArrowRight", "1"), ("End", last)):
        page.keyboard.press(key)
        assert wait_until(lambda instant=instant: slider.input_value() == instant)
        texts.append(slider.get_attribute("aria-valuetext"))
        text.filter(has_text=texts[-1]).wait_for()
    assert len(set(texts)) == 3
    path = tmp_path / "case.toml"
    path.write_text(Inputs(small).toml(), encoding="utf-8")
    summary = summary_by_command("run", path, tmp_path)
    page.get_by_test_id("motion-numbers").click()
    assert summary["converged"]
    least = 1e6 * summary["film"]["minimum_thickness"]
    assert wait_until(lambda: f"{least:.4g}" in page.get_by_test_id("motion-numbers").inner_text())


@pytest.mark.slow
def test_a_movie_is_cancelled_with_its_process(own_server, open_page):
    server = own_server()
    page = open_page(server, address_of("/contact", example("moving_roughness")))
    page.get_by_test_id("number-film_formulas.pan_hamrock.minimum_thickness").wait_for()
    before = set(server.started())
    page.get_by_test_id("solve-motion").click()
    motion = page.get_by_test_id("motion")
    motion.locator("progress[value]").wait_for()
    started = set(server.processes()) - before
    assert started
    motion.get_by_test_id("cancel").click()
    page.get_by_test_id("motion-state").filter(has_text=re.compile("cancelled|No instant")).wait_for()
    assert wait_until(lambda: not any(map(alive, started)))
