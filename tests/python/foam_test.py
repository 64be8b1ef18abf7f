"""Closed formulae against the founding paper's tables and against what they are made of."""
import math
import types
import unittest

from mpm_par import foam

try:
    from mpm_par.report import theory
except ImportError:
    theory = None

# Nairn 2006, Table 2: relative density, yield stress, modulus, elastic and plastic buckling, MPa.
# The yield stress there stands for 1.133 times its value, of plane strain (its eq. 3).
TABLE_2 = ((0.404, 100, 1510, 144, 11.8), (0.404, 500, 1510, 144, 58.8),
           (0.404, 2500, 1510, 144, 294), (0.791, 100, 20390, 1942, 66.7),
           (0.791, 500, 20390, 1942, 333.3), (0.791, 2500, 20390, 1942, 1667),
           (0.563, 500, 4965, 473, 130), (0.369, 500, 1111, 106, 47.9))


class Honeycomb(unittest.TestCase):
    def test_has_the_figures_of_the_papers_table(self):
        for density, yield_stress, modulus, elastic, plastic in TABLE_2:
            found = foam.honeycomb(density, 10600, 1.133 * yield_stress)
            with self.subTest(density=density, yield_stress=yield_stress):
                # the table's densities have three figures, and (t/l)^3 four times their error
                self.assertAlmostEqual(found.modulus / modulus, 1, delta=0.005)
                self.assertAlmostEqual(found.elastic_buckling / elastic, 1, delta=0.006)
                self.assertAlmostEqual(found.plastic_collapse / plastic, 1, delta=0.004)

    def test_thickness_is_that_of_hexagons(self):
        """A hexagon of side 1 whose walls take t/2 off each of its six sides: the lumen is a
        hexagon of apothem sqrt(3)/2 - t/2."""
        for ratio in (0.01, 0.3, 1.0, math.sqrt(3)):
            lumen = (1 - ratio / math.sqrt(3)) ** 2
            if lumen < 1:
                self.assertAlmostEqual(foam.thickness_ratio(1 - lumen), ratio, places=12)

    def test_plane_strain_stiffens_and_strengthens_the_wall(self):
        plain = foam.honeycomb(0.3, 10e9, 100e6)
        strain = foam.honeycomb(0.3, 10e9, 100e6, plane_strain=True, poisson_ratio=0.33)
        self.assertAlmostEqual(strain.modulus / plain.modulus, 1 / (1 - 0.33 ** 2), places=12)
        self.assertAlmostEqual(strain.plastic_collapse / plain.plastic_collapse,
                               2 / math.sqrt(3), places=12)

    def test_gives_way_at_the_lower_stress(self):
        weak, strong = (foam.honeycomb(0.3, 10e9, stress) for stress in (10e6, 10e9))
        self.assertEqual(weak.plateau, weak.plastic_collapse)
        self.assertEqual(strong.plateau, strong.elastic_buckling)
        elastic = foam.honeycomb(0.3, 10e9)
        self.assertIsNone(elastic.plastic_collapse)
        self.assertEqual(elastic.plateau, elastic.elastic_buckling)

    def test_densities_that_are_none_are_refused(self):
        for density in (-0.1, 0, 1.1, math.nan):
            with self.assertRaises(ValueError):
                foam.thickness_ratio(density)


class Layers(unittest.TestCase):
    def test_of_loblolly_are_the_papers(self):
        soft, stiff = foam.layer_moduli(2740, 3252, 0.473)
        self.assertAlmostEqual(soft, 1919, delta=0.5)
        self.assertAlmostEqual(stiff, 4449, delta=1)

    def test_come_back_out_of_what_they_make(self):
        for soft, stiff, share in ((1, 1, 0.5), (1, 3, 0.2), (2, 50, 0.9), (1e9, 1.2e9, 0.473)):
            across = 1 / (share / soft + (1 - share) / stiff)
            along = share * soft + (1 - share) * stiff
            found = foam.layer_moduli(across, along, share)
            self.assertAlmostEqual(found[0] / soft, 1, delta=1e-6)
            self.assertAlmostEqual(found[1] / stiff, 1, delta=1e-6)

    @unittest.skipUnless(theory, "needs NumPy, matplotlib and Pillow")
    def test_are_those_of_the_lighter_window_whichever_is_named_first(self):
        def run(piston, modulus, windows, toe=None):
            return types.SimpleNamespace(
                axis=piston, properties={"modulus": modulus, "toe": toe}, scene={"specimen": {"windows": windows}},
                summary={"windows": {"early": 0.40, "late": 0.79}})

        def rows(*windows, toe=None):
            entries = [{"settings": {"loading.piston": side}, "label": side, "level": ""}
                       for side in ("right", "top")]
            study = types.SimpleNamespace(title="", record={"along": None})
            runs = [run(0, 2740e6, windows), run(1, 3252e6 if not toe else 500e6, windows, toe)]
            return theory.layer_rows(study, list(zip(entries, runs)))[1]

        early, late = {"name": "early", "x": ["0", "0.473"]}, {"name": "late", "x": ["0.473", "1"]}
        expected = [["right", "0.473", "2740", "3252", "1919", "4449"]]
        self.assertEqual(rows(early, late), expected)
        self.assertEqual(rows(late, early), expected)
        # A soft start, where slots close first, is none of the layers'.
        self.assertEqual(rows(early, late, toe={"strain": 0.03, "modulus": 3252e6}), expected)
        # Two that do not part the width are no two layers.
        self.assertEqual(rows({"name": "early", "x": [0, 0.4]}, {"name": "late", "x": [0.6, 1]}), [])

    def test_are_none_where_the_moduli_are_no_bounds(self):
        self.assertIsNone(foam.layer_moduli(3252, 2740, 0.473))
        self.assertIsNone(foam.layer_moduli(1, 2, 0))


if __name__ == "__main__":
    unittest.main()
