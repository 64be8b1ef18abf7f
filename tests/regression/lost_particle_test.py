"""A particle that leaves the grid ends the run on every rank, with its name, exactly once."""
import re
import unittest

from program import History, ProgramTest, mpm_par, scene

LOST = re.compile(r"particle (\d+) of body 'cell_wall' left the grid at "
                  r"\((\S+), (\S+)\) m in step (\d+), t = (\S+) s, with velocity "
                  r"\((\S+), (\S+)\) m/s\.")


class LostParticle(ProgramTest):
    def lost(self, ranks, decomposition="cuts"):
        folder = self.folder / f"on_{ranks}_{decomposition}"
        run = mpm_par(scene("fast_disc"), "--output", folder, "--set",
                      f"numerics.decomposition={decomposition}", ranks=ranks)
        self.assertEqual(run.returncode, 3, run.stderr)
        found = LOST.findall(run.stderr)
        self.assertEqual(len(found), 1, run.stderr)
        self.assertEqual(run.stderr.count("numerics.cfl"), 1, run.stderr)
        particle, x, y, step, time, vx, vy = map(float, found[0])

        # The disc's front starts at 1.7 mm; the grid ends one cell of 50 um behind 2 mm.
        self.assertAlmostEqual(x, 2.05e-3, delta=0.01e-3)
        self.assertAlmostEqual(y, 0.5e-3 + 20 * time, delta=0.1e-3)
        self.assertAlmostEqual(time, (2.05e-3 - 1.7e-3) / 200, delta=0.15e-6)
        self.assertAlmostEqual(vx, 200, delta=1e-6)
        self.assertAlmostEqual(vy, 20, delta=1e-6)
        # Ids are places in the specimen: 80 locations in a row, at the right front of the disc.
        self.assertEqual(particle % 80, 67)
        self.assertLess(abs(particle // 80 - 20), 8)
        self.check_history(folder, time)
        return found[0]

    def check_history(self, folder, time):
        """All lines up to the failure, each whole."""
        history = History(folder)
        self.assertTrue(all(len(row) == len(history.names) for row in history.rows))
        self.assertEqual(len(history), int(time / 0.2e-6) + 1)
        self.assertEqual(set(history["particles"]), {history["particles"][0]})
        self.assertFalse((folder / "summary.json").exists(), "the run did not end well")

    def test_on_one_and_two_ranks_alike(self):
        alone = self.lost(1)
        for decomposition in "cuts", "metis":
            both = self.lost(2, decomposition)
            self.assertEqual(alone[3:5], both[3:5], "step and time")


if __name__ == "__main__":
    unittest.main()
