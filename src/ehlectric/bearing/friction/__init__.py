"""Friction of the contacts of a bearing: the hydrodynamic resistance to rolling of all elements."""
