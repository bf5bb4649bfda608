"""What commands of ehlectric import when they need it: a process that has it loaded starts them at once."""

from importlib import import_module

NAMES = (
    "contourpy", "dask.array", "h5netcdf", "h5py", "jinja2", "matplotlib.animation",
    "matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf", "matplotlib.pyplot",
    "PIL.PngImagePlugin", "pint", "pyarrow.parquet", "rich.console", "rich.progress", "rich.table",
    "scipy.signal", "scipy.stats.qmc", "sqlite3", "xarray", "ehlectric.bearing.files",
    "ehlectric.cases.oils.survey", "ehlectric.commands.app", "ehlectric.commands.drawing",
    "ehlectric.commands.library.oils", "ehlectric.contact.files", "ehlectric.contact.run",
    "ehlectric.contact.solver", "ehlectric.drive.files", "ehlectric.drive.spice.bench",
    "ehlectric.figures.bearing.save", "ehlectric.figures.contact.save",
    "ehlectric.figures.motion.animation", "ehlectric.figures.motion.save", "ehlectric.figures.results",
    "ehlectric.figures.surface", "ehlectric.figures.sweep.save", "ehlectric.figures.sweep.sensitivity",
    "ehlectric.motion.run", "ehlectric.paper.reproduce", "ehlectric.report.build", "ehlectric.report.files",
    "ehlectric.report.pdf", "ehlectric.runs.by_kind", "ehlectric.runs.film_factors",
    "ehlectric.runs.meaning", "ehlectric.runs.results", "ehlectric.surfaces.files",
    "ehlectric.surfaces.summits", "ehlectric.sweep.run", "ehlectric.tables.bearing",
    "ehlectric.tables.catalogue", "ehlectric.tables.contact", "ehlectric.tables.measured",
    "ehlectric.tables.motion", "ehlectric.tables.oils", "ehlectric.tables.sensitivity",
    "ehlectric.tables.surface", "ehlectric.tables.sweep",
)  # fmt: skip


def preload():
    """Import it all."""
    for name in NAMES:
        import_module(name)
