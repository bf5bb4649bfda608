"""Common-mode voltage of an inverter over time: computed from its modulation, or measured."""
