"""Reports and tables of sweeps name files as the case does, without the folders of a machine."""

from types import SimpleNamespace

from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import file_text, file_texts
from ehlectric.report.report_facts import without_folders
from ehlectric.sweep.result import columns_of


def test_a_file_below_the_working_folder_has_its_name_from_there(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert file_text(tmp_path / "rig" / "a.csv") == "rig/a.csv"
    assert file_text(tmp_path.parent / "a.csv") == "a.csv"
    assert file_texts([str(tmp_path / "1/a.csv"), 2.0, None]) == ["1/a.csv", 2.0, None]


def test_warnings_have_no_folders(tmp_path):
    warning = ResultWarning.of("rows-void", file=tmp_path / "log.csv", void=1, rows=5, line=3)
    assert "log.csv" in warning.text
    assert str(tmp_path) not in warning.text


def test_the_case_of_a_report_has_no_folders():
    text = (
        'title = "a/b"\n[source]\nfile = "/home/ann/scope.csv"\n[vary]\n"source.file" = ["/home/ann/a.csv"]\n'
    )
    assert without_folders(text) == text.replace("/home/ann/", "")


def test_points_of_a_sweep_have_no_folders():
    points = [
        SimpleNamespace(
            number=k, status="solved", reason="", warnings=(), seconds=0.0, inputs={"source.file": file}
        )
        for k, file in enumerate(["/home/ann/1/a.csv", "/home/ann/2/a.csv"])
    ]
    results = SimpleNamespace(points=points, varied=("source.file",), columns={}, numbers={})
    assert columns_of(results)["source.file"] == ["1/a.csv", "2/a.csv"]
