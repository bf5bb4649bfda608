"""Heat in the film: temperature across the film and on both surfaces, for a film whose pressure is given."""
