"""One entry for each input and result: label, symbol, unit, digits, meaning; and the units of numbers."""
