"""Pages for those who use a keyboard or a screen reader: axe-core, the accessibility tree, and what moves."""

from importlib import resources

import pytest

from tests.browser.test_screenshots import PAGES

# Findings of these impacts fail; "minor" and "moderate" ones are matters of taste and of landmarks.
_SERIOUS = ("serious", "critical")


def findings(page):
    """Serious findings of axe-core on a page as it is shown, each with its elements."""
    if not page.evaluate("() => 'axe' in window"):
        source = resources.files("axe_playwright_python").joinpath("axe.min.js").read_text("utf-8")
        page.evaluate(f"() => {{ {source} }}")
    found = page.evaluate("() => axe.run(document, { resultTypes: ['violations'] })")["violations"]
    return [
        f"{one['id']} ({one['impact']}): {node['html'][:160]} {node['failureSummary'].splitlines()[-1].strip()}"
        for one in found
        if one["impact"] in _SERIOUS
        for node in one["nodes"]
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_axe_finds_nothing_serious(open_page, app_server, name):
    address, complete = PAGES[name]
    page = open_page(app_server, address())
    complete(page)
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
