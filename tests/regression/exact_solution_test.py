"""The errors against an exact solution that a run reports."""
import csv
import math
import unittest

from program import SCENES, ProgramTest, mpm_par, set_options, summary

BENCHMARKS = SCENES.parents[2] / "inputs" / "benchmarks"
# Particles that fly through periodic sides and round again, slowed down so that the step, which obeys
# the largest speed, stays the same.
FLYING = """specimen:
  size: [1 m, 0.25 m]
  shapes: [{box: {lower: [0 m, 0 m], upper: [1 m, 0.25 m]}}]
  initial_velocity: [3 - t/2, 0]
material: {law: isotropic, youngs_modulus: 1 mPa, poisson_ratio: 0, density: 1000 kg/m^3}
grid: {cells: [8, 2]}
free_motion: {end_time: 10 s, sides: periodic}
loads: [{kind: body_force, acceleration: [-0.5, 0]}]
exact_solution: {displacement: [3*t - t^2/4, 0], velocity: [3 - t/2, 0], stress_yy: 0}
steps: 60
output: {history_lines: 40, snapshots: 0}
"""


class ExactSolution(ProgramTest):
    def run_scene(self, scene, name, ranks=1, settings=()):
        done = mpm_par(scene, "--output", self.folder / name, *set_options(settings),
                       ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return summary(self.folder / name)["exact_solution"], done.stdout

    def test_a_uniform_deceleration_is_followed_across_periodic_sides(self):
        scene = self.folder / "flying.yaml"
        scene.write_text(FLYING)
        for ranks in (1, 2):
            found, said = self.run_scene(scene, f"flying{ranks}", ranks)
            # Leap-frog is exact for a constant force; roundings of sixty steps of some metres.
            self.assertLess(found["displacement_largest_error"], 1e-12)
            self.assertLess(found["velocity_largest_error"], 1e-12)
            self.assertIn("displacement error", said)

    def test_bricks_follow_flight_and_vibration_in_space(self):
        bricks = ["numerics.formulation=total_lagrangian"]
        in_space = (FLYING.replace("0.25 m]", "0.25 m, 0.25 m]").replace("[0 m, 0 m]", "[0 m, 0 m, 0 m]")
                    .replace("t/2, 0]", "t/2, 0, 0]").replace("t^2/4, 0]", "t^2/4, 0, 0]")
                    .replace("[-0.5, 0]", "[-0.5, 0, 0]").replace("[8, 2]", "[8, 2, 2]"))
        scene = self.folder / "flying_bricks.yaml"
        scene.write_text(in_space)
        for ranks in (1, 2):
            found, _ = self.run_scene(scene, f"bricks{ranks}", ranks, bricks)
            self.assertLess(found["displacement_largest_error"], 1e-12)
            self.assertLess(found["velocity_largest_error"], 1e-12)
        found, _ = self.run_scene(BENCHMARKS / "vibrating_bar_space.yaml", "bar", 1, bricks)
        self.assertLess(found["displacement_relative_error"], 1e-3)
        self.assertLess(found["velocity_relative_error"], 1e-3)

    def test_is_the_same_on_every_number_of_ranks(self):
        scene = BENCHMARKS / "vortex.yaml"
        one, _ = self.run_scene(scene, "one", 1, ["grid.cells=[24, 24]"])
        three, _ = self.run_scene(scene, "three", 3, ["grid.cells=[24, 24]"])
        for key, value in one.items():
            self.assertTrue(math.isclose(value, three[key], rel_tol=1e-6), f"{key}: {value}")

    def test_writes_a_line_for_each_of_the_history(self):
        scene = BENCHMARKS / "axis_aligned.yaml"
        found, _ = self.run_scene(scene, "axes")
        rows, history = (list(csv.DictReader((self.folder / "axes" / file).read_text().splitlines()))
                         for file in ("exact_solution.csv", "history.csv"))
        self.assertEqual([row["time [s]"] for row in rows], [row["time [s]"] for row in history])
        self.assertLess(float(rows[0]["displacement_error [m]"]), 1e-15)
        last = float(rows[-1]["displacement_error [m]"])
        self.assertTrue(math.isclose(last, found["displacement_error"], rel_tol=1e-9))
        size = max(float(row["displacement_size [m]"]) for row in rows)
        self.assertTrue(math.isclose(found["displacement_relative_error"], last / size, rel_tol=1e-9))


if __name__ == "__main__":
    unittest.main()
