"""The README, as somebody who has nothing but it follows it to a first report of a picture of one's own, and the page
on which it sends those whose light is uneven."""
import os
import pathlib
import re
import shutil
import subprocess
import unittest

import pages

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
README = pages.PROJECT / "README.md"
QUICKSTART = pages.PROJECT / "jobscripts/quickstart.sh"
# Silent reading of English: 238 words a minute (Brysbaert 2019, J. Mem. Lang. 109:104047).
MOST_WORDS = 3 * 238
DRAWN = """seed: 4
picture: {width_px: 240, height_px: 180, width: 240, height: 180}
gray: {wall: 190, lumen: 55, noise: 8, shading: 12, blur: 2}
files:
  tangential_pitch: 30
  earlywood: {radial_pitch: 38, wall: 3.5}
"""


def section(title):
    return re.search(rf"^## {title}\n(.*?)(?=^## )", README.read_text(), re.M | re.S)[1]


class Readme(unittest.TestCase):
    def test_takes_three_minutes_to_read(self):
        shown = re.sub(r"\]\([^)]*\)", "]", pages.prose(README))  # without where links lead
        words = [word for word in shown.split() if re.search(r"\w", word)]
        self.assertLess(len(words), MOST_WORDS, "README.md: move what a newcomer can do without to docs")

    def test_names_programs_that_the_quick_start_has_built(self):
        target = re.search(r"^sh jobscripts/build\.sh --target (.*)$", QUICKSTART.read_text(), re.M)[1].split()
        launchers = {"mpm_report", "mpm_study"}  # made when the build is configured
        for page in README, pages.DOCS / "tutorial.md":
            named = set(re.findall(r"build/(\w+) ", page.read_text()))
            self.assertIn("mpm_par", named)
            self.assertLessEqual(named, {*target, *launchers}, page.name)

    def setUp(self):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        (SCRATCH / "build").symlink_to(os.environ["MPM_BUILD"])
        (SCRATCH / "jobscripts").symlink_to(pages.PROJECT / "jobscripts")
        (SCRATCH / "drawn.yaml").write_text(DRAWN)
        self.run_well("build/draw_wood drawn.yaml -o even.bmp")

    def run_well(self, script):
        done = subprocess.run(["sh", "-ec", script], cwd=SCRATCH, capture_output=True, text=True, timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def plan(self, picture):
        """Of a picture in the README's scene, by its own commands up to the run."""
        own = section("Your own micrograph")
        scene = re.search(r"^```yaml\n(.*?)^```", own, re.M | re.S)[1]
        (SCRATCH / "my_wood.yaml").write_text(re.sub(r"micrograph: \S+", f"micrograph: {picture}", scene))
        commands = re.search(r"^```sh\n(.*?)^```", own, re.M | re.S)[1].splitlines()
        self.assertEqual([line.split()[0] for line in commands], [".", "build/mpm_par", "mpirun"])
        return self.run_well("\n".join(commands[:2]))

    def density(self, picture):
        return float(re.search(r"picture +relative density (\S+)", self.plan(picture))[1])

    def test_its_scene_is_checked_without_a_warning(self):
        self.assertNotIn("warning", self.plan("even.bmp"))

    def test_lines_of_python_even_out_the_light(self):
        python = os.environ["MPM_REPORT_PYTHON"]
        if not python or subprocess.run([python, "-c", "import scipy"], capture_output=True).returncode:
            self.skipTest("no Python with Pillow and SciPy")
        lines = re.search(r"^```python\n(.*?)^```", (pages.DOCS / "micrographs.md").read_text(), re.M | re.S)[1]
        (SCRATCH / "even.py").write_text(lines)
        picture = bytearray((SCRATCH / "even.bmp").read_bytes())
        pixels = int.from_bytes(picture[10:14], "little")
        for place in range(pixels, len(picture)):  # rows of 240 bytes, one a pixel: light falls to 0.4
            picture[place] = round(picture[place] * (1 - 0.6 * ((place - pixels) % 240) / 240))
        (SCRATCH / "photo.png").write_bytes(picture)
        self.run_well(f"{python} even.py")
        even, uneven, mended = (self.density(name) for name in ("even.bmp", "photo.png", "my_wood.png"))
        self.assertLess(abs(mended - even), abs(uneven - even) / 4)


if __name__ == "__main__":
    unittest.main()
