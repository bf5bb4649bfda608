"""What commands of ehlectric import when they need it: a process that has it loaded starts them at once."""

from importlib import import_module

NAMES = (
    "contourpy", "dask.array", "h5netcdf", "h5py", "jinja2", "matplotlib.animation",
    "matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf", "matplotlib.pyplot",
    "PIL.PngImagePlugin", "pint", "pyarrow.parquet", "rich.console", "rich.progress", "rich.table",
    "scipy.signal", "scipy.stats.qmc", "sqlite3", "xarray", "ehlectric.bearing.run",
    "ehlectric.cases.oil_report", "ehlectric.commands.command_line", "ehlectric.commands.draw_commands",
    "ehlectric.commands.oil_commands", "ehlectric.contact.run", "ehlectric.contact.run",
    "ehlectric.contact.solver", "ehlectric.drive.run", "ehlectric.drive.netlist",
    "ehlectric.figures.bearing_figure_files", "ehlectric.figures.contact_figure_files",
    "ehlectric.figures.animation", "ehlectric.figures.motion_figures", "ehlectric.figures.result_figures",
    "ehlectric.figures.surface_figures", "ehlectric.figures.sweep_figures", "ehlectric.figures.sweep_figures",
    "ehlectric.motion.run", "ehlectric.paper.reproduce", "ehlectric.report.build",
    "ehlectric.report.written_report",
    "ehlectric.report.pdf", "ehlectric.runs.by_kind", "ehlectric.runs.measured_film_factors",
    "ehlectric.runs.preview", "ehlectric.runs.solve", "ehlectric.surfaces.surface_files",
    "ehlectric.surfaces.surface_warnings", "ehlectric.sweep.run", "ehlectric.tables.bearing_tables",
    "ehlectric.tables.oil_tables", "ehlectric.tables.contact_tables", "ehlectric.tables.measured_tables",
    "ehlectric.tables.motion_tables", "ehlectric.tables.oil_tables", "ehlectric.tables.sweep_summary",
    "ehlectric.tables.surface_tables", "ehlectric.tables.sweep_summary",
)  # fmt: skip


def preload():
    """Import it all."""
    for name in NAMES:
        import_module(name)
