"""First uses by several threads at once: imports that are not complete, and values that a thread keeps."""

import subprocess
import sys
import threading
import warnings
from types import ModuleType

import numpy as np
import pytest

from ehlectric import BearingCase, example
from ehlectric.cases import oil_inputs
from ehlectric.lubricant.data_sheet import viscosity_at_100
from ehlectric.quantities import units
from ehlectric.runtime.threads import local_filters

_THREADS = """
import sys, threading
sys.setswitchinterval(1e-4)
import ehlectric

case, errors, loads = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208")), [], []
begin = threading.Barrier(12)

def read(load):
    begin.wait()
    try:
        for _ in range(3):
            loads.append(case.replace({"bearing.radial_load": load}).bearing.radial_load)
    except Exception as error:
        errors.append(repr(error))

threads = [threading.Thread(target=read, args=(load,)) for load in 4 * ["400 lbf", "1.8 kN", "0.4 kip"]]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
assert not errors, errors
print(sorted({round(load, 3) for load in loads}), len(loads))
"""


@pytest.mark.slow
@pytest.mark.gate
def test_threads_read_cases_while_one_imports_the_registry_of_units():
    """400 lbf are 1779.289 N, 1.8 kN are 1800 N, and 0.4 kip are 1779.289 N."""
    done = subprocess.run([sys.executable, "-c", _THREADS], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "[1779.289, 1800.0] 36"


def test_an_import_that_is_not_complete_is_no_proof(monkeypatch):
    """While a thread imports pint, ``sys.modules`` contains a module without the class of quantities."""
    monkeypatch.setitem(sys.modules, "pint", ModuleType("pint"))
    case = BearingCase.from_toml(example("bearing_6208"))
    assert case.replace({"bearing.radial_load": "1.8 kN"}).bearing.radial_load == 1800.0
    assert not units.is_pint(1.0)


@pytest.mark.slow
def test_quantities_of_any_registry_are_known():
    from pint import UnitRegistry

    other = UnitRegistry()

    class Own(other.Quantity):
        pass

    assert units.is_pint(other.Quantity(1.0, "kN"))
    assert units.is_pint(Own(1.0, "kN"))
    assert not units.is_pint(other)


def test_a_thread_gets_its_own_viscosity(monkeypatch):
    """Another thread replaces the kept value between the comparison and the return."""
    at_40, index, other = np.array([46e-6, 68e-6]), np.array([95.0, 95.0]), np.array([1.0, 2.0])
    expected = viscosity_at_100(at_40, index)
    oil_inputs._latest[:] = [(at_40, index, expected)]

    def same(one, two):
        if two is index:
            oil_inputs._latest[:] = [(other, other, other)]
        return one is two

    monkeypatch.setattr(oil_inputs, "same", same)
    np.testing.assert_array_equal(oil_inputs._of_index(at_40, index), expected)


def test_filters_of_warnings_are_those_of_before():
    """Two overlapping contexts end in the order in which they began."""
    before, inside, leave = list(warnings.filters), threading.Event(), threading.Event()

    def first():
        with local_filters():
            warnings.simplefilter("ignore")
            inside.set()
            leave.wait(10)

    def second():
        inside.wait(10)
        with local_filters():
            warnings.simplefilter("ignore")

    threads = [threading.Thread(target=each) for each in (first, second)]
    for thread in threads:
        thread.start()
    inside.wait(10)
    leave.set()
    for thread in threads:
        thread.join(10)
    assert warnings.filters == before
