"""Figures of a drive: voltages over time, how long which voltages last, discharges, and remedies."""
