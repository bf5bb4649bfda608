"""Boxes of the contact page for rough surfaces and for roughness that moves."""
