"""Rolling bearings: loads of the elements, films of the contacts, and the electrical circuit."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
