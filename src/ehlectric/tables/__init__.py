"""Tables of results: rows as data, and how a terminal prints them."""
