"""Every shipped study is read, in full and quick, and its exact figures are those of formulae."""
import math
import pathlib
import unittest

import study_file

FOLDER = pathlib.Path(__file__).parents[2] / "inputs" / "studies"
WOOD = sorted(FOLDER.glob("wood_*.yaml"))
STUDIES = sorted({*FOLDER.glob("*.yaml")} - {*WOOD})


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
        """Nairn 2006, Table 1: ten rows with onsets (two have none), each its own modulus, and five of
        them again beside woods with solid rays."""
        rows = []
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
                rows += [(full.title.split()[0], *found.values()) for found in known if found]
        solid_rays = [row for row in rows if row[0] == "Woods"]
        rows = [row for row in rows if row not in solid_rays]
        self.assertEqual(len(solid_rays), 5)
        self.assertLessEqual({row[1:] for row in solid_rays}, {row[1:] for row in rows})
        self.assertEqual(len(rows), 11)
        self.assertEqual(sorted({row[1] / 1e6 for row in rows}), [648, 2479, 2740, 3252, 3731])
        self.assertEqual(sum(len(row) == 6 for row in rows), 9)

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
