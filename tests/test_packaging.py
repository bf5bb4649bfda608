"""Files for packages and citations say the same as pyproject.toml; the packages hold all that is needed."""

import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import PurePosixPath

import pytest
import yaml

from ehlectric.version import __version__
from tests.helpers.places import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
_BOUND = re.compile(r"([A-Za-z0-9_.-]+) *(>=.*)?")


def bounds(requirements):
    """Lower bounds by the names of packages."""
    return dict(_BOUND.fullmatch(text).groups() for text in requirements)


def pins(name):
    """Versions by the names of packages, of a file of requirements; several of one name are a set."""
    found = {}
    for line in (ROOT / name).read_text(encoding="utf-8").splitlines():
        if match := re.match(r"([a-z0-9-]+)==([^ ;\\]+)", line):
            found.setdefault(match[1], set()).add(match[2])
    return found


def test_the_recipe_of_conda_has_the_dependencies_of_the_project():
    recipe = yaml.safe_load((ROOT / "packaging/conda/recipe.yaml").read_text(encoding="utf-8"))
    assert recipe["context"]["version"] == __version__
    run = bounds(recipe["requirements"]["run"])
    assert run.pop("python") == PROJECT["requires-python"]
    # The package without the windows of Qt.
    run["matplotlib"] = run.pop("matplotlib-base")
    assert run == bounds(PROJECT["dependencies"])


def test_the_citation_is_that_of_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == __version__
    assert citation["license"] == PROJECT["license"]
    assert {"cff-version", "message", "title", "authors"} <= citation.keys()


def test_hashes_are_of_the_locked_versions():
    """Each package has hashes of its files, and a version of the lock."""
    locked, hashed = pins("requirements.lock"), pins("requirements.hashes")
    assert len(hashed) > 60
    assert {
        name: versions for name, versions in hashed.items() if not versions <= locked.get(name, set())
    } == {}
    text = (ROOT / "requirements.hashes").read_text(encoding="utf-8")
    blocks = re.split(r"^(?=[a-z0-9-]+==)", text, flags=re.MULTILINE)[1:]
    assert all("--hash=sha256:" in block for block in blocks)
    # What users install is among them.
    names = (re.match(r"[A-Za-z0-9_-]+", text)[0] for text in PROJECT["dependencies"])
    needed = {name.lower().replace("_", "-") for name in names}
    assert needed <= hashed.keys()


def test_forms_and_workflows_are_yaml():
    files = sorted((ROOT / ".github").rglob("*.yml"))
    assert len(files) >= 5
    for file in files:
        assert isinstance(yaml.safe_load(file.read_text(encoding="utf-8")), dict), file


def test_references_of_the_paper_exist():
    """Every citation has an entry with a DOI, and every entry is cited; sections and length are JOSS's."""
    text = (ROOT / "paper/paper.md").read_text(encoding="utf-8")
    entries = (ROOT / "paper/paper.bib").read_text(encoding="utf-8")
    keys = re.findall(r"^@\w+\{(\w+),", entries, re.MULTILINE)
    assert set(re.findall(r"@(\w+\d{4})", text)) == set(keys)
    assert entries.count("doi = {10.") == len(keys)
    assert 750 < len(text.partition("# Summary")[2].split()) < 1750
    sections = {"Summary", "Statement of need", "State of the field", "Software design"}
    sections |= {"Research impact statement", "AI usage disclosure", "Acknowledgements", "References"}
    assert sections <= set(re.findall(r"^# (.+)$", text, re.MULTILINE))


@pytest.fixture(scope="module")
def packages(tmp_path_factory):
    """Wheel and source distribution of the working tree."""
    folder = tmp_path_factory.mktemp("dist")
    words = [sys.executable, "-m", "hatchling", "build", "--directory", str(folder)]
    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    return folder


def wheel_content(path):
    """Contents of the files of a wheel by name, but those that name or hash others."""
    with zipfile.ZipFile(path) as wheel:
        return {name: wheel.read(name) for name in wheel.namelist() if not name.endswith("RECORD")}


@pytest.mark.slow
def test_the_wheel_holds_the_package_and_the_examples(packages):
    """Every file of the source but caches: static files, tables, schemas, templates, library, surfaces."""
    found = wheel_content(next(packages.glob("*.whl")))
    source = ROOT / "src"
    own = {
        path.relative_to(source).as_posix(): path
        for path in (source / "ehlectric").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    own |= {
        f"ehlectric/runs/{path.relative_to(ROOT).as_posix()}": path
        for path in (ROOT / "examples").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    missing = {name for name, path in own.items() if found.get(name) != path.read_bytes()}
    assert missing == set()


@pytest.mark.slow
def test_the_source_distribution_gives_the_same_wheel(packages, tmp_path):
    with tarfile.open(next(packages.glob("*.tar.gz"))) as source:
        source.extractall(tmp_path, filter="data")
    (folder,) = tmp_path.iterdir()
    names = {PurePosixPath(path.relative_to(folder).as_posix()).parts[0] for path in folder.rglob("*")}
    assert {"src", "tests", "examples", "docs", "CITATION.cff", "requirements.hashes", "Dockerfile"} <= names
    words = [
        sys.executable,
        "-m",
        "hatchling",
        "build",
        "--target",
        "wheel",
        "--directory",
        str(tmp_path / "again"),
    ]
    subprocess.run(words, cwd=folder, check=True, capture_output=True)
    first, second = (wheel_content(next(place.glob("*.whl"))) for place in (packages, tmp_path / "again"))
    assert first == second


@pytest.mark.slow
def test_the_wheel_works_outside_of_the_repository(packages, tmp_path):
    """Command, examples with their surfaces, the library and the app come from the wheel alone."""
    with zipfile.ZipFile(next(packages.glob("*.whl"))) as wheel:
        wheel.extractall(tmp_path / "site")
    (tmp_path / "folder").mkdir()

    def typed(*words):
        done = subprocess.run(
            [sys.executable, "-P", "-m", "ehlectric", *words],
            cwd=tmp_path / "folder",
            env={"PYTHONPATH": str(tmp_path / "site"), "PATH": "/usr/bin:/bin", "HOME": str(tmp_path)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert typed("--version") == f"ehlectric {__version__}\n"
    typed("examples", "rough_contact")
    typed("check", "rough_contact.toml")
    typed("init", "bearing.toml", "--kind", "bearing")
    assert "margin" in typed("bearing", "bearing.toml", "--contacts", "atlas", "-o", "out", "--no-plots")
    typed("report", "out")
    place = subprocess.run(
        [sys.executable, "-P", "-c", "import ehlectric.app.start as app; print(app.__file__)"],
        env={"PYTHONPATH": str(tmp_path / "site")}, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert place.startswith(str(tmp_path / "site"))
