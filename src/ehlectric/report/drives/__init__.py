"""What a report says of drives: their numbers, assumptions, remedies, discharges and limits."""
