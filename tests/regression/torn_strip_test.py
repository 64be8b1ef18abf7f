"""Cells that fail, in a whole run: a strip is torn in two, and nothing is lost from the books."""
import json
import unittest

from program import History, ProgramTest, mpm_par, scene, summary


class TornStrip(ProgramTest):
    def test_it_is_torn_and_its_balances_close(self):
        folder = self.results("torn_strip", ranks=2)
        history, found = History(folder), summary(folder)
        failed = history["failed_cells"][-1]
        self.assertGreater(failed, 2)
        self.assertEqual(history["failed_cells"], sorted(history["failed_cells"]))
        for left, gone in zip(history["particles"], history["failed_cells"]):
            self.assertEqual(left + gone, found["particles"])
        self.assertGreater(history["failed_energy"][-1], 0)
        # All that is torn was dissipated before, but for what was stored.
        self.assertLess(history["failed_energy"][-1], 0.05 * history["plastic_work"][-1])
        self.assertEqual(history["plastic_work"], sorted(history["plastic_work"]))
        self.assertLess(max(abs(e) for e in history["energy_error"][20:]), 1e-3)
        self.assertLess(max(history["momentum_error"]), 1e-11)
        self.assertEqual(found["failed_cells"], failed)
        self.assertAlmostEqual(found["failed_energy"] / history["failed_energy"][-1], 1, places=11)
        self.assertIn("cells have failed", " ".join(found["warnings"]))
        self.assertGreaterEqual(found["imbalance"], 1, "of the cells that are left")

    def test_on_one_rank_as_on_three(self):
        one, three = (History(self.results("torn_strip", ranks=ranks, label=f"on_{ranks}"))
                      for ranks in (1, 3))
        self.assertEqual(one["failed_cells"], three["failed_cells"])
        for name in "kinetic_energy", "elastic_energy", "plastic_work", "failed_energy":
            largest = max(map(abs, one[name]))
            for a, b in zip(one[name], three[name]):
                self.assertAlmostEqual(a, b, delta=1e-9 * largest)

    def test_without_a_limit_there_is_no_such_column(self):
        folder = self.folder / "whole"
        text = scene("torn_strip").read_text().replace(
            "  failure: {plastic_strain: 0.8, stretch: 2.5}\n", "")
        (self.folder / "whole.yaml").write_text(text)
        run = mpm_par(self.folder / "whole.yaml", "--output", folder)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        self.assertNotIn("failed_cells", History(folder).names)
        self.assertNotIn("failed_cells", json.dumps(summary(folder)))

    def test_a_limit_that_the_formulation_does_not_know_is_refused(self):
        run = mpm_par(scene("torn_strip"), "--set", "numerics.formulation=updated_lagrangian",
                      "--output", self.folder / "updated")
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("material.failure", run.stderr)
        self.assertIn("set numerics.formulation: total_lagrangian", run.stderr)


if __name__ == "__main__":
    unittest.main()
