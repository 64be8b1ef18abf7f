"""What is wrong with options and folders is folded at 80 columns on a terminal, and nowhere else."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import needed

needed.modules("numpy", "h5py", "yaml")

from mpm_par.problems import WIDTH, folded  # noqa: E402
from terminal import on_terminal  # noqa: E402

STUDY = pathlib.Path(__file__).parents[2] / "src" / "study" / "mpm_study.py"
COMMANDS = [["-m", "mpm_par", "nowhere"], ["-m", "mpm_par.report", "nowhere"], [STUDY, "nowhere.yaml", "-o", "out"]]
UNKNOWN = [f"--{word}" for word in "an option that none of these commands has heard of in all its days and years".split()]


class Problems(unittest.TestCase):
    def setUp(self):
        os.environ["COLUMNS"] = str(WIDTH)  # of the usage, which argparse folds by it

    def test_options(self):
        with tempfile.TemporaryDirectory() as folder:
            for words in COMMANDS:
                command = [sys.executable, *map(str, words), *UNKNOWN]
                piped = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                status, shown = on_terminal(command, folder)
                self.assertEqual((piped.returncode, status), (2, 2), piped.stderr)
                (message,) = [line for line in piped.stderr.splitlines() if "error: " in line]
                self.assertGreater(len(message), WIDTH)
                self.assertIn(message, shown.replace("\n    ", " "))
                self.assertLessEqual(max(map(len, shown.splitlines())), WIDTH, shown)

    def test_lines_are_no_longer_than_the_terminal(self):
        text = "word " * 40 + "and " + "x" * 100
        lines = folded(text, "  ", "    ").split("\n")
        self.assertEqual(" ".join(line.strip() for line in lines), text)
        self.assertEqual([len(line) > WIDTH for line in lines], [False] * (len(lines) - 1) + [True])
        self.assertTrue(lines[0].startswith("  w") and lines[1].startswith("    w"))

    def test_a_number_stays_with_its_unit(self):
        for length in range(60, 80):
            self.assertIn(" 15 %", folded("x" * length + " 15 % of it", others=" "))

    def test_what_fits_is_left_as_it_is(self):
        self.assertEqual(folded("one\n  two  blanks\n"), "one\n  two  blanks\n")


if __name__ == "__main__":
    unittest.main()
