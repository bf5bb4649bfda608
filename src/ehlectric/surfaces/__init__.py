"""Surface roughness: read from files, generated, filtered, and continued over the contact."""
