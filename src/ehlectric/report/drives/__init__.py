"""Parts of a report about drives: numbers, assumptions, remedies, discharges and limits."""
