"""Runs of files and cases of every kind, in memory and into folders; nothing here prints."""
