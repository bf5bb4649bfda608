"""Surface roughness: reading, generation, filtering, and continuation over the whole contact."""
