"""Answers about an axle, which have the numbers of ``solve_axle``, and opened files of axles."""

import tomllib

import pytest

from ehlectric import InputError
from ehlectric.app.compute.axle_answers import quick_answer, remedied_answer, whole_answer
from ehlectric.app.compute.page_files import uploaded, write
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import AXLE
from ehlectric.app.view_models import PENDING
from ehlectric.axle import solve_axle
from ehlectric.cases.axle_case import AxleCase
from ehlectric.readable import readable
from tests.helpers.places import EXAMPLES

FILES = ("e_axle.toml", "e_axle_stage_1.toml", "e_axle_stage_2.toml")


# Words instead of U/V_b by the state: no element of the example has summits that touch and insulate.
_WITHOUT = {"conducts": "conducts", "insulates": "no V_b"}


def contents(*names):
    return {name: (EXAMPLES / name).read_bytes() for name in names}


def test_an_answer_has_the_numbers_of_the_command():
    """Expected: ``solve_axle`` of the files of the example."""
    summary = solve_axle(AxleCase.from_toml(EXAMPLES / FILES[0]), probable=False).summary()
    answer = remedied_answer(AXLE.table)
    rows = {row[0]: row[1:] for row in answer.elements.rows}
    for row in summary["elements"]:
        expected = (row["capacitance"], row["breakdown_voltage"], row["voltage"], row["voltage_ratio"])
        texts = [
            "–" if value is None else readable(factor * value)
            for value, factor in zip(expected, (1e9, 1.0, 1.0, 1.0), strict=True)
        ]
        if row["state"] == "conducts":
            texts[-1] = "conducts"
        assert list(rows[row["element"]][3::-1]) == texts
    assert answer.elements.rows[0][0] == summary["rank"]["by-film"][0]
    assert answer.verdict.margin == pytest.approx(
        1.0 / max(row["voltage_ratio"] or 0.0 for row in summary["elements"])
    )
    remedies = {row[0]: row[2:] for row in answer.remedies.rows}
    for number, remedy in enumerate(summary["remedies"]):
        for row in remedy["elements"]:
            ratio = row["voltage_ratio"]
            cell = remedies[row["element"]][number].removesuffix(" ▲").removesuffix(" ▼")
            assert cell.partition(" (")[0] == (_WITHOUT[row["state"]] if ratio is None else readable(ratio))


def test_sentences_state_the_effect_of_each_remedy_on_all_elements():
    """A ring from the rotor to the housing lowers the voltage of every element: the rotor feeds all nodes."""
    ring, hybrid, *_ = remedied_answer(AXLE.table).effects
    assert ring.startswith("Ring on the rotor: lowers U/V_b of all elements.")
    assert "no element breaks down" in ring
    assert "raises U/V_b of both bearings of intermediate" in hybrid
    assert "leaves both bearings of rotor without a breakdown voltage" in hybrid


def test_the_table_of_remedies_contains_the_worse_state_of_the_meshes():
    """If all meshes conduct, the voltage of the rotor is on the bearings of the next shaft."""
    case = AxleCase.from_toml(EXAMPLES / FILES[0])
    worse = {}
    for conduction in ("always", "never"):
        result = solve_axle(case.replace({"mesh.gear.contact.conduction": conduction}), probable=False)
        for row in result.summary()["remedies"][0]["elements"]:
            if row["voltage_ratio"] is not None:
                worse[row["element"]] = max(worse.get(row["element"], 0.0), row["voltage_ratio"])
    remedies = {row[0]: row[2] for row in remedied_answer(AXLE.table).remedies.rows}
    for name in ("bearing 1 of intermediate", "bearing 2 of output"):
        assert f"({readable(worse[name])})" in remedies[name]


def test_summits_that_touch_are_words_and_the_first_elements():
    """Bearings of the output shaft whose composite Rq is a thicker part of the film."""
    rough = AXLE.changed({"bearing.5.composite_rq": "0.05 um", "bearing.6.composite_rq": "0.05 um"})
    answer = remedied_answer(rough.table)
    assert answer.elements.rows[0][0] == "bearing 1 of output"
    assert [row[1] for row in answer.elements.rows[:2]] == ["touches"] * 2
    assert {*answer.remedies.rows[0][1:]} == {"touches"}
    assert answer.verdict.margin == 0.0
    codes = [reason.code for reason in answer.verdict.reasons]
    assert {"axle-touching", "axle-first-film"} <= {*codes}
    ring = answer.effects[0]
    assert "lowers U/V_b of all elements that have a breakdown voltage" in ring
    assert "summits touch in both bearings of output" in ring
    assert ring.endswith("Then bearing 1 of output is first: its summits touch.")


def test_remedies_and_probabilities_follow_the_quick_answer():
    quick, remedied = quick_answer(AXLE.table), remedied_answer(AXLE.table)
    assert [quick.remedied, quick.whole, remedied.remedied, remedied.whole] == [False, False, True, False]
    assert (quick.remedies, quick.chances, remedied.chances) == (None, None, None)
    assert quick.verdict == remedied.verdict
    assert PENDING in dict(quick.deciding.facts).values()


def test_a_whole_answer_has_the_probabilities_of_the_command():
    """Expected: ``solve_axle`` of the files of the example."""
    answer = whole_answer(AXLE.table)
    table = solve_axle(AxleCase.from_toml(EXAMPLES / FILES[0])).summary()["uncertainty"]
    chances = {row[0]: row[1:] for row in answer.chances.rows}
    for row in table["elements"]:
        assert chances[row["element"]][0] == readable(100.0 * row["first_probability"], 2)
    assert answer.verdict.interval == (table["margin_low"], table["margin_high"])


def test_files_of_an_axle_come_with_their_gear_files(tmp_path):
    opened = uploaded(contents(*FILES[:2]), tmp_path)
    assert opened.missing == (FILES[2],)
    opened = uploaded(contents(*reversed(FILES)), tmp_path)
    assert (opened.name, opened.kind, opened.missing) == (FILES[0], "axle", ())
    assert Inputs(opened.table) == AXLE


def test_a_downloaded_axle_is_one_file_with_the_numbers_of_the_page(tmp_path):
    path = tmp_path / "axle.toml"
    path.write_text(AXLE.toml(), "utf-8")
    summary = solve_axle(AxleCase.from_toml(path), probable=False).summary()
    answer = quick_answer(tomllib.loads(AXLE.toml()))
    assert [row[0] for row in answer.elements.rows][:2] == summary["rank"]["by-film"][:2]
    written = write(AXLE.table, "", tmp_path, lambda *_: None)
    assert {"summary.json", "elements.csv", "shafts.csv"} <= {*written.names}


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"drive.torque": "0 N m"}, "drive.torque"),
        ({"mesh.1.file": "/etc/passwd"}, "mesh.1.file"),
        ({"bearing.3.base": "x99"}, "bearing"),
        ({"mesh.1.gears": ["rotor", "wheel"]}, "mesh"),
    ],
)
def test_wrong_inputs_are_refused(changes, key):
    with pytest.raises(InputError) as refused:
        quick_answer(AXLE.changed(changes).table)
    assert refused.value.key.startswith(key)


def test_a_line_of_the_figure_contains_its_bar():
    """Also if one of two meshes conducts, which is neither all of them nor none."""
    solution = solve_axle(AxleCase.from_written(AXLE.table), remedies=False, probable=False).solution
    ratios = solution.ratios()
    lines = solution.ratio_ends()
    assert lines
    for name, (low, high) in lines.items():
        assert 0.0 < low <= ratios[name] <= high
