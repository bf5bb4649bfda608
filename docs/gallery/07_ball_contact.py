"""
A ball on a plane
=================

A steel ball of 10 mm radius rolls on a steel plane at 2 m/s under 20 N; the potentials are -1 V and +1 V. It
is a point contact whose Hertzian contact is a circle. Film and field are maps over the plane.
"""

import ehlectric

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "geometry": "point",
            "radius_x": "10 mm",
            "radius_y": "10 mm",
            "reduced_modulus": "226 GPa",
            "load": "20 N",
            "entrainment_speed": "2 m/s",
        },
        "lubricant": {"base": "paper"},
        "electric": {"potential_1": "-1 V", "potential_2": "1 V"},
        "grid": {"nodes": 257},
    }
)
result = ehlectric.solve(case)

# %%
# The film, with lines of equal thickness as in an interferogram. Oil enters from the left. The
# constriction runs around the exit like a horseshoe, and the film is thinnest in its two side lobes,
# where oil flows off to the sides.
result.plot("film_map")

# %%
# The pressure has its ridge along the inner side of the horseshoe.
result.plot("pressure_map")

# %%
# The field follows the film: it is largest in the side lobes, not at the exit as in a line contact.
# The contour around each lobe is at 95 % of the maximum.
result.plot("field_map")

# %%
# Pressure, film and field on lines along and across entrainment, through the centre and through the
# minimum film.
result.plot("cuts")

# %%
# The key figures. The capacitance over the field range is divided into that of the Hertzian ellipse, of the
# strips before and behind it, and of the sides.
film, field = result.film, result.field
print(f"minimum film      {1e6 * film.minimum_thickness:.3f} µm")
print(f"central film      {1e6 * film.central_thickness:.3f} µm")
print(f"estimated error   {100 * film.discretisation_error:.2f} %")
print(f"maximum field     {1e-6 * field.max_strength:.2f} V/µm")
print(f"V12/h_min         {1e-6 * field.voltage / film.minimum_thickness:.2f} V/µm")
print(f"area above 95 %   {1e12 * field.high_field_area:.0f} µm², both lobes")
print(f"capacitance       {1e12 * field.capacitance:.2f} pF")
for name, zone in result.zones.items():
    print(f"  {name:<15} {1e12 * field.capacitance_of(zone):.2f} pF")

# %%
# For comparison, the values of the film-thickness formulas, which are fits to solutions like this one:
for name, formula in result.formulas().items():
    for quantity, thickness in vars(formula).items():
        if thickness is not None:
            off = 100 * (thickness / getattr(film, quantity) - 1)
            print(f"{name:<26}{quantity:<19}{1e6 * thickness:.3f} µm, {off:+.0f} %")
