"""Names of the files of results, by the kind of the result.

They stand apart from what writes the files, so that a folder is checked without the code of every kind.
"""

from __future__ import annotations

SUMMARY = "summary.json"

# Results of contacts, of bearings, of gear pairs, of drives and of axles.
CONTACT_NETCDF, FILM = "result.nc", "film.csv"
OF_CONTACTS = (SUMMARY, CONTACT_NETCDF, FILM)
BEARING_NETCDF, CONTACTS, IMPEDANCE, DUTY = "bearing.nc", "contacts.csv", "impedance.csv", "duty.csv"
OF_BEARINGS = (SUMMARY, CONTACTS, IMPEDANCE, DUTY, BEARING_NETCDF)
DRIVE_NETCDF, EVENTS, SPECTRUM = "drive.nc", "events.csv", "spectrum.csv"
GEAR_NETCDF, PATH, MESH = "gear.nc", "path.csv", "mesh.csv"
OF_GEARS = (SUMMARY, PATH, MESH, DUTY, GEAR_NETCDF)
AXLE_NETCDF, ELEMENTS, SHAFTS = "axle.nc", "elements.csv", "shafts.csv"
OF_AXLES = (SUMMARY, ELEMENTS, SHAFTS, EVENTS, DUTY, AXLE_NETCDF)
OF_DRIVES = (SUMMARY, EVENTS, SPECTRUM, DUTY, DRIVE_NETCDF)

# Run with moving roughness, its journal while it is not complete, with SQLite's file of a transaction, and
# changes that a kill of version 1.0.0 left unfinished.
MOTION, MOTION_JOURNAL, MOTION_CHANGES = "motion.nc", "motion.sqlite", ".motion.nc.redo"
OF_MOTION = (MOTION, f"{MOTION_JOURNAL}-journal", MOTION_JOURNAL, MOTION_CHANGES)

# Database of a sweep, and the files that are made from it.
SWEEP = "sweep.sqlite"
SWEEP_CSV, SWEEP_PARQUET, SWEEP_NETCDF = "sweep.csv", "sweep.parquet", "sweep.nc"
OF_SWEEPS = (SWEEP_CSV, SWEEP_PARQUET, SWEEP_NETCDF)

# Film factors that explain a measurement.
MEASURED, MEASURED_ROWS = "measured.json", "measured.csv"
OF_MEASUREMENTS = (MEASURED, MEASURED_ROWS)

# Measured next to computed values, and the case with updated ranges.
COMPARED, CALIBRATED = "compared.csv", "calibrated.toml"
OF_CALIBRATIONS = (SUMMARY, COMPARED, CALIBRATED)
