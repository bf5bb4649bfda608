"""Each input that a file accepts changes a number of the answer, or the program names it as not used."""

import pytest

from ehlectric.errors import InputError
from tests.helpers.full_cases import CASES
from tests.helpers.input_effects import MODELS, Answer, first_difference, si_values
from tests.helpers.input_keys import choices_of, key_at, keys_of, others, values_in, with_value

# Other values of texts that the types of the keys do not list, by the last name of a key.
TEXTS = {
}

# Keys without an effect on the answer, by kind, each with the reason.
EXCEPTIONS = {"title": "a text"}


def changes_of(kind, tables, path, value, answer, folder):
    annotation = keys_of(MODELS[kind]).get(key_at(path))
    choices = (*choices_of(annotation), *TEXTS.get(str(path[-1]), ()))
    reason = "no other value"
    for other in others(path, value, choices):
        try:
            return Answer(kind, with_value(tables, path, other), folder)
        except InputError as error:
            reason = str(error)
    return reason


def walk(kind, folder):
    """Keys that act, and the first failure of keys that do not."""
    acting, failing, answers = set(), {}, {}
    for number, tables in enumerate(CASES[kind]):
        answer = None
        for path, value in values_in(tables):
            key = key_at(path)
            place = (key, path[-1]) if isinstance(path[-1], int) else (key, None)
            if place in acting or path in answers.get((repr(value), path), ()):
                continue
            if (path, repr(value)) in answers and number > 0 and False:
                continue
            answer = answer or Answer(kind, tables, folder)
            other = changes_of(kind, tables, path, value, answer, folder)
            if isinstance(other, str):
                failing.setdefault(place, f"case {number}: {other}")
                continue
            before, after = si_values(answer.case), si_values(other.case)
            given = [(before.get(k), after.get(k)) for k in before.keys() | after.keys() if before.get(k) != after.get(k)]
            effect = first_difference(answer, other, given)
            if effect:
                acting.add(place)
                failing.pop(place, None)
            elif other.named(key):
                acting.add(place)
                failing.pop(place, None)
            else:
                failing[place] = f"case {number}: no effect"
    return acting, failing


@pytest.mark.slow
@pytest.mark.parametrize("kind", CASES)
def test_every_input_acts(kind, tmp_path):
    acting, failing = walk(kind, tmp_path)
    keys = {key for key, _ in (*acting, *failing)}
    print(kind, len(keys), "missing", sorted(set(keys_of(MODELS[kind])) - keys))
    assert not failing, "\n".join(f"{key}: {text}" for key, text in failing.items())
