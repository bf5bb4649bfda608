"""Grids that fit, and grids that do not."""

import pytest

from ehlectric import InputError
from ehlectric.memory import check_memory, physical_memory


def test_grids_that_do_not_fit_into_memory(monkeypatch, paper_case):
    monkeypatch.setattr("ehlectric.memory.physical_memory", lambda: 1e9)
    check_memory(paper_case)
    with pytest.raises(InputError, match=r"grid\.nodes: got 5000001 .* GB; takes a grid .* 1 GB"):
        check_memory(paper_case.replace({"grid.nodes": 5_000_001}))
    with pytest.raises(InputError, match=r"grid\.field_nodes: got 1000001 with field_degree 8"):
        check_memory(paper_case.replace({"grid.field_nodes": 1_000_001, "grid.field_degree": 8}))


def test_machine_has_memory():
    assert physical_memory() > 1e8
