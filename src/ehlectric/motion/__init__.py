"""Transient contacts: roughness that moves with its surface, solved step by step and stored as it goes."""
