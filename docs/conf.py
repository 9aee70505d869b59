"""How the documentation is built: `make docs`."""

import sys
from importlib.metadata import version as version_of
from importlib.resources import files
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx_gallery.scrapers import figure_rst

import cfree

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from live_links import fragment  # noqa: E402
from notebooks import notebooks  # noqa: E402

project = "cfree"
author = "The cfree developers"
release = version = version_of("cfree")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx-mathjax-offline",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["_build", "gallery/GALLERY_HEADER.rst", "**/sg_execution_times.rst"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
# links to files of the repository that are no pages; names of arguments taken for types
suppress_warnings = ["myst.xref_missing", "ref.python", "config.cache"]
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autosummary_generate = True
napoleon_google_docstring = False

PAGES = Path(__file__).with_name("gallery") / "pages"
FRAME = """
.. raw:: html

   <div class="cfree-page">
   <iframe src="../_static/{name}" title="Robot, obstacles and configuration space" loading="lazy"></iframe>
   </div>

"""


def scrape_page(block: Any, block_vars: Any, gallery_conf: Any) -> str:
    """The page of a block of a tutorial: what it calls `page`, to be dragged in."""
    page = block_vars["example_globals"].pop("page", None)
    if page is None:
        return ""
    PAGES.mkdir(exist_ok=True)
    name = f"{Path(block_vars['src_file']).stem}_{block[2]}.html"
    (PAGES / name).write_text(page, encoding="utf-8")
    return FRAME.format(name=name)


def write_pages(app: Any, fault: Exception | None) -> None:
    """What frames show, where they look for it."""
    static = Path(app.outdir) / "_static"
    (static / "page.html").write_bytes(files("cfree.viewer").joinpath("page.html").read_bytes())
    for page in PAGES.glob("*.html"):
        (static / page.name).write_bytes(page.read_bytes())


class Live(Directive):
    """The page with a scene of the repository open, and a link to it alone."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the frame and the link."""
        scene = cfree.load_scene(ROOT / self.arguments[0])
        up = "../" * self.state.document.settings.env.docname.count("/")
        address = f"{up}_static/page.html{fragment(scene)}"
        frame = f'<iframe src="{address}" title="Robot, obstacles and configuration space" loading="lazy"></iframe>'
        link = f'<p><a href="{address}">Open {scene.name} as a page of its own</a></p>'
        return [nodes.raw("", f'<div class="cfree-page">{frame}</div>{link}', format="html")]


def write_notebooks(app: Any) -> None:
    """Offer the notebooks of the repository for download: in those of sphinx-gallery no picture is shown."""
    for name, text in notebooks().items():
        (Path(app.srcdir) / "gallery" / f"plot_{name}").write_text(text, encoding="utf-8")


def setup(app: Any) -> None:
    """As Sphinx calls it."""
    app.add_directive("live", Live)
    app.connect("builder-inited", write_notebooks, priority=900)  # after the gallery's own
    app.connect("build-finished", write_pages)


def scrape_figure(block: Any, block_vars: Any, gallery_conf: Any) -> str:
    """The picture of a block of a tutorial: what it calls `figure`."""
    figure = block_vars["example_globals"].pop("figure", None)
    if figure is None:
        return ""
    path = next(block_vars["image_path_iterator"])
    figure.savefig(path, dpi=110)
    return str(figure_rst([path], gallery_conf["src_dir"]))


sphinx_gallery_conf = {
    "image_scrapers": [scrape_figure, scrape_page],
    "examples_dirs": ["../examples/gallery"],
    "gallery_dirs": ["gallery"],
    "filename_pattern": r"\.py$",
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,  # a page with scripts from elsewhere
    "min_reported_time": 1e9,
    "download_all_examples": False,
    "abort_on_example_error": True,
}

html_theme = "furo"
html_title = "cfree"
html_static_path = ["page.css"]
html_css_files = ["page.css"]
