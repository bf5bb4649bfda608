"""Largest field of solved smooth contacts over V/h_min, which the atlas takes as one.

python -m benchmarks.atlas_field
"""

from ehlectric.cases.case import Case
from ehlectric.contact.solver import solve

# Radius along entrainment [m]; radius across [m], None for a line; Hertz pressure [Pa]; speed [m/s].
CONTACTS = (
    (14e-3, None, 0.3e9, 0.5),
    (14e-3, None, 0.6e9, 10.0),
    (14e-3, None, 1.0e9, 4.0),
    (14e-3, None, 1.5e9, 20.0),
    (3e-3, None, 0.2e9, 20.0),
    (10e-3, 10e-3, 0.5e9, 2.0),
    (10e-3, 10e-3, 0.8e9, 10.0),
    (5e-3, 60e-3, 0.5e9, 5.0),
    (5e-3, 60e-3, 1.0e9, 5.0),
    (5e-3, 60e-3, 0.7e9, 20.0),
)


def main():
    print("| R | R across | pressure | speed | central film | minimum film | E_max h_min/V - 1 | nodes |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for radius, across, pressure, speed in CONTACTS:
        contact = {"max_hertz_pressure": pressure, "reduced_modulus": 226e9, "entrainment_speed": speed}
        if across is None:
            contact["reduced_radius"] = radius
            grid = {"nodes": 6401, "inlet": -9.0}
        else:
            contact |= {"geometry": "point", "radius_x": radius, "radius_y": across}
            grid = {"nodes": 257}
        result = solve(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": grid}))
        film, field = result.film, result.field
        off = field.max_strength * film.minimum_thickness / field.voltage - 1.0
        films = f"{film.central_thickness * 1e9:.0f} nm | {film.minimum_thickness * 1e9:.0f} nm"
        side = "" if across is None else f"{across * 1e3:g} mm"
        where = f"{radius * 1e3:g} mm | {side} | {pressure / 1e9:g} GPa | {speed:g} m/s"
        print(f"| {where} | {films} | {100.0 * off:+.4f} % | {film.thickness.shape} |", flush=True)


if __name__ == "__main__":
    main()
