"""Whole runs on 1, 2, 3 and 4 ranks: the same history as far as the run is smooth, and the same
properties where it buckles."""
import unittest

from program import History, ProgramTest, summary

ALL_RANKS = (1, 2, 3, 4)


class RankInvariance(ProgramTest):
    def histories(self, *settings):
        return [History(self.results("honeycomb", *settings, ranks=ranks, label=f"on_{ranks}"))
                for ranks in ALL_RANKS]

    def check_same(self, *settings):
        """To 1e-9 of each column's largest value: rounding of sums in other orders, which an
        elastic run does not amplify by more than some orders of magnitude."""
        first, *others = self.histories(*settings)
        self.assertGreater(max(first["stress_piston"]), 10e6)
        for ranks, other in zip(ALL_RANKS[1:], others):
            self.assertEqual(first.names, other.names)
            self.assertEqual(len(first), len(other))
            for name in first.names:
                if name == "momentum_error":  # Rounding itself: its size is what counts.
                    self.assertLess(max(other[name]), 1e-9)
                    continue
                largest = max(map(abs, first[name]))
                for line, (one, more) in enumerate(zip(first[name], other[name])):
                    self.assertLessEqual(abs(one - more), 1e-9 * largest,
                                         f"{name} in line {line} on {ranks} ranks")

    def test_elastic_honeycomb_has_the_same_history(self):
        self.check_same("material.yield_stress=500 GPa", "loading.strain=3 %")

    def test_elastic_honeycomb_with_load_cell_and_other_method_has_the_same_history(self):
        self.check_same("material.yield_stress=500 GPa", "loading.strain=2 %",
                        "loading.load_cell.cells=3", "loading.piston=bottom",
                        "numerics.shape_function=quadratic", "numerics.scheme=tpic")

    def test_elastic_honeycomb_on_blocks_mapped_by_metis_has_the_same_history(self):
        self.check_same("material.yield_stress=500 GPa", "loading.strain=3 %",
                        "numerics.decomposition=metis")

    def test_elastic_honeycomb_has_the_same_history_while_the_borders_move(self):
        """Every seven steps; History checks numbers, ids and mass of the particles at every line."""
        for kind in "cuts", "metis":
            self.check_same("material.yield_stress=500 GPa", "loading.strain=2 %",
                            f"numerics.decomposition={kind}", "numerics.repartition_interval=7")
            for ranks in ALL_RANKS:
                found = summary(self.folder / f"on_{ranks}")
                expected = found["steps"] // 7 if ranks > 1 else 0
                self.assertEqual(found["repartitions"], expected)

    def test_crushed_honeycomb_has_the_same_properties(self):
        """Within 1 %: buckling amplifies rounding, but not what is extracted."""
        first, *others = self.histories()
        stress_of = {}
        for history, ranks in zip([first, *others], ALL_RANKS):
            found = summary(self.folder / f"on_{ranks}")
            self.assertGreater(history["plastic_work"][-1], 0)
            means = []
            for low, high in ((0.01, 0.03), (0.05, 0.1), (0.1, 0.15), (0.15, 0.25)):
                window = [s for e, s in zip(history["strain"], history["stress"])
                          if low <= e < high]
                means.append(sum(window) / len(window))
            stress_of[ranks] = [found["modulus"], found["buckling_stress"] or 0, *means]
        for ranks in ALL_RANKS[1:]:
            for alone, together in zip(stress_of[1], stress_of[ranks]):
                self.assertAlmostEqual(together, alone, delta=0.01 * alone,
                                       msg=f"on {ranks} ranks: {stress_of}")
            self.assertEqual(others[0]["particles"], first["particles"])


if __name__ == "__main__":
    unittest.main()
