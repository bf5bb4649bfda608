"""Each input that a file accepts changes the answer, or the program names it as not used."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from ehlectric.drive import drive_cycle
from ehlectric.errors import InputError
from tests.helpers.full_cases import KINDS, cases_of, new_values, refused_of
from tests.helpers.input_effects import MODELS, Answer, first_difference, solving_once
from tests.helpers.input_keys import choices_of, key_at, keys_of, others, values_in, with_value

# Other values of keys by their last names: of texts, and of numbers of which a tenth more is too little.
VALUES: dict[str, tuple[Any, ...]] = {
    "between": ("rotor", "wheel"),
    "atmospheric_law": ("vogel", "roelands"),
    "base": (
        *("fva-3", "iso-vg-46", "skf-insocoat-vl0241"),
        *("6209", "nu-209", "7208-b", "NK 25/20", "32209", "51209", "AXK 5070", "QJ 209", "HK 2520"),
    ),
    "column": (2, "u_cm"),
    "common_mode_column": ("u_shaft",),
    "breakdown_voltage": ("1 V",),
    "conductivity_law": ("constant", "arrhenius"),
    "contacts": ("formula", "atlas"),
    "density_law": ("incompressible", "dowson-higginson"),
    "designation": ("6209 C3",),
    "element_material": ("silicon-nitride", "steel"),
    "error": (0.05,),
    "gears": ("wheel", "output"),
    "generator": ("sinusoid", "pit", "asperity", "gaussian"),
    "heat_capacity_law": ("constant", "larsson"),
    "housing_material": ("aluminium",),
    "iso_vg": (68,),
    "material": ("aluminium", "steel", None),
    "max_iterations": (1,),
    "most_nodes": (801,),
    "name": ("rear",),
    "permittivity_law": ("constant",),
    "refine": (0.05,),
    "ring_material": ("silicon-nitride",),
    "shaft": ("rotor",),
    "shaft_material": ("aluminium",),
    "temperature_range": ("70 degC", "20 degC"),
    "thermal_conductivity_law": ("constant",),
    "strength": ("20 V/mm",),
    "threshold": ("6 V",),
    "time_unit": ("ms",),
    "tolerance": (1e-11,),
    "uncertainty_samples": (128,),
    "value_unit": ("mV",),
    "viscosity_law": ("barus", "roelands", "modulus", "constant"),
    "x_unit": ("nm", "mm"),
    "z_unit": ("um",),
}

# Keys without an effect on the answer: ends of their names, kinds of files, and the reason.
EXCEPTIONS: tuple[tuple[str, tuple[str, ...], str], ...] = (
    ("title", KINDS, "a text of tables and figures"),
    ("roughness.direction", ("line", "motion"), "`y` is used as `x` if assume_transverse agrees, or refused"),
    (
        "pair.arrangement",
        ("bearing", "drive", "axle"),
        "both rings stay parallel: equal loads, as the book says",
    ),
    ("measured.shaft_record.step", ("bearing",), "a bearing compares voltages, and no rate"),
    ("measured.shaft_record.time_unit", ("bearing",), "a bearing compares voltages, and no rate"),
    ("ring_material", ("bearing", "drive"), "steel is the only material of rings that conducts"),
    ("mesh.pair.gear.operation.pinion_torque", ("axle",), "computed from drive.torque, as the book says"),
    ("mesh.pair.gear.operation.pinion_speed", ("axle",), "computed from drive.speed, as the book says"),
)


def excepted(kind: str, key: str) -> bool:
    """Whether a key of a kind is an exception."""
    return any(kind in kinds and f".{key}".endswith(f".{end}") for end, kinds, _ in EXCEPTIONS)


@dataclass
class Walk:
    """Keys of the files of a kind that act, and why others do not."""

    kind: str
    folder: Path
    acting: dict[Any, str] = field(default_factory=dict)
    failing: dict[Any, str] = field(default_factory=dict)

    def take(self) -> None:
        first, *further = cases_of(self.kind)
        for number, tables in enumerate((first, *further)):
            values = new_values(tables, first) if number else values_in(tables)
            if self.kind.startswith("duty") or self.kind == "sweep":
                values = [
                    each
                    for each in values
                    if ("duty" in each[0]) == (self.kind != "sweep") and each[0][0] != "case"
                ]
            self._case(number, tables, [each for each in values if self._open(each[0])])

    def _open(self, path: Any) -> bool:
        """Whether a key is not known to act, and is no exception that has been tried."""
        place = key_at(path), path[-1] if isinstance(path[-1], int) else None
        return place not in self.acting and not (place in self.failing and excepted(self.kind, place[0]))

    def _case(self, number: int, tables: Any, values: Any) -> None:
        try:
            answer = Answer(self.kind, tables, self.folder)
        except InputError:
            return
        if "error" in answer.stage(0):
            return
        for path, value in values:
            if not self._open(path):
                continue
            place = key_at(path), path[-1] if isinstance(path[-1], int) else None
            effect, reason = self._effect(tables, path, value, answer)
            if effect:
                self.acting[place] = effect
                self.failing.pop(place, None)
            else:
                self.failing[place] = f"case {number}: {reason}"

    def _effect(self, tables: Any, path: Any, value: Any, answer: Answer) -> tuple[str, str]:
        """Effect of a key, and the reason if there is none."""
        key, reason = key_at(path), "no other value"
        chosen = (
            *VALUES.get(key.rpartition(".")[2], ()),
            *choices_of(keys_of(MODELS[self.kind.removeprefix("duty of ")]).get(key)),
        )
        tried = 0
        for other in (*(each for each in chosen if each != value), *others(path, value, ())):
            try:
                changed = Answer(self.kind, with_value(tables, path, other), self.folder)
            except InputError as error:
                # Another choice needs or excludes other keys; a number that is refused is another matter.
                if (other in chosen or isinstance(other, bool)) and error.key not in (key, None):
                    return f"refused: {error}", ""
                reason = str(error)
                continue
            if effect := first_difference(answer, changed) or changed.naming(key):
                return effect, ""
            tried, reason = tried + 1, f"no effect of {other!r}"
            if tried > len(chosen):
                break
        return "", reason


def refusals(kind: str, folder: Path) -> Iterator[str]:
    """Keys that a file of a kind should refuse by name, and does not."""
    for key, value in refused_of(kind).items():
        names = tuple(key.split("."))
        table, leaf = names[0], names[-1]
        path = (table,) if table == "roughness" else names
        if isinstance(value, dict) and [*value] == [table]:
            path, value = (table,), value[table]
        for tables in cases_of(kind):
            try:
                answer = Answer(kind, with_value(tables, path, value), folder)
                reason = str(answer.stage(0).get("error", ""))
            except InputError as error:
                reason = str(error)
            if leaf in reason:
                break
        else:
            yield f"{key} is not refused by name: {reason or 'accepted'}"


def uncovered(kind: str, walk: Walk) -> Iterator[str]:
    """Keys of files of a kind that are in none of its cases."""
    name = kind.removeprefix("duty of ")
    known = {key for key, _ in (*walk.acting, *walk.failing)}
    refused = [*refused_of(kind)]
    if kind == "axle":
        # Tables that the axle replaces or does not use; its notes name them as wholes.
        refused += ["mesh.pair.lubricant", "mesh.pair.discharge", "mesh.pair.duty", "mesh.pair.measured"]
    for key in keys_of(MODELS[name]):
        of_duty = key.startswith("duty.") and name in key
        other = key.startswith(("non_drive_end.", "case.", "drive_end.duty", "drive_end.measured"))
        if key.startswith("duty.") != kind.startswith("duty") or other or of_duty:
            continue
        if key not in known and not any(f"{key}.".startswith(f"{each}.") for each in refused):
            yield f"{key} is in no case"


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_input_acts(kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drive_cycle, "SIMULATED", 4)
    solving_once(monkeypatch)
    walk = Walk(kind, tmp_path)
    walk.take()
    faults = [f"{key} {text}" for key, text in walk.failing.items() if not excepted(kind, key[0])]
    faults += [f"{key[0]}: an exception that acts" for key in walk.acting if excepted(kind, key[0])]
    faults += [*refusals(kind, tmp_path), *uncovered(kind, walk)]
    assert faults == []
