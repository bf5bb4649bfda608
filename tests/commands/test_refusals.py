"""Wrong input files: the command names the key and says what it got and takes, in one line, with status 2.

A file of ``tests/data/refusals`` has one right input or several, and what each refusal changes in them.

``base``
    The right input; a list where each refusal is that of several inputs.
``refused``
    Groups of refusals, each of which sets and drops dotted keys of the base. A table in a list is named by
    its number, from 1; the number after the last one adds a table. The message begins with ``key``,
    by default the first that is set or else dropped, and has all of ``names``: what was found, and what is
    allowed.
"""

import re
import tomllib
from copy import deepcopy

import pytest
import tomli_w
from click.testing import CliRunner
from typer.main import get_command

from ehlectric.commands.command_line import app
from tests.helpers.places import ROOT

# Making the command takes longer than a refusal does.
COMMAND = get_command(app)
FILES = sorted((ROOT / "tests" / "data" / "refusals").glob("*.toml"))


def changed(base, entry):
    """The base with the keys of ``set`` set and those of ``drop`` dropped; both are dotted."""
    table = deepcopy(base)
    for key in entry.get("drop", ()):
        *tables, last = key.split(".")
        target = inner(table, tables)
        del target[int(last) - 1 if isinstance(target, list) else last]
    for key, value in entry.get("set", {}).items():
        *tables, last = key.split(".")
        target = inner(table, tables)
        if isinstance(target, list):
            target[int(last) - 1 :] = [value, *target[int(last) :]]
        else:
            target[last] = value
    return table


def inner(table, names):
    for name in names:
        table = table[int(name) - 1] if isinstance(table, list) else table.setdefault(name, {})
    return table


def check(path, table):
    path.write_text(tomli_w.dumps(table), encoding="utf-8")
    return CliRunner().invoke(COMMAND, ["check", str(path), "--quiet"])


def has(text, part):
    """Whether a text has a word or number, and not only as part of another one."""
    return re.search(rf"(?<![\w.]){re.escape(part)}(?!\w|\.\w)", text) is not None


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_refusals(file, tmp_path, subtests):
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    entries = [entry for group in data["refused"].values() for entry in group]
    assert len({str(entry) for entry in entries}) == len(entries), "a refusal is there twice"
    path = tmp_path / "input.toml"
    for base in data["base"] if isinstance(data["base"], list) else [data["base"]]:
        done = check(path, base)
        assert (done.exit_code, done.stderr) == (0, "")
        for entry in entries:
            with subtests.test(str(entry)):
                assert set(entry) <= {"set", "drop", "key", "names"}
                done = check(path, changed(base, entry))
                assert done.exit_code == 2
                assert done.stderr.count("\n") == 1
                message = done.stderr.partition(str(path))[2].lstrip(": ") or done.stderr.removeprefix(
                    "error: "
                )
                key = entry.get("key") or next(iter(entry.get("set") or entry["drop"]))
                assert message.startswith((f"{key}: ", f"{key}, "))
                rest = message.removeprefix(key)
                assert [part for part in entry.get("names", ()) if not has(rest, part)] == [], message
                # Nothing is hidden, and a mistake of the drive end is not told of the other end, too.
                assert "more)" not in message
                assert "non_drive_end" not in message
                assert len(message) < 500
