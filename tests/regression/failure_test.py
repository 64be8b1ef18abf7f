"""A run that fails says where and why, leaves its last sound state, and can go on from it."""
import pathlib
import re
import unittest
import xml.etree.ElementTree

from program import History, ProgramTest, mpm_par, scene, set_options, summary

PROJECT = pathlib.Path(__file__).parents[2]
PAST_THE_LIMIT = PROJECT / "inputs" / "stability" / "past_the_limit.yaml"

# Of the snapshots; the first two are before the failure.
TIMES = (0, 2e-6, 30e-6, 60e-6)

STEP = re.compile(r"step (\d+), t = (\S+) s")
LAST_SOUND = re.compile(r"The last sound state \(step (\d+), t = (\S+) s\) is in (\S+)\.")

SQUEEZED = """
material: {law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes:
    - box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}
grid: {cells: [10, 10], margin: [2 mm, 2 mm, 0 mm, 0 mm]}
numerics: {cfl: 1.4, update_order: ORDER}
loads: [{kind: body_force, acceleration: ["x < 0.00055 ? PULL : -PULL", 0]}]
free_motion: {end_time: 20 us, sides: [free, free, symmetric, symmetric]}
output: {snapshots: 0}
"""


# Slowly beside the wave, which crosses in 1 us: pressed by 2 % and let go again, twice.
TO_AND_FRO = """
material: {law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes:
    - box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}
grid: {cells: [10, 10]}
free_motion:
  end_time: 80 us
  sides: [rigid, free, symmetric, symmetric]
  moving_sides:
    - side: right
      grip: slip
      table:
        - [0 us, 0 m/s]
        - [10 us, -2 m/s]
        - [30 us, 2 m/s]
        - [50 us, -2 m/s]
        - [70 us, 2 m/s]
        - [80 us, 0 m/s]
output: {snapshots: 0}
"""


def snapshots_of(series):
    """What an XDMF file says of each moment, and the size of the file that holds it."""
    found = []
    for grid in xml.etree.ElementTree.parse(series).findall("Domain/Grid/Grid"):
        file = grid.find("Geometry/DataItem").text.split(":")[0].strip()
        found.append({"time": float(grid.find("Time").get("Value")),
                      "particles": int(grid.find("Topology").get("NumberOfElements")),
                      "bytes": (series.parent / file).stat().st_size})
    return found


class Failure(ProgramTest):
    def run_past_the_limit(self, label, *settings, ranks=1):
        folder = self.folder / label
        return folder, mpm_par(PAST_THE_LIMIT, "--output", folder, *set_options(settings), ranks=ranks)

    def check_stopped(self, folder, run):
        self.assertEqual(run.returncode, 3, run.stderr + run.stdout)
        self.assertEqual(run.stderr.count("The last sound state"), 1, run.stderr)
        self.assertIn("the energy has grown by", run.stderr)
        self.assertIn("body 'cell_wall'", run.stderr)
        self.assertRegex(run.stderr.lower(), r"particle \d+ of body")
        self.assertIn("Likely cause: numerics.cfl is 1.9, beyond 1.75", run.stderr)
        self.assertFalse((folder / "summary.json").exists(), "the run did not end well")
        failed = STEP.search(run.stderr)
        step, time, place = LAST_SOUND.search(run.stderr).groups()
        self.assertLess(int(step), int(failed[1]))
        self.assertTrue(pathlib.Path(place).exists(), place)
        (found,) = snapshots_of(pathlib.Path(place))
        self.assertAlmostEqual(found["time"], float(time), delta=1e-5 * float(time))
        self.assertEqual(found["particles"], 1600)
        # x, y, z of every particle at least.
        self.assertGreater(found["bytes"], 1600 * 3 * 8)

    def test_a_step_past_the_limit_stops_every_rank_once_with_a_snapshot(self):
        for ranks in 1, 2:
            folder, run = self.run_past_the_limit(f"on_{ranks}", ranks=ranks)
            self.check_stopped(folder, run)

    def test_retry_goes_back_and_ends_as_a_short_step_does(self):
        short, run = self.run_past_the_limit("short", "numerics.cfl=0.475")
        self.assertEqual(run.returncode, 0, run.stderr)
        exact = History(short)
        for ranks in 1, 2:
            folder, run = self.run_past_the_limit(f"retry_{ranks}", "numerics.recovery=retry",
                                                  "numerics.repartition_interval=10",
                                                  ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
            self.assertEqual(run.stdout.count("Went back to step"), 1, run.stdout)
            found = summary(folder)
            self.assertEqual(found["recoveries"], 1)
            self.assertEqual(found["recovery"]["step_share"], 0.5)
            self.assertGreater(found["recovery"]["repeated_steps"], 0)
            self.assertIn("Went back to step", found["recovery"]["reports"][0])
            self.check_history(History(folder), exact)
            self.check_snapshots(folder)
            self.assertFalse((folder / "failure").exists(), "the run ended well")

    def check_history(self, history, exact):
        """Every line once; energies as with a short step, within the error of the long one."""
        times = history["time"]
        self.assertEqual(len(times), len(exact))
        self.assertEqual(times, sorted(set(times)))
        scale = exact["kinetic_energy"][0]
        for name in "kinetic_energy", "elastic_energy":
            # A line is up to a step late: 4 % of the energy at its fastest turn. A line of the run
            # that failed would be off by many times the whole.
            worst = max(abs(a - b) for a, b in zip(history[name], exact[name]))
            self.assertLess(worst, 0.06 * scale, name)
        self.assertLess(max(map(abs, history["energy_error"])), 0.05)

    def check_snapshots(self, folder):
        """Three of them, in order, none of what has not been."""
        files = sorted((folder / "snapshots").iterdir())
        self.assertEqual([file.name for file in files], [f"{k:06}.h5" for k in range(len(TIMES))])
        found = snapshots_of(folder / "past_the_limit.xdmf")
        self.assertEqual(len(found), len(TIMES))
        for snapshot, time in zip(found, TIMES):
            self.assertAlmostEqual(snapshot["time"], time, delta=1e-7)

    def test_retries_end_after_a_stated_number(self):
        # No step is short enough for a disc that flies out of the grid.
        run = mpm_par(scene("fast_disc"), "--output", self.folder / "results",
                      *set_options(["numerics.recovery=retry", "numerics.cfl=0.02"]), ranks=2)
        self.assertEqual(run.returncode, 3, run.stderr + run.stdout)
        self.assertEqual(run.stdout.count("Went back to step"), 4, run.stdout)
        self.assertIn("This was attempt 5, with 0.0625 of the step.", run.stderr)
        # 1.75 us to the end of the grid, 0.02 * 50 um / 1360 m/s each: 2380 steps, and the state
        # that was kept last before that.
        self.assertIn("Went back to step 2000, t = 1.47", run.stdout)
        times = History(self.folder / "results")["time"]
        self.assertEqual(times, sorted(set(times)))

    def test_particles_that_meet_within_a_step_are_named(self):
        # Two halves are thrown at each other: dv/dx dt is below -1 between them where the stress sees
        # the new velocities. Below that it is only pressed beyond reason; above it, they go further
        # than the cell for which ranks have looked ahead, on one rank as on two.
        inside_out = (r"particle \d+ of body 'cell_wall' was turned inside out, "
                      r"det\(I \+ dt L\) = -")
        too_far = r"particle \d+ of body 'cell_wall' moved by more than a cell in one step"
        for order, acceleration, fault in (
                ("musl", "5.05e9", inside_out), ("usl", "5.05e9", inside_out),
                ("musl", "4.5e9", "the energy has grown by"),
                ("usf", "6e9", too_far), ("usavg", "6e9", too_far)):
            for ranks in 1, 2:
                with self.subTest(order=order, acceleration=acceleration, ranks=ranks):
                    file = self.folder / "squeezed.yaml"
                    file.write_text(SQUEEZED.replace("ORDER", order).replace("PULL", acceleration))
                    run = mpm_par(file, "--overwrite", "--output", self.folder / "squeezed",
                                  ranks=ranks)
                    self.assertEqual(run.returncode, 3, run.stderr + run.stdout)
                    self.assertRegex(run.stderr, fault)

    def test_work_that_is_given_back_stops_nothing(self):
        file = self.folder / "to_and_fro.yaml"
        file.write_text(TO_AND_FRO)
        run = mpm_par(file, "--output", self.folder / "results")
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        work = History(self.folder / "results")["external_work"]
        # Twice in and out: what is left of the work is a small part of what went through.
        self.assertLess(abs(work[-1]), 0.1 * max(work))
        self.assertGreater(sum(a > b for a, b in zip(work, work[1:])), len(work) / 4)


if __name__ == "__main__":
    unittest.main()
