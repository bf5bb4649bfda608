"""How the documentation is built: make docs."""

import os
import sys
import warnings
from importlib.util import find_spec
from pathlib import Path

from jinja2 import BaseLoader
from jinja2.sandbox import SandboxedEnvironment
from numpydoc import docscrape_sphinx

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

from ehlectric.version import __version__  # noqa: E402

project = "ehlectric"
author = "the ehlectric developers"
copyright = author
version = release = __version__

# make pages leaves out what takes minutes: scripts of the gallery, and figures and tables of solved cases.
WHOLE = os.environ.get("EHLECTRIC_PAGES") != "only"
COMPUTED = [
    *("example_figures", "kind_figures", "life_figures", "measured_figures", "oil_figures", "paper_tables"),
    "sheared_figures",
]


_environments: dict[type, SandboxedEnvironment] = {}


def _environment(loader: BaseLoader) -> SandboxedEnvironment:
    """Environment with the templates of numpydoc, one for all docstrings.

    numpydoc makes one for each docstring and compiles the templates anew, in a third of the time of a build.
    """
    if type(loader) not in _environments:
        _environments[type(loader)] = SandboxedEnvironment(loader=loader)
    return _environments[type(loader)]


docscrape_sphinx.SandboxedEnvironment = _environment

extensions = [
    *(COMPUTED if WHOLE else ["stand_ins"]),
    "architecture",
    "from_code",
    "licences",
    "myst_parser",
    "numpydoc",
    "sketches",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "_generated", "gallery", "**/README.md", "auto_gallery/**/*.ipynb"]
templates_path = ["_templates"]
nitpicky = True
smartquotes = False  # options of commands begin with two hyphens

# Pages.
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_dmath_double_inline = True

# Docstrings: the types stand in them in words.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True  # as written, not the value of a table of functions
autosummary_generate = True
numpydoc_show_class_members = False
nitpick_ignore_regex = [("py:class", r"pydantic\..*|pydantic_.*")]

# MathJax with its glyphs drawn as paths is one file, and so reads without a network and from a folder.
_MATHJAX = find_spec("sphinx-mathjax-offline")
assert _MATHJAX is not None, "sphinx-mathjax-offline is not installed"
html_static_path = ["_static", str(Path(_MATHJAX.origin or "").parent / "static" / "mathjax" / "tex-svg.js")]
mathjax_path = "tex-svg.js"
mathjax3_config = {"options": {"enableMenu": False}}

# The gallery: every example is run, and one that fails or warns ends the build.
warnings.filterwarnings("error", module="ehlectric")
sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "auto_gallery",
    "filename_pattern": r"/\d+_",
    "within_subsection_order": "FileNameSortKey",
    "reset_modules": ("matplotlib", "gallery_style.apply"),
    "image_scrapers": ("matplotlib", "gallery_style.last_figure"),
    "image_srcset": ["2x"],
    "remove_config_comments": True,
    "capture_repr": (),  # what is printed is shown, and no value besides
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "download_all_examples": False,
    "plot_gallery": WHOLE,
}

html_theme = "pydata_sphinx_theme"
html_title = f"ehlectric {release}"
html_extra_path = ["_generated/extra"]  # filled before anything is read
(HERE / "_generated" / "extra").mkdir(parents=True, exist_ok=True)
html_css_files = ["ehlectric.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "header_links_before_dropdown": 9,
    "navbar_persistent": ["search-button"],  # a field with a text would take a second row
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
    "show_toc_level": 2,
    "use_edit_page_button": False,
}
