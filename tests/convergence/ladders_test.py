"""The machinery of the ladders: settings, errors, what fails, and measures of histories made by hand."""
import csv
import tempfile
import unittest
from pathlib import Path

import ladders
import measures


def case(**keys):
    return {"scene": "a.yaml", "settings": ["grid.cells=[{n}, {3*n//2}]"], "levels": [4, 8]} | keys


class Ladders(unittest.TestCase):
    def test_settings_are_worked_out(self):
        self.assertEqual(ladders.settings_of(case(), 4), ["grid.cells=[4, 6]"])

    def test_an_error_that_grows_by_more_than_a_tenth_fails(self):
        self.assertEqual(ladders.defects(case(), "gimp flip", [0.1, -0.1], [0.109, 0.109]), [])
        self.assertEqual(len(ladders.defects(case(), "gimp flip", [0.1, -0.1], [0.111, -0.111])), 2)

    def test_below_the_floor_an_error_may_change(self):
        self.assertEqual(ladders.defects(case(floor=0.01), "", [1e-5, 1e-5], [0.01, -0.01]), [])
        self.assertEqual(len(ladders.defects(case(floor=0.01), "", [1e-5, 1e-5], [0.02, 0.0])), 1)

    def test_falling_below_a_bound_fails(self):
        self.assertEqual(len(ladders.defects(case(bound=True), "", [0.1, 0.1], [0.1, -0.05])), 1)
        self.assertEqual(ladders.defects(case(bound=True), "", [-0.1, 0.1], [-0.1, 0.1]), [])

    def test_a_run_that_breaks_down_or_no_longer_does_fails(self):
        self.assertEqual(len(ladders.defects(case(), "", [0.1, None], [None, 0.1])), 2)


class Measures(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = Path(held.name)

    def history(self, header, lines):
        with open(self.folder / "history.csv", "w", newline="") as file:
            csv.writer(file).writerows([header, *lines])

    def test_the_modulus_is_the_slope_of_the_late_half(self):
        self.history(["strain [1]", "stress [Pa]"],
                     [(0, 9), (0.25, 7), (0.5, 3), (0.75, 5), (1, 7)])
        keys = {"measure": "curve.modulus", "exact": "2**4/2"}
        self.assertAlmostEqual(measures.error(keys, 4, self.folder), 0)

    def test_a_width_that_is_left_counts_in_cells(self):
        # 0.1 % of the modulus is passed at a strain of 0.055; the blocks have given way by 0.001 * 0.9
        self.history(["strain [1]", "stress_edge [Pa]"], [(0, 0), (0.05, 0), (0.06, 2), (0.07, 5)])
        keys = {"measure": "contact.remaining_width", "exact": "0",
                "options": {"gap": 0.1, "length": 1, "modulus": 1000}}
        self.assertAlmostEqual(measures.error(keys, 20, self.folder), (0.1 - 0.055 + 0.0009) * 20)

    def test_power_is_the_late_slope_of_the_work(self):
        self.history(["time [s]", "external_work [J]"],
                     [(t, 5 * max(0, t - 2)) for t in range(11)])
        keys = {"measure": "energy.power", "exact": "1.25", "options": {"rate": 2, "volume": 2}}
        self.assertAlmostEqual(measures.error(keys, 4, self.folder), 0)

    def test_every_measure_of_the_table_is_there_and_says_what_it_is(self):
        for listed in ladders.json.loads(ladders.TABLE.read_text()):
            if "measure" in listed:
                with self.subTest(listed["measure"]):
                    self.assertTrue(callable(measures.named(listed["measure"])))
                    self.assertTrue(measures.words(listed["measure"]))
                    self.assertGreaterEqual(measures.number(listed["exact"]), 0)


if __name__ == "__main__":
    unittest.main()
