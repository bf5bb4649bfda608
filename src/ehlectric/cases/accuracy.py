"""Error of the film that a case is refined to where its file does not say how far; imports no arrays."""

from __future__ import annotations

# Relative error by whether the contact is a point contact.
DEFAULT_ERROR = {False: 0.01, True: 0.02}
