"""The drive around bearings: common-mode voltage, circuit of the motor, and discharges over time."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
