"""The drive around bearings: common-mode voltage, circuit of the motor, and discharges over time."""
