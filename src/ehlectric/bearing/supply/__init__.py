"""Supply of oil to the contacts of a bearing: factor on the film, and decay of the film without it."""
