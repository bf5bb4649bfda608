"""Films of laws that are capped at the glass transition: the film does not notice where the cap is."""

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.lubricant import doolittle
from tests.conftest import PAPER_CONTACT
from tests.lubricant.oils import DOOLITTLE, TAIT, YASUTOMI


def solved(law, temperature, **oil):
    lubricant = {"viscosity_law": law, "density_law": "tait", "relative_permittivity": 2.2, **TAIT, **oil}
    contact = PAPER_CONTACT | {"load_per_length": "1 MN/m", "temperature": temperature}
    case = Case.from_dict({"contact": contact, "lubricant": lubricant, "grid": {"nodes": 1601}})
    return solve(case, require_convergence=True)


def capped_at(result):
    """Pressure at which the law begins to be capped, from the warning [Pa]."""
    (text,) = [warning.text for warning in result.warnings if warning.code == "law-range"]
    return 1e9 * float(text.split("above ")[1].split(" GPa")[0])


def test_films_under_a_capped_law_converge_and_do_not_depend_on_the_cap(monkeypatch):
    """The viscosity is held at 1e12 Pa s, and then at 1e9 Pa s, within the pressures of the contact."""
    result = solved("doolittle", "30 degC", **DOOLITTLE)
    assert result.film.max_pressure > 1.1 * capped_at(result)
    monkeypatch.setattr(doolittle, "GLASS_VISCOSITY", 1e9)
    lower = solved("doolittle", "30 degC", **DOOLITTLE)
    assert capped_at(lower) < 0.9 * capped_at(result)
    np.testing.assert_allclose(lower.film.thickness, result.film.thickness, rtol=1e-3)


def test_film_of_yasutomi_above_its_glass_transition():
    result = solved("yasutomi", "25 degC", **YASUTOMI)
    assert result.film.max_pressure > capped_at(result) == pytest.approx(1.08e9)
