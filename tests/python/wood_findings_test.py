"""What the founding paper found of wood (Nairn 2006, Wood Fiber Sci. 38(4):576), on the shipped woods,
coarse and fast: 75 cells across, 50 m/s."""
import os
import pathlib
import unittest

import needed

needed.modules("numpy", "h5py", "yaml")

import numpy  # noqa: E402

from mpm_par import Window, open_run, work_in_windows  # noqa: E402
from program import mpm_par, set_options  # noqa: E402

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
FAST = ["grid.cells=[75, 49]", "loading.speed=50 m/s", "output.history_lines=400"]
ELASTIC = ("material={law: isotropic, youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, "
           "density: 1500 kg/m^3}")
RADIAL, TANGENTIAL = "loading.piston=right", "loading.piston=top"


class Findings(unittest.TestCase):
    def crushed(self, name, strain, *settings):
        folder = pathlib.Path(os.environ["MPM_SCRATCH"]) / "_".join(
            [name, *(word.split("=")[1].strip("{} ").replace("micrograph: ", "")[:16] for word in settings)])
        run = mpm_par(WOOD / f"{name}_radial.yaml", "--output", folder, "--overwrite", *set_options(
            [*FAST, f"loading.strain={strain}", *settings]), ranks=2, timeout=400)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return open_run(folder)

    def stress(self, run, begin, end):
        """The mean from strain to strain, Pa."""
        return run.history.at("stress", numpy.linspace(begin, end, 100)).mean()

    def hump(self, run):
        """The largest share of the slope that the curve loses between 24 and 36 % strain."""
        places = numpy.arange(0.24, 0.361, 0.01)
        slope = run.history.at("stress", places + 0.02) - run.history.at("stress", places - 0.02)
        return (1 - slope / numpy.maximum.accumulate(slope)).max()

    def strain_at(self, run, stress):
        return run.history["strain"][numpy.argmax(run.history["stress"] > stress)]

    def test_collapse_follows_the_yield_stress_and_is_elastic_from_2500_MPa_on(self):
        quiet = "output.snapshots=0"
        plateau = {}
        for name, law in (("100", "material.yield_stress=100 MPa"),
                          ("500", "material.yield_stress=500 MPa"),
                          ("2500", "material.yield_stress=2500 MPa"), ("elastic", ELASTIC)):
            plateau[name] = self.stress(self.crushed("loblolly", 0.1, RADIAL, quiet, law), 0.03, 0.09)
        # The onsets of the paper's Table 1 are 16.7, 54.2, 90.7 and 92.6 MPa: exponent 0.73 over the
        # yield stress, as elastic buckling is not far off, and 1.71 times 500 MPa's without it.
        exponent = numpy.log(plateau["500"] / plateau["100"]) / numpy.log(5)
        self.assertAlmostEqual(exponent, 0.73, delta=0.12)
        self.assertAlmostEqual(plateau["2500"] / plateau["elastic"], 1, delta=0.03)
        self.assertAlmostEqual(plateau["elastic"] / plateau["500"], 1.71, delta=0.2)

    def test_softwood_collapses_in_its_earlywood_first_and_tangentially_at_a_higher_stress(self):
        radial = self.crushed("loblolly", 0.45, RADIAL, "output.snapshots={strains: [0 %, 5 %, 15 %, 45 %]}")
        border = 0.473 * 0.832e-3
        inside, everywhere, volumes = work_in_windows(radial, [
            Window("earlywood", (0, 0), (border, 1)), Window("latewood", (border, 0), (1, 1))])
        shares = inside / everywhere[:, None]
        for k, snapshot in enumerate(radial.snapshots):
            if 0.04 < snapshot.strain < 0.16:
                self.assertGreater(shares[k, 0], 0.95, snapshot.strain)
        self.assertGreater(shares[-1, 1], 0.3)  # the latewood follows

        tangential = self.crushed("loblolly", 0.45, TANGENTIAL, "output.snapshots=0")
        self.assertGreater(self.stress(tangential, 0.08, 0.15), 2 * self.stress(radial, 0.08, 0.15))
        self.check_densification(radial, tangential)

    def test_curve_has_a_second_hump_where_the_latewood_yields_and_none_where_it_hardly_does(self):
        # Fig. 5, at 24 % strain. The paths of buckling leave some noise in slopes.
        soft, strong = (self.hump(self.crushed("loblolly", 0.39, RADIAL, "output.snapshots=0", "loading.speed=25 m/s",
                                               f"material.yield_stress={size} MPa")) for size in (100, 2500))
        self.assertGreater(soft, 0.3)
        self.assertGreater(soft, 2 * strong)

    def check_densification(self, radial, tangential):
        """Of a hardwood too: it is stiffer along its rays, both directions are alike from some 35 %
        on, and the strain at which wood becomes dense depends on its lumens, not on the direction."""
        poplar = [self.crushed("poplar", 0.5, way, "output.snapshots=0")
                  for way in (RADIAL, TANGENTIAL)]
        self.assertGreater(self.stress(poplar[0], 0.01, 0.03), 2 * self.stress(poplar[1], 0.01, 0.03))
        late = [self.stress(run, 0.35, 0.4) for run in poplar]
        self.assertAlmostEqual(late[0] / late[1], 1, delta=0.1)
        softwood, hardwood = ([self.strain_at(run, 1e9) for run in pair]
                              for pair in ((radial, tangential), poplar))
        self.assertAlmostEqual(softwood[0], softwood[1], delta=0.015)
        self.assertAlmostEqual(hardwood[0], hardwood[1], delta=0.015)
        lumens = [1 - pair[0].summary["relative_density"] for pair in ((radial,), poplar)]
        self.assertGreater(lumens[1], lumens[0])
        self.assertGreater(min(hardwood), max(softwood))

    def test_softwood_is_stiffer_along_the_tangent_where_its_rays_are_solid(self):
        # Table 1 has 2740 and 3252 MPa for loblolly, 3731 and 2479 MPa for poplar, along radius and tangent.
        def read(wood, rays):
            specimen = f"specimen={{micrograph: {wood}{rays}.anatomy.yaml, threshold: 150}}"
            return [self.crushed(wood, 0.2, way, specimen, "loading.speed=25 m/s", "output.snapshots=0")
                    .properties for way in (RADIAL, TANGENTIAL)]

        radial, tangential = read("loblolly", "_filled_rays")
        self.assertGreater(tangential["modulus"], 1.1 * radial["modulus"])
        self.assertIsNone(tangential["toe"])
        radial, tangential = read("poplar", "_filled_rays")
        self.assertGreater(radial["modulus"], 1.4 * tangential["modulus"])
        # Open ones close first: a toe.
        radial, tangential = read("loblolly", "")
        self.assertIsNone(radial["toe"])
        self.assertLess(tangential["modulus"], 0.7 * radial["modulus"])
        self.assertGreater(tangential["toe"]["modulus"], 2 * tangential["modulus"])
        self.assertGreater(tangential["toe"]["modulus"], radial["modulus"])
        # 173.6 MPa in the paper, 219 here over ten drawn specimens (docs/wood_study.md).
        self.assertAlmostEqual(tangential["buckling"]["stress"] / 219e6, 1, delta=0.1)


if __name__ == "__main__":
    unittest.main()
