"""What CMake says of a Python that lacks what reports and studies import."""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
CMAKE = os.environ["MPM_CMAKE"]
SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
PROJECT = f"""cmake_minimum_required(VERSION 3.22)
project(newcomer LANGUAGES NONE)
include({ROOT}/cmake/python.cmake)
mpm_find_python(FOUND "json, sys" "reading")
mpm_find_python(LACKS "json, no_such_module, nor_this_one" "pictures")
"""


class FindPythonTest(unittest.TestCase):
    def configured(self, *options):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        (SCRATCH / "CMakeLists.txt").write_text(PROJECT)
        done = subprocess.run([CMAKE, "-S", SCRATCH, "-B", SCRATCH / "build", *options], text=True,
                              capture_output=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        cache = (SCRATCH / "build/CMakeCache.txt").read_text().splitlines()
        return done.stdout, dict(line.split(":FILEPATH=") for line in cache if ":FILEPATH=" in line)

    def test_one_that_has_all_is_taken_without_a_word(self):
        said, cache = self.configured(f"-DPython3_EXECUTABLE={sys.executable}")
        self.assertEqual(cache["FOUND"], sys.executable)
        self.assertNotIn("reading", said)

    def test_what_each_lacks_is_said_with_a_remedy(self):
        said, cache = self.configured(f"-DPython3_EXECUTABLE={sys.executable}")
        self.assertEqual(cache["LACKS"], "")
        self.assertIn("No pictures: no Python has all of json, no_such_module, nor_this_one", said)
        self.assertIn(f"{sys.executable} lacks no_such_module, nor_this_one\n", said)
        self.assertIn("jobscripts/install_packages.sh", said)
        self.assertIn("-DLACKS=FILE", said)

    def test_one_that_is_named_is_kept(self):
        said, cache = self.configured("-DLACKS=/some/python")
        self.assertEqual(cache["LACKS"], "/some/python")
        self.assertNotIn("No pictures", said)


if __name__ == "__main__":
    unittest.main()
