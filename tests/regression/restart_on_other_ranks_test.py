"""A run goes on from the checkpoint of another number of ranks as it would have gone on if the ranks had
been these all along: with the same history, to the rounding of sums in another order."""
import unittest

from program import History, scene, summary
from restart_test import BAR, CELLS, CROP, INPUTS, RING, STRIP, RunsToRestart

FROM_AND_TO = (2, 1), (1, 3), (3, 2)
ELASTIC = "material.yield_stress=500 GPa"
HONEYCOMB = (scene("honeycomb"), [ELASTIC, "loading.strain=2 %"])
PERIODIC = (scene("periodic_honeycomb"), [])
PUNCH = (scene("punch"), [])
TWO_BLOCKS = (scene("two_blocks"), [])
SPACE = (INPUTS / "benchmarks" / "vibrating_bar_space.yaml", ["output.history_lines=20"])


class RestartOnOtherRanks(RunsToRestart):
    def check_same(self, whole, folder, tolerance):
        expected, found = History(whole), History(folder)
        self.assertEqual(expected.names, found.names)
        self.assertEqual(len(expected), len(found))
        for name in expected.names:
            # Differences of what is compared, and what rounding may decide.
            if name in ("momentum_error", "energy_error", "contact_pairs"):
                continue
            energy = name.endswith(("energy", "work"))
            largest = max(max(map(abs, expected[of])) for of in
                          ([n for n in expected.names if n.endswith(("energy", "work"))] if energy else [name]))
            for line, (one, other) in enumerate(zip(expected[name], found[name])):
                self.assertLessEqual(abs(one - other), tolerance * largest, f"{name} in line {line}")
        self.assertEqual(summary(whole)["steps"], summary(folder)["steps"])

    def check_goes_on(self, of, steps, settings=(), tolerance=1e-9, ranks=FROM_AND_TO):
        whole = self.folder / "whole"
        self.run_it(of, whole, settings=settings)
        for first, second in ranks:
            folder = self.folder / f"{first}_then_{second}"
            self.run_it(of, folder, ranks=first,
                        settings=[*settings, f"steps={steps}", "output.checkpoints={steps: 20, keep: 1}"])
            run = self.run_it(of, folder, "--restart", settings=settings, ranks=second)
            self.assertIn(f"of {first} rank{'s' if first > 1 else ''}\n", run.stdout)
            self.check_same(whole, folder, tolerance)
        return whole

    def test_particles(self):
        self.check_goes_on(HONEYCOMB, 301)

    def test_particles_and_a_load_cell(self):
        self.check_goes_on(HONEYCOMB, 301, ["loading.load_cell.cells=3", "numerics.decomposition=metis"])

    def test_cells_and_a_load_cell(self):
        self.check_goes_on(HONEYCOMB, 301, [CELLS, "loading.load_cell.cells=3"])

    def test_particles_of_bodies_that_meet(self):
        self.check_goes_on(TWO_BLOCKS, 301)

    def test_particles_across_periodic_sides(self):
        self.check_goes_on(PERIODIC, 301)

    def test_particles_in_space(self):
        self.check_goes_on(SPACE, 101)

    def test_cells(self):
        self.check_goes_on(RING, 1001, [CELLS, "output.snapshots=0"])

    def test_cells_of_ranks_that_were_arranged(self):
        folder, settings = self.folder / "arranged", [CELLS, "output.snapshots=0"]
        self.run_it(RING, folder, ranks=2, settings=[*settings, "steps=301", "numerics.ranks=[1, 2]",
                                                     "output.checkpoints={steps: 20, keep: 1}"])
        run = self.run_it(RING, folder, "--restart", ranks=1, settings=[*settings, "numerics.ranks=[1, 2]"],
                          status=2)
        self.assertIn("1 ranks cannot be arranged as 1 x 2", run.stderr)
        self.run_it(RING, folder, "--restart", ranks=1, settings=[*settings, "steps=400"])

    def test_cells_that_touch(self):
        self.check_goes_on(CROP, 2001, ["loading.strain=25 %"], tolerance=1e-6)

    def test_fitted_cells(self):
        self.check_goes_on(RING, 1001, [CELLS, "numerics.surface=fitted", "output.snapshots=0"])

    def test_cells_across_periodic_sides(self):
        self.check_goes_on(PERIODIC, 601, [CELLS])

    def test_cells_in_space(self):
        self.check_goes_on(SPACE, 101, [CELLS])

    def test_cells_that_fail(self):
        whole = self.check_goes_on(STRIP, 901, ["output.snapshots=0"])
        self.assertGreater(History(whole)["failed_cells"][-1], 10)

    def test_cells_and_rigid_bodies(self):
        self.check_goes_on(PUNCH, 301, [CELLS, "contact=[{between: [wood, punch], friction: 0.3}]"])

    def test_exact_solution(self):
        whole = self.check_goes_on(BAR, 101)
        lines = (whole / "exact_solution.csv").read_text().splitlines()
        self.assertEqual(len(lines), len((self.folder / "2_then_1" / "exact_solution.csv").read_text()
                                         .splitlines()))


if __name__ == "__main__":
    unittest.main()
