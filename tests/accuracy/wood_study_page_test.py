"""What the page works out of what its studies found, on figures made by hand."""
import json
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy

import load_paths
import wood_study_page as page

from mpm_par.report import study_facts

MEASURE = {"name": "modulus"}


def ladder_study(*levels):
    """Of one wood: (particles, value, bar) each."""
    return SimpleNamespace(record={"runs": [
        {"label": "oak", "particles": particles, "value_modulus": value, "bar_modulus": bar}
        for particles, value, bar in levels]})


def known(found, error=None, finer=None, finer_error=None, scatter=None, paper=100.0):
    return page.Property("oak", MEASURE, found, error, finer, finer_error, scatter, paper).verdict()


class At(dict):
    """A snapshot's fields, and its strain."""

    def __init__(self, fields, strain):
        super().__init__(fields)
        self.strain = strain


class MadeAgain(unittest.TestCase):
    RUN = {"program": "abcdef0", "processor": "Abacus", "ranks": "1"}

    def test_says_how_far_figures_moved_and_what_one_alone_found(self):
        runs = [self.RUN | {"study": "Oak", "run": f"{k} m/s", "figures": {"modulus": [100.0, repeated], "toe": toe}}
                for k, (repeated, toe) in enumerate([(100.5, [None, 1.0]), (97.0, [2.0, None]), (102.0, [4.0, 4.0])])]
        runs[1]["program"], runs[-1]["program"] = "abcdef1", "abcdef2"
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder) / "newer.json"
            place.write_text(json.dumps(runs))
            found = page.made_again(place)
        self.assertEqual(found["newer_opening"],
                         "Of *Oak* 3 runs were made again by abcdef0, abcdef1 and abcdef2, on 1 rank of an Abacus.")
        self.assertEqual(found["newer_runs"], "3")
        *_, modulus, toe = found["newer"].splitlines()
        self.assertEqual(modulus, "| modulus | 3 | 2 % | 2 | -3 % | Oak: 1 m/s | 0 |")
        self.assertEqual(toe, "| toe | 1 | 0 % | 0 | +0 % | Oak: 2 m/s | 2 |")

    def test_runs_of_a_part_of_a_study_are_known_by_what_is_set_in_them(self):
        def ended(settings):
            return page.ended_by_settings(SimpleNamespace(record={"runs": [
                {"settings": settings, "state": study_facts.OK}, {"settings": {"speed": "9 m/s"}, "state": "lost"}]}))
        part = ended({"speed": "1 m/s", "ranks": "2"})
        whole = ended({"speed": "1 m/s", "depth": None})
        self.assertEqual((len(part), part.keys()), (1, whole.keys()))
        self.assertNotEqual(part.keys(), ended({"speed": "1 m/s", "depth": "1 mm"}).keys())

    def newer_properties(self, *runs):
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder) / "newer.json"
            place.write_text(json.dumps([self.RUN | run for run in runs]))
            with mock.patch.object(page, "NEWER", place):
                return page.table_1.__wrapped__(page.newer_study)

    def test_a_figure_that_moved_moves_what_finer_cells_make_of_it(self):
        kept = page.table_1()
        title = page.kept_study("wood_poplar").title
        moved = self.newer_properties({"study": title, "run": "radial", "bars": {},
                                       "figures": {"buckling_stress": [None, 150e6]}})
        for one, later in zip(kept, moved, strict=True):
            if (one.wood, one.measure["name"]) != ("poplar, radial", "buckling_stress"):
                self.assertEqual(later, one)
                continue
            self.assertAlmostEqual(later.found, 150e6)
            self.assertAlmostEqual(later.finer / later.found, one.finer / one.found)
            self.assertEqual((one.verdict(), later.verdict()), ("agrees", "differs"))

    def test_a_ladder_that_moved_moves_the_numerical_error(self):
        ladder = page.kept_study("wood_error_bars")
        of = ("poplar, radial", "densification_stress")
        kept, = [one for one in page.table_1() if (one.wood, one.measure["name"]) == of]
        runs = [{"study": ladder.title, "run": study_facts.name_of(ladder, run), "bars": {of[1]: 1e6},
                 "figures": {}} for run in ladder.record["runs"] if run["label"] == "poplar, radial"]
        moved, = [one for one in self.newer_properties(*runs) if (one.wood, one.measure["name"]) == of]
        self.assertEqual((moved.found, moved.error), (kept.found, 1e6))
        self.assertNotEqual(kept.error, moved.error)


class FinerCells(unittest.TestCase):
    LADDER = ladder_study((4000, 80.0, None), (1000, 60.0, None), (16000, 90.0, 9.0))

    def test_what_they_change_is_carried_over_from_the_level_that_is_as_fine_as_the_run(self):
        found = page.ladder_of([self.LADDER], ("oak",), {"particles": 3500}, MEASURE)
        self.assertEqual(found, (80.0, 90.0, 9.0))
        value, error = page.carried(160.0, found)
        self.assertAlmostEqual(value, 180.0)
        self.assertAlmostEqual(error, 18.0)

    def test_a_finest_run_without_the_figure_says_nothing_of_it(self):
        study = ladder_study((1000, 60.0, None), (4000, None, None))
        self.assertIsNone(page.ladder_of([study], ("oak",), {"particles": 1000}, MEASURE))
        self.assertEqual(page.carried(160.0, None), (None, None))

    def test_another_wood_has_no_part_in_it(self):
        self.assertIsNone(page.ladder_of([self.LADDER], ("ash",), {"particles": 1000}, MEASURE))


class Verdicts(unittest.TestCase):
    def test_within_a_fifth_of_the_paper_agrees_whatever_the_error(self):
        self.assertEqual(known(119.0, error=90.0), "agrees")

    def test_beyond_it_differs_or_is_undecided_where_it_is_not_known_better(self):
        self.assertEqual(known(130.0, error=20.0), "differs")
        self.assertEqual(known(130.0, error=40.0), "undecided")
        self.assertEqual(known(130.0, scatter=40.0), "undecided")

    def test_what_finer_cells_make_of_it_counts(self):
        self.assertEqual(known(130.0, error=40.0, finer=110.0, finer_error=5.0), "agrees")
        self.assertEqual(known(110.0, error=5.0, finer=130.0, finer_error=5.0), "differs")

    def test_a_curve_without_the_figure_is_not_found(self):
        self.assertEqual(known(None), "not found")


class LoadPaths(unittest.TestCase):
    """Ten locations of 10 um along the load, three rows across that are 7 um apart."""
    PLACE = numpy.array([(1e-3 + 7e-6 * row, 1e-5 * along) for row in range(3) for along in range(10)])

    def test_an_unbroken_row_bears_its_share_and_a_broken_one_none(self):
        load = numpy.array([5.0] * 10 + [5.0] * 4 + [0.0] + [5.0] * 5 + [1.0] * 10)
        self.assertAlmostEqual(load_paths.long_paths(self.PLACE, load, 6e-5), 50 / load.sum())
        self.assertAlmostEqual(load_paths.long_paths(self.PLACE, load, 4.5e-5), 75 / load.sum())
        self.assertAlmostEqual(load_paths.long_paths(self.PLACE, load, 1e-5), 95 / load.sum())

    def test_where_all_bear_the_same_no_path_bears_more(self):
        self.assertEqual(load_paths.long_paths(self.PLACE, numpy.ones(30), 1e-5), 0)

    def test_rows_are_of_each_window_at_each_strain_whatever_the_order_of_particles(self):
        # Pressed along x: of four lines of 20 locations of 10 um two are early-, two latewood.
        along, across = (part.ravel() for part in numpy.meshgrid(numpy.arange(20), numpy.arange(4)))
        place = 1e-5 * numpy.column_stack([along + 0.5, across + 0.5, 0 * along])
        whole, broken = numpy.isin(across, (0, 2)), (across == 3) & (along != 10)
        loads = [numpy.where(whole, 3.0, 1.0), numpy.where(whole, 3.0, numpy.where(broken, 3.0, 0.0))]
        shuffled = numpy.random.default_rng(3).permutation(80)

        def snapshot(strain, load, order):
            stress = numpy.zeros((80, 6))
            stress[:, 0] = -load
            return At({"id": order, "position": (1 - strain) * place[order], "stress": stress[order]}, strain)

        run = SimpleNamespace(
            axis=0, summary={"size": [2e-4, 4e-5]},
            scene={"specimen": {"micrograph": "wood/loblolly.bmp",
                                "windows": [{"name": "early", "y": [0, 0.5]}, {"name": "late", "y": [0.5, 1]}]}},
            snapshots=[snapshot(0.0, numpy.zeros(80), shuffled), snapshot(0.01, loads[0], numpy.arange(80)),
                       snapshot(0.05, loads[1], shuffled[::-1])])
        entry = {"label": "radial", "level": None}
        titles, rows = load_paths.load_path_rows(None, [(entry, run)])
        # Late at 5 %: 60 of 60 + 57; the broken line bears its part in pieces of 100 and 90 um.
        self.assertEqual(rows, [["radial", "early, paths of more than 100 um", "50", "75 at 1 %, 100 at 5 %"],
                                ["radial", "late, paths of more than 100 um", "50", "75 at 1 %, 51.3 at 5 %"]])
        self.assertEqual(len(titles), len(rows[0]))

    def test_a_run_without_stress_has_none(self):
        run = SimpleNamespace(scene={"specimen": {"micrograph": "loblolly.bmp"}}, snapshots=[At({}, 0.0)])
        self.assertEqual(load_paths.load_path_rows(None, [({}, run)])[1], [])


if __name__ == "__main__":
    unittest.main()
