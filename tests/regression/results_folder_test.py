"""What a run does with a folder that is not empty: nothing of another run or of the user's own is lost
without being asked for, and nothing of two runs is mixed."""
import os
import pathlib
import shutil
import signal
import unittest

from program import ProgramTest, mpm_par, seconds, set_options, start
from same_results import all_of, expect_same

WHOLE = ["output.history_lines=4"]
QUICK = [*WHOLE, "steps=40"]
# Long enough to be met on its way.
LASTING = ["grid.cells=[64, 8]", "output.history_lines=50", "output.checkpoints={steps: 20}"]
OF_A_RUN = ["exact_solution.csv", "history.csv", "report.html", "scene.yaml", "specimen.png", "summary.json"]


class ResultsFolder(ProgramTest):
    def setUp(self):
        super().setUp()
        self.results_of_first = self.folder / "results"
        self.bar = pathlib.Path(__file__).parents[2] / "inputs" / "benchmarks" / "vibrating_bar.yaml"

    def run_it(self, *words, ranks=1, file=None, output=None, settings=QUICK):
        return mpm_par(file or self.bar, "--output", output or self.results_of_first,
                       *set_options(settings), *words, ranks=ranks)

    def good(self, *words, **more):
        run = self.run_it(*words, **more)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run

    def refused(self, *words, **more):
        run = self.run_it(*words, **more)
        self.assertEqual(run.returncode, 2, run.stderr + run.stdout)
        message, *rest = run.stderr.strip().splitlines()
        self.assertTrue(not rest or set(rest[0]) == {"-"}, f"more than the launcher's own: {run.stderr}")
        return message

    def test_results_of_another_run_stay_unless_told_otherwise(self):
        self.good()
        before = all_of(self.results_of_first)
        for ranks in 1, 2:
            self.assertIn("holds the results of a run. Replace them with --overwrite, go on with that run "
                          "with --restart, or choose another folder with --output.",
                          self.refused(ranks=ranks))
        self.assertEqual(all_of(self.results_of_first), before)
        for name in OF_A_RUN:
            alone = self.folder / name.replace(".", "_")
            alone.mkdir()
            (alone / name).write_text("something")
            self.refused(output=alone)
            self.assertEqual(all_of(alone), {name: b"something"})

    def test_states_and_pictures_of_another_run_stay_as_well(self):
        self.good(settings=[*WHOLE, "output.snapshots=3"])
        folder = self.results_of_first
        for name in [path.name for path in folder.iterdir() if path.is_file() and path.suffix != ".xdmf"]:
            (folder / name).unlink()
        before = all_of(folder)
        self.assertIn("holds the results of a run", self.refused())
        for path in folder.glob("*.xdmf"):
            path.unlink()
        self.assertIn("holds the results of a run", self.refused())
        self.assertEqual(set(all_of(folder)) | {name for name in before if name.endswith(".xdmf")}, set(before))
        self.good("--overwrite", settings=[*WHOLE, "output.snapshots=0"])
        self.assertFalse((folder / "snapshots").exists())

    def test_check_needs_no_folder(self):
        self.good()
        before = all_of(self.results_of_first)
        self.good("--check")
        self.assertEqual(all_of(self.results_of_first), before)

    def test_overwrite_takes_away_what_was_of_the_other_run_and_nothing_else(self):
        self.good(settings=[*WHOLE, "output.snapshots=6", "output.checkpoints={steps: 20, keep: 9}"])
        folder = self.results_of_first
        self.assertTrue((folder / "snapshots" / "000005.h5").exists())
        self.assertTrue((folder / "checkpoints").exists())
        mine = {"notes.txt", "snapshots/mine.txt", "curve.png"}
        for name in mine:
            (folder / name).write_text("mine")
        (folder / "snapshots" / "000009.h5.part").write_text("half")
        self.good("--overwrite", settings=[*WHOLE, "output.snapshots=2"])
        fresh = self.folder / "fresh"
        self.good(output=fresh, settings=[*WHOLE, "output.snapshots=2"])
        self.assertEqual(set(all_of(folder)), set(all_of(fresh)) | mine)
        self.assertEqual((folder / "history.csv").read_bytes(), (fresh / "history.csv").read_bytes())

    def test_overwrite_takes_nothing_away_for_a_run_that_does_not_begin(self):
        self.good()
        before = all_of(self.results_of_first)
        nothing = ["loads=[{kind: traction, side: right, stress: [1 MPa, 0 Pa], "
                   "within: {lower: [8 m, 8 m], upper: [9 m, 9 m]}}]"]
        message = self.refused("--overwrite", settings=[*QUICK, *nothing])
        self.assertIn("acts on nothing", message)
        self.assertEqual(all_of(self.results_of_first), before)
        fresh = self.folder / "fresh"
        self.refused(output=fresh, settings=[*QUICK, *nothing])
        self.assertFalse(fresh.exists())

    def test_a_checkpoint_of_one_run_does_not_go_on_in_the_folder_of_another(self):
        every = [*WHOLE, "output.checkpoints={steps: 20, keep: 9}"]
        self.good(settings=every)
        other = self.folder / "other"
        self.good(output=other, settings=[*every, "name=other"])
        before = all_of(other)
        first = sorted(self.results_of_first.glob("checkpoints/*.h5"))[0]
        self.assertIn("is not among its checkpoints. Choose another folder with --output.",
                      self.refused("--restart", first, output=other, settings=[*every, "name=other"]))
        self.assertEqual(all_of(other), before)
        self.good("--restart", first, output=self.folder / "branch", settings=every)
        self.assertEqual((self.folder / "branch" / "history.csv").read_bytes(),
                         (self.results_of_first / "history.csv").read_bytes())

    def test_a_run_that_broke_off_leaves_no_summary_of_the_one_before(self):
        self.good()
        run = self.run_it("--overwrite", "--time-limit", "1 us", settings=[])
        self.assertEqual(run.returncode, 75, run.stderr)
        self.assertFalse((self.results_of_first / "summary.json").exists())

    def test_a_scene_in_the_folder_of_its_results_is_not_replaced(self):
        own = self.folder / "own"
        own.mkdir()
        shutil.copy(self.bar, own / "scene.yaml")
        before = all_of(own)
        for words in [], ["--overwrite"]:
            self.assertIn("the run reads this file, and would put its results in its place",
                          self.refused(*words, file=own / "scene.yaml", output=own))
        self.assertEqual(all_of(own), before)
        # An effective scene is what it would be replaced by.
        self.good()
        history = (self.results_of_first / "history.csv").read_bytes()
        self.good("--overwrite", file=self.results_of_first / "scene.yaml", settings=[])
        self.assertEqual((self.results_of_first / "history.csv").read_bytes(), history)

    def start(self):
        """A run that is on its way."""
        run = start(self.bar, "--output", self.results_of_first, *set_options(LASTING))
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        self.wait_for(lambda: any(self.results_of_first.glob("checkpoints/*.h5")), "the run does not begin")
        return run

    def test_a_run_has_its_folder_to_itself(self):
        whole = self.folder / "whole"
        self.good(output=whole, settings=LASTING)
        run = self.start()
        run.send_signal(signal.SIGSTOP)
        before = all_of(self.results_of_first)
        for words, ranks in ([], 1), (["--overwrite"], 1), (["--overwrite"], 2), (["--restart"], 2):
            message = self.refused(*words, ranks=ranks, settings=LASTING)
            self.assertIn(f"a run is writing there (process {run.pid} on ", message)
            self.assertIn("Wait until it has ended, or choose another folder with --output.", message)
        self.assertEqual(all_of(self.results_of_first), before)
        run.send_signal(signal.SIGCONT)
        _, errors = run.communicate(timeout=seconds(60))
        self.assertEqual(run.returncode, 0, errors)
        expect_same(self, whole, self.results_of_first)
        self.assertFalse((self.results_of_first / "in_use.lock").exists())

    def test_a_killed_run_has_no_folder(self):
        for words in ["--restart"], ["--overwrite"]:
            shutil.rmtree(self.results_of_first, ignore_errors=True)
            run = self.start()
            run.kill()
            run.communicate()
            self.assertTrue((self.results_of_first / "in_use.lock").exists())
            self.good(*words, settings=LASTING)
            self.assertFalse((self.results_of_first / "in_use.lock").exists())

    def test_a_folder_that_cannot_be_made_or_written(self):
        file = self.folder / "file"
        file.write_text("")
        run = self.run_it(output=file / "results")
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertIn(str(file / "results"), run.stderr)
        if os.geteuid() == 0:
            return  # root may write anywhere
        self.folder.chmod(0o500)
        self.addCleanup(self.folder.chmod, 0o700)
        run = self.run_it()
        self.assertEqual(run.returncode, 4, run.stderr)


if __name__ == "__main__":
    unittest.main()
