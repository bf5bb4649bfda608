"""Mechanics of a bearing: geometry, kinematics and the load that every rolling element carries."""
