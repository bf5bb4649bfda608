"""Version of ehlectric; the build of the package reads it here."""

__version__ = "1.0.0"
