"""The shipped wood scenes, as shipped and with the updated Lagrangian step of the founding paper: energy
balance, order of the paper's Table 1, nothing behind the piston."""
import pathlib
import unittest

from program import History, ProgramTest, mpm_par, set_options, summary

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
CLOSED = 0.005  # share of the external work
DRIFT = 0.02  # of the figures below: equal runs agree to 1e-5, another number of ranks as well

UPDATED = ["numerics.formulation=updated_lagrangian"]

# The project's own figures of the updated Lagrangian step with specimen.sampling: match, on 1 and 2
# ranks; relative densities are those of the pictures. With `threshold` loblolly has 0.607 (the paper's, to which it was drawn),
# 3742 MPa and 66.0 MPa at 1.71 %. A figure that moves by more than DRIFT has to be explained.
RADIAL = {"relative_density": 0.6160, "modulus": 3930e6, "buckling_stress": 81.5e6,
          "buckling_strain": 0.02029, "densification_stress": 151.0e6,
          "densification_strain": 0.1796}
# At 8 % strain: relative density, modulus, mean stress from 4 % on.
OTHERS = {"loblolly_tangential": (0.6160, 3573e6, 218.5e6),
          "poplar_radial": (0.5703, 4382e6, 186.1e6),
          "poplar_tangential": (0.5703, 2275e6, 114.7e6),
          "ponderosa_tangential": (0.3802, 1214e6, 62.6e6)}
# Of loblolly_radial as shipped, to 5 % strain: mean stress from, to.
CELLS = {(0.005, 0.015): 35.48e6, (0.03, 0.05): 65.54e6}
CLOSED_OF_CELLS = 0.001


class Wood(ProgramTest):
    def crush(self, name, strain=None, settings=UPDATED):
        folder = self.folder / name
        cut = [] if strain is None else [f"loading.strain={strain}", "output.snapshots=0"]
        run = mpm_par(WOOD / f"{name}.yaml", "--output", folder, *set_options([*settings, *cut]),
                      ranks=2, timeout=900)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        history, found = History(folder), summary(folder)
        for at, error in zip(history["strain"], history["energy_error"]):
            if at > 0.01:
                self.assertLess(abs(error), CLOSED, f"{name} at strain {at}")
        self.assertLess(max(history["momentum_error"]), 1e-9)
        # Half of the narrowest cell: nobody is far behind the piston's face.
        self.assertLess(found["deepest_behind_piston"], 5e-6)
        return history, found

    def assertBetween(self, lower, value, upper):
        self.assertIsNotNone(value)
        self.assertLess(lower, value)
        self.assertLess(value, upper)

    def test_loblolly_radial_goes_through_three_regions_to_sixty_percent(self):
        history, found = self.crush("loblolly_radial")
        self.assertAlmostEqual(found["strain"], 0.6, places=9)
        for figure, own in RADIAL.items():
            self.assertAlmostEqual(found[figure], own, delta=DRIFT * own, msg=figure)
        self.assertAlmostEqual(found["relative_density"], found["picture_relative_density"],
                               delta=1e-4)  # a few of 58,200 locations
        # Nairn 2006, Table 1: 2740 MPa, 54.2 MPa at 1.8 %, 161.4 MPa at 27.1 %, for another
        # picture and with shape functions that lose work: the order must agree, not the digits.
        self.assertBetween(1.4e9, found["modulus"], 5.5e9)
        self.assertBetween(27e6, found["buckling_stress"], 108e6)
        self.assertBetween(0.009, found["buckling_strain"], 0.036)
        self.assertBetween(80e6, found["densification_stress"], 320e6)
        self.assertBetween(0.14, found["densification_strain"], 0.40)

        def stress(strain):
            return next(s for e, s in zip(history["strain"], history["stress"]) if e >= strain)

        elastic = stress(0.015) / 0.015
        plateau = (stress(0.10) - stress(0.04)) / 0.06
        dense = (stress(0.50) - stress(0.40)) / 0.10
        self.assertLess(plateau, elastic / 4)
        self.assertGreater(dense, elastic)

    def test_loblolly_radial_buckles_as_shipped_with_cells_that_hardly_overlap(self):
        history, found = self.crush("loblolly_radial", 0.05, settings=[])
        self.assertEqual(found["plan"]["passes"], ["cells"])  # the total Lagrangian step
        self.assertLess(abs(found["largest_energy_error"]), CLOSED_OF_CELLS)
        self.assertAlmostEqual(found["relative_density"], RADIAL["relative_density"], delta=1e-4)
        for (start, end), own in CELLS.items():
            stress = [s for e, s in zip(history["strain"], history["stress"]) if start < e < end]
            self.assertAlmostEqual(sum(stress) / len(stress), own, delta=DRIFT * own)
        self.assertGreater(max(history["contact_pairs"]), 0)
        wall = found["relative_density"] * 0.832e-3 * 0.541e-3  # m2
        self.assertLess(max(history["overlapped_area"]), 1e-3 * wall)
        self.assertEqual(history["added_mass"][0], 0)
        self.assertLess(history["added_mass"][-1], 0.5)

    def test_both_ends_feel_the_same_force_once_the_wood_collapses(self):
        history, _ = self.crush("loblolly_radial", 0.12)
        pairs = [(p, e) for at, p, e in zip(history["strain"], history["stress_piston"],
                                            history["stress_edge"]) if at > 0.04]
        piston = sum(p for p, _ in pairs) / len(pairs)
        edge = sum(e for _, e in pairs) / len(pairs)
        # Quasi-static: within 2 % on the mean over the plateau.
        self.assertLess(abs(piston - edge), 0.02 * edge)

    def test_the_other_scenes_close_their_energy_balance_and_keep_their_figures(self):
        for name, (density, modulus, mean_stress) in OTHERS.items():
            with self.subTest(name):
                history, found = self.crush(name, 0.08)
                self.assertAlmostEqual(found["relative_density"], density, delta=1e-4)
                self.assertAlmostEqual(found["modulus"], modulus, delta=DRIFT * modulus)
                stress = [s for e, s in zip(history["strain"], history["stress"]) if e > 0.04]
                self.assertAlmostEqual(sum(stress) / len(stress), mean_stress,
                                       delta=DRIFT * mean_stress)


if __name__ == "__main__":
    unittest.main()
