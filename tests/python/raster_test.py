"""Squares in pixels: where they are, what they carry, and that memory follows the picture."""
import io
import pathlib
import tempfile
import tracemalloc
import unittest

import needed

needed.modules("numpy", "h5py", "yaml", "matplotlib", "PIL")

import h5py  # noqa: E402
import numpy  # noqa: E402
from PIL import Image  # noqa: E402

import made_up  # noqa: E402
from mpm_par import raster  # noqa: E402
from mpm_par.report import film, structure  # noqa: E402
from mpm_par.snapshots import read_snapshot  # noqa: E402


class Painting(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def paint(self, snapshot, view=raster.View((0, 1)), in_space=False):
        edge = raster.edge_of(snapshot, 2.0, in_space)
        canvas = raster.canvas_of(snapshot.bounds(), view, edge)
        return canvas, raster.paint(snapshot, lambda work: work, ["plastic_work"], view, canvas,
                                    edge)

    def test_each_square_has_its_value_in_its_place(self):
        made_up.write_snapshot(self.folder / "0.h5", 0.0, work=(1.0, 2.0, 3.0, 4.0))
        canvas, painting = self.paint(read_snapshot(self.folder / "0.h5"))
        self.assertEqual(painting.shape, (4, 16))
        numpy.testing.assert_allclose(canvas.extent, (0, 4e-3, 0, 1e-3), atol=1e-12)
        for k in range(4):
            self.assertTrue((painting[:, 4 * k + 1:4 * k + 3] == k + 1).all(), painting)

    def test_what_is_empty_stays_empty_and_only_hairlines_close(self):
        path = self.folder / "0.h5"
        made_up.write_snapshot(path, 0.0)
        with h5py.File(path, "r+") as file:
            file["particles/position"][2:, 0] += 1e-3  # a lumen of one particle
        painting = self.paint(read_snapshot(path))[1]
        self.assertTrue(numpy.isnan(painting[:, 9:11]).all(), painting)
        self.assertTrue(numpy.isfinite(painting[:, :8]).all(), painting)

    def test_a_section_shows_its_layer_only(self):
        path = self.folder / "0.h5"
        made_up.write_snapshot(path, 0.0, work=(1.0, 2.0, 3.0, 4.0))
        with h5py.File(path, "r+") as file:
            file["particles/position"][:, 2] = (numpy.arange(4) + 0.5) * 1e-3
            file.attrs["particle_volume"] = 1e-9
        for layer in range(4):
            view = raster.View((0, 1), 2, (layer + 0.5) * 1e-3, 1e-3)
            painting = self.paint(read_snapshot(path), view, in_space=True)[1]
            self.assertEqual(set(painting[numpy.isfinite(painting)]), {layer + 1})

    def test_memory_follows_the_picture(self):
        rows = 1_000_000
        path = self.folder / "0.h5"
        with h5py.File(path, "w") as file:
            file.attrs.update({"time": 0.0, "strain": 0.0, "step": 0, "complete": 1,
                               "particle_volume": 2.0 / rows})
            across = int(rows ** 0.5)
            position = numpy.zeros((rows, 3))
            position[:, 0] = (numpy.arange(rows) % across + 0.5) / across
            position[:, 1] = (numpy.arange(rows) // across + 0.5) / across
            file["particles/position"] = position
            file["particles/plastic_work"] = position[:, 0]
        del position
        snapshot = read_snapshot(path)
        tracemalloc.start()
        canvas, painting = self.paint(snapshot)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        # All of the snapshot would be 32 MB and its pixels' numbers as much again.
        self.assertLess(peak, 60e6)
        self.assertLessEqual(max(canvas.shape), raster.PIXELS_ACROSS)
        self.assertTrue(numpy.isfinite(painting).all())
        left, right, _, _ = canvas.extent
        numpy.testing.assert_allclose(painting.mean(axis=0),
                                      numpy.linspace(left, right, len(painting.T)), atol=4e-3)

    def test_films_are_no_larger_than_they_may_be(self):
        noise = numpy.random.default_rng(1).integers(0, 255, (8, 200, 300, 3), dtype=numpy.uint8)
        frames = [Image.fromarray(frame) for frame in noise]
        for most in 100_000, 300_000:
            made = film._bounded(frames, most, "viridis")
            self.assertLessEqual(len(made), most)
            self.assertGreater(len(made), most / 4)
            with Image.open(io.BytesIO(made)) as picture:
                self.assertGreaterEqual(picture.n_frames, 2)

    def test_colours_end_at_round_numbers(self):
        paintings = [numpy.zeros(9), numpy.linspace(0, 310, 1000), numpy.full(9, 7000.0)]
        self.assertEqual(structure.limits_of(paintings, False), (0, 8000))
        self.assertEqual(structure.limits_of(paintings[:2], False), (0, 400))
        self.assertEqual(structure.limits_of([*paintings, paintings[1]], True), (-400, 400))
        self.assertEqual(structure.limits_of(paintings[:1], True), (-1, 1))
        self.assertEqual(structure.limits_of(paintings, True, 250), (-250, 250))


if __name__ == "__main__":
    unittest.main()
