"""Properties of elements: texts of them hold names of the program only, never a text of a user.

The framework splits such a text into properties, and the browser runs those whose names begin with a colon.
Any other text is set as an item of ``props``.
"""

import ast
from pathlib import Path

import pytest

import ehlectric.app.pages

PAGES = Path(ehlectric.app.pages.__file__).parent

# Expressions whose values are names of the program, numbers, or one of a few words.
OWN = {
    "name",
    "name.replace('.', '-')",
    "test",
    "testid",
    "test_id",
    "label",
    "keys",
    "unit",
    "ends[0]",
    "look",
    "ends[1]",
    "prefix",
    "one.key",
    "shown.name",
    "level",
    "verdict.level",
    "answer.contacts",
    "str(answer.whole).lower()",
    "str(answer.solved).lower()",
    "str(name == chosen).lower()",
    "number.key",
    "str(dimmed).lower()",
    "'true' if wrong else 'false'",
    "len(answer.times) - 1",
    "job.done / job.of",
}


def inserted():
    """Expressions in texts of properties, with their places."""
    for path in sorted(PAGES.rglob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute)):
                continue
            if call.func.attr != "props":
                continue
            for argument in [*call.args, *(keyword.value for keyword in call.keywords)]:
                for part in ast.walk(argument):
                    if isinstance(part, ast.FormattedValue):
                        yield f"{path.name}:{call.lineno}", ast.unparse(part.value)
                    elif isinstance(part, ast.BinOp | ast.Name) and part is argument:
                        yield f"{path.name}:{call.lineno}", ast.unparse(part)


@pytest.mark.slow
def test_properties_hold_no_text_of_a_user():
    found = list(inserted())
    assert len(found) > 10
    assert [place for place in found if place[1] not in OWN] == []
