"""Every link within README and docs leads somewhere, and nothing is left out of the pages that list."""
import pathlib
import tempfile
import unittest

import pages

INPUTS = pages.PROJECT / "inputs"


class Links(unittest.TestCase):
    def test_of_all_pages_lead_to_files_and_headings_that_are_there(self):
        looked_at = 0
        for page in pages.ALL_PAGES:
            for link in pages.links(page):
                looked_at += 1
                wrong = pages.defect(page, link)
                self.assertIsNone(wrong, f"{page.relative_to(pages.PROJECT)}: {link}: {wrong}")
        self.assertGreater(looked_at, 100)

    def test_wrong_ones_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name).resolve()
            page = folder / "page.md"
            page.write_text("# One title\n\n## One (2)\n\n## One 2\n\n```\n# no title\n```\n")
            self.assertEqual(pages.anchors(page), ["one-title", "one-2", "one-2-1"])
            for link, wrong in (("other.md", "file"), ("#two", "heading"), ("#no-title", "heading"),
                                ("page.md#one-3", "heading"), ("/", "out of")):
                self.assertIn(wrong, pages.defect(page, link, folder) or "", link)
            for good in ("#one-2-1", "page.md#one-title", "https://a.b/c"):
                self.assertIsNone(pages.defect(page, good, folder), good)

    def test_the_index_names_every_page(self):
        index = pages.DOCS / "index.md"
        named = {(pages.DOCS / link.partition("#")[0]).resolve() for link in pages.links(index)}
        for page in sorted(pages.DOCS.glob("*.md")):
            self.assertIn(page, named | {index},
                          f"docs/index.md has no link to {page.name}. Add one where readers look.")

    def test_every_shipped_scene_has_its_section(self):
        sections = set(pages.headings(pages.DOCS / "scenes.md"))
        scenes = {path.relative_to(INPUTS).as_posix() for path in INPUTS.rglob("*.yaml")}
        self.assertGreater(len(scenes), 10)
        for scene in sorted(scenes):
            self.assertIn(scene, sections, f"docs/scenes.md has no section '### {scene}'. Say what "
                                           "it shows, how long it takes and what to look at.")
        for title in sections:
            if title.endswith(".yaml"):
                self.assertIn(title, scenes, "docs/scenes.md: there is no such scene")


if __name__ == "__main__":
    unittest.main()
