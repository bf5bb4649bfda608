"""Material laws of the lubricant as pure functions of pressure, density and temperature."""
