"""Mechanics of a bearing: geometry, kinematics, and the load of every rolling element."""
