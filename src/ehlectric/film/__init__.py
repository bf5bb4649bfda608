"""Reynolds equation, deflection, cavitation and load: from a dimensionless problem to a film."""
