"""The tutorial, as a newcomer follows it: its files are written, its commands run, its figures looked for."""
import os
import pathlib
import re
import shutil
import subprocess
import unittest

import pages

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
PAGE = pages.DOCS / "tutorial.md"
# What draws needs a Python with Matplotlib; what needs ParaView has a test of its own.
PYTHON = os.environ["MPM_REPORT_PYTHON"]
LEFT_OUT = ("xvfb-run",) if PYTHON else ("xvfb-run", "build/mpm_report", "build/mpm_study")


def blocks():
    """Kind and text of each block of code, in their order."""
    return re.findall(r"^```(yaml|sh)\n(.*?)^```", PAGE.read_text(), re.M | re.S)


def run(command):
    command = re.sub(r"^mpirun -n", " ".join((os.environ["MPM_MPIEXEC"],
                                               os.environ["MPM_NUMPROC_FLAG"])), command)
    return subprocess.run(["sh", "-ec", command], cwd=SCRATCH, capture_output=True, text=True,
                          timeout=600)


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        (SCRATCH / "build").symlink_to(os.environ["MPM_BUILD"])
        (SCRATCH / "jobscripts").symlink_to(pages.PROJECT / "jobscripts")
        cls.printed, cls.failed, cls.commands = {}, [], 0
        for kind, text in blocks():
            if kind == "yaml":
                name, _, content = text.partition("\n")
                (SCRATCH / name.removeprefix("# ")).write_text(content)
                continue
            for command in text.splitlines():
                if command.startswith(LEFT_OUT):
                    continue
                done = run(command)
                cls.commands += 1
                cls.printed[command] = done.stdout
                if done.returncode:
                    cls.failed.append(f"{command}\n{done.stdout}{done.stderr}")

    def test_every_command_ends_well(self):
        self.assertEqual(self.failed, [])
        self.assertGreaterEqual(self.commands, 6)

    def test_the_plan_is_the_one_that_the_page_shows(self):
        plan = self.printed["build/mpm_par --check my_wood.yaml --preview seen.png"].splitlines()
        shown = re.findall(r"^    (\w.*)$", PAGE.read_text(), re.M)
        self.assertGreater(len(shown), 4)
        for line in shown:
            if not line.startswith("steps"):  # vectors of another width round otherwise
                self.assertIn(line, [row.strip() for row in plan])

    def test_the_figures_are_those_that_the_page_names(self):
        page = PAGE.read_text()
        found = self.printed["build/mpm_curve results/my_wood/history.csv"]
        modulus = float(re.search(r"^modulus E +(\S+) ", found, re.M)[1])
        self.assertAlmostEqual(modulus / 1000, float(re.search(r"\*\*modulus\*\*, (\S+) GPa", page)[1]),
                               delta=0.06)
        stress, strain = re.search(r"^onset of buckling +(\S+) .* at (\S+) ", found, re.M).groups()
        named = re.search(r"\*\*onset of buckling\*\*, (\S+) MPa at (\S+) %", page)
        self.assertAlmostEqual(float(stress), float(named[1]), delta=3)
        self.assertAlmostEqual(float(strain), float(named[2]), delta=0.15)

    def test_the_curve_is_drawn(self):
        if not PYTHON:
            self.skipTest("no Python with Matplotlib")
        self.assertTrue((SCRATCH / "results/my_wood/report/curve.png").is_file())


if __name__ == "__main__":
    unittest.main()
