"""Figures out of histories and summaries that are written here."""
import pathlib
import tempfile
import unittest

import numpy

import results

# A stress of 100 MPa per unit of strain; each is the mean since the last line, half a line earlier.
STRAINS = [0.0, 0.1, 0.2, 0.3, 0.4]
LINES = "".join(f"{e},{100e6 * max(0, e - 0.05)}\n" for e in STRAINS)


class History(unittest.TestCase):
    def read(self, lines=LINES, header="strain [1],stress [Pa]", column="stress", begin=0.1,
             end=0.3, read=results.curve):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            path.write_text(header + "\n" + lines)
            return read(path, column, begin, end)

    def missing(self, words, **changes):
        with self.assertRaisesRegex(results.Missing, words):
            self.read(**changes)

    def test_stress_belongs_to_the_middle_of_a_line(self):
        curve = self.read()
        numpy.testing.assert_allclose(curve, 100e6 * numpy.linspace(0.1, 0.3, len(curve)))
        self.assertAlmostEqual(self.read(read=results.mean) / 20e6, 1)

    def test_other_columns_belong_to_its_end(self):
        curve = self.read(header="strain [1],elastic_energy [J]", column="elastic_energy")
        self.assertAlmostEqual(curve[0] / 5e6, 1)

    def test_what_is_not_there_is_told(self):
        self.missing("no column stress_edge", column="stress_edge")
        self.missing("ends at 40 % strain, before 50 %", end=0.5)
        self.missing("no line of values", lines="")
        self.missing("not finite", lines=LINES[:LINES.index("0.2,")] + "0.2,nan\n0.3,0\n")


class Figure(unittest.TestCase):
    summary = {"modulus": 3.0, "name": "x", "bad": float("nan"), "compression":
               {"densification": None, "remark": "The curve ends early."}}

    def test_is_found_by_its_path(self):
        self.assertEqual(results.figure(self.summary, "modulus"), 3.0)

    def test_that_is_missing_says_why(self):
        for path, words in (("compression.densification.strain", "The curve ends early."),
                            ("compression.modulus", "has no compression.modulus"),
                            ("name", "no number"), ("bad", "not finite")):
            with self.assertRaisesRegex(results.Missing, words):
                results.figure(self.summary, path)


class RelativeError(unittest.TestCase):
    def test_of_curves_is_in_the_2_norm(self):
        found = results.relative_error(numpy.array([3.0, 4.0]), numpy.array([3.0, 0.0]))
        self.assertAlmostEqual(found, 4 / 3)


if __name__ == "__main__":
    unittest.main()
