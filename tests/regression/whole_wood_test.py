"""The shipped wood scenes as shipped, to their ends, loblolly to 80 %: at every line of the history the energy
balance is closed, cells hardly overlap, momentum is kept, and what is dense bears no less than solid wall."""
import math
import pathlib
import unittest

from program import History, ProgramTest, mpm_par, set_options, summary

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
CLOSED = 0.003  # share of the external work
OVERLAPPED = 0.01  # share of the wall
DEEPEST = 0.25  # of a cell; twice that of half as many cells, 0.13 (loblolly, at 80 %)
BULK_MODULUS = 10.6e9 / (3 * (1 - 2 * 0.33))  # Pa, of the walls as inputs/wood has them
WHOLE = {"loblolly_radial": 0.8, "loblolly_tangential": 0.8, "poplar_radial": 0.6, "poplar_tangential": 0.6,
         "ponderosa_tangential": 0.6}


class WholeWood(ProgramTest):
    def check(self, name, strain):
        folder = self.folder / name
        run = mpm_par(WOOD / f"{name}.yaml", "--output", folder,
                      *set_options([f"loading.strain={strain}", "output.snapshots=0"]), ranks=2, timeout=3600)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        history, found = History(folder), summary(folder)
        self.assertEqual(found["plan"]["passes"], ["cells"])  # the total Lagrangian step
        self.assertAlmostEqual(history["strain"][-1], strain)
        wall = found["relative_density"] * found["size"][0] * found["size"][1]  # m2
        self.assertLess(max(map(abs, history["energy_error"])), CLOSED)
        self.assertLess(max(history["overlapped_area"]), OVERLAPPED * wall)
        self.assertLess(max(history["deepest_overlap"]), DEEPEST)
        self.assertLess(max(history["momentum_error"]), 1e-11)
        self.assertGreater(max(history["contact_pairs"]), 10000)
        for crushed, stress in zip(history["strain"], history["stress"]):
            left = (1 - crushed) / found["relative_density"]  # of the wall's volume, without a void
            if left < 1:  # its pressure alone (Hencky); it also bears a deviator
                self.assertGreater(stress, -BULK_MODULUS * math.log(left) / left, f"at {crushed}")

    def test_as_shipped(self):
        self.assertEqual(sorted(WHOLE), sorted(path.stem for path in WOOD.glob("*.yaml")
                                               if not path.stem.endswith(".anatomy")))
        for name, strain in WHOLE.items():
            with self.subTest(name):
                self.check(name, strain)


if __name__ == "__main__":
    unittest.main()
