"""A test run in a loop over its cases, which names all cases that fail."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import pytest


def each(names: str | Sequence[str], cases: Iterable[Any], ids: Callable[[Any], str] | None = None) -> Any:
    """Decorate a test to take its cases in a loop, in place of ``pytest.mark.parametrize``.

    The test is collected once, and every case that fails is a failed subtest of it. This suits checks that
    take milliseconds. Fixtures are made once for all cases, so that a test that changes one (a file in
    ``tmp_path``, an attribute by ``monkeypatch``) must not depend on the case before.

    Parameters
    ----------
    names : str or sequence of str
        Arguments of the test that a case gives, separated by commas.
    cases : iterable
        A value, or a tuple of values where there are several names; also ``pytest.param`` with an id.
    ids : callable, optional
        Text that names a case of one value in a failure; by default its representation.
    """
    keys = [name.strip() for name in names.split(",")] if isinstance(names, str) else list(names)
    rows = [_values(case, len(keys), ids) for case in cases]
    assert rows, "a test without cases cannot fail"

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        fixtures = [one for one in inspect.signature(test).parameters.values() if one.name not in keys]

        def loop(subtests: pytest.Subtests, **made: Any) -> None:
            for text, values in rows:
                with subtests.test(text):
                    arguments = dict(zip(keys, values, strict=True))
                    test(**({"subtests": subtests} if takes_subtests else {}), **made, **arguments)

        takes_subtests = any(one.name == "subtests" for one in fixtures)
        own = inspect.Parameter("subtests", inspect.Parameter.KEYWORD_ONLY)
        others = [one.replace(kind=own.kind) for one in fixtures if one.name != "subtests"]
        loop.__signature__ = inspect.Signature([own, *others])  # type: ignore[attr-defined]
        loop.__name__, loop.__doc__, loop.__module__ = test.__name__, test.__doc__, test.__module__
        loop.pytestmark = list(getattr(test, "pytestmark", []))  # type: ignore[attr-defined]
        return loop

    return decorate


def _values(case: Any, count: int, ids: Callable[[Any], str] | None) -> tuple[str, Sequence[Any]]:
    """Name and values of a case."""
    if isinstance(case, type(pytest.param())):
        assert not case.marks, "a case of a loop has no marks of its own"
        values = case.values
        return case.id or repr(values), values
    values = (case,) if count == 1 else tuple(case)
    return (ids(case) if ids else ", ".join(map(_short, values))), values


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:40]} ... {text[-16:]}"
