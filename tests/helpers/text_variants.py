"""Hypothesis strategy for the many ways in which instruments and spreadsheets write one table of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hypothesis import strategies as st

ABOVE = (
    [],
    ["EHD Test Data File", "", "Profile description:\tX"],
    ["# remark", "Operator;N. N.", "Serial;12,5"],
    ["Instrument, model 7", "Date, 2001-01-01", ""],
)


@dataclass(frozen=True)
class Written:
    """Column of a table as a file may write it."""

    heads: Sequence[str]  # names over the column
    units: Sequence[tuple[str, float]]  # units, and the number of them in an SI unit
    values: Sequence[float]  # SI units


@st.composite
def variants(draw, columns, *, digits=6, steps=True):
    """Content of a file with some columns in SI units, in one of many spellings; ``digits``, significant
    digits of the numbers; ``steps``, whether the rows may be in several tables below each other.
    """
    separator = draw(st.sampled_from(";\t,"))
    decimal = draw(st.sampled_from(".,"))
    where = draw(st.sampled_from(["[]", "()", "below", "cells"]))
    quoted = separator == "," and decimal == ","
    columns = draw(st.permutations(list(columns)))
    spelled = [
        (draw(st.sampled_from(column.heads)), *draw(st.sampled_from(column.units))) for column in columns
    ]
    remark = draw(st.booleans())
    heads = [f"{name} {where[0]}{unit}{where[1]}" if len(where) == 2 else name for name, unit, _ in spelled]
    heads = [f'"{head}"' if separator in head else head for head in heads]
    head_lines = [separator.join([*heads, *["remark"] * remark])]
    if where == "below":
        head_lines.append(separator.join([*(f"[{unit}]" for _, unit, _ in spelled), *[""] * remark]))

    def cell(value, unit, size):
        text = f"{value * size:.{digits}g}".replace(".", decimal)
        text = f"{text} {unit}" if where == "cells" else text
        return f'"{text}"' if quoted else text

    rows = []
    for place in range(len(columns[0].values)):
        cells = [cell(column.values[place], *of) for column, (_, *of) in zip(columns, spelled, strict=True)]
        rows.append(separator.join([*cells, *["a note"] * remark]))
    lines = [*draw(st.sampled_from(ABOVE)), *head_lines]
    cut = draw(st.integers(0, len(rows) - 1)) if steps else 0
    title = ["", 'Step 2 "Film" started at 01/01/2001 10:30', "", *head_lines] if cut else []
    lines += [*rows[:cut], *title, *rows[cut:]]
    end = draw(st.sampled_from(["\n", "\r\n"]))
    text = end.join([*lines, *draw(st.sampled_from([[""], ["", ""], []]))])
    codes = [code for code in ("utf-8", "utf-8-sig", "utf-16", "cp1252") if _encodes(text, code)]
    return text.encode(draw(st.sampled_from(codes)))


def _encodes(text, code):
    try:
        text.encode(code)
    except UnicodeEncodeError:
        return False
    return True
