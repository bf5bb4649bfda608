"""One line or point contact: operating conditions, film and field problems, solution, and result files."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
