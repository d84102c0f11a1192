"""Configuration of the documentation."""

from __future__ import annotations

import re
from importlib.metadata import version as installed_version

from sphinx.application import Sphinx
from sphinx.util.inspect import TypeAliasForwardRef

project = "magwire"
author = "The magwire authors"
copyright = "2026, The magwire authors"
version = release = installed_version("magwire")

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx-mathjax-offline",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "gallery/*.py", "gallery/*.ipynb", "gallery/*.md5"]
templates_path = ["_templates"]
nitpicky = False
# properties of several classes share a name, such as Result.field and Simulation.field
suppress_warnings = ["ref.python"]
language = "en-GB"

myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

autosummary_generate = True
autodoc_typehints = "signature"
# As the sources have them, not what numpy makes of them; in unions, too.
TypeAliasForwardRef.__repr__ = lambda alias: alias.name
autodoc_type_aliases = {name: name for name in ("ArrayLike", "Array", "Indices")}
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "show-inheritance": False}
numpydoc_class_members_toctree = False
numpydoc_show_class_members = False
numpydoc_xref_param_type = False

sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"plot_\w+\.py$",  # the others take a command line
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "min_reported_time": 1,
    "remove_config_comments": True,
    "abort_on_example_error": True,
}

# Norms in docstrings, such as |x - c|, would be taken for substitutions.
LITERALS = re.compile(r"(``.*?``)")


def escape_bars(
    app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]
) -> None:
    """Escape the bars of a docstring's text, but not those of its literals and examples."""
    for number, line in enumerate(lines):
        if "|" in line and not line.lstrip().startswith((">>>", "...", "|")):
            parts = LITERALS.split(line)
            parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
            lines[number] = "".join(parts)


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", escape_bars, priority=100)


html_theme = "furo"
html_title = "magwire"
html_static_path = ["_static"]
html_show_sourcelink = False
