"""Page of a gear pair as a user sees it: from a drawing to the verdict, with the numbers of the command."""

import json
import re
import zipfile

import pytest

from tests.app.driving import field, number, type_into, wait_for_address, wait_for_number
from tests.app.outputs import downloaded, summary_by_command
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser


@pytest.fixture
def gears(open_page, app_server):
    page = open_page(app_server, "/gear")
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()
    return page


def level(page):
    return page.get_by_test_id("verdict").get_attribute("data-level")


@pytest.mark.slow
@pytest.mark.gate
def test_a_drawing_leads_to_the_numbers_of_the_command(gears, tmp_path):
    page = gears
    type_into(page, "gear.teeth.2", "68")
    type_into(page, "gear.profile_shift.1", "")
    type_into(page, "gear.centre_distance", "")
    type_into(page, "gear.tip_diameter.1", "")
    type_into(page, "gear.tip_diameter.2", "")
    type_into(page, "gear.operation.pinion_torque", "60")
    wait_for_address(page, "60 N*m")
    # Without shifts the centre distance is m_n (z1 + z2)/(2 cos beta), 1.75 mm 91/(2 cos 25°) = 87.8565 mm.
    follows = field(page, "gear.centre_distance")
    assert wait_until(lambda: follows.get_attribute("placeholder") == "87.8565 mm")
    mesh = summary_by_command("gear", downloaded(page, "download-toml", tmp_path), tmp_path)["mesh"]
    wait_for_number(page, "mesh.margin", mesh["margin"])
    assert number(page, "mesh.lambda_ratio") == pytest.approx(mesh["lambda_ratio"], rel=5e-3)
    head = page.get_by_test_id("points").get_by_role("columnheader").all_inner_texts()
    assert [text for text in head if text] == list("ABCDE")
    for name in ("film", "flank", "mesh", "path"):
        assert page.get_by_test_id(f"figure-{name}").filter(visible=True).count() == 1


@pytest.mark.slow
def test_states_of_the_mesh_have_words_and_colours(gears):
    page = gears
    assert level(page) == "red"
    # Smooth flanks hold the voltage also within what is uncertain.
    for gear in (1, 2):
        type_into(page, f"gear.flank_ra.{gear}", "0.02")
    type_into(page, "gear.contact.voltage", "50 mV")
    assert wait_until(lambda: level(page) == "green")
    page.get_by_text("The film holds the voltage between both gears.").wait_for()
    for gear in (1, 2):
        type_into(page, f"gear.flank_ra.{gear}", "0.8")
    page.get_by_test_id("verdict").filter(has_text="The mesh conducts").wait_for()
    assert level(page) == "grey"
    page.get_by_test_id("number-mesh.lambda_ratio").wait_for()


@pytest.mark.slow
def test_a_refusal_stands_next_to_its_field(gears):
    page = gears
    type_into(page, "gear.centre_distance", "95 mm")
    error = page.get_by_test_id("error-gear-centre_distance")
    error.filter(has_text="profile shift coefficient").wait_for()
    type_into(page, "gear.centre_distance", "87 mm")
    error.wait_for(state="hidden")
    type_into(page, "gear.teeth.1", "many")
    page.get_by_test_id("error-gear-teeth-1").filter(has_text="a whole number").wait_for()
    page.get_by_test_id("undo").click()
    page.locator("[data-testid=answer][aria-busy=false]").wait_for()
    assert field(page, "gear.teeth.1").input_value() == "23"
    assert field(page, "gear.teeth.2").input_value() == "67"


@pytest.mark.slow
def test_a_spur_drawing_is_typed_without_errors(gears):
    page = gears
    kinds = page.get_by_test_id("gears")
    kinds.get_by_text("Spur pair").click()
    assert wait_until(lambda: field(page, "gear.teeth.1").input_value() == "16")
    assert field(page, "gear.helix_angle").input_value() == ""
    type_into(page, "gear.normal_module", "2.5 mm")
    page.get_by_test_id("form-note").filter(
        has_text="removed: Title, Centre distance, Profile shift coefficients, Tip diameters"
    ).wait_for()
    type_into(page, "gear.teeth.1", "20")
    type_into(page, "gear.teeth.2", "61")
    # m (z1 + z2)/2
    follows = field(page, "gear.centre_distance")
    assert wait_until(lambda: follows.get_attribute("placeholder") == "101.25 mm")
    assert page.get_by_role("alert").filter(visible=True).all_inner_texts() == []
    # A helix angle makes it a helical pair, and the other kind has the inputs with which it was left.
    type_into(page, "gear.helix_angle", "20 deg")
    kinds.get_by_role("radio", name="Helical pair", checked=True).wait_for()
    kinds.get_by_text("Spur pair").click()
    assert wait_until(lambda: field(page, "gear.teeth.1").input_value() == "16")
    kinds.get_by_text("Helical pair").click()
    assert wait_until(lambda: field(page, "gear.teeth.1").input_value() == "20")


@pytest.mark.slow
def test_the_second_value_of_a_pair_is_asked_for_without_an_alert(gears):
    """A tip diameter that is removed is asked for as the one of the other gear is given."""
    page = gears
    page.get_by_test_id("gears").get_by_text("Spur pair").click()
    assert wait_until(lambda: field(page, "gear.teeth.1").input_value() == "16")
    type_into(page, "gear.tip_diameter.1", "")
    waiting = page.get_by_test_id("error-gear-tip_diameter-1")
    waiting.filter(has_text="missing").wait_for()
    assert waiting.get_attribute("role") == "status"
    assert field(page, "gear.tip_diameter.1").get_attribute("aria-invalid") is None
    assert page.get_by_role("alert").filter(visible=True).all_inner_texts() == []
    type_into(page, "gear.tip_diameter.1", "82.46 mm")
    waiting.wait_for(state="hidden")


@pytest.mark.slow
def test_a_gear_file_opens_on_its_page(page):
    page.get_by_test_id("upload-case").locator("input[type=file]").set_input_files(
        EXAMPLES / "gear_spur.toml"
    )
    page.wait_for_url(re.compile("/gear"))
    page.get_by_test_id("verdict").filter(has_text="The mesh conducts").wait_for()
    assert field(page, "gear.flank_ra.1").input_value() == "0.3 µm"
    assert field(page, "gear.flank_ra.2").get_attribute("placeholder") == "0.3 µm"


@pytest.mark.slow
def test_a_sweep_begins_with_the_gears_of_the_page(gears):
    page = gears
    page.get_by_test_id("vary").click()
    page.wait_for_url(re.compile("/sweep"))
    # Fields are made anew when the inputs that may vary are known.
    names = ["Torque of gear 1", "Speed of gear 1"]
    values = "names.map((_, k) => document.querySelector(`[data-testid=field-vary-${k}]`)?.value)"
    page.wait_for_function(f"names => `${{{values}}}` === `${{names}}`", arg=names)
    assert "/gear?" in page.get_by_role("link", name="Open the base case on its page").get_attribute("href")


@pytest.mark.slow
def test_a_duty_cycle_follows_the_answer(gears, tmp_path):
    """The numbers of the cycle are the numbers of the command; without its file, its place is hidden."""
    page = gears
    rows = "0,0,50,60\n10,50,120,80\n20,9000,20,50\n60,12000,30,70\n100,6000,15,70\n"
    cycle = tmp_path / "cycle.csv"
    cycle.write_text(f"time [s],speed [rpm],torque [N m],temperature [degC]\n{rows}", encoding="utf-8")
    assert not page.get_by_test_id("duty").is_visible()
    page.locator("[data-testid=group-duty-cycle] > summary").click()
    wrong = tmp_path / "wrong.csv"
    wrong.write_text("time [s],radial load [N]\n0,1\n1,2\n", encoding="utf-8")
    page.get_by_test_id("upload-duty").set_input_files(wrong)
    page.get_by_test_id("error-duty").filter(has_text="torque [N m]").wait_for()
    page.get_by_test_id("upload-duty").set_input_files(cycle)
    wait_for_address(page, "duty.file=")
    numbers = page.get_by_test_id("duty-numbers").locator("tr")
    still = numbers.filter(has_text="share of the duty cycle at a standstill").locator("td")
    # The first row counts for half of the first interval of 100 s.
    still.filter(has_text="5 %").wait_for()
    numbers.filter(has_text="mesh conducts").filter(has_text="10 %").wait_for()
    assert page.get_by_test_id("figure-duty").locator(".js-plotly-plot .yaxislayer-above").count() > 0
    assert page.get_by_test_id("duty-stretches").locator("tbody tr").count() > 0
    with zipfile.ZipFile(downloaded(page, "download-all", tmp_path)) as archive:
        assert {"duty.csv", "gear_duty.svg", "surfaces/surface-2.csv"} <= set(archive.namelist())
        duty = json.loads(archive.read("summary.json"))["duty"]
    assert duty["standstill_share"] == pytest.approx(0.05)
    page.get_by_test_id("duty-remove").click()
    page.get_by_test_id("duty").wait_for(state="hidden")
