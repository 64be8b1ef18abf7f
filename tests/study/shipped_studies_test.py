"""Every shipped study is read, in full and quick, and its exact figures are those of formulae."""
import math
import pathlib
import unittest

import study_file

FOLDER = pathlib.Path(__file__).parents[2] / "inputs" / "studies"
WOOD = sorted(FOLDER.glob("wood_*.yaml"))
STUDIES = sorted({*FOLDER.glob("*.yaml")} - {*WOOD})
# Nairn 2006, Table 1: modulus, stress and strain of the onsets of buckling and densification; MPa, %.
UNITS = 1e6, 1e6, 0.01, 1e6, 0.01
TABLE_1 = ((2740, 16.7, 0.43, 40.0, 24.8), (2740, 54.2, 1.80, 161.4, 27.1), (2740, 90.7, 3.13, 238.4, 27.7),
           (2740, 92.6, 3.20, 213.4, 28.1), (3252, 39.1, 1.32, 79.9, 29.9), (3252, 173.6, 5.45, 330.4, 29.5),
           (3252,), (3252,), (3731, 102.1, 2.75, 221.1, 31.4), (2479, 71.4, 2.75, 192.4, 30.7),
           (648, 15.2, 2.47, 63.8, 36.2))


class ShippedStudies(unittest.TestCase):
    def test_are_understood_in_both_variants(self):
        self.assertGreaterEqual(len(STUDIES), 4)
        for path in STUDIES:
            with self.subTest(path.name):
                full, quick = (study_file.read_study(path, quick=way) for way in (False, True))
                self.assertNotEqual([quick.assignments(run) for run in quick.combinations],
                                    [full.assignments(run) for run in full.combinations])
                self.assertLessEqual(len(quick.combinations) * quick.repeat,
                                     len(full.combinations) * full.repeat)
                self.assertIsNotNone(full.along)

    def test_of_the_founding_paper_are_understood_and_stand_beside_its_table(self):
        """Nairn 2006, Table 1: eleven rows, two of them without onsets, each with its own modulus. All
        of them stand again beside the paper's method; those of a yield stress of 500 MPa beside
        woods with solid rays, and ponderosa twice there: as drawn and from a coarse scan."""
        rows = {}
        for path in WOOD:
            with self.subTest(path.name):
                full, quick = (study_file.read_study(path, quick=way) for way in (False, True))
                self.assertNotEqual([quick.assignments(run) for run in quick.combinations],
                                    [full.assignments(run) for run in full.combinations])
                self.assertEqual({run.label for run in quick.combinations},
                                 {run.label for run in full.combinations})
                known = [full.known_of(run) for run in full.combinations]
                self.assertEqual(known, [quick.known_of(run) for run in quick.combinations]
                                 if any(known) else known)
                for found in filter(None, known):
                    self.assertEqual(found.pop("modulus_beyond_toe", found["modulus"]), found["modulus"])
                rows[path.stem] = [tuple(found.values()) for found in known if found]
        table = rows.pop("wood_yield") + rows.pop("wood_poplar") + rows.pop("wood_ponderosa")
        self.assertCountEqual([tuple(float(f"{figure / unit:.4g}") for figure, unit in zip(row, UNITS))
                               for row in table], TABLE_1)
        self.assertCountEqual(rows.pop("wood_paper_method"), table)
        self.assertEqual(len(rows["wood_rays"]), 6)
        self.assertEqual(len(set(rows.pop("wood_rays")) & set(table)), 5)
        self.assertFalse(any(rows.values()))

    def test_the_block_is_compared_with_its_exact_line(self):
        """Mean of - M ln(1 - e)/(1 - e) over the strains, M = E (1 - nu)/((1 + nu)(1 - 2 nu))."""
        modulus = 50e9 * 0.7 / (1.3 * 0.4)
        for name in ("confined_block", "block_levels"):
            study = study_file.read_study(next(p for p in STUDIES if p.stem == name))
            for measure in study.measures:
                begin, end = measure.strain
                mean = modulus / 2 * (math.log(1 - end) ** 2 - math.log(1 - begin) ** 2) \
                    / (end - begin)
                self.assertAlmostEqual(measure.against / mean, 1, places=6, msg=measure.name)


if __name__ == "__main__":
    unittest.main()
