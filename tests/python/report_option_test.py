"""mpm_par --report: the page is there when the run is over, and the run's status is its own."""
import os
import unittest

import needed

needed.modules("numpy", "h5py", "yaml", "matplotlib", "PIL")

from program import ProgramTest, mpm_par, scene, set_options  # noqa: E402

QUICK = set_options(["steps=60", "output.history_lines=5", "output.snapshots=0"])


class ReportOption(ProgramTest):
    def run_it(self, *words, ranks=2, of="confined_block", report=None):
        if report is not None:
            os.environ["MPM_REPORT"] = str(report)
            self.addCleanup(os.environ.pop, "MPM_REPORT", None)
        return mpm_par(scene(of), "--output", self.folder / "results", "--report", *words,
                       ranks=ranks)

    def page(self):
        return (self.folder / "results" / "report.html").read_text()

    def test_leaves_a_page_on_any_number_of_ranks(self):
        for ranks in 1, 2:
            run = self.run_it(*QUICK, "--overwrite", ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(run.stdout.count("report in "), 1, run.stdout)
            self.assertIn("Uniform block", self.page())

    def test_a_failed_and_an_interrupted_run_keep_their_status(self):
        run = self.run_it("--set", "output.snapshots=3", of="fast_disc")
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("left the grid", self.page())
        run = self.run_it("--overwrite", "--time-limit", "1 us", of="honeycomb")
        self.assertEqual(run.returncode, 75, run.stderr)
        self.assertIn("the time limit was reached", self.page())

    def test_bad_input_leaves_nothing(self):
        run = self.run_it("--set", "grid.cells=[0, 0]")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertFalse((self.folder / "results").exists())
        run = self.run_it("--check")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("--report is of a run, and --check leaves none", run.stderr)

    def test_whatever_becomes_of_the_report_the_status_is_the_runs(self):
        failing = self.folder / "failing"
        failing.write_text("#!/bin/sh\nexit 9\n")
        killed = self.folder / "killed"
        killed.write_text("#!/bin/sh\nkill -9 $$\n")
        for program in failing, killed:
            program.chmod(0o755)
        for program, said in ((self.folder / "none", "No such file or directory"), (failing, None),
                              (killed, "ended by signal 9")):
            run = self.run_it(*QUICK, "--overwrite", report=program)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual("no report: " in run.stderr, said is not None, run.stderr)
            self.assertIn(said or "", run.stderr)
            self.assertTrue((self.folder / "results" / "summary.json").exists())

    def test_the_report_program_is_told_nothing_of_ranks(self):
        spy = self.folder / "spy"
        spy.write_text(f'#!/bin/sh\nenv > "{self.folder}/environment"\necho "$@"\n')
        spy.chmod(0o755)
        run = self.run_it(*QUICK, report=spy)
        self.assertIn(f"{self.folder}/results\n", run.stdout)
        lines = (self.folder / "environment").read_text().split("\n")
        names = {line.split("=")[0] for line in lines}
        self.assertIn("PATH", names)
        self.assertFalse([name for name in names if name.startswith(("OMPI_", "PMIX_", "PMI_"))])

    def test_overwrite_and_restart_take_the_page_away(self):
        self.run_it(*QUICK)
        mine = self.folder / "results" / "report" / "notes.txt"
        mine.write_text("mine")
        words = scene("confined_block"), "--output", self.folder / "results", *QUICK
        run = mpm_par(*words, "--overwrite")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertFalse((self.folder / "results" / "report.html").exists())
        self.assertEqual([path.name for path in mine.parent.iterdir()], ["notes.txt"])
        self.run_it("--overwrite", "--time-limit", "1 us", of="honeycomb")
        self.assertIn("did not reach its end", self.page())
        run = mpm_par(scene("honeycomb"), "--output", self.folder / "results", "--restart",
                      "--time-limit", "1 us")
        self.assertEqual(run.returncode, 75, run.stderr)
        self.assertFalse((self.folder / "results" / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
