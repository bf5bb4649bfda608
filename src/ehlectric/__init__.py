"""Film and electric field of lubricated contacts, and breakdown of the film in bearings and gears.

The public names are listed in ``__init__.pyi``. Each is imported when it is first used, so
``import ehlectric`` loads no NumPy.
"""

import sys
import types

import lazy_loader

_imported, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# Public names whose modules import matplotlib.
_DRAWING = {"figure", "figure_names", "save_figures", "write_report"}


class _Package(types.ModuleType):
    """Package whose functions have priority over its subpackages of the same names, such as ``film``.

    An import of a subpackage would otherwise replace the function.
    """

    def __setattr__(self, name: str, value: object) -> None:
        if name not in __all__ or not isinstance(value, types.ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> object:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name in _DRAWING:
        from ehlectric.runtime.display import import_matplotlib

        import_matplotlib()
    return _imported(name)
