"""The snapshots of a real run, seen through both of ParaView's readers."""
import json
import os
import pathlib
import subprocess
import sys
import unittest

from program import History, ProgramTest, summary

READER = pathlib.Path(__file__).parents[1] / "support" / "read_xdmf.py"
FIELDS = {"velocity": 3, "stress": 6, "von_mises": 1, "volume_ratio": 1, "plastic_strain": 1,
          "plastic_work": 1, "material": 1, "id": 1, "rank": 1}


class Snapshots(ProgramTest):
    def setUp(self):
        super().setUp()
        self.run_folder = self.results("honeycomb", "loading.strain=5 %", "output.snapshots=4",
                                       f"output.fields=[{', '.join(FIELDS)}]", ranks=2)
        self.summary = summary(self.run_folder)
        self.history = History(self.run_folder)

    def seen(self):
        run = subprocess.run([os.environ["MPM_PVPYTHON"], READER,
                              self.run_folder / "honeycomb.xdmf"],
                             capture_output=True, text=True, timeout=240)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def test_series_holds_what_the_run_reports(self):
        for reader, series in self.seen().items():
            with self.subTest(reader=reader):
                self.assertEqual(len(series), 4)
                self.assertEqual(series[0]["time"], 0)
                times = [snapshot["time"] for snapshot in series]
                self.assertEqual(times, sorted(set(times)))
                self.assertAlmostEqual(times[-1] / self.summary["end_time"], 1, delta=1e-9)
                for snapshot in series:
                    self.check_snapshot(snapshot)

    def check_snapshot(self, snapshot):
        self.assertEqual(snapshot["points"], self.summary["particles"])
        self.assertEqual(snapshot["cells"], self.summary["particles"])
        arrays = snapshot["arrays"]
        self.assertEqual({name: array["components"] for name, array in arrays.items()}, FIELDS)
        ranges = {name: array["first_component"] for name, array in arrays.items()}
        for name, (low, high) in ranges.items():
            self.assertTrue(-1e300 < low <= high < 1e300, f"{name} from {low} to {high}")
        self.assertEqual(ranges["rank"], [0, self.summary["ranks"] - 1])
        self.assertEqual(ranges["material"], [0, 0])
        locations = 4 * self.summary["cells"][0] * self.summary["cells"][1]
        self.assertLess(ranges["id"][1], locations)
        self.assertGreater(ranges["id"][1] - ranges["id"][0], 0.9 * locations)

        # Nobody is behind the fixed edge or in front of where the piston stood at the start.
        left, right, bottom, top, back, front = snapshot["bounds"]
        cell = 1e-3 / self.summary["cells"][0]
        self.assertTrue(-cell < left < right < 1e-3 + cell, snapshot["bounds"])
        self.assertTrue(-cell < bottom < top < 0.866e-3 + cell, snapshot["bounds"])
        self.assertEqual((back, front), (0, 0))

        # The strongest particle has no more than all together, and yields at the yield stress.
        line = min(range(len(self.history)),
                   key=lambda k: abs(self.history["time"][k] - snapshot["time"]))
        total = self.history["plastic_work"][min(line + 1, len(self.history) - 1)]
        self.assertLessEqual(ranges["plastic_work"][1], total)
        self.assertGreaterEqual(ranges["plastic_work"][0], 0)
        self.assertLess(ranges["von_mises"][1], 1.1 * 500e6)
        if snapshot["time"] == 0:
            self.assertEqual(ranges["velocity"], [0, 0])
            self.assertEqual(ranges["von_mises"], [0, 0])
            self.assertEqual(ranges["volume_ratio"], [1, 1])
        else:
            self.assertLess(ranges["velocity"][0], -1, "the piston pushes to the left")
            self.assertGreater(ranges["von_mises"][1], 1e6)


if __name__ == "__main__":
    if not os.environ.get("MPM_PVPYTHON"):
        print("skipped: pvpython is not installed (Debian: python3-paraview)")
        sys.exit(0)
    unittest.main()
