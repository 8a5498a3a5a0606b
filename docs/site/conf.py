"""Settings of the site. scripts/site/build.py writes the sources of its pages and calls Sphinx."""

import inspect
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted((ROOT / "scripts" / "site").glob("*.py"))
sys.path[:0] = [str(ROOT / "scripts" / "site"), str(ROOT / "build" / "python")]

import docstrings  # noqa: E402
import python_pages  # noqa: E402

project = "Koebe UV"
author = "The Koebe UV developers"
release = subprocess.check_output([ROOT / "scripts" / "version.sh"], text=True).strip()

extensions = ["myst_nb", "sphinx.ext.autodoc", "breathe", "sphinx_copybutton", "sphinx-mathjax-offline"]
exclude_patterns = ["code"]
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "dollarmath"]
nb_execution_mode = "off"
suppress_warnings = ["mystnb.unknown_mime_type"]

# Names of Python and labels must exist; names of other libraries have no page to lead to.
nitpicky = True
nitpick_ignore_regex = [("cpp:.*", ".*"), ("py:class", r"(numpy|np|collections|os|pathlib|typing)\..*")]

autodoc_typehints = "none"  # the docstrings give shapes and units
autodoc_member_order = "bysource"
maximum_signature_line_length = 80
toc_object_entries_show_parents = "hide"

breathe_projects = {"koebe": str(ROOT / "build" / "docs" / "doxygen" / "xml")}
breathe_default_project = "koebe"
breathe_show_include = False

html_theme = "furo"
html_title = f"Koebe UV {release}"
html_logo = html_favicon = "logo.svg"
html_static_path = ["style.css", "site.js"]
html_css_files = ["style.css"]
html_js_files = ["site.js"]
html_copy_source = False
html_show_sphinx = html_show_copyright = False
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"
copybutton_prompt_text = r">>> |\.\.\. "
copybutton_prompt_is_regexp = True
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#1d4e89", "color-brand-content": "#1d4e89"},
    "dark_css_variables": {"color-brand-primary": "#8ab8f0", "color-brand-content": "#8ab8f0"},
}


def write_docstring(app, what, name, obj, options, lines):
    """Brings a docstring of the package into the markup of the site."""
    if name.startswith("koebe."):
        results = python_pages.results(obj) if what == "function" else []
        plain = docstrings.plain(obj) or lines
        lines[:] = docstrings.converted(list(plain), what == "class", python_pages.PUBLIC, results)


def hide_arguments(app, what, name, obj, options, signature, returned):
    """Leaves out the arguments of classes that only the package makes."""
    if inspect.isclass(obj) and name.removeprefix("koebe.") not in python_pages.CALLED:
        return "", None
    return signature, returned


def setup(app):
    app.add_config_value("site_scripts", b"".join(path.read_bytes() for path in SCRIPTS), "env")  # reads all again
    app.connect("autodoc-process-docstring", write_docstring)
    app.connect("autodoc-process-signature", hide_arguments)
