"""Each input that a file accepts changes a number of the answer, or the program names it as not used."""

import sys, time
import pytest

from ehlectric.errors import InputError
from tests.helpers.full_cases import CASES
from tests.helpers.input_effects import MODELS, Answer, first_difference, si_values
from tests.helpers.input_keys import choices_of, key_at, keys_of, others, values_in, with_value

# Other values of keys by their last names, where a tenth more is too little or is no value. If the program refuses
# one of them and names the key, the key acts.
VALUES = {
    "base": ("fva-3", "iso-vg-46", "e-axle-fluid", "6209", "nu-209", "7208-b", "NK 25/20", "32209", "51209", "AXK 5070", "QJ 209", "HK 2520", "porcelain"),
    "viscosity_law": ("barus", "roelands", "modulus", "constant"),
    "density_law": ("incompressible", "dowson-higginson"),
    "permittivity_law": ("constant",),
    "conductivity_law": ("constant", "arrhenius"),
    "heat_capacity_law": ("constant", "larsson"),
    "thermal_conductivity_law": ("constant",),
    "atmospheric_law": ("vogel", "roelands"),
    "iso_vg": (68,),
    "generator": ("sinusoid", "pit", "asperity", "gaussian"),
    "x_unit": ("nm", "mm"),
    "z_unit": ("um",),
    "material": ("silicon-nitride", "steel", "alumina"),
    "element_material": ("silicon-nitride", "steel"),
    "error": (0.05,), "refine": (0.05,), "most_nodes": (801,), "tolerance": (1e-4, 1e-10), "max_iterations": (1,), "temperature_range": ("70 degC", "20 degC"),
}

# Keys without an effect on the answer, by kind, each with the reason.
EXCEPTIONS = {"title": "a text", "contact.geometry": "line and point contacts are different kinds here"}


def changes_of(kind, tables, path, value, folder):
    """Answers to other values of a key, or the reasons why they are refused."""
    annotation = keys_of(MODELS[kind]).get(key_at(path))
    leaf = key_at(path).rpartition(".")[2]
    explicit = VALUES.get(leaf, ())
    for other in (*explicit, *others(path, value, choices_of(annotation))):
        if other == value: continue
        try:
            yield Answer(kind, with_value(tables, path, other), folder)
        except InputError as error:
            yield f"refused {other!r}: {error}" if other not in explicit else f"{other!r}: {error}"


def effect_of(kind, tables, path, value, answer, folder):
    """Why a key acts, with a mark; or why it does not."""
    key, reasons = key_at(path), ["no other value"]
    tried = 0
    for other in changes_of(kind, tables, path, value, folder):
        if isinstance(other, str):
            if not other.startswith("refused") and (f": {key}: " not in other or "temperature_range" in key): return True, "refused"
            reasons.append(other)
            continue
        before, after = si_values(answer.case), si_values(other.case)
        given = [(before.get(k), after.get(k)) for k in before.keys() | after.keys() if before.get(k) != after.get(k)]
        found = first_difference(answer, other, given)
        if found: return True, found
        if other.named(key): return True, "named"
        reasons.append("no effect")
        tried += 1
        if tried > len(VALUES.get(key.rpartition(".")[2], ())):
            break
    return False, reasons[-1]


def walk(kind, folder):
    """Keys that act, and the first failure of keys that do not."""
    acting, failing = {}, {}
    for number, tables in enumerate(CASES[kind]):
        answer = None
        print(number, time.process_time(), file=sys.stderr)
        for path, value in values_in(tables):
            key = key_at(path)
            place = (key, path[-1]) if isinstance(path[-1], int) else (key, None)
            if place in acting or key in EXCEPTIONS or key.startswith('non_drive_end.'):
                continue
            try:
                answer = answer or Answer(kind, tables, folder)
            except InputError as error:
                print("SKIP", number, error)
                break
            if "error" in answer.stage(0):
                print("SKIP", number, answer.stage(0))
                break
            t0 = time.process_time()
            acts, reason = effect_of(kind, tables, path, value, answer, folder)
            if time.process_time() - t0 > 1: print('   ', path, acts, reason, round(time.process_time() - t0, 1), file=sys.stderr)
            if acts:
                acting[place] = reason
                failing.pop(place, None)
            else:
                failing[place] = f"case {number}: {reason}"
    return acting, failing


@pytest.mark.slow
@pytest.mark.parametrize("kind", CASES)
def test_every_input_acts(kind, tmp_path):
    acting, failing = walk(kind, tmp_path)
    keys = {key for key, _ in (*acting, *failing)}
    print(kind, len(keys), "missing", sorted(set(keys_of(MODELS[kind])) - keys))
    assert not failing, "\n".join(f"{key}: {text}" for key, text in failing.items())
