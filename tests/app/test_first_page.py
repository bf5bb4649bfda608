"""The first page: its answer is there, it changes with its inputs, and it comes back."""

import signal
from urllib.request import urlopen

import pytest

from ehlectric import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from tests.app.driving import complete, connected, field, loaded_again, number, type_into, wait_for_number
from tests.helpers.app_server import kept_port
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import alive, memory_of, wait_until

pytestmark = pytest.mark.browser

LOAD = "bearing.radial_load"


def capacitance(load="1800 N"):
    """Capacitance that the command computes from the atlas for the first page's file [pF]."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({LOAD: load, "contacts": "atlas"})
    return 1e12 * summary_of(solve_bearing(case).solution)["bearing"]["capacitance"]


@pytest.mark.slow
@pytest.mark.gate
def test_the_first_page_has_its_answer(page, screenshot):
    wait_for_number(page, "bearing.capacitance", capacitance())
    assert page.get_by_test_id("verdict").inner_text().strip()
    hosts = {url.split("/")[2] for url in page.watch.requests if "://" in url}
    assert hosts == {page.watch.host}
    screenshot(page, "first_page")


@pytest.mark.slow
def test_the_next_start_has_the_answer_in_its_page(own_server, open_page, tmp_path, monkeypatch):
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
    monkeypatch.setenv("PYTHONPYCACHEPREFIX", str(tmp_path / "modules"))
    server = own_server()
    page = open_page(server)
    complete(page)
    speed = page.get_by_test_id("number-margin.critical_speed").get_by_test_id("value").inner_text()
    assert wait_until(lambda: list(tmp_path.glob("modules/**/kept_answers.*.pickle")))
    page.close()
    server.stop()
    with urlopen(own_server().address) as answer:
        assert speed.replace("\xa0", " ") in answer.read().decode().replace("\xa0", " ")


@pytest.mark.slow
def test_two_tabs_are_independent(page, open_page, app_server):
    wait_for_number(page, "bearing.capacitance", capacitance())
    other = open_page(app_server)
    type_into(other, LOAD, "900 N")
    wait_for_number(other, "bearing.capacitance", capacitance("900 N"))
    assert number(page, "bearing.capacitance") == pytest.approx(capacitance(), rel=1e-3)
    assert field(page, LOAD).input_value() == "1800 N"


@pytest.mark.slow
def test_a_token_opens_the_pages_of_a_server_for_others(own_server, open_page):
    server = own_server("--host", "0.0.0.0")
    page = open_page(server)
    wait_for_number(page, "bearing.capacitance", capacitance())
    connected(page)
    assert "token" not in page.url
    page.reload()
    wait_for_number(page, "bearing.capacitance", capacitance())
    stranger = open_page(server, "/?bearing.base=%276208%27")
    assert "token" in stranger.inner_text("body")
    # The refusals stand in its console, some of them later than its text; a closed page has no more.
    stranger.close()
    stranger.watch.wrong.clear()


@pytest.mark.slow
def test_a_tab_comes_back_with_its_inputs_after_the_server_was_killed(own_server, open_page):
    with kept_port() as port:
        server = own_server("--port", str(port))
        page = open_page(server)
        type_into(page, LOAD, "900 N")
        wait_for_number(page, "bearing.capacitance", capacitance("900 N"))
        wait_until_again = loaded_again(page)
        server.stop(signal.SIGKILL)
        page.locator("#popup[aria-hidden=false]").filter(has_text="Connection lost").wait_for()
        own_server("--port", str(port))
    wait_until_again()
    wait_for_number(page, "bearing.capacitance", capacitance("900 N"))
    assert field(page, LOAD).input_value() == "900 N"
    # The browser tells that the server was gone.
    page.watch.wrong.clear()


@pytest.mark.slow
def test_a_closed_tab_ends_its_job(own_server, open_page):
    server = own_server(away=20.0)
    page = open_page(server)
    wait_for_number(page, "bearing.capacitance", capacitance())
    before = set(server.started())
    page.get_by_test_id("solve").click()
    assert wait_until(lambda: set(server.processes()) > before)
    started = set(server.processes()) - before
    page.close()
    # A browser may come back for a while.
    assert wait_until(lambda: not any(map(alive, started)))
    assert wait_until(lambda: not list(server.temporary.glob("*/session-*")))


@pytest.mark.slow
def test_twenty_sessions_at_once_within_their_memory(own_server, open_page):
    server = own_server()
    loads = [600 + 100 * number for number in range(20)]
    pages = [open_page(server) for _ in loads]
    for page, load in zip(pages, loads, strict=True):
        type_into(page, LOAD, f"{load} N")
    for page, load in zip(pages, loads, strict=True):
        expected = capacitance(f"{load} N")
        try:
            wait_for_number(page, "bearing.capacitance", expected, digits=4)
        except AssertionError:
            # A page that got no time for so long that its session ended comes back with the inputs of its
            # address. Where it still shows what was typed, its answer is missing.
            assert field(page, LOAD).input_value() != f"{load} N"
            type_into(page, LOAD, f"{load} N")
            wait_for_number(page, "bearing.capacitance", expected, digits=4)
    # The server, the process that the others are forked from, and those of quick answers [bytes].
    assert server.memory() < 1e9


@pytest.mark.slow
@pytest.mark.gate
def test_a_keyboard_is_enough(page):
    wait_for_number(page, "bearing.capacitance", capacitance())
    box = field(page, LOAD)
    for _ in range(80):
        page.keyboard.press("Tab")
        if box.evaluate("box => box === document.activeElement"):
            break
    else:
        pytest.fail("the radial load is not reached by the key Tab")
    assert box.evaluate(
        "box => getComputedStyle(box).outlineStyle !== 'none' || box.matches(':focus-visible')"
    )
    page.keyboard.press("Control+A")
    page.keyboard.type("900 N")
    page.keyboard.press("Tab")
    wait_for_number(page, "bearing.capacitance", capacitance("900 N"))


@pytest.mark.slow
def test_requests_without_a_browser_take_little_memory(own_server):
    """A page has 3 MB, so that 80 of them would have 240 MB."""
    server = own_server()
    urlopen(server.address).read()
    before = memory_of([server.process.pid])
    for _ in range(80):
        urlopen(server.address).read()
    assert memory_of([server.process.pid]) - before < 150e6
