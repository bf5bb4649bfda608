"""Results of contacts as xarray datasets, and their NetCDF files."""
