"""Mixed lubrication: films that asperities pierce, and the pressure of the asperities."""
