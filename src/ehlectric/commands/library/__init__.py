"""Commands that show the library of the package, and oils of users beside it."""
