"""Report of a stored result of any kind: contact, motion, bearing, gear pair, drive, axle, or a sweep."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ehlectric.axle import AxleResult
from ehlectric.bearing import BearingResult
from ehlectric.cases.defaults import HOW
from ehlectric.contact import ContactResult
from ehlectric.drive import DriveResult
from ehlectric.errors import printable
from ehlectric.gear import GearResult
from ehlectric.motion.result import MotionResult
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.quantities.rows import placed
from ehlectric.quantities.sheets import CONTACT_CARDS, FIRST_PAGE_OF_GEAR
from ehlectric.report.appendix import (
    date_of_report,
    file_section,
    input_sections,
    limit_section,
    source_section,
    version_section,
)
from ehlectric.report.drive_report import drive_part
from ehlectric.report.first_page import bearing_blocks, first_section, is_solved, machine_of, numbers_of
from ehlectric.report.report_content import Block, Numbers, Part, Picture, Report, Section, Text
from ehlectric.report.report_facts import (
    alarms_of,
    cell_table,
    density_tables,
    part_of,
    pictures_of,
    row_tables,
    warning_block,
)
from ehlectric.report.report_texts import SENTENCES, TEXTS
from ehlectric.report.sweep_report import sweep_part
from ehlectric.runs.result_folders import stored_result
from ehlectric.runs.solve import load
from ehlectric.sweep import NAME as SWEEP
from ehlectric.sweep import SweepResults, read_sweep
from ehlectric.tables.axle_tables import (
    REMEDIES,
    axle_rows,
    chance_rows,
    chances_table,
    duty_table,
    elements_table,
    remedied_simulation_table,
    remedies_table,
    shafts_table,
    simulation_table,
)
from ehlectric.tables.bearing_tables import films_table, loads_table, total_rows
from ehlectric.tables.contact_tables import result_rows
from ehlectric.tables.gear_tables import gear_rows, points_table
from ehlectric.tables.motion_tables import run_rows


def report_of(path: str | Path, *, summary: bool = False) -> Report:
    """Report of a stored result, as data. Returns title, date and sections; with ``summary`` only the first
    page. Raises InputError if the folder has no result or several, or the result cannot be read.
    """
    date = date_of_report()
    path = stored_result(path)
    result: Any = read_sweep(path.parent) if path.name == SWEEP else load(path)
    part = next(make for kind, make in _PARTS.items() if isinstance(result, kind))(result)
    name = _title(result) or part.kind[0].upper() + part.kind.partition(" over ")[0][1:]
    first = first_section(result, part, path)
    shown = {block.name for block in first.blocks if isinstance(block, Picture)}
    further = (
        () if summary else _appendix(result, part, [figure for figure in part.figures if figure not in shown])
    )
    return Report(name, part.kind, date, (first, *further))


def _title(result: Any) -> str:
    """Title of a result; a sweep has its own, or the title of its case."""
    return printable(getattr(result, "title", "") or result.case.title)


def _appendix(result: Any, part: Part, figures: Sequence[str]) -> Iterator[Section]:
    """Sections behind the first page, in the order of the question, with the figures of these names."""
    yield Section(
        "What was asked",
        (Text(TEXTS["questions"][part.question or part.command]), Text(part.machine or part.lead)),
    )
    yield Section("Result", tuple(_answer(part)))
    yield Section("Key numbers", part.numbers)
    drawn = tuple(pictures_of(result, converged=is_solved(result), names=figures))
    note = (Text(part.figure_note),) if part.figure_note else ()
    yield Section("Figures", (*drawn, *note) or (Text(SENTENCES["no_further_figures"]),))
    yield from part.further
    yield Section("Warnings", (warning_block(part.warnings),))
    yield from input_sections(result.case, part.varied, part.rests)
    yield limit_section(result.case)
    yield source_section(result.case)
    yield version_section(part.details)
    yield file_section(part.toml, part.command)


def _answer(part: Part) -> Iterator[Block]:
    yield from alarms_of(part.warnings, part.failure)
    yield Text(part.lead)
    yield Text(SENTENCES["no_verdict"] if part.verdict is None else printable(part.verdict.text))


def _contact(result: Any) -> Part:
    rows = result_rows(result)
    return part_of(
        result,
        result.summary(),
        date=result.to_xarray().attrs.get("date", ""),
        kind=f"{result.case.contact.geometry} contact",
        command="run",
        first=(Numbers(numbers_of(rows, CONTACT_CARDS, {})),),
        numbers=tuple(row_tables(rows, "Overview")),
    )


def _motion(result: MotionResult) -> Part:
    summary = result.summary()
    return part_of(
        result,
        summary,
        date=str(result.dataset.attrs.get("date", "")),
        kind=f"{result.case.contact.geometry} contact with moving roughness",
        command="run",
        failure="" if result.converged else SENTENCES["ended_early"],
        numbers=tuple(row_tables(run_rows(summary), "Overview")),
    )


def _bearing(result: BearingResult) -> Part:
    summary, case = result.summary(), result.case
    rows, name = total_rows(summary), case.bearing.name
    loads = "Loads and Hertzian contacts of the elements with both rings"
    films = "Films, capacitances and voltages of the contacts"
    loads, films = (placed(caption, "contacts", summary) for caption in (loads, films))
    contacts = cell_table(loads_table(summary), loads), cell_table(films_table(summary), films)
    densities = density_tables({"bearing": summary["bearing"].get("current_density")})
    return part_of(
        result,
        summary,
        kind=f"{case.bearing.kind} bearing{f' {name}' if name else ''}, contacts {HOW[case.contacts]}",
        command="bearing",
        machine=machine_of(case, summary),
        first=tuple(bearing_blocks(case, summary, rows)),
        numbers=(*row_tables(rows, "Overview"), *densities),
        further=(Section("Contacts", contacts),),
    )


def _gear(result: GearResult) -> Part:
    summary, gear = result.summary(), result.case.gear
    rows, teeth = gear_rows(summary), "/".join(map(str, gear.teeth))
    shape = "spur" if gear.helix_angle == 0.0 else "helical"
    speed, temperature = operating_point(gear.operation.pinion_speed, result.solution.bulk_temperature)
    machine = (
        f"{shape.capitalize()} gears of {gear.material} with {teeth} teeth, normal module "
        f"{amount(gear.normal_module, 'm')}, face width {amount(gear.face_width, 'm')}: "
        f"{amount(gear.operation.pinion_torque, 'N m')} on gear 1, {speed}, flanks at {temperature}."
    )
    return part_of(
        result,
        summary,
        kind=f"{shape} gear pair {teeth}, films {HOW[result.case.contacts]}",
        command="gear",
        machine=machine,
        first=(Numbers(numbers_of(rows, FIRST_PAGE_OF_GEAR, summary)),),
        numbers=tuple(row_tables(rows, "Overview")),
        further=(
            Section(
                "Path of contact",
                (cell_table(points_table(summary), "Points of the path of contact", "quantity"),),
            ),
        ),
    )


def _axle(result: AxleResult) -> Part:
    summary, case = result.summary(), result.case
    speed, temperature = operating_point(case.drive.speed, case.drive.temperature)
    shafts, meshes = len(case.shaft), len(case.mesh)
    machine = (
        f"{shafts} shaft{'s' if shafts > 1 else ''}, {len(case.bearing)} bearings and {meshes} gear "
        f"mesh{'' if meshes == 1 else 'es'}: {amount(case.drive.torque, 'N m')} on the rotor, {speed}, "
        f"oil at {temperature}."
    )
    elements = cell_table(elements_table(summary), "Bearings and meshes, the first to discharge on top")
    further = [elements, cell_table(shafts_table(summary), "Shafts", "shaft")]
    if "simulation" in summary:
        further.append(cell_table(simulation_table(summary), "Discharges over time"))
    if "duty" in summary:
        further.append(cell_table(duty_table(summary), "Shares of the duty cycle"))
    if "uncertainty" in summary:
        further.append(cell_table(chances_table(summary), "Probabilities of bearings and meshes"))
    if summary["remedies"]:
        further.append(cell_table(remedies_table(summary), REMEDIES))
    if summary["remedies"] and "simulation" in summary:
        further.append(cell_table(remedied_simulation_table(summary), "Discharges with each remedy"))
    return part_of(
        result,
        summary,
        kind=f"axle with {shafts} shafts",
        command="drive",
        question="axle",
        machine=machine,
        first=(elements,),
        numbers=(*row_tables(axle_rows(summary), "Overview"), *row_tables(chance_rows(summary), "Spread")),
        further=(Section("Bearings, meshes and shafts", tuple(further)),),
    )


# Parts by the class of the result.
_PARTS: Mapping[type, Callable[[Any], Part]] = MappingProxyType(
    {
        ContactResult: _contact,
        MotionResult: _motion,
        BearingResult: _bearing,
        GearResult: _gear,
        DriveResult: drive_part,
        AxleResult: _axle,
        SweepResults: sweep_part,
    }
)
