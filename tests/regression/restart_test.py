"""A run that ended before its end, by a signal, the clock, a kill or a limit of steps, goes on from its
last checkpoint with the same bits: history, snapshots and what the summary says of them."""
import fcntl
import pathlib
import re
import shutil
import signal
import time
import unittest

from program import History, ProgramTest, mpm_par, seconds, set_options, start, summary
from same_results import all_of, expect_same, files_of

INPUTS = pathlib.Path(__file__).parents[2] / "inputs"
SNAPSHOTS = "output.snapshots={strains: [0 %, 10 %, 20 %, 29 %]}"
RING = (INPUTS / "benchmarks" / "crushed_ring.yaml",
        ["grid.cells=[14, 14]", "loading.speed=50 m/s", "loading.strain=30 %", "output.history_lines=60",
         SNAPSHOTS])
CELLS = "numerics.formulation=total_lagrangian"
# A run of seconds: what meets it on its way by the clock has to come before its end.
LASTING = [CELLS, "grid.cells=[80, 80]"]
# Earlywood, pressed until its lumens are closed.
CROP = (INPUTS / "wood" / "loblolly_radial.yaml",
        ["specimen={micrograph: loblolly.bmp, image_size: [0.208 mm, 0.161838 mm], threshold: 150, "
         "crop: [40, 60, 90, 70]}", "grid.cells=[19, 15]", "loading.speed=100 m/s",
         "loading.strain=60 %", "output.history_lines=60", "output.snapshots=0"])
STRIP = (pathlib.Path(__file__).parent / "scenes" / "torn_strip.yaml", [])
WOOD = (INPUTS / "wood" / "ponderosa_tangential.yaml",
        ["loading.strain=6 %", "loading.speed=20 m/s", "loading.ramp_time=0 s", "grid.cells=[50, 64]",
         "numerics.formulation=updated_lagrangian", "numerics.repartition_interval=40",
         "output.history_lines=100", "output.snapshots.strains=[0 %, 1 %]",
         "output.fields=[velocity, stress, id, rank]"])
BAR = (INPUTS / "benchmarks" / "vibrating_bar.yaml", ["output.history_lines=50"])


class RunsToRestart(ProgramTest):
    def run_it(self, of, folder, *words, settings=(), ranks=1, status=0):
        file, fixed = of
        run = mpm_par(file, "--output", folder, *set_options([*fixed, *settings]), *words, ranks=ranks)
        self.assertEqual(run.returncode, status, run.stderr + run.stdout)
        return run


class Restart(RunsToRestart):
    def whole(self, of, ranks=1, settings=()):
        folder = self.folder / f"whole_{ranks}"
        self.run_it(of, folder, settings=settings, ranks=ranks)
        return folder

    def checkpoints(self, folder):
        return sorted((folder / "checkpoints").glob("*.h5"))

    def check_goes_on(self, of, steps, ranks=1, settings=()):
        """From a run that a limit of steps has ended, and from one that went on once already."""
        whole, folder = self.whole(of, ranks, settings), self.folder / f"parts_{ranks}"
        every = [*settings, f"output.checkpoints={{steps: {steps}}}"]
        first, second = int(1.5 * steps), int(2.5 * steps)
        self.run_it(of, folder, settings=[*every, f"steps={first}"], ranks=ranks)
        for end in (f"steps={second}", None):
            run = self.run_it(of, folder, "--restart", settings=[*every, *([end] if end else [])],
                              ranks=ranks)
            self.assertIn("goes on from", run.stdout)
        expect_same(self, whole, folder)

    def test_cells_in_contact(self):
        for ranks in 1, 2, 3:
            self.check_goes_on(CROP, 1500, ranks)
        self.assertGreater(History(self.folder / "parts_3")["contact_pairs"][-1], 100)

    def test_cells_that_go_to_other_ranks(self):
        for ranks in 2, 3:
            self.check_goes_on(CROP, 1500, ranks, ["numerics.repartition_interval=400"])
        self.assertGreater(summary(self.folder / "whole_3")["repartitions"], 4)

    def test_cells_that_fail(self):
        for ranks in 1, 2:
            self.check_goes_on(STRIP, 700, ranks)

    def test_fitted_cells(self):
        self.check_goes_on(RING, 700, 2, [CELLS, "numerics.surface=fitted"])

    def test_particles_while_borders_move(self):
        for ranks in 1, 2:
            self.check_goes_on(WOOD, 140, ranks)
        self.assertGreater(summary(self.folder / "parts_2")["repartitions"], 3)

    def test_exact_solution(self):
        self.check_goes_on(BAR, 100)

    def start(self, of, folder, settings, *words, ranks=1):
        file, fixed = of
        return start(file, "--output", folder, *words, *set_options([*fixed, *settings]), ranks=ranks)

    def wait_for_lines(self, folder, lines):
        history = folder / "history.csv"
        self.wait_for(lambda: history.exists() and history.read_bytes().count(b"\n") > lines, "no history")

    def test_signals(self):
        whole = {ranks: self.whole(RING, ranks, LASTING) for ranks in (1, 2)}
        for ranks, what in (1, signal.SIGTERM), (1, signal.SIGINT), (2, signal.SIGUSR1):
            folder = self.folder / f"{what.name}_{ranks}"
            run = self.start(RING, folder, LASTING, ranks=ranks)
            self.wait_for_lines(folder, 10)
            run.send_signal(what)
            _, errors = run.communicate(timeout=seconds(60))
            self.assertEqual(run.returncode, 75, errors)
            self.assertIn(f"signal {what.value}. Go on with --restart.", errors)
            self.assertEqual(len(self.checkpoints(folder)), 1)
            self.assertFalse((folder / "summary.json").exists())
            self.run_it(RING, folder, "--restart", settings=LASTING, ranks=ranks)
            expect_same(self, whole[ranks], folder)

    def test_killed_at_any_moment(self):
        settings = [*LASTING, "output.checkpoints={steps: 200, keep: 3}"]
        whole, folder = self.whole(RING, 1, LASTING), self.folder / "killed"
        restart = []
        for lines in 3, 9, 15, 21:
            run = self.start(RING, folder, settings, *restart)
            self.wait_for_lines(folder, lines)
            time.sleep(0.003 * lines)
            run.kill()
            run.communicate()
            self.assertGreater(len(self.checkpoints(folder)), 0)
            restart = ["--restart"]
        self.run_it(RING, folder, "--restart", settings=settings)
        expect_same(self, whole, folder)
        self.assertEqual(len(self.checkpoints(folder)), 3)

    def test_time_limit(self):
        folder, settings = self.folder / "limited", LASTING
        run = self.run_it(RING, folder, "--time-limit", "0.2 s", settings=settings, status=75)
        self.assertIn("the time limit was reached", run.stderr)
        self.run_it(RING, folder, "--restart", settings=settings)
        expect_same(self, self.whole(RING, 1, settings), folder)
        for limit in "soon", "-1 s", "3 m":
            run = self.run_it(RING, folder, "--restart", "--time-limit", limit, status=2)
            self.assertIn("--time-limit is " + limit, run.stderr)

    def test_time_of_steps_counts_those_before_the_checkpoint(self):
        folder, settings = self.folder / "timed", [CELLS, "output.checkpoints={steps: 1400}"]
        self.run_it(RING, folder, settings=[*settings, "steps=1450"], ranks=3)
        before = summary(folder)["ns_per_particle_step"]
        self.run_it(RING, folder, "--restart", settings=[*settings, "steps=1460"])
        found = summary(folder)  # on one rank, after 1400 steps of three
        self.assertGreater(found["ns_per_particle_step"], 0.5 * before)
        self.assertGreater(found["wall_seconds"], found["loop_seconds"])

    def test_names_of_pictures_with_quotes(self):
        picture = self.folder / 'wood 2"x4" \\s.bmp'
        shutil.copy(INPUTS / "wood" / "loblolly.bmp", picture)
        file = self.folder / "wood.yaml"
        text = CROP[0].read_text()
        file.write_text(text.replace("loblolly.bmp", f"'{picture.name}'"))
        settings = [word.replace("micrograph: loblolly.bmp", f"micrograph: '{picture.name}'")
                    for word in CROP[1]]
        of, folder = (file, settings), self.folder / "quoted"
        self.run_it(of, folder, settings=["steps=40", "output.checkpoints={steps: 20}"])
        self.run_it(of, folder, "--restart", settings=["steps=60"])

    def begun(self, settings=()):
        folder = self.folder / "begun"
        self.run_it(RING, folder, settings=[CELLS, "steps=1500", "output.checkpoints={steps: 400, keep: 3}",
                                            *settings])
        self.assertEqual([path.name for path in self.checkpoints(folder)],
                         ["000000000400.h5", "000000000800.h5", "000000001200.h5"])
        return folder

    def test_passes_over_what_is_not_whole(self):
        whole, folder = self.whole(RING, 1, [CELLS]), self.begun()
        first, second, third = self.checkpoints(folder)
        bytes_of_second = bytearray(second.read_bytes())
        bytes_of_second[len(bytes_of_second) // 2] ^= 4
        second.write_bytes(bytes_of_second)
        third.write_bytes(third.read_bytes()[:-5000])
        (folder / "checkpoints" / "000000001600.h5.part").write_bytes(b"half")
        run = self.run_it(RING, folder, "--restart", settings=[CELLS])
        for file in second, third:
            self.assertIn(str(file), run.stdout + run.stderr)
        self.assertIn(f"goes on from {first}", run.stdout)
        expect_same(self, whole, folder)

    def test_what_is_done_from_an_older_one_takes_the_place_of_what_was_done_before(self):
        folder = self.begun()
        first = self.checkpoints(folder)[0]
        self.run_it(RING, folder, "--restart", first,
                    settings=[CELLS, "steps=700", "output.checkpoints={steps: 300, keep: 2}"])
        (folder / "checkpoints" / "my_copy.h5").write_bytes(first.read_bytes())
        self.assertEqual([path.name for path in self.checkpoints(folder)],
                         ["000000000400.h5", "000000000600.h5", "my_copy.h5"])
        run = self.run_it(RING, folder, "--restart", settings=[CELLS])
        self.assertIn("goes on from " + str(folder / "checkpoints" / "000000000600.h5"), run.stdout)
        expect_same(self, self.whole(RING, 1, [CELLS]), folder)

    def snapshots_named(self, folder):
        return sorted(set(re.findall(r"snapshots/(\d+)\.h5", (folder / "crushed_ring.xdmf").read_text())))

    def test_goes_on_with_other_snapshots_or_none(self):
        folder = self.begun(["output.snapshots=0"])
        first = self.checkpoints(folder)[0]  # before 10 % strain
        self.run_it(RING, folder, "--restart", first, settings=[CELLS])
        self.assertEqual(self.snapshots_named(folder), ["000000", "000001", "000002"])
        shutil.rmtree(folder)
        folder = self.begun()
        self.run_it(RING, folder, "--restart", first, settings=[CELLS, "output.snapshots=0"])
        self.assertEqual(self.snapshots_named(folder), ["000000"])

    def test_goes_on_without_snapshots_that_were_taken_away(self):
        folder, settings = self.folder / "taken", [CELLS, "output.checkpoints={steps: 400}"]
        self.run_it(RING, folder, settings=[*settings, "steps=1500"], ranks=2)
        (folder / "snapshots" / "000000.h5").unlink()
        self.run_it(RING, folder, "--restart", settings=[*settings, "steps=2500"], ranks=2)
        self.run_it(RING, folder, "--restart", settings=settings, ranks=2)
        self.assertEqual(self.snapshots_named(folder), ["000001", "000002", "000003"])

    def test_changes_nothing_while_a_run_is_writing_there(self):
        folder = self.folder / "taken"
        self.run_it(RING, folder, settings=[CELLS, "output.checkpoints={steps: 1400, keep: 9}"])
        self.assertEqual(len(self.snapshots_named(folder)), 4)
        with open(folder / "in_use.lock", "a") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            before = all_of(folder)
            run = self.run_it(RING, folder, "--restart", self.checkpoints(folder)[0], settings=[CELLS],
                              status=2)
            self.assertIn("a run is writing there", run.stderr)
            self.assertEqual(all_of(folder), before)

    def test_says_why_it_cannot_go_on(self):
        folder = self.begun()
        before = files_of(folder)

        def refused(*words, settings=(CELLS,), to=folder):
            run = self.run_it(RING, to, *words, settings=settings, status=2)
            self.assertEqual(files_of(folder), before)
            return run.stderr

        newest = self.checkpoints(folder)[-1]
        text = refused("--restart", settings=[CELLS, "material.youngs_modulus=9 GPa", "grid.cells=[12, 14]"])
        self.assertIn("grid.cells[0] was 14 and is 12; ", text)
        self.assertIn("youngs_modulus was 10 GPa and is 9 GPa", text)
        self.assertIn("Replace them with --overwrite, go on with that run with --restart", refused())
        self.assertIn("there is no checkpoint", refused("--restart", to=self.folder / "empty"))
        for file in self.checkpoints(folder):
            file.write_bytes(file.read_bytes()[:1000])
        text = refused("--restart")
        self.assertIn(str(newest), text)
        self.assertIn("There is no other checkpoint", text)
        self.run_it(RING, folder, "--overwrite", settings=[CELLS, "steps=100"])
        self.assertEqual(self.checkpoints(folder), [])

    def test_refuses_what_another_version_wrote(self):
        """One in which a value has another name. Nothing in the folder is lost."""
        folder = self.begun()
        newest = self.checkpoints(folder)[-1]
        newest.write_bytes(newest.read_bytes().replace(b"external_work", b"external_worj"))
        before = all_of(folder)
        for ranks in 1, 2:  # as it is, and shared out anew
            run = self.run_it(RING, folder, "--restart", settings=[CELLS], ranks=ranks, status=2)
            self.assertIn("written by another version of the program", run.stderr)
            self.assertIn("history/external_work is not there). Go on with that one, or run the scene "
                          "from its start with --overwrite.", run.stderr)
            self.assertEqual(all_of(folder), before)

    def test_takes_the_one_that_is_named_and_another_end(self):
        folder = self.begun()
        second = self.checkpoints(folder)[1]
        run = self.run_it(RING, folder, "--restart", second,
                          settings=[CELLS, "loading.strain=33 %", "output.fields=[velocity]"])
        self.assertIn(f"goes on from {second}", run.stdout)
        self.assertEqual(History(folder)["strain"][-1], 0.33)


if __name__ == "__main__":
    unittest.main()
