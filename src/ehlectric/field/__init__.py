"""Electric field in the gap between two conducting surfaces, by a solution of Poisson's equation."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
