"""Compare a table of results with the open benchmark: ``python compare.py mine.csv``.

The table has a column ``name`` and any columns of ``results.csv``, in SI units; contacts and columns may be
missing. For each class of contacts and each quantity the median and the largest deviation are printed, and
where the largest one is. Reference values are left out where their own error is above ``--own``.

Needs Python 3.9 and nothing else.
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
import sys
from collections import defaultdict
from pathlib import Path
from typing import NoReturn

HERE = Path(__file__).parent

# Quantities, and the column with the error of the reference; capacitances follow the film.
QUANTITIES = {
    "central_film": "film_error",
    "minimum_film": "film_error",
    "mean_film": "film_error",
    "max_pressure": "max_pressure_error",
    "traction_coefficient": "film_error",
    "temperature_rise": "temperature_rise_error",
    "capacitance": "film_error",
    "max_field": "max_field_error",
}
# Errors that are given in the unit of the quantity, in place of relative to it.
ABSOLUTE = {"temperature_rise"}


def refuse(text: str) -> NoReturn:
    """End with one line and status 2."""
    print(text, file=sys.stderr)
    sys.exit(2)


def table(path: Path) -> dict[str, dict[str, str]]:
    """Rows of a table by the names of their contacts."""
    try:
        # Spreadsheets begin their files with a mark.
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file)
            if "name" not in (reader.fieldnames or ()):
                refuse(f"{path}: expected a column name, with the names of contacts.csv")
            rows = list(reader)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        refuse(f"{path}: {error}; expected a CSV file in UTF-8")
    names = [row["name"] for row in rows]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        refuse(f"{path}: {twice} stands there twice; expected one row for each contact")
    return {row["name"]: row for row in rows}


def number(row: dict[str, str], key: str, path: Path) -> float | None:
    """Value of a row; None where it is empty or its column is missing."""
    text = (row.get(key) or "").strip()
    if not text:
        return None
    try:
        value = float(text)
    except ValueError:
        refuse(f"{path}: {row['name']}, {key}: got {text!r}; expected a number")
    if not math.isfinite(value):
        refuse(f"{path}: {row['name']}, {key}: got {text}; expected a finite number, or nothing")
    return value


def deviations(path: Path, own: float) -> dict[tuple[str, str], list[tuple[float, str]]]:
    """Deviations with the names of their contacts, by class and quantity."""
    reference, mine = table(HERE / "results.csv"), table(path)
    unknown = sorted(set(mine) - set(reference))
    if unknown:
        refuse(f"{path}: {unknown[0]} is no contact of contacts.csv")
    found: dict[tuple[str, str], list[tuple[float, str]]] = defaultdict(list)
    for name, row in mine.items():
        exact = reference[name]
        for key, error_of in QUANTITIES.items():
            true, value = number(exact, key, HERE / "results.csv"), number(row, key, path)
            error = number(exact, error_of, HERE / "results.csv")
            if true is None or value is None or error is None:
                continue
            error = error / abs(true) if key in ABSOLUTE else error
            error += number(exact, "domain_error", HERE / "results.csv") or 0.0
            if error <= own:
                found[name.rsplit("-", 1)[0], key].append((value / true - 1.0, name))
    return found


def main() -> None:
    """Print the comparison."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="CSV with a column name and columns of results.csv")
    parser.add_argument("--own", type=float, default=0.01, help="largest error of a reference, default 0.01")
    asked = parser.parse_args()
    found = deviations(asked.table, asked.own)
    if not found:
        refuse(f"{asked.table}: no quantity to compare; expected columns {', '.join(QUANTITIES)}")
    print(f"{'class':10s} {'quantity':21s} {'number':>6s} {'median':>9s} {'largest':>9s}  at")
    for (kind, key), values in sorted(found.items()):
        middle = statistics.median(abs(value) for value, _ in values)
        worst, name = max(values, key=lambda each: abs(each[0]))
        print(f"{kind:10s} {key:21s} {len(values):6d} {middle:9.2%} {worst:+9.2%}  {name}")


if __name__ == "__main__":
    sys.exit(main())
