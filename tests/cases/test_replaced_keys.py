"""Inputs of a case that laws of a user's own replace: other values are refused wherever they are given."""

import numpy as np
import pytest

from ehlectric import Case, InputError, Laws, Sweep, run_sweep
from ehlectric.cases.case import check_changes
from ehlectric.cases.oil_inputs import LAWS
from ehlectric.cases.table_edits import flattened

CONTACT = {"reduced_radius": "12.7 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "0.8 GPa"}
CONTACT |= {"entrainment_speed": "2 m/s", "temperature": "40 degC"}


def visc(pressure, temperature):
    return 0.04 * np.exp(2e-8 * pressure - 0.03 * (temperature - 313.15))


def dens(pressure, temperature):
    return (850.0 - 0.6 * (temperature - 313.15)) * (1.0 + 0.2 * pressure / (pressure + 1e9))


def perm(pressure, _temperature):
    return 2.2 + 0.1 * pressure / 1e9


def strong(pressure, _temperature):
    return 15e6 * (1.0 + pressure / 2e9)


FUNCTIONS = {"viscosity": visc, "density": dens, "permittivity": perm, "strength": strong}
SHEET = {"iso_vg": 46, "viscosity_index": 95, "density_15": 870.0, "base_oil": "mineral-paraffinic"}
TAIT = {"tait_k0_prime": 10.5, "tait_k00": 9e9, "tait_beta_k": 6e-3, "tait_expansion": 8e-4}
WEIBULL = {"shape": 10.0, "scale": "20 V/um", "reference_area": "1 mm^2"}
HEATS = {"thermal_conductivity": 0.14, "heat_capacity": 2000.0}
SCALING = {"heat_capacity_law": "scaling", "scaling_c_base": 2e6, "scaling_c_factor": 1e6}
SCALING |= {"scaling_c_exponent": 2.0}
OILS = {
    "plain": {"base": "paper", "density": 860.0, **HEATS},
    "vogel": {
        "base": "paper",
        "atmospheric_law": "vogel",
        "vogel_viscosity": 6.2e-5,
        "vogel_b": 1000.0,
        "vogel_c": 155.0,
        "pressure_viscosity_coefficient": 2e-8,
    },
    "sheet": {"base": "paper", "temperature": SHEET, **HEATS},
    "expanding": {
        "base": "paper",
        "density": 860.0,
        "thermal_expansion": 7e-4,
        "reference_temperature": 288.15,
        **HEATS,
    },
    "tait": {
        "base": "paper",
        "density": 860.0,
        "density_law": "tait",
        "reference_temperature": 288.15,
        **TAIT,
        **HEATS,
    },
    "tait in the heat": {
        "base": "paper",
        "density": 860.0,
        "reference_temperature": 288.15,
        "thermal_conductivity": 0.14,
        **SCALING,
        **TAIT,
    },
}


def laws_of(*names):
    return Laws(**{name: FUNCTIONS[name] for name in names})


def case(oil="plain", *names, **tables):
    return Case.line(**CONTACT, lubricant=OILS[oil], grid={"nodes": 401}, laws=laws_of(*names), **tables)


def test_a_value_that_an_own_law_replaces_is_refused():
    """The film of the function does not depend on the viscosity, so that no other viscosity is accepted."""
    own = case("plain", "viscosity")
    for changes in (
        {"lubricant.viscosity": "0.1 Pa s"},
        {"lubricant.viscosity_law": "barus"},
        {"lubricant.temperature": SHEET | {"density_15": 860.0}},
    ):
        key = next(iter(flattened(changes)))
        with pytest.raises(InputError, match=rf"^{key}: .*visc \(Python function\).*viscosity.*laws"):
            own.replace(changes)
    with pytest.raises(InputError, match=r"^lubricant\.viscosity: "):
        own.replace(lubricant={"viscosity": 0.1})
    with pytest.raises(InputError, match=r"^lubricant\.viscosity: "):
        own.replace(lubricant={"base": "fva-3", "viscosity": 0.1})
    with pytest.raises(InputError, match=r"^lubricant\.viscosity: "):
        case().replace({"lubricant.viscosity": 0.1}, laws=laws_of("viscosity"))


def test_an_equal_value_is_accepted():
    own, viscosity = case("plain", "viscosity"), case().lubricant.viscosity
    assert own.replace({"lubricant.viscosity": f"{viscosity!r} Pa s"}) == own
    assert own.replace({"lubricant": own.replace(laws=None).to_dict()["lubricant"]}) == own


def test_other_values_are_accepted():
    own = case("plain", "viscosity")
    assert own.replace({"contact.temperature": "60 degC"}).oil.viscosity == pytest.approx(visc(0.0, 333.15))
    assert own.replace({"lubricant.density": 900.0}).oil.density == 900.0
    without = own.replace({"lubricant.viscosity": 0.1}, laws=None)
    assert without.oil.viscosity == 0.1


@pytest.mark.parametrize("name", ["viscosity", "density", "permittivity"])
def test_another_oil_is_refused_if_an_own_law_replaces_its_property(name, tmp_path):
    """fva-3 has another viscosity, density and permittivity, which would not be used."""
    own, match = case("plain", name), rf"^(vary\.)?lubricant\.base: .*{name}.*replace\(lubricant=.*laws=Laws"
    for change in ({"lubricant": "fva-3"}, {"lubricant": {"base": "fva-3"}}):
        with pytest.raises(InputError, match=match):
            own.replace(**change)
    with pytest.raises(InputError, match=match):
        own.replace({"lubricant.base": "fva-3", "contact.entrainment_speed": 3.0})
    for vary in ({"lubricant.base": ["paper", "fva-3"]}, {"lubricant": ["paper", "fva-3"]}):
        with pytest.raises(InputError, match=match):
            Sweep.from_dict(sweep_of(own, vary))
        sweep = Sweep.from_dict(sweep_of(case(), vary))
        with pytest.raises(InputError, match=match):
            run_sweep(sweep, tmp_path / "sweep", workers=1, laws=laws_of(name))


def test_another_oil_is_accepted_without_effect_on_own_laws_or_with_new_laws():
    own = case("plain", "viscosity")
    assert own.replace(lubricant="fva-3", laws=None).user_laws is None
    new = own.replace(lubricant="fva-3", laws=laws_of("viscosity"))
    assert new.lubricant.base == "fva-3"
    assert new.oil.viscosity == visc(0.0, 313.15)
    strength = case("plain", "strength", discharge={"length": "10 mm"})
    assert strength.replace(lubricant="fva-3").lubricant.base == "fva-3"
    paper = Case.line(**CONTACT, lubricant="paper", grid={"nodes": 401}, laws=laws_of("viscosity"))
    assert paper.replace(lubricant="paper") == paper


@pytest.mark.parametrize(
    "changes",
    [
        {"discharge.dielectric_strength": "20 V/um"},
        {"discharge.weibull": WEIBULL},
        {"discharge.strength_table": {"pressure": [0.0, 1e9], "strength": [1e7, 2e7]}},
    ],
)
def test_a_strength_that_an_own_law_replaces_is_refused(changes):
    own = case("plain", "strength", discharge={"dielectric_strength": "15 V/um", "length": "10 mm"})
    assert own.replace({"discharge.dielectric_strength": 15e6}) == own
    assert own.replace({"discharge.conductivity": 1e-10}).discharge.conductivity == 1e-10
    with pytest.raises(InputError, match=r"^discharge\..*strong \(Python function\)"):
        own.replace(changes)


def sweep_of(base, vary, **tables):
    return {"case": base, "vary": vary, **tables}


@pytest.mark.parametrize(
    ("vary", "tables"),
    [
        ({"lubricant.viscosity": ["20 mPa s", "100 mPa s"]}, {}),
        ({"lubricant.viscosity": [0.02, 0.1], "contact.entrainment_speed": [1.0, 2.0]}, {"design": "paired"}),
        ({"lubricant.viscosity": {"from": 0.02, "to": 0.1}}, {"design": "sobol", "samples": 4}),
        ({"lubricant.viscosity_law": ["roelands", "barus"]}, {}),
    ],
)
def test_a_sweep_over_a_replaced_value_is_refused_before_it_is_solved(vary, tables, tmp_path):
    match = r"^(vary\.)?lubricant\.viscosity(_law)?: .*visc \(Python function\)"
    with pytest.raises(InputError, match=match):
        Sweep.from_dict(sweep_of(case("plain", "viscosity"), vary, **tables))
    sweep = Sweep.from_dict(sweep_of(case(), vary, **tables))
    with pytest.raises(InputError, match=match):
        run_sweep(sweep, tmp_path / "sweep", workers=1, laws=laws_of("viscosity"))
    assert not (tmp_path / "sweep").exists()


def test_a_sweep_over_other_values_is_accepted():
    for key, values in {
        "contact.temperature": ["40 degC", "60 degC"],
        "lubricant.viscosity": [case().lubricant.viscosity],
    }.items():
        assert Sweep.from_dict(sweep_of(case("plain", "viscosity"), {key: values})).size == len(values)


def numbers(lubricant, own, temperature):
    """All numbers of an oil with own laws on which films and fields depend."""
    oil = Case.line(
        **(CONTACT | {"temperature": temperature}),
        lubricant=lubricant,
        grid={"nodes": 401},
        laws=laws_of(*own),
    ).oil
    pressure = np.array([0.0, 0.1e9, 0.5e9, 0.8e9])
    density = oil.density_ratio(pressure)[0]
    laws = (oil.log_viscosity, oil.thermal_conductivity_law, oil.heat_capacity_law)
    found = [law(pressure)[0] for law in laws if law is not None]
    at_zero = [oil.viscosity, oil.density or 0.0, oil.relative_permittivity]
    return np.concatenate([at_zero, density, oil.permittivity(pressure, density), *found])


OWN = [(), ("viscosity",), ("density",), ("permittivity",), ("viscosity", "density")]
OWN += [("density", "permittivity"), ("viscosity", "density", "permittivity")]


@pytest.mark.parametrize("own", OWN, ids="-".join)
@pytest.mark.parametrize("name", OILS)
def test_the_refused_keys_are_those_without_effect(name, own):
    """A number that changes the oil of the library is accepted if it also changes the oil with own laws."""
    table = case(name).to_dict()["lubricant"]
    base = case(name, *own)
    for key, value in flattened(table).items():
        if not isinstance(value, float):
            continue
        changed = base.lubricant.model_dump(mode="json", exclude_none=True)
        *parents, leaf = key.split(".")
        (changed[parents[0]] if parents else changed)[leaf] = value * 1.01

        def effect(some, changed=changed):
            return any(
                not np.array_equal(numbers(table, some, at), numbers(changed, some, at))
                for at in (300.0, 360.0)
            )

        if not effect(()):
            continue
        try:
            check_changes(base, {f"lubricant.{key}": (value * 1.01,)})
            accepted = True
        except InputError:
            accepted = False
        assert accepted == effect(own), key


def test_every_law_of_a_replaced_property_is_refused():
    """Also laws that the oil does not have, and their parameters."""
    own = case("plain", "viscosity")
    for choice in ("atmospheric_law", "viscosity_law"):
        for law in LAWS[choice].values():
            for parameter in law.parameters:
                with pytest.raises(InputError, match=rf"^lubricant\.{parameter.name}: "):
                    check_changes(own, {f"lubricant.{parameter.name}": (1.0,)})
