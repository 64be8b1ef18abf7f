"""How Sphinx makes the pages of this folder into HTML: sh jobscripts/docs.sh.

The pages are plain Markdown that reads as well without Sphinx. Their order is that of the links on
index.md, where tests/documentation/links_test.py asks for every page of this folder; a page also
leads to those in the folder of its name, and a README to those beside it.
"""
import pathlib
import re

DOCS = pathlib.Path(__file__).parent

project = "mpm_par"
extensions = ["myst_parser"]
root_doc = "index"
myst_heading_anchors = 6
html_theme = "furo"
html_title = "mpm_par"
html_static_path = ["style"]
html_css_files = ["pages.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False


def toctree(pages, caption=""):
    lines = ["", "```{toctree}", ":hidden:"]
    if caption:
        lines.append(f":caption: {caption}")
    return "\n".join([*lines, "", *pages, "```", ""])


def sections(text):
    """Each heading of the second level with the pages that its links lead to."""
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        title, _, body = part.partition("\n")
        yield title, re.findall(r"\]\(([\w/]+)\.md\)", body)


def pages_below(page):
    file = DOCS / page
    folder = file.parent if file.name == "README" else file
    if not folder.is_dir():
        return []
    others = sorted(other.stem for other in folder.glob("*.md") if other.name != "README.md")
    prefix = "" if folder == file.parent else f"{file.name}/"
    return [prefix + other for other in (reversed(others) if not prefix else others)]


def lead_on(app, page, source):
    if page == root_doc:
        source[0] += "".join(toctree(pages, title) for title, pages in sections(source[0]))
    elif pages_below(page):
        source[0] += toctree(pages_below(page))


def setup(app):
    app.connect("source-read", lead_on)
