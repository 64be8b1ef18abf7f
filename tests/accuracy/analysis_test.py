"""What the page reads out of its files, on rows made by hand."""
import unittest
from unittest import mock

import numpy

import analysis
import curve_landmarks
from mpm_par.history import History


def row(cells, **keys):
    return {"method": "gimp flip", "geometry": "fixed", "cells": cells, "status": "ok"} | keys


class Analysis(unittest.TestCase):
    def test_the_closing_strain_is_the_last_time_that_the_stress_rises_through_the_level(self):
        strain = numpy.array([0, 0.1, 0.2, 0.3, 0.4])
        stress = numpy.array([0, 300e6, 100e6, 300e6, 400e6])
        with mock.patch.object(analysis, "curve", lambda model, row: (strain, stress)):
            self.assertAlmostEqual(analysis.closing_strain("loblolly", row(75)), 0.25)

    def test_a_curve_that_stays_below_has_none(self):
        curve = (numpy.array([0, 0.4]), numpy.array([0, 1e6]))
        with mock.patch.object(analysis, "curve", lambda model, row: curve):
            self.assertIsNone(analysis.closing_strain("loblolly", row(75)))

    def test_a_figure_that_grows_with_the_cell_is_of_first_order(self):
        rows = [row(cells, modulus=3e9 + 1e14 * 0.832e-3 / cells) for cells in (75, 150, 300)]
        at_zero, slope, off = analysis.first_order("loblolly", rows, "modulus")
        self.assertAlmostEqual(at_zero / 3e9, 1)
        self.assertAlmostEqual(slope / 1e14, 1)
        self.assertLess(off, 1e-9)
        self.assertAlmostEqual(analysis.first_order_error("loblolly", rows, "modulus", 100),
                               1e14 * 0.832e-5 / 3e9)
        self.assertAlmostEqual(analysis.cells_for("loblolly", rows, "modulus", 0.01),
                               1e14 * 0.832e-3 / 3e9 / 0.01)
        self.assertAlmostEqual(analysis.limit("loblolly", rows, "modulus").order, 1, places=3)

    def test_a_curve_is_carried_to_zero_strain_by_strain(self):
        rows = [row(cells) for cells in (75, 150, 300)]
        with mock.patch.object(analysis, "value", lambda model, row, figure: numpy.array(
                [3.0, 4.0]) * (1 + 20 / row["cells"])):
            at_zero, _, off = analysis.first_order("loblolly", rows, "curve")
            self.assertAlmostEqual(analysis.first_order_error("loblolly", rows, "curve", 200), 0.1)
        numpy.testing.assert_allclose(at_zero, [3, 4])
        self.assertLess(off, 1e-9)

    def test_run_times_grow_with_the_power_that_they_were_made_with(self):
        rows = [row(cells, seconds=2e-6 * cells**3) for cells in (75, 150, 300)]
        self.assertAlmostEqual(analysis.exponent(rows), 3)
        self.assertAlmostEqual(analysis.seconds_at(rows, 600), 2e-6 * 600**3)

    def test_a_level_that_passes_through_zero_is_on_no_front(self):
        rows = [{"case": "a", "method": method, "level": level, "seconds": cost, "error": error}
                for method, level, cost, error in (("one", 1, 1, 0.001), ("one", 2, 4, 0.2),
                                                   ("two", 1, 2, 0.1), ("two", 2, 8, 0.05))]
        with mock.patch.object(analysis, "read", lambda name: rows):
            self.assertEqual([(row["method"], row["level"]) for row in analysis.front("a")],
                             [("one", 1), ("two", 1), ("two", 2)])
            self.assertEqual(analysis.settled(rows[0]), 0.2)

    def test_only_good_rows_of_the_geometry_are_levels(self):
        rows = [row(150), row(75), row(300, status="exit status 3"), row(225, geometry="picture")]
        with mock.patch.object(analysis, "read", lambda name: rows):
            found = analysis.ladder("loblolly", "gimp flip", "fixed")
        self.assertEqual([one["cells"] for one in found], [75, 150])


class Landmarks(unittest.TestCase):
    def curve(self, stress, end=0.5):
        strain = numpy.linspace(0, end, 501)
        return History({"strain": strain, "stress": stress(strain)}, {"strain": "1", "stress": "Pa"})

    def test_a_stress_is_reached_at_a_strain_or_not_at_all(self):
        rising = self.curve(lambda strain: 1e9 * strain)
        # Stresses are means since the line before.
        self.assertAlmostEqual(curve_landmarks.strain_at(rising, 0.3e9), 0.2995, places=6)
        self.assertIsNone(curve_landmarks.strain_at(rising, 0.6e9))

    def test_a_hump_is_where_the_slope_falls(self):
        share, strain = curve_landmarks.hump(self.curve(
            lambda strain: 1e9 * (numpy.minimum(strain, 0.3) + 0.4 * numpy.maximum(strain - 0.3, 0))))
        self.assertAlmostEqual(share, 0.6, places=6)
        self.assertAlmostEqual(strain, 0.32, places=6)
        self.assertAlmostEqual(curve_landmarks.hump(self.curve(lambda strain: 1e9 * strain ** 2))[0], 0, places=9)

    def test_a_curve_that_ends_before_or_falls_has_none(self):
        self.assertIsNone(curve_landmarks.hump(self.curve(lambda strain: 1e9 * strain, end=0.35)))
        self.assertIsNone(curve_landmarks.hump(self.curve(lambda strain: -1e9 * strain)))


if __name__ == "__main__":
    unittest.main()
