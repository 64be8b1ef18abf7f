"""The pages as HTML: made without a warning, complete, and readable without a network."""
import html.parser
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import pages

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
DOCS_SH = pages.PROJECT / "jobscripts" / "docs.sh"


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.loaded, self.ids = [], [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.add(given.get("id"))
        if tag == "a":
            self.links.append(given.get("href") or "")
        elif tag in ("script", "img") and given.get("src"):
            self.loaded.append(given["src"])
        elif tag == "link" and given.get("rel") in ("stylesheet", "icon", "preload"):
            self.loaded.append(given["href"])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        run = subprocess.run(["sh", DOCS_SH, SCRATCH / "site"], capture_output=True, text=True)
        if run.returncode == 2:
            print("skipped: " + run.stderr.strip())
            sys.exit(0)
        cls.run_of_all = run
        cls.html = SCRATCH / "site" / "html"

    def test_is_made_without_a_warning(self):
        self.assertEqual(self.run_of_all.returncode, 0, self.run_of_all.stderr)
        self.assertEqual(self.run_of_all.stderr, "")

    def test_has_every_page_and_leads_to_it_from_the_first(self):
        first = Page(self.html / "index.html")
        for page in pages.DOCS.rglob("*.md"):
            name = page.relative_to(pages.DOCS).with_suffix(".html").as_posix()
            self.assertTrue((self.html / name).is_file(), name)
            if page.parent == pages.DOCS and name != "index.html":
                self.assertIn(name, first.links)

    def test_loads_nothing_from_elsewhere_and_all_links_lead_somewhere(self):
        parsed = {file: Page(file) for file in self.html.rglob("*.html")}
        self.assertGreater(len(parsed), 20)
        for file, page in parsed.items():
            for address in page.loaded:
                self.assertIsNone(re.match(r"(\w+:)?//", address), f"{file.name} loads {address}")
                self.assertTrue((file.parent / address.partition("?")[0]).is_file(), address)
            for address in page.links:
                path, _, anchor = address.partition("#")
                target = (file.parent / path).resolve() if path else file
                if re.match(r"\w+:", address) or target not in parsed:
                    self.assertTrue(re.match(r"\w+:", address) or target.exists(),
                                    f"{file.name}: {address}")
                elif anchor:
                    self.assertIn(anchor, parsed[target].ids, f"{file.name}: {address}")

    def test_a_broken_link_is_an_error(self):
        source = SCRATCH / "broken"
        shutil.copytree(pages.PROJECT / "jobscripts", source / "jobscripts")
        (source / "docs").mkdir()
        shutil.copy(pages.DOCS / "conf.py", source / "docs")
        shutil.copytree(pages.DOCS / "style", source / "docs" / "style")
        index = source / "docs" / "index.md"
        index.write_text("# Pages\n\n## First\n\n- [one](one.md)\n")
        one = source / "docs" / "one.md"
        for text, status in (("# One\n\n[first](#one)\n", 0), ("# One\n\n[none](none.md)\n", 1),
                             ("# One\n\n[none](#none)\n", 1)):
            one.write_text(text)
            run = subprocess.run(["sh", source / "jobscripts/docs.sh", SCRATCH / "broken_site"],
                                 capture_output=True, text=True)
            self.assertEqual(run.returncode, status, text + run.stderr)


if __name__ == "__main__":
    unittest.main()
