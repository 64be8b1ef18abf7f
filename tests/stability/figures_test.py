"""The figures against what is known of a run.

    figures_test.py MPM_PAR
"""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

from atlas import defect
from figures import energies, figures_of, pieces, snapshots
import scene_run

SCENES = Path(__file__).with_name("scenes")
MPM_PAR = sys.argv.pop(1) if len(sys.argv) > 1 else None


class Figures(unittest.TestCase):
    def run_scene(self, name, *settings):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        done = scene_run.ended_or_stopped(MPM_PAR, SCENES / name, folder, settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def test_volume_ratio_of_a_confined_block_is_what_the_piston_leaves(self):
        folder = self.run_scene("block_space.yaml", "loading.strain=10 %", "loading.speed=10 m/s")
        *_, (_, _, ratio, strain) = snapshots(folder)
        self.assertAlmostEqual(strain, 0.1, delta=1e-3)
        # Quasi-static: the same everywhere, but for half a cell that a wall holds.
        self.assertAlmostEqual(ratio.mean(), 1 - strain, delta=0.005)
        found = figures_of(folder, ())
        self.assertEqual(found["pieces"], 0)
        self.assertLess(found["through"], 0.5)

    def test_a_spinning_disc_keeps_its_angular_momentum_with_apic_and_loses_it_with_pic(self):
        kept, lost = (figures_of(self.run_scene("spinning_disc.yaml", "free_motion.end_time=0.1 ms",
                                                f"numerics.scheme={scheme}"), ("turned",))["turned"]
                      for scheme in ("apic", "pic"))
        self.assertLess(kept, 0.01)
        self.assertGreater(lost, 0.1)

    def test_a_beam_of_common_material_swings_as_the_theory_says(self):
        folder = self.run_scene("incompressible_beam.yaml", "material.poisson_ratio=0.3")
        self.assertAlmostEqual(figures_of(folder, ("stiffness",))["stiffness"], 1, delta=0.1)


class Parts(unittest.TestCase):
    def test_gain_and_loss_of_made_up_lines(self):
        lines = {"external_work": numpy.array([0, 1.0, 2.0]),
                 "kinetic_energy": numpy.array([2.0, 2, 2]),
                 "energy_error": numpy.array([0, 0.1, -0.2])}
        found = energies(lines)
        self.assertAlmostEqual(found["gain"], 0.2 / 3)
        self.assertAlmostEqual(found["loss"], 0.4 / 4)

    def test_a_verdict_is_worse_beyond_the_slack_only(self):
        table = {"bounds": {"loss": [None, 0.1]}}
        case = {"name": "case", "expected": {"gimp pic": ["degrades", "damping"]}}
        def judged(method, verdict, loss):
            return defect(table, case, method, {"verdict": verdict, "loss": loss, "beyond": "loss",
                                                "message": ""})
        self.assertIsNone(judged("gimp flip", "holds", 0.05))
        self.assertIsNone(judged("gimp flip", "degrades", 0.12))
        self.assertIn("degrades, was: holds", judged("gimp flip", "degrades", 0.13))
        self.assertIsNone(judged("gimp pic", "degrades", 0.5))
        self.assertIn("fails, was: degrades", judged("gimp pic", "fails", 0.0))

    def test_pieces_are_cells_that_share_a_corner(self):
        spacing = numpy.array([1.0, 1.0])
        self.assertEqual(pieces(numpy.array([[0.5, 0.5], [1.5, 1.5], [1.2, 2.1]]), spacing), 1)
        self.assertEqual(pieces(numpy.array([[0.5, 0.5], [2.5, 1.5]]), spacing), 2)


if __name__ == "__main__":
    unittest.main()
