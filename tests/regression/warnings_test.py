"""What a specialist would warn of, before a run and in its summary; no warning without cause."""
import pathlib
import re
import unittest

from program import History, ProgramTest, mpm_par, set_options, summary, unfolded

RING = pathlib.Path(__file__).parents[2] / "inputs" / "benchmarks" / "crushed_ring.yaml"
SCENE = """
material: {law: isotropic, youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes:
SHAPES
grid: {cells: [20, 20]}
loading: {piston: right, speed: 1 m/s, strain: 30 %}
steps: 2
output: {snapshots: 0}
"""
FLIGHT = """
material: {law: isotropic, youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes: [{box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}, velocity: [50 m/s, 0 m/s]}]
grid: {cells: [20, 20], margin: [0 mm, 2 mm, 0 mm, 0 mm]}
free_motion: {end_time: 32 us}
output: {snapshots: 0}
"""
WHOLE = ["{lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}"]
# Walls across the specimen, 1.5 cells of 50 um thick.
THIN = [f"{{lower: [{x} mm, 0 mm], upper: [{x + 0.075} mm, 1 mm]}}" for x in (0.2, 0.4, 0.6)]
# Walls two cells thick from end to end.
TWO_CELLS = [f"{{lower: [0 mm, {y} mm], upper: [1 mm, {y + 0.1} mm]}}" for y in (0.2, 0.5, 0.7)]
APART = ["{lower: [0 mm, 0 mm], upper: [0.3 mm, 1 mm]}",
         "{lower: [0.7 mm, 0 mm], upper: [1 mm, 1 mm]}"]


def gray_bmp(rows):
    """An 8-bit gray BMP; rows from the top, 0 or 255 each."""
    height, width = len(rows), len(rows[0])
    line = (width + 3) // 4 * 4
    palette = b"".join(bytes([g, g, g, 0]) for g in range(256))
    offset = 14 + 40 + len(palette)
    header = b"BM" + (offset + line * height).to_bytes(4, "little") + bytes(4) + \
        offset.to_bytes(4, "little")
    sizes = (40).to_bytes(4, "little") + width.to_bytes(4, "little") + \
        height.to_bytes(4, "little") + (1).to_bytes(2, "little") + (8).to_bytes(2, "little") + \
        bytes(24)
    pixels = b"".join(bytes(row) + bytes(line - width) for row in reversed(rows))
    return header + sizes + palette + pixels


class Warnings(ProgramTest):
    def warnings(self, boxes, *settings):
        """Those of --check, which are those of the run's summary, on one rank and on two."""
        return self.warnings_of(self.scene_of(boxes), *settings)

    def scene_of(self, boxes):
        shapes = "\n".join(f"    - box: {box}" for box in boxes)
        file = self.folder / "scene.yaml"
        file.write_text(SCENE.replace("SHAPES", shapes))
        return file

    def picture_scene(self, rows, keys="", more=""):
        """Of a picture of 1 mm; `keys`: of the specimen, `more`: of the scene."""
        (self.folder / "picture.bmp").write_bytes(gray_bmp(rows))
        file = self.folder / "picture.yaml"
        file.write_text(f"specimen: {{micrograph: picture.bmp, pixel_size: 25 um{keys}}}\n{more}"
                        "grid: {cells: [20, 20]}\nsteps: 2\noutput: {snapshots: 0}\n"
                        "loading: {piston: right, speed: 1 m/s}\n")
        return file

    def warnings_of(self, file, *settings):
        options = set_options(settings)
        check = mpm_par("--check", file, *options)
        self.assertEqual(check.returncode, 0, check.stderr)
        said = [line.split("warning", 1)[1].strip() for line in unfolded(check.stdout).splitlines()
                if line.startswith("  warning")]
        folder = self.folder / "results"
        run = mpm_par(file, "--output", folder, "--overwrite", *options, ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        self.assertEqual(summary(folder)["warnings"], said)
        for warning in said:
            self.assertIn(warning, unfolded(run.stdout))
        return said

    def test_quiet_leaves_them_alone_on_the_terminal(self):
        file = self.scene_of(THIN)
        for words in ["--check"], ["--output", self.folder / "results"]:
            run = mpm_par(file, "--quiet", "--set", "loading.piston=top", *words, ranks=2)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertRegex(run.stdout, r"\Awarning: [^\n]+\n\Z")

    def assert_only(self, warnings, *parts):
        self.assertEqual(len(warnings), 1, warnings)
        for part in parts:
            self.assertIn(part, warnings[0])

    def test_a_sound_scene_has_none(self):
        self.assertEqual(self.warnings(WHOLE), [])
        self.assertEqual(self.warnings(TWO_CELLS), [])

    def test_thin_walls(self):
        self.assert_only(self.warnings(THIN, "loading.piston=top"),
                         "100 % of the wall is thinner than two cells", "grid.cells")
        # As thin on a grid that is finer: three cells.
        self.assertEqual(self.warnings(THIN, "loading.piston=top", "grid.cells=[40, 40]"), [])

    def test_speeds(self):
        # Fastest wave: sqrt(10e9 * 0.7 / (1.3 * 0.4) / 1000) = 3669 m/s.
        self.assertEqual(self.warnings(WHOLE, "loading.speed=36 m/s"), [])
        self.assert_only(self.warnings(WHOLE, "loading.speed=37 m/s"),
                         "above the quasi-static range, 37 m/s", "loading.speed")
        self.assertEqual(self.warnings(WHOLE, "loading.ramp_time=0.3 us", "loading.speed=5 m/s"),
                         [])
        self.assert_only(
            self.warnings(WHOLE, "loading.ramp_time=0.2 us", "loading.speed=5 m/s"),
            "before the fastest wave has crossed", "loading.ramp_time")
        self.assert_only(self.warnings(WHOLE, "loading.speed=4 km/s"),
                         "not below that of the fastest wave, 3669 m/s")

    def test_a_long_free_flight(self):
        file = self.folder / "flight.yaml"
        file.write_text(FLIGHT)
        # 50 m/s for 32 us: 1.6 mm of 0.05 mm cells.
        self.assert_only(self.warnings_of(file), "50 m/s something may cross 32 cells",
                         "scheme apic or tpic")
        for quiet in ("numerics.scheme=apic", "numerics.update_order=usl",
                      "free_motion.end_time=29 us"):
            self.assertEqual(self.warnings_of(file, quiet), [], quiet)

    def test_linear_functions_with_usf(self):
        linear = "numerics.shape_function=linear"
        self.assert_only(self.warnings(WHOLE, linear, "numerics.update_order=usf"),
                         "linear shape functions with usf", "update_order: musl")
        self.assertEqual(self.warnings(WHOLE, linear), [])
        self.assertEqual(self.warnings(WHOLE, "numerics.update_order=usf"), [])

    def test_near_incompressible_material(self):
        nearly = "material.poisson_ratio=0.49"
        self.assert_only(self.warnings(WHOLE, nearly), "locks", "numerics.f_bar: true")
        self.assertEqual(self.warnings(WHOLE, nearly, "numerics.f_bar=true"), [])
        self.assertEqual(self.warnings(WHOLE, nearly, "numerics.plane=stress"), [])
        self.assertEqual(self.warnings(WHOLE, "material.poisson_ratio=0.45"), [])

    def test_a_long_run(self):
        self.assert_only(self.check_only("loading.speed=1e-4 m/s", "steps=200000000"),
                         "1.8e+08 steps", "grid.cells")

    def check_only(self, *settings):
        check = mpm_par("--check", self.scene_of(WHOLE), *set_options(settings))
        self.assertEqual(check.returncode, 0, check.stderr)
        return [line for line in unfolded(check.stdout).splitlines() if line.startswith("  warning")]

    def test_particles_that_the_piston_never_meets(self):
        # 0.4 mm of empty layers before the second box of 6 x 20 cells of 4 particles.
        early, unmet = self.warnings(APART)
        self.assertIn("never meets 480 of 960 particles", unmet)
        self.assertIn("loading.strain", unmet)
        self.assert_only(self.warnings(APART, "loading.strain=45 %"), early)
        self.assertIn("never meets 480 of 960", self.warnings(APART, "loading.piston=left")[1])
        self.assertEqual(self.warnings(APART, "loading.piston=top"), [])

    def test_gaps_that_close_early(self):
        # One gap, and a cell of 20.
        self.assert_only(self.warnings(APART, "loading.strain=45 %"), "1.0 of them",
                         "5.0 % of strain", "mpm_study --error-bar", "grid.cells",
                         "numerics.formulation: total_lagrangian", "docs/formulations.md")
        self.assertEqual(self.warnings(APART, "loading.strain=45 %",
                                       "numerics.formulation=total_lagrangian"), [])
        finer = ["loading.strain=45 %", "grid.cells=[100, 20]"]
        self.assertEqual(self.warnings(APART, *finer), [])
        self.assert_only(self.warnings(APART, "loading.strain=45 %", "grid.cells=[99, 20]"),
                         "1.0 % of strain")
        # Nothing closes up to here.
        self.assertNotIn("closes gaps", self.warnings(APART, "loading.strain=9 %")[0])

    def test_unconnected_pieces(self):
        rows = [[255 if 10 <= i < 22 else 0 for i in range(40)] for _ in range(40)]
        for j in range(16, 22):
            for i in range(30, 36):
                rows[j][i] = 255
        file = self.picture_scene(rows, more="numerics: {formulation: updated_lagrangian}\n")
        # 36 of 12 * 40 + 36 locations.
        pieces, early = self.warnings_of(file)
        self.assertIn("7 % of the wall (36 of 516 particles)", pieces)
        self.assertIn("specimen.remove_unconnected: true", pieces)
        self.assertIn("closes gaps", early)
        self.assert_only(self.warnings_of(file, "specimen.remove_unconnected=true"), "closes gaps")

    def test_a_picture_without_lumens(self):
        file = self.picture_scene([[255] * 40] * 40)
        self.assert_only(self.warnings_of(file), "all of the picture is wall", "specimen.threshold")

    def test_a_density_that_no_threshold_gives(self):
        """Two squares side by side, of which one goes as a whole."""
        rows = [[0] * 40 for _ in range(40)]
        for j in range(10, 30):
            for i in range(4, 36):
                if not 18 <= i < 22:
                    rows[j][i] = 200 + i
        file = self.picture_scene(rows, ", remove_unconnected: true, threshold: {target_relative_density: 0.22}")
        # Each square is 0.175 of the picture.
        self.assert_only(self.warnings_of(file), "relative density is 0.175, not the 0.22",
                         "specimen.remove_specks")
        self.assertEqual(self.warnings_of(file, "specimen.threshold={target_relative_density: 0.17}"), [])

    def test_contact_of_what_is_not_there(self):
        file = self.scene_of(WHOLE)
        file.write_text(file.read_text().replace("material:", "materials:\n - {name: wood, ", 1)
                        .replace("{law", "law", 1).replace("kg/m^3}", "kg/m^3}\n - {name: steel, law: isotropic, "
                        "youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}", 1)
                        + "contact: [{between: [wood, steel]}]\n")
        file.write_text(file.read_text().replace("1 mm]}", "1 mm]}\n      material: wood"))
        self.assert_only(self.warnings_of(file), "no particles of steel", "no effect")

    def test_what_has_happened_in_a_run(self):
        """A ring that folds upon itself, between plates of which one moves."""
        def of_ring(*settings):
            folder = self.folder / "ring"
            run = mpm_par(RING, "--output", folder, "--overwrite", "--quiet",
                          *set_options(["grid.cells=[10, 10]", "numerics.formulation=total_lagrangian",
                                        *settings]))
            self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
            found = summary(folder)
            for warning in found["warnings"]:
                self.assertIn(warning, run.stdout)
            history = History(folder)
            loaded = [abs(error) for strain, error in zip(history["strain"], history["energy_error"])
                      if strain > 0.01]
            return " ".join(found["warnings"]), max(loaded), history

        said, _, _ = of_ring("loading.speed=1 m/s", "loading.strain=10 %")
        self.assertEqual(said, "")
        # By hand, in windows of 1 % of strain: 40 lines to 1 %.
        said, balance, history = of_ring("loading.strain=10 %", "output.history_lines=400")
        ends = [(piston, edge) for strain, piston, edge in
                zip(history["strain"], history["stress_piston"], history["stress_edge"]) if strain >= 0.02]
        means = [[sum(end[side] for end in ends[k:k + 40]) for side in (0, 1)] for k in range(0, 320, 40)]
        share = sum(2 * abs(piston - edge) / (piston + edge) for piston, edge in means) / len(means)
        self.assertGreater(share, 0.05)
        found = re.search(r"differ by (\d+) % on the average: the run is not quasi-static", said)
        self.assertAlmostEqual(float(found[1]), 100 * share, delta=2)
        self.assertLess(balance, 0.02)
        self.assertNotIn("balance", said)

        said, balance, _ = of_ring("numerics.formulation=updated_lagrangian",
                                   "numerics.shape_function=linear")
        self.assertGreater(balance, 0.02)
        found = re.search(r"balance is open by ([\d.]+) % of the work at [\d.]+ % strain: work is lost, .*gimp\.",
                          said)
        self.assertAlmostEqual(float(found[1]), 100 * balance, delta=0.5)


if __name__ == "__main__":
    unittest.main()
