"""
A measured surface in the contact
=================================

A stylus profile lies on the lower body, which is at rest while the other surface slides over it. Form and
long waves are removed first; ``ehlectric surface`` shows the same steps without solving.
"""

import ehlectric

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "1 m/s",
        },
        "lubricant": {"base": "paper"},
        "roughness": [
            {
                "surface": 1,
                "file": str(ehlectric.example("surfaces/dektak-1.csv")),
                "form": "parabola",
                "cutoff_long": "80 um",
                "truncate": "50 nm",
            }
        ],
        "grid": {"nodes": 12_801},
    }
)
result = ehlectric.solve(case, require_convergence=True)

# %%
# The profile after each step:
for step in result.rough[0]["steps"]:
    print(
        f"{step['step']:34} Rq {1e9 * step['rq']:6.1f} nm, "
        f"correlation length {1e6 * step['correlation_length']:6.2f} µm"
    )

# %%
# The roughness as the film sees it:
result.plot("roughness")

# %%
# Pressure and film. A ridge a few micrometres wide carries up to three times the Hertzian pressure, which
# presses it nearly flat: the film hardly shows it.
result.plot("film")

# %%
# The field follows the film; it is highest on the peaks of the rough wall.
result.plot("field_profiles")

# %%
# V12/h_min with the minimum of the *rough* film is within some per cent of the maximum field. With the smooth
# film it is lower, since roughness reduces the minimum film.
summary = result.summary()
smooth = result.smooth.minimum_thickness
voltage = result.field.voltage
print(
    f"maximum field, solved   {1e-6 * result.field.max_strength:.2f} V/µm, {result.field.max_strength_wall}"
)
print(f"V12/h_min, rough film   {1e-6 * voltage / result.film.minimum_thickness:.2f} V/µm")
print(f"V12/h_min, smooth film  {1e-6 * voltage / smooth:.2f} V/µm")
print(f"lambda ratio            {summary['roughness']['lambda_ratio']:.1f}")
for warning in result.warnings:
    print("warning:", warning)
