"""Lubricant film of one contact: Reynolds equation, elastic deflection, cavitation and balance of load."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
