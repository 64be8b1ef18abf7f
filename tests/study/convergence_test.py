"""Observed order and extrapolation on sequences whose order and limit are known."""
import unittest

import numpy

import convergence


def sequence(limit, constant, order, sizes):
    return [limit + constant * h ** order for h in sizes]


class ObservedOrder(unittest.TestCase):
    def test_is_exact_where_the_ratio_of_sizes_is_not_constant(self):
        sizes = [1.0, 0.7, 0.4]
        for order in (0.6, 1.0, 1.7, 2.0, 3.5):
            for constant in (0.3, -2.0):
                values = sequence(5, constant, order, sizes)
                self.assertAlmostEqual(convergence.observed_order(sizes, values), order, places=9)

    def test_of_a_curve_is_that_of_its_differences(self):
        sizes, shape = [1.0, 0.5, 0.25], numpy.array([1.0, -2.0, 0.5])
        values = [3 + shape * h ** 1.5 for h in sizes]
        self.assertAlmostEqual(convergence.observed_order(sizes, values), 1.5, places=9)

    def test_there_is_none_of_values_that_oscillate_grow_apart_or_stand_still(self):
        sizes = [1.0, 0.5, 0.25]
        for values in ([1.0, 2.0, 1.5], [1.0, 2.0, 4.0], [1.0, 1.0, 1.0], [1.0, 2.0, 2.0]):
            self.assertIsNone(convergence.observed_order(sizes, values))

    def test_there_is_none_of_curves_that_change_in_another_way_each_time(self):
        values = [numpy.array(v) for v in ([1.0, 0.0], [0.0, 0.0], [0.0, 0.5])]
        self.assertIsNone(convergence.observed_order([1.0, 0.5, 0.25], values))


class Limit(unittest.TestCase):
    def test_is_exact_and_without_warning_in_the_asymptotic_range(self):
        sizes = [1 / n for n in (10, 15, 20, 30)]
        found = convergence.limit(sizes, sequence(7, 40, 1.8, sizes))
        self.assertAlmostEqual(found.value, 7, places=9)
        self.assertAlmostEqual(found.order, 1.8, places=9)
        self.assertEqual(found.warnings, [])

    def test_of_a_curve_is_the_curve(self):
        sizes = [1 / n for n in (10, 15, 20, 30)]
        straight, bent = numpy.linspace(0, 1, 5), numpy.array([0.0, 1.0, 4.0, 2.0, 1.0])
        found = convergence.limit(sizes, [straight + bent * h for h in sizes])
        numpy.testing.assert_allclose(found.value, straight, atol=1e-9)

    def test_three_levels_show_no_range(self):
        sizes = [0.1, 0.07, 0.05]
        found = convergence.limit(sizes, sequence(7, 40, 2, sizes))
        self.assertEqual(len(found.warnings), 1)
        self.assertIn("three levels only", found.warnings[0])

    def test_orders_that_disagree_are_told(self):
        sizes = [1.0, 0.5, 0.25, 0.125]
        values = [1 + h + 3 * h ** 4 for h in sizes]
        found = convergence.limit(sizes, values)
        self.assertTrue(any("disagree" in text for text in found.warnings), found.warnings)

    def test_differences_that_do_not_fall_are_told_though_the_last_ones_do(self):
        sizes = [1.0, 0.5, 0.25, 0.125]
        found = convergence.limit(sizes, [5.0, 3.0, 4.0, 4.4])
        self.assertTrue(any("do not fall monotonically" in text for text in found.warnings))
        self.assertIsNotNone(found.value)

    def test_there_is_none_where_the_last_levels_do_not_approach_one(self):
        sizes = [1.0, 0.5, 0.25]
        for values in ([1.0, 2.0, 1.5], [1.0, 1.5, 2.5]):
            found = convergence.limit(sizes, values)
            self.assertIsNone(found.value)
            self.assertTrue(found.warnings)

    def test_a_low_order_is_not_extrapolated(self):
        sizes = [1.0, 0.5, 0.25]
        found = convergence.limit(sizes, sequence(1, 1, 0.2, sizes))
        self.assertIsNone(found.value)
        self.assertTrue(any("0.20 lies outside" in text for text in found.warnings))


if __name__ == "__main__":
    unittest.main()
