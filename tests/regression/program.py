"""mpm_par as a user starts it, and what it leaves behind."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from patience import seconds  # noqa: E402
from scene_run import set_options  # noqa: E402

SCENES = pathlib.Path(__file__).parent / "scenes"


def command_of(arguments, ranks):
    """On one rank without the launcher, which takes its time and would stand between the program and signals."""
    launcher = [os.environ["MPM_MPIEXEC"], os.environ["MPM_NUMPROC_FLAG"], str(ranks)] if ranks > 1 else []
    return [*launcher, os.environ["MPM_PAR"], *map(str, arguments)]


def mpm_par(*arguments, ranks=1, folder=None, timeout=240):
    """Runs to the end; `folder` is where it is started."""
    return subprocess.run(command_of(arguments, ranks), cwd=folder, capture_output=True, text=True,
                          timeout=seconds(timeout))


def unfolded(text):
    """A plan, and what follows it, with the lines in one that were folded at 80 columns."""
    return text.replace("\n" + 21 * " ", " ")


def start(*arguments, ranks=1):
    """A run that goes on meanwhile."""
    return subprocess.Popen(command_of(arguments, ranks), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True)


def scene(name):
    return SCENES / f"{name}.yaml"


class History:
    """history.csv by column name; units are left away."""

    def __init__(self, folder):
        with open(pathlib.Path(folder) / "history.csv", newline="") as file:
            lines = list(csv.reader(file))
        self.names = [cell.split(" [")[0] for cell in lines[0]]
        self.rows = [[float(cell) for cell in line] for line in lines[1:]]

    def __getitem__(self, name):
        column = self.names.index(name)
        return [row[column] for row in self.rows]

    def __len__(self):
        return len(self.rows)


def summary(folder):
    with open(pathlib.Path(folder) / "summary.json") as file:
        return json.load(file)


class ProgramTest(unittest.TestCase):
    """Each test has a folder of its own, empty when it starts."""

    def setUp(self):
        self.folder = pathlib.Path(os.environ["MPM_SCRATCH"]) / self.id().split(".", 1)[1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def wait_for(self, happens, what):
        end = time.monotonic() + seconds(30)
        while not happens():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.01)

    def results(self, scene_name, *settings, ranks=1, label="results"):
        """Runs a scene that must end well; returns its folder of results, without those of an earlier run."""
        folder = self.folder / label
        run = mpm_par(scene(scene_name), "--output", folder, "--overwrite", *set_options(settings),
                      ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return folder
