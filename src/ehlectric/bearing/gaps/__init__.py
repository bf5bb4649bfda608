"""Capacitance of the gaps outside the loaded contacts, from their geometry."""
