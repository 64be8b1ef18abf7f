"""What the founding paper found of wood (Nairn 2006, Wood Fiber Sci. 38(4):576), on the shipped woods,
coarse and fast: 75 cells across, 50 m/s. All runs are made at once, two at a time, whichever test asks."""
import concurrent.futures
import os
import pathlib
import unittest

import needed

needed.modules("numpy", "h5py", "yaml")

import numpy  # noqa: E402

from mpm_par import Window, open_run, work_in_windows  # noqa: E402
from program import mpm_par, set_options  # noqa: E402
from curve_landmarks import hump, strain_at  # noqa: E402

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
FAST = ["grid.cells=[75, 49]", "loading.speed=50 m/s", "output.history_lines=400", "output.snapshots=0"]
SLOWER = "loading.speed=25 m/s"
ELASTIC = ("material={law: isotropic, youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, "
           "density: 1500 kg/m^3}")
METHOD = ["numerics={formulation: updated_lagrangian, shape_function: linear}", SLOWER]  # the paper's
PISTONS = {"radial": "loading.piston=right", "tangential": "loading.piston=top"}


def specimen(wood, rays, sampling="match"):
    return f"specimen={{micrograph: {wood}{rays}.anatomy.yaml, threshold: 150, sampling: {sampling}}}"


def by_its_method(picture, cells, *settings):
    return 0.1, *METHOD, f"grid.cells={cells}", specimen(*picture, "threshold"), *settings


RUNS = {  # wood, law or rays, piston: strain and settings
    **{("loblolly", law, "radial"): (0.1, setting) for law, setting in (
        ("100 MPa", "material.yield_stress=100 MPa"), ("500 MPa", "material.yield_stress=500 MPa"))},
    **{("loblolly", law, way): (0.1, setting) for way in PISTONS for law, setting in (
        ("2500 MPa", "material.yield_stress=2500 MPa"), ("elastic", ELASTIC))},
    ("loblolly", "whole", "radial"): (0.45, "output.snapshots={strains: [0 %, 5 %, 15 %, 24 %, 36 %, 45 %]}"),
    ("loblolly", "whole", "tangential"): (0.45,),
    ("poplar", "whole", "radial"): (0.5,),
    ("poplar", "whole", "tangential"): (0.5,),
    **{("loblolly", f"hump, {size} MPa", "radial"): (0.39, SLOWER, f"material.yield_stress={size} MPa")
       for size in (100, 2500)},
    **{(wood, "solid rays", way): (0.2, SLOWER, specimen(wood, "_filled_rays"))
       for wood in ("loblolly", "poplar") for way in PISTONS},
    # On 75 cells the walls that bear along the tangent are a location wide in places: no stiffer than radially.
    **{("loblolly", "open rays", way): (0.2, SLOWER, "grid.cells=[106, 69]", specimen("loblolly", ""))
       for way in PISTONS},
    **{("loblolly", f"its method{rays}", "tangential"): by_its_method(
        ("loblolly", rays), [150, 97], "material.yield_stress=100 MPa") for rays in ("", "_narrow_rays")},
    **{("loblolly", f"its method, ponderosa{scan}", "tangential"): by_its_method(
        ("ponderosa", scan), [200, 258]) for scan in ("", "_coarse_scan")},
}


def crush(number, key):
    wood, _, way = key
    strain, *settings = RUNS[key]
    folder = pathlib.Path(os.environ["MPM_SCRATCH"]) / str(number)
    return folder, mpm_par(WOOD / f"{wood}_radial.yaml", "--output", folder, "--overwrite", *set_options(
        [*FAST, PISTONS[way], f"loading.strain={strain}", *settings]), timeout=600)


class Findings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pool = concurrent.futures.ThreadPoolExecutor(2)
        cls.addClassCleanup(cls.pool.shutdown, cancel_futures=True)
        cls.made = {key: cls.pool.submit(crush, number, key) for number, key in enumerate(RUNS)}

    def crushed(self, *key):
        folder, run = self.made[key].result()
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return open_run(folder)

    def stress(self, run, begin, end):
        """The mean from strain to strain, Pa."""
        return run.history.at("stress", numpy.linspace(begin, end, 100)).mean()

    def test_collapse_follows_the_yield_stress_and_is_elastic_from_2500_MPa_on(self):
        plateau = {law: self.stress(self.crushed("loblolly", law, "radial"), 0.03, 0.09)
                   for law in ("100 MPa", "500 MPa", "2500 MPa", "elastic")}
        # The onsets of the paper's Table 1 are 16.7, 54.2, 90.7 and 92.6 MPa: exponent 0.73 over the
        # yield stress, as elastic buckling is not far off, and 1.71 times 500 MPa's without it.
        exponent = numpy.log(plateau["500 MPa"] / plateau["100 MPa"]) / numpy.log(5)
        self.assertAlmostEqual(exponent, 0.73, delta=0.12)
        self.assertAlmostEqual(plateau["elastic"] / plateau["500 MPa"], 1.71, delta=0.2)
        for way in PISTONS:
            strong, elastic = (self.crushed("loblolly", law, way) for law in ("2500 MPa", "elastic"))
            self.assertAlmostEqual(self.stress(strong, 0.03, 0.09) / self.stress(elastic, 0.03, 0.09), 1,
                                   delta=0.03, msg=way)
            self.assertAlmostEqual(strong.properties["modulus"] / elastic.properties["modulus"], 1,
                                   delta=0.01, msg=way)

    def test_softwood_collapses_in_its_earlywood_first_and_tangentially_at_a_higher_stress(self):
        radial = self.crushed("loblolly", "whole", "radial")
        self.assertEqual([round(snapshot.strain, 2) for snapshot in radial.snapshots],
                         [0, 0.05, 0.15, 0.24, 0.36, 0.45])
        inside, everywhere, _ = work_in_windows(radial, [Window("latewood", (0.473 * 0.832e-3, 0), (1, 1))])
        # Of the work between two snapshots.
        late = numpy.diff(inside[:, 0]) / numpy.diff(everywhere)
        self.assertLess(late[:2].max(), 0.05)
        self.assertGreater(late[3], 0.3)  # where the curve has its second hump
        tangential = self.crushed("loblolly", "whole", "tangential")
        self.assertGreater(self.stress(tangential, 0.08, 0.15), 2 * self.stress(radial, 0.08, 0.15))

    def test_curve_has_a_second_hump_where_the_latewood_yields_and_none_where_it_hardly_does(self):
        # Fig. 5, at 24 % strain. The paths of buckling leave some noise in slopes.
        soft, strong = (hump(self.crushed("loblolly", f"hump, {size} MPa", "radial").history)[0]
                        for size in (100, 2500))
        self.assertGreater(soft, 0.3)
        self.assertGreater(soft, 2 * strong)

    def test_hardwood_is_stiffer_along_its_rays_and_as_strong_in_both_directions_once_it_is_dense(self):
        poplar = [self.crushed("poplar", "whole", way) for way in PISTONS]
        self.assertGreater(self.stress(poplar[0], 0.01, 0.03), 2 * self.stress(poplar[1], 0.01, 0.03))
        late = [self.stress(run, 0.4, 0.45) for run in poplar]  # it is dense from 38 % on (docs/wood_study.md)
        self.assertAlmostEqual(late[0] / late[1], 1, delta=0.1)

    def test_wood_is_dense_at_a_strain_that_grows_with_its_lumens_whatever_the_direction(self):
        """By the strain at 1 GPa, twice the yield stress: where two lines through the rise meet depends
        on how it begins, which differs between directions (docs/wood_study.md, Densification)."""
        dense, lumens = {}, {}
        for wood in ("loblolly", "poplar"):
            runs = [self.crushed(wood, "whole", way) for way in PISTONS]
            dense[wood] = [strain_at(run.history, 1e9) for run in runs]
            self.assertNotIn(None, dense[wood])
            self.assertAlmostEqual(*dense[wood], delta=0.015)
            lumens[wood] = 1 - runs[0].summary["relative_density"]
        self.assertGreater(lumens["poplar"], lumens["loblolly"] + 0.03)
        self.assertGreater(min(dense["poplar"]), max(dense["loblolly"]))

    def test_softwood_is_stiffer_along_the_tangent_where_its_rays_are_solid(self):
        # Table 1 has 2740 and 3252 MPa for loblolly, 3731 and 2479 MPa for poplar, along radius and tangent.
        def read(wood, rays):
            return [self.crushed(wood, rays, way).properties for way in PISTONS]

        radial, tangential = read("loblolly", "solid rays")
        self.assertGreater(tangential["modulus"], 1.1 * radial["modulus"])
        self.assertIsNone(tangential["toe"])
        radial, tangential = read("poplar", "solid rays")
        self.assertGreater(radial["modulus"], 1.4 * tangential["modulus"])
        # Open ones close first: a toe.
        radial, tangential = read("loblolly", "open rays")
        self.assertIsNone(radial["toe"])
        self.assertLess(tangential["modulus"], 0.7 * radial["modulus"])
        self.assertGreater(tangential["toe"]["modulus"], 2 * tangential["modulus"])
        self.assertGreater(tangential["toe"]["modulus"], radial["modulus"])
        # 173.6 MPa in the paper, 213 here over ten drawn specimens of 150 cells (docs/wood_study.md).
        self.assertAlmostEqual(tangential["buckling"]["stress"] / 213e6, 1, delta=0.1)

    def test_what_its_picture_shows_of_rays_and_walls_decides_what_the_papers_method_finds(self):
        def read(picture):
            return self.crushed("loblolly", f"its method{picture}", "tangential").properties

        # Its grid shuts rays as wide as a cell of it. Table 1 has 3252 MPa, and 39.1 MPa at 1.32 % strain; five
        # drawn pieces 2675 MPa, and 47.0 MPa at 1.72 % (docs/wood_study.md, Other pieces of the same woods).
        open_rays, narrow = read(""), read("_narrow_rays")
        self.assertGreater(narrow["modulus"], 2.5 * open_rays["modulus"])
        self.assertAlmostEqual(narrow["modulus"] / 2675e6, 1, delta=0.25)
        self.assertAlmostEqual(narrow["buckling"]["stress"] / 47.0e6, 1, delta=0.1)
        self.assertLess(narrow["buckling"]["strain"], 0.02)
        self.assertGreater(open_rays["buckling"]["strain"], 0.04)
        # A scan of a printed figure breaks walls. 15.2 MPa at 2.47 %, 648 MPa; five pieces 15.3 ± 2.6 MPa.
        fine, coarse = read(", ponderosa"), read(", ponderosa_coarse_scan")
        self.assertGreater(fine["buckling"]["stress"], 2.5 * 15.2e6)
        self.assertAlmostEqual(coarse["buckling"]["stress"] / 15.2e6, 1, delta=0.35)
        for run in (fine, coarse):
            self.assertAlmostEqual(run["modulus"] / 648e6, 1, delta=0.25)


if __name__ == "__main__":
    unittest.main()
