"""Tables of a case about its film: supply of oil at the inlet, heat and shear."""
