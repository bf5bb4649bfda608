"""Flow of oils whose viscosity falls under shear: laws, stress in a column of the film, flow, traction."""
