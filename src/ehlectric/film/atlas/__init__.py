"""Atlas of films: dimensionless films of smooth contacts, solved once, and interpolated."""
