"""Pareto front and slopes on points whose answer is seen by hand."""
import unittest

import pareto


def front(points):
    return pareto.front(points, lambda point: point[0], lambda point: point[1])


class Front(unittest.TestCase):
    def test_keeps_what_nothing_beats(self):
        best = [(1, 9), (2, 5), (4, 1)]
        beaten = [(2, 9), (3, 5), (3, 6), (5, 1), (8, 2)]
        self.assertEqual(front(beaten + best[::-1]), best)

    def test_of_equal_points_only_one_stays(self):
        self.assertEqual(front([(1, 1), (1, 1), (1, 2)]), [(1, 1)])

    def test_of_nothing_is_empty(self):
        self.assertEqual(front([]), [])


class Slope(unittest.TestCase):
    def test_of_a_power_law_is_its_exponent(self):
        costs = [1.0, 3.0, 10.0, 70.0]
        self.assertAlmostEqual(pareto.slope(costs, [5 * c ** -0.66 for c in costs]), -0.66)

    def test_needs_two_different_costs_and_errors_above_zero(self):
        self.assertIsNone(pareto.slope([1.0], [1.0]))
        self.assertIsNone(pareto.slope([2.0, 2.0], [1.0, 3.0]))
        self.assertIsNone(pareto.slope([1.0, 2.0], [1.0, 0.0]))


if __name__ == "__main__":
    unittest.main()
