"""Pairs of cylindrical gears: geometry, load, film, electric field and breakdown on their flanks."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
