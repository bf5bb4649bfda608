"""Keywords of the constructors of cases: their types, and the tables made of them."""
