"""Figures of a drive: voltages over time and how long they last, discharges, and remedies."""
