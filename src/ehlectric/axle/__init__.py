"""Axles: shafts that gear meshes connect, the loads of their bearings, and their network of capacitances."""
