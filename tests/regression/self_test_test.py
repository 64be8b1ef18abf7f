"""mpm_par --self-test: what it says, on several ranks, of what is right and of what is wrong."""
import os
import pathlib
import re
import subprocess
import unittest

from program import ProgramTest, mpm_par, seconds

CHECKS = ["one MPI world", "cores", "messages", "folder", "HDF5", "updated step", "total step",
          "checkpoint", "speed"]
PAGE = pathlib.Path(__file__).parents[2] / "docs" / "performance.md"


class SelfTest(ProgramTest):
    def outcomes(self, run):
        return re.findall(r"^  (passed|FAILED)  (.{14})(.*(?:\n {24}.*)*)$", run.stdout, re.M)

    def alone(self, **environment):
        """Processes without a launcher."""
        return subprocess.run([os.environ["MPM_PAR"], "--self-test"], cwd=self.folder, text=True,
                              capture_output=True, env={**os.environ, **environment}, timeout=seconds(120))

    def test_passes_and_leaves_nothing_behind(self):
        for ranks in 1, 2, 3:
            run = mpm_par("--self-test", "--output", "a/new", ranks=ranks, folder=self.folder)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertEqual([name.strip() for _, name, _ in self.outcomes(run)], CHECKS)
            self.assertNotIn("FAILED", run.stdout)
            for line in run.stdout.splitlines():
                self.assertLessEqual(len(line), 80, line)
            self.assertIn(f"{ranks} rank", run.stdout.splitlines()[0])
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_compares_with_the_page_on_performance(self):
        found = dict((name.strip(), words) for _, name, words in self.outcomes(self.alone()))
        said = re.search(r"([\d.]+) in docs/performance.md", " ".join(found["speed"].split()))[1]
        documented = re.search(r"^\| block gimp \| ([\d.]+) \| ns", PAGE.read_text(), re.M)[1]
        self.assertEqual(said, documented)

    def test_finds_worlds_that_do_not_know_each_other(self):
        """As where the mpirun of another MPI has started them."""
        first, second = (self.alone(PMI_SIZE="2", PMI_RANK=rank) for rank in "01")
        self.assertEqual((first.returncode, second.returncode), (1, 1))
        self.assertEqual(second.stdout + second.stderr, "")
        self.assertEqual([outcome for outcome, *_ in self.outcomes(first)], ["FAILED"])
        words = " ".join(first.stdout.split())
        self.assertIn("has started 2 processes, and MPI joins 1 of them", words)
        self.assertIn("--mpi=pmix", words)

    def test_says_that_a_folder_cannot_be_written(self):
        (self.folder / "plain").write_text("a file")
        for more in [], ["--quiet"]:
            run = mpm_par("--self-test", "-o", "plain", *more, ranks=2, folder=self.folder)
            self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
            said = run.stderr if more else run.stdout
            self.assertEqual(said.count("FAILED"), 1)
            self.assertIn("--output", said)
            self.assertEqual(run.stdout == "", bool(more))
        self.assertEqual((self.folder / "plain").read_text(), "a file")

    def test_is_silent_if_all_is_well_and_quiet(self):
        run = mpm_par("--self-test", "--quiet", ranks=2, folder=self.folder)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))


if __name__ == "__main__":
    unittest.main()
