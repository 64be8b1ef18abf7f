"""Real micrographs, where they are: scenes as short as a user would write them."""
import os
import pathlib
import sys
import unittest

from program import History, ProgramTest, mpm_par

MICROGRAPHS = pathlib.Path(os.environ["MPM_MICROGRAPHS"])
PICTURES = {"spruce": ("spruce_sem/spruce_ring_boundary_x4.bmp", 0.974),
            "lomatia": ("hardwood/lomatia_arborescens_621x418.bmp", 0.96)}

SCENE = """specimen:
  micrograph: {picture}
  pixel_size: {pixel} um
  threshold: 128
loading:
  piston: right
  speed: 10 m/s
  strain: {strain}
"""


class RealWood(ProgramTest):
    def test_real_wood_collapses_with_a_closed_energy_balance(self):
        for name, (picture, pixel) in PICTURES.items():
            with self.subTest(name):
                scene = self.folder / f"{name}.yaml"
                scene.write_text(SCENE.format(picture=MICROGRAPHS / picture, pixel=pixel,
                                              strain=0.1))
                run = mpm_par(scene, "--output", self.folder / name, ranks=2, timeout=300)
                self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
                history = History(self.folder / name)
                for at, error in zip(history["strain"], history["energy_error"]):
                    if at > 0.01:
                        self.assertLess(abs(error), 0.005, f"{name} at strain {at}")
                self.assertGreater(history["plastic_work"][-1], 0)


if __name__ == "__main__":
    if not all((MICROGRAPHS / picture).exists() for picture, _ in PICTURES.values()):
        print(f"skipped: the real micrographs are not in {MICROGRAPHS}")
        sys.exit(0)
    unittest.main()
