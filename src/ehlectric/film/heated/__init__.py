"""Films with heat and shear thinning: pressure, film thickness and temperature solved together."""
