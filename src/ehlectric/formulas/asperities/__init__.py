"""Statistics of touching asperities: pressure, area and number of spots, duty of contact, resistance."""
