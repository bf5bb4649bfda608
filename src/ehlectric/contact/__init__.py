"""One line or point contact: operating conditions, the problems to solve, the solution, and its files."""
