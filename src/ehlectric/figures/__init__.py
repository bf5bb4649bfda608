"""All figures; no other package draws."""
