"""
First film
==========
"""

print(1)
