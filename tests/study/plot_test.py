"""Plots of whatever a study may give: they are drawn, whole, and the same each time."""
import pathlib
import tempfile
import unittest

import evaluation
import plot
from made_up import evaluated


def drawn(*arguments, **keywords):
    study, rows, outcome = evaluated(*arguments, **keywords)
    with tempfile.TemporaryDirectory() as folder:
        paths = plot.draw(study, rows, outcome, pathlib.Path(folder))
        return {pathlib.Path(path).name: pathlib.Path(path).read_bytes() for path in paths}


class Plot(unittest.TestCase):
    def check(self, files):
        self.assertEqual(set(files), {"error_modulus.svg", "error_modulus.png"})
        self.assertTrue(files["error_modulus.png"].startswith(b"\x89PNG"))
        self.assertTrue(files["error_modulus.svg"].rstrip().endswith(b"</svg>"))

    def test_shows_fronts_and_crosses(self):
        values = {"gimp": [220.0, 210.0, 205.0], "linear": [300.0, 290.0, 280.0]}
        states = {3: evaluation.UNSTABLE, 4: evaluation.FAILED, 5: evaluation.FAILED}
        files = drawn(200.0, values, series=("gimp", "linear"), states=states)
        self.check(files)
        self.assertIn(b"error of modulus against 200.0", files["error_modulus.svg"])
        self.assertIn(b"unstable or failed", files["error_modulus.svg"])

    def test_is_the_same_each_time(self):
        values = {"gimp": [220.0, 210.0, 205.0]}
        self.assertEqual(drawn(200.0, values), drawn(200.0, values))

    def test_needs_no_point(self):
        self.check(drawn("finest", {"gimp": [1.0, 2.0]},
                         states={0: evaluation.FAILED, 1: evaluation.FAILED}))

    def test_bears_one_point_and_an_error_of_zero(self):
        self.check(drawn(200.0, {"gimp": [210.0]}))
        self.check(drawn(200.0, {"gimp": [210.0, 200.0]}))


if __name__ == "__main__":
    unittest.main()
