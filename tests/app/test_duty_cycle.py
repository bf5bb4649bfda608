"""Duty cycle on the page of a bearing: wrong and right files, its result, and what other pages get of it."""

import json
import zipfile

import pytest

from ehlectric.cases.duty_inputs import Duty, read_cycle
from ehlectric.errors import InputError
from ehlectric.runtime.memory import MOST_MEASURED
from tests.app.driving import complete, field, seen, type_into, wait_for_address
from tests.app.outputs import downloaded, fits
from tests.helpers.cycles import HEADS, ROWS
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser


def cycle(folder, rows=ROWS, name="my <i>cycle.csv"):
    """Path of a file with a duty cycle."""
    path = folder / name
    path.write_text(f"{HEADS}\n{rows}", encoding="utf-8")
    return path


def opened(page):
    """Open the group of the duty cycle."""
    complete(page)
    page.locator("[data-testid=group-duty-cycle] > summary").click()
    page.get_by_test_id("duty-example").wait_for()


def given(page, path):
    page.get_by_test_id("upload-duty").set_input_files(path)


def share(page, name):
    """Share of time that the page shows [%]; None where there is none yet."""
    row = page.get_by_test_id("duty-numbers").locator("tr").filter(has_text=name).filter(visible=True)
    if row.count() == 0 or page.get_by_test_id("duty-state").is_visible():
        return None
    return float(row.locator("td").inner_text().split()[0])


def wait_for_share(page, name, expected):
    assert wait_until(lambda: (found := share(page, name)) is not None and abs(found - expected) < 1e-6), (
        share(page, name)
    )


@pytest.mark.slow
def test_a_cycle_is_uploaded_and_its_result_follows_the_inputs(page, tmp_path):
    opened(page)
    assert not page.get_by_test_id("duty").is_visible()
    given(page, cycle(tmp_path, "0,0,1800,70,1\n1,fast,1800,70,1\n", "bad.csv"))
    error = page.get_by_test_id("error-duty")
    error.filter(has_text="bad.csv").filter(has_text="line 3").filter(has_text="fast").wait_for()
    assert "surface-" not in error.inner_text(), "the file has the name of its user"
    assert "duty" not in page.url, "a wrong file is not used"
    given(page, cycle(tmp_path))
    wait_for_address(page, "duty.file=")
    # Each row stands for the time from halfway to the row before to halfway to the next.
    wait_for_share(page, "share of the duty cycle at a standstill", 5.0)
    wait_for_share(page, "with frequent asperity contact", 10.0)
    assert not error.is_visible()
    assert "my <i>cycle.csv: 6 rows over 100 s" in page.get_by_test_id("duty-used").inner_text()
    assert "operating point of the form" in page.get_by_test_id("operating-point").inner_text()
    note = page.get_by_test_id("duty-warnings")
    note.locator("summary").click()
    assert "my <i>cycle.csv: not used: gear" in note.inner_text()
    assert page.get_by_test_id("duty-stretches").locator("tbody tr").count() > 0
    assert seen(page, "figure-duty").locator(".js-plotly-plot .yaxislayer-above").count() > 0
    with zipfile.ZipFile(downloaded(page, "download-all", tmp_path)) as archive:
        names = archive.namelist()
        assert {"duty.csv", "bearing_duty.svg", "surfaces/surface-2.csv"} <= set(names)
        summary = json.loads(archive.read("summary.json"))["duty"]
    assert share(page, "with a full film") == pytest.approx(100.0 * summary["full_film_share"], rel=5e-3)
    # Rough surfaces touch for longer: another input, another cycle.
    before = share(page, "with a full film")
    type_into(page, "bearing.composite_rq", "0.5 um")
    assert wait_until(lambda: (now := share(page, "with a full film")) is not None and now < before)
    wait_for_share(page, "share of the duty cycle at a standstill", 5.0)
    page.get_by_test_id("undo").click()
    wait_for_share(page, "with a full film", before)
    page.get_by_test_id("duty-remove").click()
    page.get_by_test_id("duty").wait_for(state="hidden")
    assert "duty" not in page.url


@pytest.mark.slow
def test_a_driving_cycle_has_fields_for_wheels_and_ratio(page, tmp_path):
    opened(page)
    radius = page.get_by_test_id("group-vehicle")
    assert not radius.is_visible()
    driven = tmp_path / "driven.csv"
    rows = "".join(f"{time},{speed}\n" for time, speed in ((0, 0), (10, 36), (20, 72), (30, 72), (40, 36)))
    driven.write_text(f"time [s],vehicle speed [km/h]\n{rows}", encoding="utf-8")
    given(page, driven)
    wait_for_address(page, "duty.vehicle.ratio=9")
    assert field(page, "duty.vehicle.wheel_radius").input_value() == "320 mm"
    assert radius.evaluate("group => Boolean(group.parentElement.closest('[data-testid=group-duty-cycle]'))")
    # The first of five rows belongs to half a step.
    wait_for_share(page, "share of the duty cycle at a standstill", 12.5)
    type_into(page, "duty.vehicle.wheel_radius", "500")
    type_into(page, "duty.vehicle.ratio", "10")
    wait_for_address(page, "duty.vehicle.ratio=10")
    # 20 m/s of wheels of 0.5 m turn at 40 rad/s, and the shaft ten times as fast.
    duty = page.get_by_test_id("duty")
    assert wait_until(lambda: "3820" in "".join(duty.text_content().split()))
    type_into(page, "duty.vehicle.ratio", "-1")
    page.get_by_test_id("error-duty-vehicle-ratio").filter(has_text="above 0").wait_for()
    page.get_by_test_id("undo").click()
    # A cycle with the speed of the shaft has no vehicle.
    given(page, cycle(tmp_path))
    page.wait_for_function("() => !location.search.includes('vehicle')")
    assert not radius.is_visible()
    wait_for_share(page, "share of the duty cycle at a standstill", 5.0)


@pytest.mark.slow
def test_a_cycle_that_does_not_suit_the_bearing_leaves_its_answer(page, tmp_path):
    opened(page)
    path = tmp_path / "idle.csv"
    heads = "time [s],speed [rpm],radial load [N],axial load [N]"
    path.write_text(f"{heads}\n0,1000,1800,100\n1,1000,0,0\n", encoding="utf-8")
    given(page, path)
    error = page.get_by_test_id("error-duty")
    error.filter(has_text="idle.csv: line 3: got a speed without a load").wait_for()
    page.get_by_test_id("duty-state").filter(has_text="not computed").wait_for()
    assert page.get_by_test_id("answer").get_attribute("aria-busy") == "false"
    assert not page.get_by_test_id("notice").is_visible()


@pytest.mark.slow
def test_a_cycle_above_the_limit_of_its_reader_is_not_sent(page, tmp_path):
    opened(page)
    path = tmp_path / "long.csv"
    path.write_bytes(b"time [s],speed [rpm]\n".ljust(MOST_MEASURED + 1_000_000, b"\n"))
    given(page, path)
    page.get_by_test_id("error-duty").filter(has_text="long.csv: has 9 MB; expected at most 8 MB").wait_for()
    assert not any("/upload/" in url for url in page.watch.requests)
    # The reader of the command has the same limit.
    with pytest.raises(InputError, match="8"):
        read_cycle(Duty(file=str(path)))


@pytest.mark.slow
def test_the_example_is_one_click_and_stays_on_its_page(open_page, app_server):
    page = open_page(app_server, width=400)
    opened(page)
    page.get_by_test_id("duty-example").click()
    # The standstills of the WLTC at the motor of the example.
    wait_for_share(page, "share of the duty cycle at a standstill", 13.0)
    page.get_by_test_id("to-duty").click()
    assert wait_until(
        lambda: page.get_by_test_id("duty").evaluate("one => Math.abs(one.getBoundingClientRect().top) < 400")
    )
    assert fits(page)
    # A link has the inputs; the file stays in its tab, and the answer does not need it.
    other = open_page(app_server, f"/{page.url[page.url.index('?') :]}")
    complete(other)
    other.get_by_test_id("error-duty").filter(has_text="another session").wait_for()
    other.get_by_test_id("duty-remove").click()
    other.get_by_test_id("duty").wait_for(state="hidden")
    # Other pages take the bearing without its cycle.
    page.get_by_test_id("compare").click()
    page.wait_for_url("**/compare?**")
    page.get_by_test_id("compared").get_by_text("Both cases have the same inputs").wait_for()
    assert "duty" not in page.url
