"""The finite elements behind the table against what is known, and the table against them."""
import json
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).with_name("references")))
import honeycomb
import measures
import ring
import thick_cylinder
from finite_elements import Plane, four_sided, patch

TABLE = json.loads(Path(__file__).with_name("table.json").read_text())


def exact(scene):
    return measures.number(next(case["exact"] for case in TABLE if case["scene"] == scene + ".yaml"))


class References(unittest.TestCase):
    def test_a_distorted_patch_carries_uniform_strain(self):
        ends = numpy.array([0, 0.3, 1])
        body = Plane([patch(four_sided([(0, 0), (2, 0.2), (1.7, 1), (-0.1, 1.4)]), ends, ends)], 1, 0.3)
        x, y = body.nodes.T
        u = numpy.stack([0.1 * x + 0.05 * y, -0.2 * y], -1).ravel()
        forces, _, _ = body.response(u)
        lame, shear = 0.3 / (1.3 * 0.4), 1 / 2.6
        energy = 0.5 * (lame * 0.1**2 + 2 * shear * (0.1**2 + 0.2**2 + 2 * 0.025**2))
        self.assertAlmostEqual(forces @ u / 2, energy * body.weight.sum(), places=12)

    def test_the_thick_cylinder_is_hills_when_nearly_incompressible(self):
        hill = thick_cylinder.K * 1.5**2 * 1.4999 * 2 / 3
        self.assertAlmostEqual(thick_cylinder.mean_displacement(8, 0.4999) / hill, 1, delta=5e-4)

    def test_the_thick_cylinder_of_the_table(self):
        self.assertAlmostEqual(thick_cylinder.mean_displacement(8, 0.3) / exact("thick_cylinder"), 1,
                               delta=1e-3)

    def test_moduli_of_the_honeycomb_of_the_table(self):
        body = honeycomb.cell(0.3, 4, 0.33)
        confined = honeycomb.loaded(body, [1.0], 0.0)[0, 0]
        uniaxial, _, ratio = honeycomb.loaded(body, [1.0])[0]
        self.assertAlmostEqual(confined / exact("honeycomb_confined") * 10.6e9, 1, delta=1e-3)
        self.assertAlmostEqual(uniaxial / exact("honeycomb_uniaxial") * 10.6e9, 1, delta=1e-3)
        self.assertAlmostEqual(ratio, 0.741, delta=5e-4)
        # In the elastic range a regular honeycomb is isotropic: C11 (1 - nu^2) = E.
        self.assertAlmostEqual(confined * (1 - ratio**2), uniaxial, delta=1e-3 * uniaxial)

    def test_confined_collapse_of_the_honeycomb_is_that_of_its_upright_walls(self):
        found = honeycomb.loaded(honeycomb.cell(0.3, 2, 0.33, 1e-3),
                                 numpy.linspace(0, 5e-3, 21)[1:], 0.0)
        self.assertAlmostEqual(found[-1, 0] / 1e-3 / (2 / 3 * 0.3), 1, delta=2e-3)

    def test_the_ring_between_plates(self):
        # Timoshenko (Strength of Materials II): shortened by (pi/4 - 2/pi) F R^3 / EI at first.
        self.assertAlmostEqual(2 * (1 - ring.half_height(1e-3)) / (2e-3 * (numpy.pi / 4 - 2 / numpy.pi)), 1, delta=1e-3)
        self.assertAlmostEqual(ring.mean_stress() / exact("ring_between_plates"), 1, delta=1e-3)

    def test_energy_of_the_bent_wall(self):
        # The formula of bent_wall.yaml
        length, t, nu = 0.02, 1e-3, 0.33
        modulus, shear, load = 10.6e9 / (1 - nu**2), 10.6e9 / (2 + 2 * nu), 1500 * 1e4 * t
        wave = 2 * numpy.pi / length
        energy = 0.75 * load**2 * length / wave**4 / (modulus * t**3 / 12) * (
            1 + modulus * t**2 * wave**2 / (36 * 5 / 6 * shear))
        for scene in ("bent_wall", "bent_wall_inclined"):
            self.assertAlmostEqual(exact(scene) * energy, 1, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
