"""Hypothesis strategies for cases of every kind that a case file may hold."""

from hypothesis import strategies as st

# Characters of titles: files take only those that are seen.
SEEN = st.characters(codec="utf-8", exclude_categories=("Cs", "Cc", "Cf", "Zl", "Zp"))

radius = st.floats(1e-6, 1e3)
modulus = st.floats(1e5, 2e12)
body = st.fixed_dictionaries({"youngs_modulus": modulus, "poissons_ratio": st.floats(-0.99, 0.5)})


def either(*alternatives):
    return st.one_of(*(st.fixed_dictionaries(keys, optional=others) for keys, others in alternatives))


def merged(*parts):
    """Strategy for tables that are merged from those of several strategies."""
    return st.tuples(*parts).map(lambda tables: {k: v for table in tables for k, v in table.items()})


speeds = either(
    ({"entrainment_speed": st.floats(1e-9, 1e4)}, {"slide_to_roll_ratio": st.floats(-1e3, 1e3)}),
    ({"speed_1": st.floats(1.0, 1e4), "speed_2": st.floats(-0.9, 1e4)}, {}),
)
contacts = merged(
    either(
        ({"reduced_radius": radius}, {}),
        ({"radius_1": radius, "radius_2": radius.map(lambda r: -r)}, {}),
    ),
    either(({"reduced_modulus": modulus}, {}), ({"body_1": body, "body_2": body}, {})),
    either(
        ({"load_per_length": st.floats(1e-2, 1e9)}, {}), ({"max_hertz_pressure": st.floats(1e4, 2e10)}, {})
    ),
    speeds,
)
radii = st.fixed_dictionaries({"radius_x": radius, "radius_y": radius})
groove = st.fixed_dictionaries({"radius_x": radius, "radius_y": radius.map(lambda r: -r)})


def with_bodies(table):
    """Table in which each body has one table with its radii and its elastic constants."""
    kept = {key: value for key, value in table.items() if not isinstance(value, tuple)}
    for k, name in enumerate(("body_1", "body_2")):
        parts = [value[k] for value in table.values() if isinstance(value, tuple)]
        if parts:
            kept[name] = {key: value for part in parts for key, value in part.items()}
    return kept


point_contacts = merged(
    st.just({"geometry": "point"}),
    st.one_of(radii, st.fixed_dictionaries({"both_radii": st.tuples(groove, radii)})),
    either(({"reduced_modulus": modulus}, {}), ({"both_bodies": st.tuples(body, body)}, {})),
    either(({"load": st.floats(1e-6, 1e9)}, {}), ({"max_hertz_pressure": st.floats(1e4, 2e10)}, {})),
    speeds,
).map(with_bodies)
permittivity = {"relative_permittivity": st.floats(1.0, 1e3)}
more = {
    "ambient_pressure": st.floats(0.0, 1e8),
    "permittivity_law": st.sampled_from(["constant", "clausius-mossotti"]),
}
viscosity = {"viscosity": st.floats(1e-7, 1e6)}
alpha = {"pressure_viscosity_coefficient": st.floats(1e-11, 2e-7)}
roelands = {"roelands_z": st.floats(0.01, 2.0), "roelands_pressure": st.floats(1e7, 1e10)}
density = {"density_c1": st.floats(1e7, 1e11), "density_c2": st.floats(1.0, 3.0)}
lubricants = either(
    ({"base": st.just("paper")}, more | permittivity | viscosity | alpha | roelands | density),
    (
        {
            **viscosity,
            "viscosity_law": st.just("constant"),
            "density_law": st.just("incompressible"),
            **permittivity,
        },
        more,
    ),
    (
        {
            **viscosity,
            **alpha,
            **roelands,
            **density,
            "viscosity_law": st.sampled_from(["roelands", "barus"]),
            "density_law": st.just("dowson-higginson"),
            **permittivity,
        },
        more,
    ),
)
height, length = st.floats(1e-12, 1e-3), st.floats(1e-9, 1.0)
place = {"shift": st.floats(-1.0, 1.0), "surface": st.sampled_from([1, 2])}
roughness = either(
    (
        {
            "surface": place["surface"],
            "generator": st.just("sinusoid"),
            "amplitude": height,
            "wavelength": length,
        },
        {"phase": st.floats(-9.0, 9.0), "shift": place["shift"]},
    ),
    (
        {
            "surface": place["surface"],
            "generator": st.just("gaussian"),
            "rq": height,
            "correlation_length": length,
            "seed": st.integers(0, 2**32),
        },
        {"form": st.sampled_from(["none", "line"]), "trim": length, "extend": st.just("flat")},
    ),
    (
        {"surface": place["surface"], "file": st.text(SEEN, min_size=1).map(lambda name: f"/{name}")},
        {"line": st.integers(0, 9), "x_unit": st.just("mm"), "cutoff_long": length, "truncate": height},
    ),
)
grids = either(
    (
        {"nodes": st.integers(20_000, 10**7)},
        {
            "inlet": st.floats(-100.0, -2.0),
            "outlet": st.floats(2.0, 100.0),
            "wedge": st.sampled_from(["first-order", "second-order", "third-order"]),
            "field_range": st.tuples(st.floats(-2.0, -0.1), st.floats(0.1, 2.0)).map(list),
            "field_nodes": st.integers(17, 10**6),
            "field_degree": st.integers(2, 20),
        },
    ),
)
point_grids = st.fixed_dictionaries(
    {},
    optional={
        "nodes": st.integers(1000, 4097),
        "nodes_y": st.integers(1000, 4097),
        "inlet": st.floats(-50.0, -2.0),
        "outlet": st.floats(2.0, 50.0),
        "side": st.floats(1.3, 60.0),
        "wedge": st.sampled_from(["first-order", "second-order", "third-order"]),
        "field_range": st.tuples(st.floats(-2.0, -0.1), st.floats(0.1, 1.5)).map(list),
        "field_side": st.floats(1e-3, 1.3),
        "field_nodes": st.integers(17, 4097),
        "field_nodes_y": st.integers(17, 4097),
        "field_degree": st.integers(2, 20),
        "refine": st.floats(1e-4, 0.5),
    },
).map(lambda grid: {"nodes": 1000, "field_nodes": 100} | grid)
strength = st.floats(1e4, 1e10)
table_of = {"strength": st.tuples(strength, strength).map(list)}
costs = {
    "conductivity": st.floats(1e-20, 1e2),
    "external_capacitance": st.floats(0.0, 1.0),
    "peak_current": st.floats(0.0, 1e6),
    "outlet": st.sampled_from(["full", "fingers", "layers"]),
}
discharges = merged(
    st.fixed_dictionaries({"length": st.floats(1e-6, 1e2)}, optional=costs),
    either(
        ({"dielectric_strength": strength}, {}),
        (
            {
                "strength_table": st.fixed_dictionaries({"temperature": st.just([250.0, 400.0]), **table_of}),
                "temperature": st.floats(250.0, 400.0),
            },
            {},
        ),
        (
            {
                "strength_table": st.fixed_dictionaries({"pressure": st.just([0.0, 2e9]), **table_of}),
            },
            {},
        ),
        (
            {
                "weibull": st.fixed_dictionaries(
                    {
                        "scale": strength,
                        "shape": st.floats(0.5, 200.0),
                        "reference_area": st.floats(1e-18, 1.0),
                    }
                )
            },
            {},
        ),
        (
            {
                "pit": st.fixed_dictionaries(
                    {"efficiency": st.floats(1e-3, 1.0), "melting_energy": st.floats(1e8, 1e12)}
                ),
                "external_capacitance": st.floats(0.0, 1.0),
            },
            {},
        ),
    ),
)
volts = st.floats(-1e7, 0.0), st.floats(1.0, 1e7)
tables = st.fixed_dictionaries(
    {"contact": contacts, "lubricant": lubricants},
    optional={
        "title": st.text(SEEN, max_size=200),
        "roughness": st.lists(roughness, max_size=2),
        "electric": st.fixed_dictionaries({"potential_1": volts[0], "potential_2": volts[1]}),
        "discharge": discharges,
        "grid": grids,
        "solver": st.fixed_dictionaries({"tolerance": st.floats(1e-11, 1e-6)}),
    },
)
point_tables = st.fixed_dictionaries(
    {"contact": point_contacts, "lubricant": lubricants},
    optional={
        "title": st.text(SEEN, max_size=200),
        "discharge": discharges.map(lambda table: {k: v for k, v in table.items() if k != "length"}),
        "grid": point_grids,
    },
)
