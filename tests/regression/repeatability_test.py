"""Two runs of the same scene on the same ranks are the same to the last bit, also where the borders
between the ranks move: history and snapshots are compared byte by byte."""
import pathlib
import unittest

from program import ProgramTest, mpm_par, set_options, summary
from same_results import expect_same

INPUTS = pathlib.Path(__file__).parents[2] / "inputs"
FIELDS = "output.fields=[velocity, stress, plastic_work, id, rank]"


class Repeatability(ProgramTest):
    def run_once(self, scene, label, ranks, settings):
        folder = self.folder / label
        run = mpm_par(INPUTS / scene, "--output", folder, *set_options(settings), ranks=ranks,
                      timeout=600)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return folder

    def check_repeats(self, scene, ranks, *settings):
        first, second = (self.run_once(scene, f"on_{ranks}_{k}", ranks, settings) for k in (0, 1))
        self.assertGreater(summary(first)["repartitions"], 0)
        self.assertGreater(len(list(first.glob("snapshots/*.h5"))), 0)
        expect_same(self, first, second)

    def test_ponderosa_repeats_itself_while_borders_move_often(self):
        for ranks in 2, 3:
            self.check_repeats("wood/ponderosa_tangential.yaml", ranks, "steps=1500", "grid.cells=[100, 129]",
                               "numerics.formulation=updated_lagrangian",
                               "loading.speed=60 m/s", "loading.ramp_time=0 s", FIELDS,
                               "output.snapshots.strains=[0 %, 1 %]",
                               "numerics.repartition_interval=100")

    def test_one_sided_block_repeats_itself_where_borders_move_by_themselves(self):
        self.check_repeats("benchmarks/one_sided.yaml", 3, "steps=700", "grid.cells=[100, 100]",
                           "output.snapshots={times: [0 s, 2 us]}", FIELDS)


if __name__ == "__main__":
    unittest.main()
