"""Values that hold where a case file gives none; without arrays, as the server of the app reads them."""

from __future__ import annotations

# Relative error to which a film is refined, by whether the contact is a point contact.
DEFAULT_ERROR = {False: 0.01, True: 0.02}

# Thickness of the boundary film [m]: one layer of molecules of oil.
BOUNDARY_FILM = 1e-9
