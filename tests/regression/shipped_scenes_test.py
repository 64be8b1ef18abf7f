"""Every shipped scene is understood and takes its first steps, and those of the tutorial run."""
import pathlib
import unittest

from program import History, ProgramTest, mpm_par, set_options, summary

INPUTS = pathlib.Path(__file__).parents[2] / "inputs"
# A million particles and more are too many for a test: fewer of the same.
COARSER = {"benchmarks/eight_million.yaml": ["grid.cells=[275, 279]"],
           "benchmarks/tube_bundle.yaml": ["grid.spacing=8 um"]}


class ShippedScenes(ProgramTest):
    def run_scene(self, name, *options):
        run = mpm_par(INPUTS / name, *options, ranks=2, timeout=900)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run.stdout

    def test_all_are_understood_and_take_their_first_steps(self):
        scenes = {path.relative_to(INPUTS).as_posix() for path in INPUTS.glob("*/*.yaml")
                  if not path.name.endswith(".anatomy.yaml") and path.parent.name != "studies"}
        self.assertGreater(len(scenes), 10)
        for name in sorted(scenes):
            with self.subTest(name):
                folder = self.folder / name
                plan = self.run_scene(name, "--output", folder, *set_options(
                    ["steps=2", "output.snapshots=0", *COARSER.get(name, [])]))
                self.assertIn("time step", plan)
                self.assertEqual(summary(folder)["steps"], 2)

    def test_the_punch_pushes_the_block_and_the_energy_balance_closes(self):
        folder = self.folder / "punch"
        self.run_scene("tutorial/punch.yaml", "--output", folder)
        history = History(folder)
        self.assertAlmostEqual(history["time"][-1], 15e-6, delta=1e-7)
        # Elastic block, rigid punch: the work that the punch does is all there is.
        self.assertGreater(history["external_work"][-1], 0)
        self.assertLess(abs(history["energy_error"][-1]), 0.005)

    def test_the_bundle_of_tubes_is_crushed_in_space(self):
        folder = self.folder / "tubes"
        self.run_scene("tutorial/tubes.yaml", "--output", folder)
        found = summary(folder)
        self.assertEqual(found["dimensions"], 3)
        self.assertAlmostEqual(found["strain"], 0.2, places=9)
        self.assertLess(abs(found["largest_energy_error"]), 0.005)

    def test_an_own_micrograph_needs_seven_lines(self):
        folder = self.folder / "own"
        self.run_scene("tutorial/own_micrograph.yaml", "--output", folder)
        self.assertIn("formulation: total_lagrangian", (folder / "scene.yaml").read_text())
        found = summary(folder)
        self.assertAlmostEqual(found["strain"], 0.1, places=9)
        self.assertLess(abs(found["largest_energy_error"]), 0.005)


if __name__ == "__main__":
    unittest.main()
