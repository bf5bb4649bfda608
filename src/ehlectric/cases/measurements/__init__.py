"""Measurements beside a case: columns with units, rows read from text, and the mean of film factors."""
