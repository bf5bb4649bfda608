"""Rows of what a capacitance meter at the two bodies of a contact reads."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.contact.meter.reading import MeterReading
from ehlectric.contact.results import PointResult, Result
from ehlectric.quantities.rows import Row


def meter_rows(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the meter's reading of a solved contact; none where its case has no table ``meter``."""
    reading = result.meter
    if reading is None:
        return
    yield Row("capacitance at the meter")
    yield Row("capacitance that the meter reads", reading.capacitance, "pF", f", {reading.bodies}")
    least, most = (Row("", value, "pF").shown for value in (reading.capacitance_air, reading.capacitance_oil))
    yield Row("capacitance, outer gap in air to oil", f"{least} to {most}", "pF")
    for name, value, part in (
        ("capacitance of the film's domain", reading.capacitance_domain, reading.share_of_domain),
        ("capacitance of the Hertz zone in it", reading.capacitance_hertz, reading.share_of_hertz),
        ("capacitance of the gap outside", reading.capacitance_outside, reading.share_of_outside),
    ):
        yield Row(name, value, "pF", f", {100.0 * part:.0f} %")
    if reading.parallel_capacitance is not None:
        yield Row("capacitance in parallel", reading.parallel_capacitance, "pF", ", from the case")
    if reading.roughness_factor is not None:
        yield Row("roughness factor of the domain", reading.roughness_factor)
    yield from _coating(reading)


def _coating(reading: MeterReading) -> Iterator[Row]:
    """Rows of a coating and of the voltages at which film and coating break down; none without a coating."""
    if reading.coating_voltage_share is None:
        return
    yield Row("capacitance without the coating", reading.capacitance_uncoated, "pF")
    yield Row("capacitance of the coating in series", reading.coating_capacitance, "pF")
    yield Row(
        "share of the voltage on the coating", reading.coating_voltage_share, "%", ", at the minimum film"
    )
    film, coating, both = (
        reading.film_breakdown_voltage, reading.coating_breakdown_voltage, reading.breakdown_voltage,
    )  # fmt: skip
    if film is not None:
        yield Row("breakdown voltage of the film", film, "V", ", between the bodies", bound="≤")
    if coating is not None:
        yield Row("breakdown voltage of the coating", coating, "V", ", with the film bridged")
    if both is not None:
        yield Row("breakdown voltage of both", both, "V", ", between the bodies", bound="≤")
