"""What importing the package costs and gives."""

import subprocess
import sys
from importlib import import_module

import pytest

import ehlectric


def modules_after(statement):
    code = f"import sys; {statement}; print(*sys.modules)"
    return set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.split())


def test_import_loads_nothing_heavy():
    loaded = modules_after("import ehlectric")
    assert "ehlectric" in loaded
    assert not loaded & {"matplotlib", "xarray", "pint", "numpy", "scipy", "pydantic"}


def test_the_command_starts_without_what_it_may_not_need():
    loaded = modules_after("import ehlectric.__main__, ehlectric.commands.command_line")
    assert "typer" in loaded
    heavy = {"matplotlib", "xarray", "pint", "numpy", "scipy", "pydantic", "h5py", "multiprocessing"}
    assert not loaded & heavy


# What an answer without figures, files of results and solved films does not need. SciPy itself is small, and
# loads each of its parts at its first use.
PARTS_OF_SCIPY = {
    f"scipy.{part}" for part in ("special", "linalg", "sparse", "fft", "interpolate", "optimize")
}
FILES = {"xarray", "pint", "h5py", "pandas", "matplotlib"}
COMPILER = {"numba", "ehlectric.drive.discharges.event_loop"}
BEARINGS = {"ehlectric.cases.bearing_case", "ehlectric.bearing.uncertainty", "ehlectric.sweep.sweep_inputs"}
OTHER_FILES = {"ehlectric.cases.gear_case", "ehlectric.cases.drive_case"}
SOLVERS = {"ehlectric.film.newton", "ehlectric.field.poisson"}
UNSOLVED = PARTS_OF_SCIPY | FILES | COMPILER

# Modules of commands: those that each loads, those that it must not load, and the largest number of all.
BEARING, LINE = "examples/bearing_6208.toml", "examples/line_contact.toml"
LOADED = {
    f"check {BEARING}": ("ehlectric.bearing.uncertainty", UNSOLVED | SOLVERS | OTHER_FILES, 700),
    "check examples/drive.toml": (
        "ehlectric.drive.preparation",
        UNSOLVED | SOLVERS | {"ehlectric.cases.gear_case"},
        710,
    ),
    f"check {LINE}": ("ehlectric.contact.preparation", UNSOLVED | BEARINGS | OTHER_FILES, 675),
    f"bearing {BEARING} --contacts atlas --no-plots --output OUT": (
        "ehlectric.bearing.stored",
        PARTS_OF_SCIPY | COMPILER | {"matplotlib", "pint", "pandas", "ehlectric.film.newton"} | OTHER_FILES,
        750,
    ),
    f"run {LINE} --no-plots --output OUT": (
        "ehlectric.film.newton",
        BEARINGS | COMPILER | {"scipy.interpolate", "scipy.optimize", "scipy.ndimage", "matplotlib", "pint"},
        970,
    ),
    "oil iso-vg-32": ("ehlectric.cases.oil_report", UNSOLVED | BEARINGS | SOLVERS, 535),
    "init OUT": ("ehlectric.runs.example_files", UNSOLVED | SOLVERS, 620),
}


@pytest.mark.parametrize("command", LOADED)
def test_a_command_loads_only_what_it_needs(command, tmp_path):
    needed, unneeded, most = LOADED[command]
    typed = command.replace("OUT", str(tmp_path / "out.toml")).split()
    code = f"""
import runpy, sys
sys.argv = ["ehlectric", *{typed}]
try:
    runpy.run_module("ehlectric", run_name="__main__")
finally:
    open({str(tmp_path / "modules")!r}, "w").write(" ".join(sys.modules))
"""
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    loaded = {*(tmp_path / "modules").read_text().split()}
    assert needed in loaded
    assert not loaded & unneeded
    assert len(loaded) <= most


@pytest.mark.slow
def test_solving_needs_no_figures_or_files():
    loaded = modules_after("import ehlectric; ehlectric.solve; ehlectric.Case")
    assert "scipy" in loaded
    assert not loaded & {"matplotlib", "xarray", "pint", "h5py"}


@pytest.mark.slow
def test_files_of_results_are_named_without_the_compiler_of_drives():
    loaded = modules_after(
        "from ehlectric.runs.result_folders import files_of_results; files_of_results('.')"
    )
    assert "ehlectric.figures.figure_names" in loaded
    assert not loaded & {"numba", "ehlectric.drive.discharges.event_loop"}


@pytest.mark.slow
def test_a_sweep_of_contacts_begins_without_the_compiler_of_drives():
    loaded = modules_after("import ehlectric.sweep.engine, ehlectric.sweep.run")
    assert "ehlectric.drive.quick_estimate" in loaded
    assert not loaded & {"numba", "ehlectric.drive.discharges.event_loop"}


NAMES = sorted({*ehlectric.__all__} - {"__version__"})


def test_public_names_are_listed():
    assert dir(ehlectric) == sorted(ehlectric.__all__)
    assert {"solve", "Case", "film", "Laws", "InputError", "__version__"} <= {*ehlectric.__all__}
    assert ehlectric.__version__ == ehlectric.version.__version__


@pytest.mark.parametrize("name", NAMES)
def test_a_public_name_is_the_object_of_its_module(name):
    value = getattr(ehlectric, name)
    assert value.__module__.startswith("ehlectric.")
    assert value is getattr(import_module(value.__module__), name)


def test_matplotlib_is_prepared_for_the_names_that_draw():
    homes = {name: getattr(ehlectric, name).__module__.split(".")[1] for name in NAMES}
    assert {name for name in NAMES if homes[name] in ("figures", "report")} == ehlectric._DRAWING


def test_an_unknown_name_gets_the_nearest_one():
    done = subprocess.run(
        [sys.executable, "-c", "import ehlectric; ehlectric.solv"], capture_output=True, text=True
    )
    assert done.stderr.splitlines()[-1] == (
        "AttributeError: module 'ehlectric' has no attribute 'solv'. Did you mean: 'solve'?"
    )


def test_help_of_cases_is_about_their_own_methods():
    """On two screens of about 50 lines, without keywords and example; pydantic's methods made them 650."""
    import pydoc

    for case in (ehlectric.BearingCase, ehlectric.DriveCase, ehlectric.Case):
        text = pydoc.render_doc(case, renderer=pydoc.plaintext)
        assert {"model_validate", "schema_json", "from_written"}.isdisjoint(text.split())
        assert all(f"{name}(" in text for name in ("replace", "from_toml", "from_dict", "to_toml"))
        constructors = [getattr(case, name) for name in ("of", "line", "point") if hasattr(case, name)]
        keywords = [one.__doc__.partition("Parameters")[2].partition("Examples")[0] for one in constructors]
        others = ((case.__doc__ or "").partition(name)[2] for name in ("Notes", "Examples"))
        own = len(text.splitlines()) - sum(len(part.splitlines()) for part in (*others, *keywords))
        assert own <= 110, case.__name__
