"""Wrong input files: the command names the key and says what it got and takes, in one line, with status 2.

``tests/data/refusals`` holds the files: a base that is right, and what each refusal changes in it.
"""

import tomllib
from copy import deepcopy

import pytest
import tomli_w
from typer.testing import CliRunner

from ehlectric.commands.app import app
from tests.helpers.places import ROOT

FILES = sorted((ROOT / "tests" / "data" / "refusals").glob("*.toml"))


def changed(base, entry):
    """The base with the keys of ``set`` set and those of ``drop`` dropped; both are dotted."""
    table = deepcopy(base)
    for key in entry.get("drop", ()):
        *tables, last = key.split(".")
        del inner(table, tables)[last]
    for key, value in entry.get("set", {}).items():
        *tables, last = key.split(".")
        inner(table, tables)[last] = value
    return table


def inner(table, names):
    for name in names:
        table = table.setdefault(name, {})
    return table


def check(path, table):
    path.write_text(tomli_w.dumps(table), encoding="utf-8")
    return CliRunner().invoke(app, ["check", str(path), "--quiet"])


@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_refusals(file, tmp_path, subtests):
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    path = tmp_path / "input.toml"
    assert check(path, data["base"]).exit_code == 0
    for entry in data["refused"]:
        with subtests.test(str(entry)):
            done = check(path, changed(data["base"], entry))
            assert done.exit_code == entry["status"]
            assert done.stderr.count("\n") == 1
            message = done.stderr.partition(str(path))[2].lstrip(": ") or done.stderr.removeprefix("error: ")
            assert message.startswith(entry["key"])
            assert [part for part in entry.get("names", ()) if part not in message] == []
            assert len(message) < 500
