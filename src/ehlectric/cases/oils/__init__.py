"""Lubricant of a case: its keys, its laws with the parameters of the case, and its data sheet."""
