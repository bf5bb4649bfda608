"""Material laws of the lubricant: viscosity and density over pressure, and permittivity over density."""
