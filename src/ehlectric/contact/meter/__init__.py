"""Capacitance that a meter at the two bodies of a contact reads: film, outer gap, coating, parallel parts."""
