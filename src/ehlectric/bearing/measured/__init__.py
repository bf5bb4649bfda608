"""Film factors of a bearing from its measured capacitance: the model over film factor, and its inverse."""
