"""Parameters of oils by name, with their sources, and any parameters for hypothesis."""

from hypothesis import strategies as st

# Mineral oil FVA 3: Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369, table A1,
# where temperatures are in degrees Celsius and pressures in bar.
VOGEL = {"vogel_viscosity": 0.062e-3, "vogel_b": 1021.7, "vogel_c": 273.15 - 101.5517}
MODULUS = {
    "modulus_a1": (327.7918 - 2.9862 * 273.15) * 1e5,
    "modulus_a2": 2.9862e5,
    "modulus_b1": 4.419e-3 - 3.0115e-4 * 273.15,
    "modulus_b2": 3.0115e-4,
}

# Mineral oil Shell T9, as later works quote Habchi et al., Tribol. Int. 43 (2010) 1842.
YASUTOMI = {
    "yasutomi_glass_viscosity": 1e12,
    "yasutomi_glass_temperature": 273.15 - 83.2,
    "yasutomi_a1": 188.86,
    "yasutomi_a2": 0.719e-9,
    "yasutomi_b1": 8.20e-9,
    "yasutomi_b2": -0.5278,
    "yasutomi_c1": 16.09,
    "yasutomi_c2": 17.38,
}
TAIT = {
    "tait_k0_prime": 10.545,
    "tait_k00": 9.234e9,
    "tait_beta_k": 6.09e-3,
    "tait_expansion": 7.734e-4,
    "reference_temperature": 298.0,
}
MURNAGHAN = {key.replace("tait", "murnaghan"): value for key, value in TAIT.items()}

# Constants of an 80W-90 gear oil as a later program quotes Bair (2019), with the volume of Shell T9.
DOOLITTLE = {
    "doolittle_viscosity": 0.0348,
    "doolittle_b": 4.336,
    "doolittle_r0": 0.6988,
    "doolittle_epsilon": -7.679e-4,
    **TAIT,
    "reference_temperature": 323.0,
}

# Constants of Shell T9 (see above), of PAO B and of a paraffinic mineral oil, all as later works quote them.
SCALED_K = {
    "scaling_k_base": 0.053,
    "scaling_k_factor": 0.026,
    "scaling_k_exponent": 7.66,
    "scaling_a": -0.101,
    "scaling_q": 3.0,
    **TAIT,
}
SCALED_C = {"scaling_c_base": 1.17e6, "scaling_c_factor": 0.39e6, "scaling_c_exponent": 4.0, **TAIT}
LARSSON_K = {"thermal_conductivity": 0.154, "larsson_c1": 1.40e-9, "larsson_c2": 0.34e-9}
LARSSON_C = {
    "volumetric_heat_capacity": 1.71e6,
    "larsson_temperature": 295.0,
    "larsson_beta": 9.3e-4,
    "larsson_b1": 1.4e-9,
    "larsson_b2": -0.51e-18,
    "larsson_k1": 0.47e-9,
    "larsson_k2": 0.81e-9,
}


def around(parameters, share=0.15):
    """Strategy of parameters within a share of those of an oil.

    The temperatures stay, and the exponent q of the scaled conductivity: with a larger one, kappa itself
    rises with pressure above 400 K, where (1 + q) |a| T / T_ref exceeds 1.
    """
    fixed = {"reference_temperature", "larsson_temperature", "modulus_a1", "modulus_b1", "scaling_q"}
    return st.fixed_dictionaries(
        {
            name: st.just(value)
            if name in fixed
            else st.floats(*sorted(value * (1 + s * share) for s in (-1, 1)))
            for name, value in parameters.items()
        }
    )
