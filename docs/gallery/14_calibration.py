"""
A bearing that its measurement corrects
=======================================

The capacitance and the shaft voltage of a ball bearing were measured at several speeds, and the temperature
of its outer ring at one speed. Some inputs of the bearing are only known as ranges. Which of them does the
measurement correct, and what should be measured next?
"""

import ehlectric

case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_measured"))
calibration = ehlectric.calibrate(case)
print("inputs within their ranges explain the measurement:", calibration.explained)

# %%
# The figure shows the range of each uncertain input before and after the measurement, and the computed values
# divided by the measured values.
calibration.plot()

# %%
# The measurement removes a different share of the variance of each input.
for item in calibration.inputs:
    print(f"{item.label}: {100 * item.reduction:.0f} % of the variance removed")

# %%
# The next measurement that removes most of the remaining variance of the margin:
for quantity, share in calibration.following[:3]:
    print(f"{quantity}: {100 * share:.0f} %")

# %%
# The probability of breakdown before and after the measurement, and the verdict with the updated probability.
print(f"{calibration.before.probability:.2f} before, {calibration.after.probability:.2f} after")
print(calibration.verdict.text)
