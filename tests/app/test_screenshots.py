"""Pictures of every page for the documentation; the folder EHLECTRIC_SCREENSHOTS keeps them."""

import os
import tomllib
from pathlib import Path

import pytest
from PIL import Image

from ehlectric.app.pages.frame import AXLE
from tests.app.driving import complete, drawn, seen, wait_for_number
from tests.app.outputs import address_of, downloaded, fits
from tests.app.test_axle_page import simulate as simulate_axle
from tests.app.test_contact_page import wait_until_solved
from tests.app.test_drive import AT_PEAK, short, simulate
from tests.app.test_first_page import capacitance
from tests.app.test_sweep_page import run, sweep, wait_for_points
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import PATIENCE, wait_until

pytestmark = pytest.mark.browser

# Largest picture [bytes], and the number of its colours.
_MOST, _COLOURS = 260_000, 128

# A bearing with measured values.
MEASURED = {
    **tomllib.loads((EXAMPLES / "bearing_6208.toml").read_text(encoding="utf-8")),
    "measured": {"capacitance": "250 pF +- 5 %", "outer_ring_temperature": "74 degC +- 2 K"},
}

# Two axles of which one has a ring on the rotor.
AXLES = {
    name: dict(AXLE.changed({"remedies": None, "circuit.grounding_ring_resistance": ring}).table)
    for name, ring in (("a", None), ("b", "1 ohm"))
}

# Height beyond which a picture of a page is cut off [px].
_TALLEST = 3600


@pytest.fixture
def folder(tmp_path):
    """Folder of the pictures."""
    found = Path(os.environ.get("EHLECTRIC_SCREENSHOTS") or tmp_path / "pictures")
    found.mkdir(parents=True, exist_ok=True)
    return found


def bearing(page):
    wait_for_number(page, "bearing.capacitance", capacitance())
    complete(page)


def measured(page):
    bearing(page)
    page.get_by_test_id("calibrate").click()
    page.locator("[data-testid=calibration][data-explained=true]").wait_for()


def drive(page):
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    simulate(page)


def gear(page):
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()


def axle_simulated(page):
    gear(page)
    simulate_axle(page)


def contact(page):
    wait_until_solved(page)


def contact_point(page):
    page.get_by_test_id("number-film_formulas.chittenden.minimum_thickness").wait_for()
    page.get_by_test_id("solve").click()
    wait_until_solved(page)


def swept(page):
    page.get_by_test_id("plan").filter(has_text="36 points").wait_for()
    run(page)
    wait_for_points(page, "36 solved")
    page.get_by_test_id("number-sweep.margin").wait_for()


def compared(page):
    seen(page, "effect-margin-first-breakdown-shaft-voltage").wait_for()
    # Critical speeds follow the first answer.
    assert wait_until(lambda: page.get_by_test_id("effect-critical-speed").count() > 0)


def compared_axles(page):
    seen(page, "effect-mesh-of-rotor-and-intermediate").wait_for()
    # Probabilities follow the first answer.
    page.get_by_test_id("side-b").get_by_text("Measure first").wait_for()


# Name of the picture: address of the page, and what waits until it is complete.
PAGES = {
    "bearing": (lambda: "/", bearing),
    "measured": (lambda: address_of("/", MEASURED), measured),
    "drive": (lambda: address_of("/drive", short("0.05 s")), drive),
    "gear": (lambda: "/gear", gear),
    "axle": (lambda: "/axle", gear),
    "axle-simulated": (lambda: "/axle", axle_simulated),
    "contact": (lambda: "/contact", contact),
    "contact-point": (lambda: "/contact?contact.geometry=point", contact_point),
    "sweep": (lambda: address_of("/sweep", sweep(6)), swept),
    "compare": (lambda: "/compare", compared),
    "compare-axle": (lambda: address_of("/compare", AXLES), compared_axles),
}


def take(page, path):
    """Write a picture of a page that is small enough for a repository."""
    # Figures are drawn in the frames after their numbers.
    page.wait_for_load_state("networkidle")
    drawn(page)
    page.evaluate("document.activeElement.blur(); window.scrollTo(0, 0)")
    page.screenshot(path=path, full_page=True, animations="disabled")
    with Image.open(path) as taken:
        picture = taken.convert("RGB")
    picture = picture.crop((0, 0, picture.width, min(picture.height, _TALLEST)))
    picture.quantize(_COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
    return picture


def assert_is_picture(picture, path, width):
    """A picture has the width of its window, many colours, and few bytes."""
    assert picture.width == width
    assert len(picture.getcolors(1 << 24)) > 50, "the picture is blank"
    assert path.stat().st_size < _MOST


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_pictures_of_a_page(open_page, app_server, folder, name):
    address, complete = PAGES[name]
    page = open_page(app_server, address())
    complete(page)
    for width, height in ((1280, 900), (400, 800)):
        page.set_viewport_size({"width": width, "height": height})
        # Figures follow the window in their own time.
        page.wait_for_function(
            "width => document.documentElement.clientWidth === width"
            " && document.documentElement.scrollWidth <= width",
            arg=width,
        )
        path = folder / f"{name}-{width}.png"
        picture = take(page, path)
        assert fits(page), f"{name} scrolls sideways at {width} px"
        assert_is_picture(picture, path, width)


@pytest.mark.slow
def test_picture_of_a_report(page, browser, folder, tmp_path):
    wait_for_number(page, "bearing.capacitance", capacitance())
    report = downloaded(page, "download-report-html", tmp_path)
    # The report is one file that needs no server.
    context = browser.new_context(viewport={"width": 1280, "height": 900}, offline=True)
    try:
        context.set_default_timeout(1e3 * PATIENCE)
        shown = context.new_page()
        shown.goto(report.as_uri())
        path = folder / "report-1280.png"
        assert_is_picture(take(shown, path), path, 1280)
        assert fits(shown)
    finally:
        context.close()
