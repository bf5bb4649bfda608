"""Figures of a page: after a change of the inputs they are those of a page that begins with these inputs."""

import json
import re

import pytest

from tests.app.driving import complete, drawn

pytestmark = pytest.mark.browser

# Label, traces, ranges and curves of all figures that are seen, as Plotly got them and drew them. Curves over
# an axis depend on the margins of earlier tick labels by tenths of a pixel.
FIGURES = """() => Object.fromEntries(
  [...document.querySelectorAll('.js-plotly-plot')].filter(one => one.getClientRects().length).map(one => [
    one.closest('[data-testid^=figure-]').dataset.testid,
    {
      label: one.getAttribute('aria-label'),
      data: one.data.map(({x, y, r, theta, text, name}) => ({x, y, r, theta, text, name})),
      ranges: ['xaxis', 'yaxis'].map(name => one._fullLayout[name]?.range ?? null),
      around: [...one.querySelectorAll('.polar .scatterlayer path')].map(path => path.getAttribute('d')),
    },
  ]))"""

# Moves a slider by a step.
STEP = """slider => {
  slider.value = String(Number(slider.value) - 1);
  slider.dispatchEvent(new Event('input', {bubbles: true}));
}"""


@pytest.mark.slow
def test_a_step_of_a_slider_draws_the_figures_of_its_inputs_from_changes(page, app_server, open_page):
    complete(page)
    drawn(page)
    before = page.evaluate(FIGURES)
    page.evaluate(
        "() => window.socket.onAny((name, message) => (window.messages ??= []).push([name, message]))"
    )
    address = page.url
    page.get_by_test_id("slider-bearing-radial_load").evaluate(STEP)
    page.wait_for_function("before => location.href !== before", arg=address)
    complete(page)
    drawn(page)
    frames = page.evaluate("() => window.messages")
    whole = [name for name, message in frames if name == "update" and '"layout"' in json.dumps(message)]
    assert not whole, "a whole figure is sent again"
    changes = [message["code"] for name, message in frames if name == "run_javascript"]
    assert any(re.search(r'"change".*\["data", ?0, ?"r"\]', code) for code in changes)
    after = page.evaluate(FIGURES)
    assert after.keys() == before.keys()
    assert after != before
    other = open_page(app_server, page.url.partition(app_server.address.rstrip("/"))[2])
    complete(other)
    drawn(other)
    assert other.evaluate(FIGURES) == after
