"""Transient contacts: moving roughness, solved step by step and stored while it is solved."""
