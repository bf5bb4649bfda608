"""Axles: shafts that gear meshes connect, the loads of their bearings, and their network of capacitances."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
