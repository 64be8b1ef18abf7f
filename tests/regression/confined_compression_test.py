"""A uniform block in confined compression against the exact stress.

Why only to 0.5 % strain, and why within 1 %: the piston acts on grid nodes. In the last, partly
filled cell the material deforms as if the cell were full, so that the stress is low by about the
strain itself (and at most by the displacement of a fraction of a cell: it converges, see the last
test). Stresses in the history are means since the last line: they belong to the mean of the exact
line over that interval.
"""
import math
import unittest

from program import History, ProgramTest

YOUNG, POISSON = 50e9, 0.3
SHEAR = YOUNG / (2 * (1 + POISSON))
BULK = YOUNG / (3 * (1 - 2 * POISSON))
CONFINED = BULK + 4 / 3 * SHEAR
VOLUME = 1e-3 * 0.5e-3 * 1.0
YIELD = 100e6

PLASTIC = ["material.law=von_mises", "material.yield_stress=100 MPa"]


def elastic(strain, modulus=CONFINED):
    """Nominal stress, compression positive: - M ln F / F."""
    stretch = 1 - strain
    return -modulus * math.log(stretch) / stretch


def elastic_plastic(strain):
    """Confined von Mises flow: pressure stays elastic, the deviator has the size of the yield stress."""
    stretch = 1 - strain
    if -2 * SHEAR * math.log(stretch) < YIELD:
        return elastic(strain)
    return (-BULK * math.log(stretch) + 2 / 3 * YIELD) / stretch


class ConfinedCompression(ProgramTest):
    def compare(self, *settings, exact=elastic, tolerance=0.01, energy=0.005,
                columns=("stress_piston", "stress_edge"), side="right"):
        """Beyond 0.1 % strain, where what waves of the start remain are a small part."""
        history = History(self.results("confined_block", *settings, ranks=2))
        strain = history["strain"]
        later = [k for k in range(1, len(history)) if strain[k - 1] >= 0.001]
        self.assertGreater(len(later), 25)
        for column in columns:
            for k in later:
                expected = 0.5 * (exact(strain[k - 1]) + exact(strain[k]))
                self.assertAlmostEqual(history[column][k] / expected, 1, delta=tolerance,
                                       msg=f"{column} at strain {strain[k]}")
        for k in later:
            piston, edge = history["stress_piston"][k], history["stress_edge"][k]
            self.assertAlmostEqual(piston / edge, 1, delta=0.02, msg=f"at strain {strain[k]}")
            self.assertLess(abs(history["energy_error"][k]), energy, f"at strain {strain[k]}")
        return history

    def test_hencky_elasticity_in_plane_strain(self):
        history = self.compare()
        energy = VOLUME * 0.5 * CONFINED * math.log(1 - 0.005) ** 2
        self.assertAlmostEqual(history["elastic_energy"][-1] / energy, 1, delta=0.02)

    def test_hencky_elasticity_in_plane_stress(self):
        # ln F_yy = 0 and tau_zz = 0 leave tau_xx = E / (1 - nu^2) ln F; the force is per reference
        # thickness, so the nominal stress is tau / F here too.
        self.compare("numerics.plane=stress",
                     exact=lambda e: elastic(e, YOUNG / (1 - POISSON ** 2)))

    def test_rate_form_follows_the_same_line(self):
        self.compare("material.strain_measure=hypoelastic")

    def test_von_mises_flow(self):
        history = self.compare(*PLASTIC, exact=elastic_plastic)
        self.work_of_flow(history)

    def test_von_mises_flow_in_rate_form(self):
        history = self.compare(*PLASTIC, "material.strain_measure=hypoelastic",
                               exact=elastic_plastic)
        self.work_of_flow(history)

    def work_of_flow(self, history):
        """Equivalent plastic strain: 2/3 |ln F| less the elastic part q / (3 G)."""
        strain = -2 / 3 * math.log(1 - 0.005) - YIELD / (3 * SHEAR)
        self.assertGreater(strain, 0.001)
        self.assertAlmostEqual(history["plastic_work"][-1] / (VOLUME * YIELD * strain), 1,
                               delta=0.03)

    def test_piston_may_come_from_any_side(self):
        first = None
        for side in ("right", "left", "top", "bottom"):
            with self.subTest(side=side):
                settings = [f"loading.piston={side}"]
                if side in ("top", "bottom"):
                    settings += ["specimen.size=[0.5 mm, 1 mm]", "grid.cells=[10, 20]",
                                 "specimen.shapes[0].box.upper=[0.5 mm, 1 mm]"]
                history = self.compare(*settings)
                # Mirrored and turned, the same numbers up to rounding.
                first = first or history["stress"]
                for one, other in zip(first, history["stress"]):
                    self.assertAlmostEqual(one / first[-1], other / first[-1], delta=1e-8)


if __name__ == "__main__":
    unittest.main()
