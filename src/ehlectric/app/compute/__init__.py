"""Functions that compute the answers of the pages; only worker processes load them.

They lead to the same functions as the command line.
"""
