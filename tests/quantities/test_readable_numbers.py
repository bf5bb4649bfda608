"""Numbers that people read: large ones have groups of digits or are in millions, and no exponent."""

import re

import numpy as np
import pytest

from ehlectric import save, solve
from ehlectric.app.compute.bearing_answers import whole_quick_answer
from ehlectric.quantities.formats import amount
from ehlectric.readable import formatted, readable
from ehlectric.report.written_report import write_report
from tests.helpers.each import each
from tests.helpers.readable import number_in

# A power of ten of a number that needs none, as in 1.6e+04.
EXPONENT = re.compile(r"\de\+\d")


@each(
    ("value", "digits", "text"),
    [
        (16_000.0, ".3g", "16 000"),
        (16_000.0, ".2g", "16 000"),
        (12_345.6, ".4g", "12 350"),
        (12_345.6, ".6g", "12 345.6"),
        (999.6, ".3g", "1000"),
        (9999.6, ".4g", "10 000"),
        (-16_000.0, ".3g", "-16 000"),
        (33_333_333.0, ".3g", "33.3 million"),
        (33_333_333.0, ".0f", "33 333 333"),
        (1.2e9, ".3g", "1.2·10⁹"),
        (999.7e6, ".3g", "1·10⁹"),
        (4.5e13, ".2g", "4.5·10¹³"),
        (7430.0, ".3g", "7430"),
        (0.0123, ".2g", "0.012"),
    ],
)
def test_a_number_is_written_as_people_write_it(value, digits, text):
    assert formatted(value, digits).replace("\xa0", " ") == text
    assert " " not in formatted(value, digits), "no line breaks within a number"


def test_no_magnitude_has_an_exponent_or_loses_a_digit():
    """The text is read back by its own rules: groups, and millions."""
    for value in np.geomspace(0.01, 9e8, 300):
        for digits in range(1, 7):
            text = readable(float(value), digits)
            assert "e" not in text
            assert number_in(text) == pytest.approx(value, rel=0.5000001 * 10.0 ** (1 - digits))


def test_amounts_have_no_exponent():
    assert amount(999.96, "V").replace("\xa0", " ") == "1000 V"
    assert amount(5e13, "ohm").replace("\xa0", " ") == "50 000 GΩ"


@pytest.mark.slow
def test_no_output_of_a_fast_and_heavy_bearing_has_an_exponent(tmp_path):
    """At 16 000 rpm and 12 kN a format of four digits has exponents in speed and load."""
    written = {
        "contacts": "formula",
        "bearing": {
            "base": "6314",
            "radial_load": "12000 N",
            "axial_load": "12000 N",
            "inner_speed": "16000 rpm",
            "temperature": "90 degC",
            "composite_rq": "0.1 um",
        },
        "lubricant": {"base": "iso-vg-32"},
        "discharge": {"dielectric_strength": "15 V/um"},
        "motor": {
            "common_mode_voltage": "400 V",
            "winding_rotor_capacitance": "30 pF",
            "rotor_frame_capacitance": "1 nF",
        },
    }
    result = solve(written)
    save(result, tmp_path)
    (file,) = write_report(tmp_path, tmp_path / "report.html")
    page = file.read_text(encoding="utf-8")
    answer = whole_quick_answer(written)
    for text in (result.verdict.text, repr(result), result._repr_html_(), page, repr(answer)):
        assert not EXPONENT.search(re.sub(r'src="data:[^"]*"|<pre.*?</pre>', "", text, flags=re.S))
    assert "16\xa0000 rpm" in result.verdict.text
    assert "12\xa0000\xa0N" in page.replace(" N ", "\xa0N ")
