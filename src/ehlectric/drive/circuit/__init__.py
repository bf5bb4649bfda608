"""Circuit of a motor around its bearings, and its exact solution between two edges of the source."""
