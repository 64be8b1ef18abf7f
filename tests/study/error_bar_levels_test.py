"""Settings of coarser and finer levels: the geometry stays; and bars out of figures of levels."""
import pathlib
import tempfile
import types
import unittest

import error_bar
import error_bar_report
import resolution
from problems import InputError
from yaml_tree import Node


def tree(value):
    if isinstance(value, dict):
        return Node({key: tree(item) for key, item in value.items()}, "scene.yaml:1:1")
    return Node(value, "scene.yaml:1:1")


EMPTY = tree({})


def level(factor, own=EMPTY, effective=EMPTY, given=(), cells=(150, 97), axes=2):
    return dict(error_bar.level_assignments(list(given), own, effective, list(cells), factor, axes))


class Levels(unittest.TestCase):
    def test_scale_the_cells(self):
        self.assertEqual(level(1.5), {"grid.cells": "[100, 65]"})
        self.assertEqual(level(1 / 1.5), {"grid.cells": "[225, 146]"})
        self.assertEqual(level(2, cells=(30, 30, 20)), {"grid.cells": "[15, 15, 10]"})

    def test_scale_a_spacing_where_the_scene_has_one(self):
        own = tree({"grid": {"spacing": "2.5 um"}})
        self.assertEqual(level(1.5, own=own), {"grid.spacing": "3.75 um"})
        self.assertEqual(level(2, given=[("grid.spacing", "[1 um, 2 um]")]),
                         {"grid.spacing": "[2 um, 4 um]"})

    def test_keep_the_thickness_of_a_load_cell_and_the_size_of_specks(self):
        effective = tree({"loading": {"load_cell": {"cells": "6"}},
                          "specimen": {"remove_specks": "20"}})
        self.assertEqual(level(2, effective=effective),
                         {"grid.cells": "[75, 48]", "loading.load_cell.cells": "3",
                          "specimen.remove_specks": "5"})
        specks = tree({"specimen": {"remove_specks": "20"}})
        self.assertEqual(level(2, effective=specks, cells=(30, 30, 20), axes=3)["specimen.remove_specks"],
                         "2")
        self.assertEqual(level(2, effective=specks, cells=(30, 30, 20), axes=2)["specimen.remove_specks"],
                         "5")

    def test_look_for_pieces_of_a_picture_that_is_drawn_out_in_its_layers(self):
        from PIL import Image
        with tempfile.TemporaryDirectory() as folder:
            pages = [Image.new("L", (4, 4), level) for level in (0, 255)]
            pages[0].save(f"{folder}/one.tif")
            pages[0].save(f"{folder}/two.tif", save_all=True, append_images=pages[1:])
            pages[0].save(f"{folder}/one.png")

            def axes(name, cells):
                return error_bar.axes_of_pieces(f"{folder}/scene.yaml",
                                                tree({"specimen": {"micrograph": name,
                                                                   "remove_specks": "9"}}), cells)

            self.assertEqual([axes(name, (3, 3, 3)) for name in ("one.png", "one.tif", "two.tif")],
                             [2, 2, 3])
            self.assertEqual(axes("one.png", (3, 3)), 2)
            pages[0].save(f"{folder}/s_1.png")
            self.assertEqual(axes("s_*.png", (3, 3, 3)), 2, "a stack of one")
            pages[0].save(f"{folder}/s_2.png")
            self.assertEqual(axes("s_*.png", (3, 3, 3)), 3)
            for name, text, expected in (("pine", "grain: {tracheid_length: 2 mm}\n", 3), ("flat", "", 2)):
                (pathlib.Path(folder) / f"{name}.anatomy.yaml").write_text(f"size: [1 mm, 1 mm]\n{text}")
                self.assertEqual(axes(f"{name}.anatomy.yaml", (3, 3, 3)), expected)

    def test_leave_the_scene_as_it_is(self):
        self.assertEqual(level(1, given=[("a", "b")]), {"a": "b"})


class Sizes(unittest.TestCase):
    def test_fall_as_the_value_is_refined(self):
        self.assertAlmostEqual(resolution.size("grid.cells", "[10, 40]"), 1 / 20)
        self.assertAlmostEqual(resolution.size("grid.spacing", "5 um"), 5e-6)
        self.assertAlmostEqual(resolution.size("grid.particles_per_cell", "4"), 0.25)
        self.assertAlmostEqual(resolution.size("loading.speed", "10 m/s"), 10)

    def test_of_what_is_none_are_refused(self):
        for text in ("fine", "[]", "[0, 3]"):
            with self.assertRaises(ValueError):
                resolution.size("grid.cells", text)


def levels(moduli, cells):
    """Runs from coarse to fine; factor 1 is the last unless a pair says otherwise."""
    return [(factor, types.SimpleNamespace(folder=None, summary={
        "cells": [n, n], "compression": {"modulus": modulus, "modulus_error": 0.5}}))
        for modulus, (factor, n) in zip(moduli, cells)]


MODULUS = error_bar_report.FIGURES[0]


class Bars(unittest.TestCase):
    def bar(self, moduli, cells=((4, 10), (2, 20), (1, 40))):
        return error_bar_report.bar_of(MODULUS, levels(moduli, cells), (0.05, 0.15))

    def test_of_first_order_is_twice_the_rest(self):
        bar = self.bar([140.0, 120.0, 110.0])
        self.assertAlmostEqual(bar.limit, 100)
        self.assertAlmostEqual(bar.error, 20)
        self.assertEqual(bar.basis, "gci")

    def test_is_never_smaller_than_the_error_of_reading(self):
        bar = self.bar([100.02, 100.01, 100.005])
        self.assertEqual(bar.error, 0.5)
        self.assertIn("reading", bar.remark)

    def test_of_a_scene_with_finer_levels_reaches_to_their_limit(self):
        bar = self.bar([140.0, 120.0, 110.0], ((1, 10), (0.5, 20), (0.25, 40)))
        self.assertEqual(bar.value, 140)
        self.assertAlmostEqual(bar.error, 40 + 20)

    def test_without_a_value_says_why(self):
        bar = self.bar([140.0, 120.0, None])
        self.assertIsNone(bar.value)
        self.assertIn("no compression.modulus", bar.remark)


class Options(unittest.TestCase):
    def given(self, **options):
        return types.SimpleNamespace(**{"levels": [1.5, 2.25], "finer": [], "set": [],
                                        "plateau": ["5 %", "15 %"], **options})

    def test_that_are_wrong_are_refused(self):
        with self.assertRaisesRegex(InputError, "no factor"):
            error_bar.check_factors(self.given(levels=[0.5]))
        with self.assertRaisesRegex(InputError, "two levels beside"):
            error_bar.check_factors(self.given(levels=[2]))
        with self.assertRaisesRegex(InputError, "no assignment"):
            error_bar.assignments_of(self.given(set=["steps"]))
        with self.assertRaisesRegex(InputError, "--plateau 15 % 5 %"):
            error_bar.plateau_range(self.given(plateau=["15 %", "5 %"]))


if __name__ == "__main__":
    unittest.main()
