"""Texts of warnings in warning_texts.toml: warnings and their flags give the values that the texts name."""

import ast
import string
import tomllib
from pathlib import Path

import pytest

import ehlectric
from ehlectric.quantities.result_warnings import CODES
from tests.unit.test_warnings import FOREIGN

SOURCE = Path(ehlectric.__file__).parent


def texts():
    """Names of the values in each text, by code and situation."""
    read = tomllib.loads((SOURCE / "quantities" / "warning_texts.toml").read_text("utf-8"))
    for code, entry in read.items():
        for situation, text in entry.items() if isinstance(entry, dict) else [("", entry)]:
            yield (code, situation), {name for _, name, _, _ in string.Formatter().parse(text) if name}


def calls_of(function):
    """File and call of each call of a function, without the file that defines warnings."""
    for path in sorted(set(SOURCE.rglob("*.py")) - {SOURCE / "quantities" / "result_warnings.py"}):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == function:
                yield path.relative_to(SOURCE).as_posix(), node


def calls():
    """Code and situation, None where they are computed, and names of the values of each call."""
    given = [(file, node, node.args) for file, node in calls_of("ResultWarning.of")]
    # The first argument of a flag is its condition.
    given += [(file, node, node.args[1:]) for file, node in calls_of("Flag.of")]
    for file, node, arguments in given:
        keys = [each.value if isinstance(each, ast.Constant) else None for each in arguments]
        code, situation = (*keys, "")[:2]
        yield file, (code, situation), {each.arg for each in node.keywords}


@pytest.mark.slow
def test_every_warning_has_the_values_of_its_text():
    known, used = dict(texts()), set()
    for file, key, names in calls():
        # Values in a dict cannot be compared.
        assert None not in names, (file, key)
        fitting = {
            text
            for text in known
            if all(wanted in (None, part) for wanted, part in zip(key, text, strict=True))
            and known[text] <= names
        }
        assert fitting, (file, key, names)
        assert names <= set().union(*(known[text] for text in fitting)), (file, key)
        used |= fitting
    assert used == set(known)


def test_every_code_has_its_text():
    """All but the codes that only files of later versions give."""
    assert {code for code, _ in dict(texts())} == set(CODES) - FOREIGN


@pytest.mark.slow
def test_no_text_is_written_where_a_warning_is_given():
    """Only a warning that was made before is made again, with its place in front of its text."""
    given = {ast.unparse(node.args[0]) for file, node in calls_of("ResultWarning")}
    assert given == {"warning.code"}
