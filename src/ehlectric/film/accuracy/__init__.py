"""Error estimates that look at places of the film: rough films between their nodes, and the maximum pressure."""
