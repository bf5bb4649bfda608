"""Text files of oscilloscopes: separator and decimal mark, heads and units, numbers, and spacing of times."""
