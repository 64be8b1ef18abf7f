"""The Markdown of README and docs: headings, their anchors as forges make them, and links."""
import pathlib
import re

PROJECT = pathlib.Path(__file__).parents[2]
DOCS = PROJECT / "docs"
ALL_PAGES = [PROJECT / "README.md", *sorted(DOCS.rglob("*.md"))]

CODE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
SPAN = re.compile(r"`[^`\n]+`")
LINK = re.compile(r"!?\[[^\]]*\]\(([^()\s]+)\)")


def prose(page):
    return CODE.sub("", page.read_text())


def headings(page):
    """Titles of all levels, without their marks."""
    return [line.lstrip("#").strip() for line in prose(page).splitlines()
            if re.match(r"#{1,6} ", line)]


def anchors(page):
    """A title in small letters, without punctuation, with - for spaces; -1, -2 for repeated ones."""
    found = []
    for title in headings(page):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title)
        anchor = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        repeated = sum(other == anchor or re.fullmatch(re.escape(anchor) + r"-\d+", other) is not None
                       for other in found)
        found.append(f"{anchor}-{repeated}" if repeated else anchor)
    return found


def links(page):
    return LINK.findall(SPAN.sub("", prose(page)))


def defect(page, link, root=PROJECT):
    """What is wrong with a link of a page; nothing for a good one, or one to another site."""
    if re.match(r"\w+:", link):
        return None
    path, _, anchor = link.partition("#")
    target = (page.parent / path).resolve() if path else page
    if not target.exists():
        return "there is no such file"
    if root not in target.parents:
        return "it leads out of the project"
    if anchor and (target.suffix != ".md" or anchor not in anchors(target)):
        return "there is no such heading"
    return None
