"""
A first film and its field
==========================

A roller of 14.1 mm reduced radius rolls on steel under 1.57 MN/m. Both surfaces move at 4 m/s; their
potentials are -1 V and +1 V. This is the first contact of Morris, Leighton and Morris, `Lubricants 2022,
10(5), 87 <https://doi.org/10.3390/lubricants10050087>`_.
"""

import ehlectric

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "load_per_length": "1.57 MN/m",
            "entrainment_speed": "4 m/s",
        },
        "lubricant": {"base": "paper"},
        "electric": {"potential_1": "-1 V", "potential_2": "1 V"},
    }
)
result = ehlectric.solve(case)

# %%
# Film and pressure. The pressure follows Hertz's except for the spike before the exit, where the film is
# thinnest.
result.plot("film")

# %%
# The field strength in the film, with its maximum at the constriction enlarged. Grey is below the range of
# the colours. The figure says how many times its heights are enlarged.
result.plot("field_strength")

# %%
# The field has its maximum at the exit constriction, in a strip some twenty micrometres wide. The width
# matters for the current density of a discharge.
result.plot("field_profiles")

# %%
# The key figures, in SI units. ``result.summary()`` holds them all.
field = result.field
print(f"minimum film      {1e6 * result.film.minimum_thickness:.3f} µm")
print(f"estimated error   {100 * result.film.discretisation_error:.2f} %")
print(f"maximum field     {1e-6 * field.max_strength:.2f} V/µm")
print(f"V12/h_min         {1e-6 * field.voltage / result.film.minimum_thickness:.2f} V/µm")
print(f"width above 95 %  {1e6 * field.high_field_width:.1f} µm")
print(f"capacitance       {1e9 * field.capacitance:.2f} nF/m over 2.5 half-widths")
