"""Asperities that touch in a bearing: load shares, share of time in which it conducts, and its regime."""
