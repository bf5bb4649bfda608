"""Electric field in the gap between two conducting surfaces, by a solution of Poisson's equation."""
