"""One line or point contact: operating conditions, film and field problems, solution, and result files."""
