"""Page of a drive: its form, its first answer, its simulation, and its remedies."""
