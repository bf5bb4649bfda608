"""Answers that the pages show, as plain data, and the names of the functions that compute them."""
