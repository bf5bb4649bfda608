"""Spots in which the surfaces of a solved contact touch: load, area, film around them, electrical answer."""
