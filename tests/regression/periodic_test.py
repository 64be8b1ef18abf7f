"""Periodic sides of whole scenes, on any number of ranks."""
import math
import unittest

from program import History, ProgramTest, summary


class PeriodicHoneycomb(ProgramTest):
    def history(self, label, *settings, ranks=1):
        return History(self.results("periodic_honeycomb", *settings, ranks=ranks, label=label))

    def test_the_history_is_the_same_on_any_number_of_ranks(self):
        first, *others = [self.history(f"on_{ranks}", ranks=ranks) for ranks in (1, 2, 3)]
        self.assertGreater(max(first["stress"]), 1e6)
        for other in others:
            for name in ("stress", "kinetic_energy", "elastic_energy", "external_work"):
                largest = max(map(abs, first[name]))
                for one, more in zip(first[name], other[name]):
                    self.assertLessEqual(abs(one - more), 1e-9 * largest, name)
        self.assertLess(abs(summary(self.folder / "on_1")["largest_energy_error"]), 0.005)
        self.assertLess(max(first["momentum_error"]), 1e-9)

    def test_a_shifted_comb_is_the_same_comb(self):
        """By half a period up, where the seam cuts other walls. In the lattice of locations, whose
        locations the shift takes onto each other: 31 cells of 62."""
        upright = self.history("upright")
        shifted = self.history(
            "shifted", "specimen.shapes[0].honeycomb.lower=[0 mm, -0.3 mm]",
            "specimen.shapes[0].honeycomb.upper=[0.3464 mm, 0.6 mm]")
        self.assertEqual(upright["particles"][0], shifted["particles"][0])
        for name in ("stress", "elastic_energy"):
            largest = max(map(abs, upright[name]))
            for one, more in zip(upright[name], shifted[name]):
                self.assertLessEqual(abs(one - more), 1e-6 * largest, name)

    def test_walls_hold_a_comb_that_is_its_own_mirror_image_like_its_images_do(self):
        """The lower and upper side are mirror lines of the comb: slipping walls there change
        nothing but the last third of a cell at them."""
        periodic, walls = self.history("periodic"), self.history("walls", "loading.lateral=symmetric")
        middle = [k for k in range(1, len(walls)) if walls["strain"][k] > 0.01]
        for k in middle:
            self.assertAlmostEqual(periodic["stress"][k] / walls["stress"][k], 1, delta=0.1)
        mean = sum(periodic["stress"][k] / walls["stress"][k] for k in middle) / len(middle)
        self.assertTrue(math.isclose(mean, 1, abs_tol=0.05), mean)


if __name__ == "__main__":
    unittest.main()
