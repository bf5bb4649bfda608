"""Benchmarks and the scripts of the documentation are run by hand: what they import is there all the same."""

import ast
import importlib

from tests.helpers.each import each
from tests.helpers.places import ROOT

NAMES = sorted(path.stem for path in (ROOT / "benchmarks").glob("*.py"))
SCRIPTS = sorted(
    path.relative_to(ROOT).as_posix()
    for folder in ("docs/gallery", "docs/_ext")
    for path in (ROOT / folder).rglob("*.py")
)


@each("name", NAMES)
def test_a_benchmark_is_imported(name):
    assert importlib.import_module(f"benchmarks.{name}").__doc__ or name == "__init__"


@each("script", SCRIPTS)
def test_names_that_a_script_of_the_documentation_imports_exist(script):
    for node in ast.walk(ast.parse((ROOT / script).read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("ehlectric"):
            module = importlib.import_module(node.module)
            for name in (alias.name for alias in node.names):
                assert hasattr(module, name) or importlib.import_module(f"{node.module}.{name}"), name
