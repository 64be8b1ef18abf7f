"""mpm_study as a user starts it."""
import os
import pathlib
import shutil
import subprocess
import unittest

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])

# 4 x 16 cells: a run takes a twentieth of a second.
BLOCK = pathlib.Path(__file__).parents[1] / "support" / "block.yaml"


def mpm_study(*words, **more):
    return subprocess.run([os.environ["MPM_STUDY"], *map(str, words)], capture_output=True,
                          text=True, timeout=300, **more)


class WholeRun(unittest.TestCase):
    """Each test has a folder of its own, empty when it starts."""

    def setUp(self):
        self.folder = SCRATCH / self.id().split(".", 1)[1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        shutil.copy(BLOCK, self.folder)

    def good(self, *words):
        run = mpm_study(*words)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run.stdout
