"""Error estimates of rough films and of the maximum pressure, which look between the nodes of the grid."""
