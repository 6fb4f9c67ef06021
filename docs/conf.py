"""How Sphinx makes the site from docs/. `script/docs` calls it."""

import importlib.util
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent
sys.path.insert(0, str(HERE / "_ext"))

from counts import counts  # noqa: E402

project = "stickslip"
author = "The stickslip authors"
copyright = author
release = re.search(
    r"project\(\s*stickslip\s+VERSION\s+([0-9.]+)",
    (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"),
)[1]
version = release

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "breathe",
    "equations",  # these are ours, in _ext
    "docstrings",
    "names",
    "headers",
    "tables",
]
exclude_patterns = ["_ext", "thesis"]  # gallery.md includes the latter
nitpicky = True
default_role = "literal"
smartquotes_action = "D"  # dashes alone: x'' is a second derivative, not a quotation
highlight_language = "none"

# Pages are Markdown that reads on a forge too: ```math is a formula, \tag{5.34} its number.
myst_enable_extensions = ["dollarmath", "substitution"]
myst_substitutions = counts()  # {{ cpp_tests }}
myst_fence_as_directive = ["math"]
myst_heading_anchors = 3
myst_update_mathjax = False  # it would seem to be another configuration at each run

# Python, from the installed package.
autodoc_member_order = "groupwise"
autodoc_typehints_format = "short"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_preprocess_types = False

# C++, from what Doxygen wrote (docs/Doxyfile).
breathe_projects = {"stickslip": str(ROOT / "build" / "docs" / "doxygen" / "xml")}
breathe_default_project = "stickslip"
breathe_domain_by_extension = {"hpp": "cpp"}
breathe_show_include = False
cpp_maximum_signature_line_length = 88
# Nothing is known here of the standard library, and template parameters are nowhere declared.
nitpick_ignore_regex = [("cpp:.*", ".*")]

html_theme = "furo"
html_title = f"stickslip {release}"
html_static_path = ["_static"]
# The page that slides records, if script/web built it.
if (ROOT / "build" / "web" / "stickslip.html").exists():
    html_extra_path = ["../build/web/stickslip.html"]
    tags.add("page")  # noqa: F821, which Sphinx defines
html_copy_source = False
html_show_sourcelink = False
html_permalinks_icon = "#"

# Formulas are set by MathJax, from a Python package: nothing is loaded from outside. As SVG, which
# needs no font files: browsers refuse those to pages that are opened from a disk. MathML made at
# build time needs no script, but where no mathematical font is installed it reads badly.
mathjax_package = Path(importlib.util.find_spec("sphinx-mathjax-offline").origin).parent
mathjax_path = "mathjax/tex-svg.js"
mathjax3_config = {
    "tex": {"tags": "none"},
    "svg": {"displayAlign": "center"},
    "options": {"enableMenu": False, "processHtmlClass": "math"},
}


def copy_mathjax(app, error):
    if error is None and app.builder.format == "html":
        source = mathjax_package / "static" / "mathjax" / "tex-svg.js"
        target = Path(app.outdir) / "_static" / mathjax_path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(source.read_bytes())


def setup(app):
    app.add_css_file("site.css")
    app.connect("build-finished", copy_mathjax)
