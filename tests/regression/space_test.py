"""Scenes in space: a block on the exact line whatever side the piston comes from, and pictures drawn
out through their depth, which give the curve of the plane."""
import pathlib
import unittest

from confined_compression_test import ExactLine, PLASTIC, elastic_plastic
from program import History, mpm_par, summary

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
SIDES = {"left": 0, "right": 0, "bottom": 1, "top": 1, "back": 2, "front": 2}
BLOCK = "confined_block_space"


TOTAL = "numerics.formulation=total_lagrangian"


class BlockInSpace(ExactLine):
    def turned(self, axis):
        """The scene with its long edge along an axis."""
        size, cells = ["0.2 mm", "0.25 mm"], ["4", "5"]
        size.insert(axis, "1 mm")
        cells.insert(axis, "20")
        edges = "[" + ", ".join(size) + "]"
        return [f"specimen.size={edges}", f"specimen.shapes[0].box.upper={edges}",
                "grid.cells=[" + ", ".join(cells) + "]"]

    def test_piston_may_come_from_any_of_the_six_sides(self):
        first = None
        for side, axis in SIDES.items():
            with self.subTest(side=side):
                history = self.compare(f"loading.piston={side}", *self.turned(axis), scene=BLOCK)
                # Mirrored and turned, the same numbers up to rounding.
                first = first or history["stress"]
                for one, other in zip(first, history["stress"]):
                    self.assertAlmostEqual(one / first[-1], other / first[-1], delta=1e-8)

    def test_shape_functions_schemes_and_orders(self):
        for setting in ("numerics.shape_function=linear", "numerics.scheme=tpic",
                        "numerics.update_order=usf", "numerics.update_order=usl",
                        "numerics.update_order=usavg", "numerics.update_order=musl_displacement"):
            with self.subTest(setting):
                self.compare(setting, scene=BLOCK)

    def test_rate_form_follows_the_same_line(self):
        self.compare("material.strain_measure=hypoelastic", scene=BLOCK)

    def test_von_mises_flow(self):
        for measure in "hencky", "hypoelastic":
            with self.subTest(measure):
                self.compare(*PLASTIC, f"material.strain_measure={measure}", scene=BLOCK,
                             exact=elastic_plastic)

    def test_total_lagrangian_formulation(self):
        """Walls that hold the nodes of their face, and walls that push."""
        for settings in ([], ["loading.grip=contact"], ["loading.lateral=periodic"],
                         ["material.strain_measure=hypoelastic"], ["material.law=neo_hookean"]):
            with self.subTest(settings):
                self.compare(TOTAL, *settings, scene=BLOCK)
        self.compare(TOTAL, *PLASTIC, scene=BLOCK, exact=elastic_plastic)

    def test_load_cell_reads_what_piston_and_edge_feel(self):
        from confined_compression_test import behind_load_cell
        for formulation in [], [TOTAL]:
            self.compare("loading.load_cell.cells=3", *formulation, scene=BLOCK,
                         exact=behind_load_cell, load_cell=True)

    def test_periodic_sides_confine_like_walls(self):
        """A uniform block does not move sideways: its own image is its wall."""
        self.compare("loading.lateral=[periodic, periodic, rigid, rigid]", scene=BLOCK)
        self.compare("loading.lateral=periodic", scene=BLOCK)

    def test_any_number_of_ranks_gives_the_same_history(self):
        for formulation in "updated_lagrangian", "total_lagrangian":
            histories = [History(self.results(BLOCK, f"numerics.formulation={formulation}", *PLASTIC,
                                              ranks=ranks, label=f"{formulation}_on_{ranks}"))
                         for ranks in (1, 2, 4, 8)]
            for other in histories[1:]:
                for name in ("stress", "elastic_energy", "plastic_work", "kinetic_energy"):
                    largest = max(histories[0][name])
                    for one, more in zip(histories[0][name], other[name]):
                        self.assertLessEqual(abs(one - more), 1e-9 * largest, name)


class PictureDrawnOut(ExactLine):
    """An extrusion between slipping walls cannot move along its depth: plane strain. Only the time
    step differs, by the wave speed's bound in space; 1 % of the largest value, waves included."""
    DEPTH = 11.2e-6
    SCENE = """
specimen:
  micrograph: {picture}
  image_size: [0.832 mm, 0.541 mm]
  crop: [60, 60, 60, 40]
  {depth}
grid: {{cells: {cells}}}
numerics: {{formulation: {formulation}_lagrangian}}
loading: {{piston: right, speed: 50 m/s, strain: 0.25, lateral: symmetric, grip: slip}}
output: {{history_lines: 200, snapshots: 0}}
"""

    def run_crop(self, label, depth, cells, formulation):
        file = self.folder / f"{label}.yaml"
        file.write_text(self.SCENE.format(picture=WOOD / "loblolly.bmp", depth=depth, cells=cells,
                                           formulation=formulation))
        folder = self.folder / label
        run = mpm_par(file, "--output", folder, ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return History(folder), summary(folder)

    def have_the_same_curves(self, plane, space, names=("elastic_energy", "plastic_work", "external_work"),
                             within=0.01):
        (plane, of_plane), (space, of_space) = plane, space
        self.assertEqual(of_space["particles"], 8 * of_plane["particles"])
        self.assertEqual(of_space["relative_density"], of_plane["relative_density"])
        for name in names:
            largest = max(plane[name]) * self.DEPTH
            for one, other in zip(plane[name], space[name]):
                self.assertAlmostEqual(self.DEPTH * one, other, delta=within * largest, msg=name)
        self.assertAlmostEqual(of_space["modulus"], of_plane["modulus"],
                               delta=0.01 * of_plane["modulus"])

    def test_crop_of_wood_gives_the_curve_of_the_plane(self):
        self.have_the_same_curves(self.run_crop("plane", "", "[48, 32]", "updated"),
                                  self.run_crop("space", "depth: 11.2 um", "[48, 32, 4]", "updated"))

    def test_bricks_give_the_curve_of_the_plane(self):
        """Beyond yield a brick that bends takes some curvature until it is held along its depth by
        half of its stress; in the plane it is so at once. And contact sees the middles of bricks,
        in the plane their corners. The elastic energy falls with every wall that gives way, a little
        earlier or later: its mean is the same."""
        plane = self.run_crop("plane_cells", "", "[48, 32]", "total")
        space = self.run_crop("bricks", "depth: 11.2 um", "[48, 32, 4]", "total")
        self.have_the_same_curves(plane, space, ("plastic_work", "external_work"), within=0.015)
        one, other = (sum(history["elastic_energy"]) for history, _ in (plane, space))
        self.assertAlmostEqual(other / (self.DEPTH * one), 1, delta=0.015)


if __name__ == "__main__":
    unittest.main()
