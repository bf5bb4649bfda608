"""Pages for those who use a keyboard or a screen reader: axe-core, the accessibility tree, and what moves."""

import re
from importlib import resources
from itertools import pairwise

import pytest

from tests.app.driving import complete, drawn, field, number, type_into, wait_for_address
from tests.app.test_screenshots import PAGES
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser

# Findings of axe-core that keep somebody from using a page; "minor" and "moderate" ones do not.
_SERIOUS = ("serious", "critical")

# Largest sum of the layout shifts of a page: half of 0.1, up to which "web vitals" calls a page good. Half of
# the window that moves by a tenth of its height makes 0.05.
_MOST_SHIFT = 0.05

# Most stops of the focus between the first field of a page and its files.
_STOPS = 250


def findings(page):
    """Serious findings of axe-core on a page as it is shown, each with its element."""
    if not page.evaluate("() => 'axe' in window"):
        source = resources.files("axe_playwright_python").joinpath("axe.min.js").read_text("utf-8")
        page.evaluate(f"() => {{ {source} }}")
    found = page.evaluate("() => axe.run(document, { resultTypes: ['violations'] })")["violations"]
    return [
        f"{one['id']} ({one['impact']}): {node['html'][:160]}\n{node['failureSummary']}"
        for one in found
        if one["impact"] in _SERIOUS
        for node in one["nodes"]
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_axe_finds_nothing_serious(open_page, app_server, name):
    """With all groups open, and one help."""
    address, wait = PAGES[name]
    page = open_page(app_server, address())
    wait(page)
    page.evaluate("() => document.querySelectorAll('details').forEach(one => { one.open = true; })")
    for about in page.get_by_role("button", name=re.compile("^About ")).filter(visible=True).all()[:1]:
        about.click()
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        page.wait_for_function(
            "dark => document.body.classList.contains('body--dark') === dark", arg=scheme == "dark"
        )
        for width in (1280, 400):
            page.set_viewport_size({"width": width, "height": 900})
            page.wait_for_function("width => document.documentElement.clientWidth === width", arg=width)
            found = findings(page)
            assert not found, f"{name}, {scheme}, {width} px:\n" + "\n".join(found)


@pytest.mark.slow
def test_axe_finds_nothing_serious_in_an_error(page):
    complete(page)
    type_into(page, "bearing.radial_load", "much")
    page.get_by_test_id("error-bearing-radial_load").wait_for()
    assert findings(page) == []


def focus_on(page, test, key="Tab"):
    """Press a key until the element of a test mark has the focus."""
    for _ in range(_STOPS):
        if page.evaluate("() => document.activeElement.dataset.testid") == test:
            return
        page.keyboard.press(key)
    raise AssertionError(f"{test} is not reached by {key}")


@pytest.mark.slow
def test_form_and_answer_are_used_by_the_keyboard_alone(page):
    complete(page)
    margin = number(page, "bearing.margin")
    keys = page.keyboard
    page.locator("main.page").focus()
    # A value with its unit, and Escape, which takes back what was typed.
    focus_on(page, "field-bearing-radial_load")
    keys.press("Control+A")
    keys.type("9 kN")
    keys.press("Escape")
    assert field(page, "bearing.radial_load").input_value() == "1800 N"
    keys.press("Control+A")
    keys.type("3.6 kN")
    keys.press("Enter")
    wait_for_address(page, "3.6 kN")
    assert wait_until(lambda: number(page, "bearing.margin") < margin)
    # Arrow keys on the slider, one step and back by undo; the text box has an undo of its own.
    focus_on(page, "slider-bearing-radial_load", "Shift+Tab")
    keys.press("ArrowRight")
    wait_for_address(page, "3650 N")
    for text in ("3.6 kN", "1800 N"):
        keys.press("Control+Z")
        wait_for_address(page, f"bearing.radial_load={text}")
    assert page.evaluate("() => document.activeElement.dataset.testid") == "slider-bearing-radial_load"
    # Help opens at its button, and Escape closes it there.
    keys.press("Shift+Tab")
    text = page.get_by_text("If the value increases, the capacitance rises, the films get thinner")
    for key, count in (("Enter", 1), ("Escape", 0), ("Space", 1), ("Escape", 0)):
        keys.press(key)
        assert wait_until(lambda count=count: text.count() == count), key
    assert page.evaluate("() => document.activeElement.ariaLabel") == "About Radial load"
    complete(page)
    assert number(page, "bearing.margin") == margin
    # From the form to the answer, whose notes open, and to the files.
    focus_on(page, "solve")
    notes = page.get_by_role("region", name="Notes").locator("details")
    for _ in range(_STOPS):
        keys.press("Tab")
        if notes.first.evaluate("one => one.contains(document.activeElement)"):
            break
    keys.press("Enter")
    assert notes.first.evaluate("one => one.open")
    focus_on(page, "download-toml")


_NAMELESS = """() => [...document.querySelectorAll('.form :is(input, select)')]
  .filter(one => one.checkVisibility())
  .map(one => ({
    test: one.dataset.testid,
    name: [...(one.labels || [])].map(label => label.innerText).join(' ') || one.ariaLabel,
  }))"""


_DESCRIBED = """one => one.getAttribute('aria-describedby').split(' ')
  .map(id => document.getElementById(id).innerText).filter(text => !text.startsWith('('))"""


@pytest.mark.slow
@pytest.mark.parametrize("path", ["/", "/drive", "/gear", "/axle", "/contact"])
def test_fields_have_names_units_and_errors_in_the_accessibility_tree(open_page, app_server, path):
    page = open_page(app_server, path)
    page.locator(".form .field").first.wait_for()
    for one in page.evaluate(_NAMELESS):
        assert one["name"], one
    named = {
        "/contact": ("Entrainment speed", "m/s"),
        "/gear": ("Normal module", "mm"),
        "/axle": ("Torque of the rotor", "N m"),
    }
    name, unit = named.get(path, ("Radial load", "N"))
    box = page.get_by_role("textbox", name=name, exact=True).first
    box.wait_for()
    assert box.evaluate(_DESCRIBED) == [f"in {unit}"]
    box.fill("much")
    box.press("Enter")
    page.locator(".form .field-error").filter(visible=True).wait_for()
    assert box.get_attribute("aria-invalid") == "true"
    assert "expected a number" in box.evaluate(_DESCRIBED)[-1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "verdict", "deciding"),
    [
        ("bearing", "Breakdown likely", "Margin (first breakdown / shaft voltage)"),
        ("drive", "Discharges expected", "Discharges per second"),
        ("gear", "Breakdown expected", "Margin"),
        ("axle", "Breakdown expected", "Margin of the first element"),
    ],
)
def test_the_answer_is_a_live_region_with_headings_and_named_figures(
    open_page, app_server, name, verdict, deciding
):
    address, wait = PAGES[name]
    page = open_page(app_server, address())
    wait(page)
    drawn(page)
    told = page.get_by_test_id("panel").get_by_role("status").inner_text()
    assert verdict in told
    assert deciding in told
    assert page.get_by_test_id("panel").get_by_test_id("value").first.inner_text() in told
    tree = page.locator("main.page").aria_snapshot()
    levels = [int(one) for one in re.findall(r"heading .*\[level=(\d)\]", tree)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels)), levels
    figures = re.findall(r"- '?figure(.*)", tree)
    assert len(figures) == page.locator(".js-plotly-plot").filter(visible=True).count() > 0
    assert all(re.match(r' "\w', one) for one in figures), figures
    # What moves is announced; the short answer of narrow screens, which says the same, is not.
    assert page.get_by_test_id("strip").locator("[aria-hidden=true]").count() == 2


# Layout shifts of a page from its first paint on; those within half a second of a key are marked "recent".
_WATCH_SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => {
  for (const one of list.getEntries()) {
    const moved = one.sources.map(({ node }) => node?.outerHTML?.slice(0, 90));
    window.shifts.push({ value: one.value, moved });
  }
}).observe({ type: 'layout-shift', buffered: true });
"""


@pytest.mark.slow
@pytest.mark.parametrize("width", [1280, 400])
@pytest.mark.parametrize(
    ("path", "slider"),
    [
        ("/", "slider-bearing-radial_load"),
        ("/drive", "slider-drive-speed"),
        ("/gear", "slider-gear-face_width"),
        ("/axle", "slider-drive-torque"),
    ],
)
def test_nothing_jumps_when_numbers_arrive(open_page, app_server, path, slider, width):
    page = open_page(app_server, "/compare", width=width)
    page.context.add_init_script(_WATCH_SHIFTS)
    page.goto(f"{app_server.address.partition('?')[0].rstrip('/')}{path}")

    def settled():
        page.locator("[data-testid=answer][aria-busy=false]:not([data-whole=false])").wait_for()
        drawn(page)
        shifts = page.evaluate("() => window.shifts.splice(0)")
        assert sum(one["value"] for one in shifts) <= _MOST_SHIFT, shifts

    settled()
    page.get_by_test_id(slider).focus()
    # The focus scrolls the page to the slider.
    page.evaluate("() => new Promise(done => setTimeout(done, 200))")
    page.evaluate("() => window.shifts.splice(0)")
    before = page.get_by_test_id("answer").inner_text()
    page.keyboard.press("ArrowRight")
    assert wait_until(lambda: page.get_by_test_id("answer").inner_text() != before)
    settled()
