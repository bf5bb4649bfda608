"""Capacitance and voltages between shaft and housing: films, coating, parallel capacitance, and roughness."""
