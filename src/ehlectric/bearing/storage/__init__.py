"""Solution of a bearing as a dataset, which its NetCDF file holds, and back."""
