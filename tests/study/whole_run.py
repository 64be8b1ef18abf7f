"""mpm_study as a user starts it."""
import os
import pathlib
import shutil
import subprocess
import unittest

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])

# 4 x 16 cells: a run takes a twentieth of a second.
BLOCK = """\
material: {law: isotropic, youngs_modulus: 50 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 0.25 mm]
  shapes:
    - box: {lower: [0 mm, 0 mm], upper: [1 mm, 0.25 mm]}
grid: {cells: [16, 4]}
loading: {piston: right, speed: 10 m/s, strain: 4 %}
output: {history_lines: 100, snapshots: 0}
"""


def mpm_study(*words, **more):
    return subprocess.run([os.environ["MPM_STUDY"], *map(str, words)], capture_output=True,
                          text=True, timeout=300, **more)


class WholeRun(unittest.TestCase):
    """Each test has a folder of its own, empty when it starts."""

    def setUp(self):
        self.folder = SCRATCH / self.id().split(".", 1)[1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        (self.folder / "block.yaml").write_text(BLOCK)

    def good(self, *words):
        run = mpm_study(*words)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run.stdout
