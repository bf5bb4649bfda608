"""Pages of a server that is strained: many jobs, a kill during a job, wrong links, and large files."""

import signal
from urllib.parse import quote

import pytest

from tests.app.driving import loaded_again, seen, type_into, wait_for_number
from tests.app.outputs import address_of, downloaded
from tests.app.test_contact_page import open_group
from tests.app.test_first_page import LOAD, capacitance
from tests.app.test_sweep_page import run, sweep, wait_for_points
from tests.helpers.app_server import kept_port
from tests.helpers.processes import alive, wait_until

pytestmark = pytest.mark.browser


@pytest.mark.slow
@pytest.mark.parametrize(
    "path",
    [
        "/?bearing.base=none-such",
        "/?bearing=1&bearing.base=2",
        "/?bearing.base=6208&bearing.radial_load=%3Cscript%3Ealert(1)%3C/script%3E",
        "/contact?contact.geometry=square&contact.load=1",
        "/sweep?case.bearing.base=6208&vary.x=1",
        "/compare?a.bearing.base=6208&b=2",
    ],
)
def test_a_wrong_link_is_told_in_words(open_page, app_server, path):
    page = open_page(app_server, path)
    alert = page.locator("[role=alert], .verdict, [data-testid=notice]").filter(has_text="expected")
    assert wait_until(lambda: alert.filter(visible=True).count() > 0)
    assert "Traceback" not in page.inner_text("body")
    assert "Server error" not in page.inner_text("body")


@pytest.mark.slow
def test_a_server_that_is_killed_during_a_job_leaves_no_process(own_server, open_page):
    with kept_port() as port:
        server = own_server("--port", str(port))
        page = open_page(server)
        wait_for_number(page, "bearing.capacitance", capacitance())
        before = set(server.started())
        page.get_by_test_id("solve").click()
        assert wait_until(lambda: set(server.processes()) > before)
        every = server.processes()
        wait_until_again = loaded_again(page)
        server.stop(signal.SIGKILL)
        assert wait_until(lambda: not any(map(alive, every)))
        own_server("--port", str(port))
    wait_until_again()
    wait_for_number(page, "bearing.capacitance", capacitance())
    # The browser tells that the server was gone.
    page.watch.wrong.clear()


@pytest.mark.slow
def test_a_page_answers_while_others_compute(own_server, open_page):
    server = own_server("--jobs", "1")
    tabs = [open_page(server) for _ in range(4)]
    asking = open_page(server)
    for tab in (asking, *tabs):
        wait_for_number(tab, "bearing.capacitance", capacitance())
    for tab in tabs:
        tab.get_by_test_id("solve").click()
    type_into(asking, LOAD, "900 N")
    wait_for_number(asking, "bearing.capacitance", capacitance("900 N"))
    # Jobs beyond the number that may run wait, and say so.
    assert wait_until(lambda: any("wait" in tab.inner_text("body").lower() for tab in tabs))
    for tab in tabs:
        seen(tab, "cancel").click()
        tab.get_by_test_id("solve-message").filter(has_text="Cancelled").wait_for()


@pytest.mark.slow
def test_a_sweep_and_a_bearing_of_two_tabs_do_not_mix(open_page, app_server, tmp_path):
    first = open_page(app_server, address_of("/sweep", sweep(2)))
    second = open_page(app_server, address_of("/sweep", sweep(3)))
    for tab, count in ((first, 4), (second, 9)):
        tab.get_by_test_id("plan").filter(has_text=f"{count} points").wait_for()
        run(tab)
    bearing = open_page(app_server)
    wait_for_number(bearing, "bearing.capacitance", capacitance())
    for tab, count in ((first, 4), (second, 9)):
        wait_for_points(tab, f"{count} solved")
        lines = downloaded(tab, "download-csv", tmp_path).read_text("utf-8").splitlines()
        assert len(lines) == count + 1


@pytest.mark.slow
def test_a_file_that_is_too_large_is_refused_before_it_is_read(open_page, app_server, tmp_path):
    large = tmp_path / "large.csv"
    with large.open("wb") as file:
        file.truncate(120_000_000)
    page = open_page(app_server, "/contact")
    page.get_by_test_id("upload-surface").wait_for(state="attached")
    open_group(page, "rough-surfaces")
    # Playwright sends files of at most 50 MB; the field takes larger ones by their path only.
    page.get_by_test_id("upload-surface").set_input_files(large)
    page.get_by_test_id("roughness").get_by_role("alert").filter(has_text="at most").wait_for()


@pytest.mark.slow
@pytest.mark.parametrize(
    "address",
    [
        "/?bearing.base='6208'&" + quote("\"b :x='(window.ran=1)' c\"") + "=1",
        "/contact?contact.geometry=line&roughness="
        + quote('[{surface="1\\" :x=\'(window.ran=1)\' y=\\"", generator="waves"}]'),
        "/?bearing.base='6208'&title=" + quote('\'"><img src=x onerror="window.ran=1">\''),
    ],
)
def test_no_text_of_a_link_runs(open_page, app_server, address):
    """The framework runs properties whose names begin with a colon, and a text could hold further ones."""
    page = open_page(app_server, address)
    # What comes with the page has run when the server has answered a click.
    page.wait_for_load_state("networkidle")
    page.get_by_test_id("copy-link").click()
    page.get_by_test_id("toast").filter(has_text="link").wait_for()
    assert page.evaluate("window.ran === undefined")
