"""File of a solved drive: its content, and the result of it."""
