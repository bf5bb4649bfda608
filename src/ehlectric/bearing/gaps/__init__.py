"""Capacitance of the gaps around the loaded contacts, from the geometry of element and raceway."""
