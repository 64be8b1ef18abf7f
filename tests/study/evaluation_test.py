"""References, errors, targets and warnings out of figures that are made up, and their tables."""
import csv
import io
import json
import unittest

import numpy

import evaluation
import known_values
import tables
from made_up import SHAPE, evaluated


def errors(rows):
    return [row.errors["modulus"] for row in rows]


def ladder(limit, constant, order, count=4):
    return [limit + constant * (1 / (10 * 2 ** k)) ** order for k in range(count)]


class Errors(unittest.TestCase):
    def test_against_a_number_are_fractions_of_it_and_show_the_order(self):
        _, rows, outcome = evaluated(200.0, {"gimp": ladder(200, 400, 2)})
        numpy.testing.assert_allclose(errors(rows), [0.02, 0.005, 0.00125, 0.0003125])
        reference = next(iter(outcome.references.values()))
        self.assertAlmostEqual(reference.order, 2)
        self.assertEqual(outcome.warnings, [])

    def test_exact_figures_are_errors_themselves(self):
        _, rows, _ = evaluated("exact", {"gimp": [-0.04, 0.01]})
        self.assertEqual(errors(rows), [0.04, 0.01])

    def test_against_the_finest_leave_it_without_one(self):
        _, rows, outcome = evaluated("finest", {"gimp": ladder(200, 400, 1)})
        self.assertIsNone(errors(rows)[-1])
        self.assertEqual(rows[-1].remarks["modulus"], evaluation.IS_REFERENCE)
        self.assertAlmostEqual(errors(rows)[0], 35 / 205)
        self.assertNotIn(rows[-1], outcome.fronts["wall_seconds"])

    def test_against_0_there_are_none(self):
        for known in "finest", 0.0:
            study, rows, outcome = evaluated(known, {"gimp": [3.0, 1.0, 0.0]})
            self.assertEqual(errors(rows), [None, None, None])
            self.assertEqual(rows[0].remarks["modulus"], "no error relative to a reference of 0")
            self.assertIn("modulus", tables.terminal_text(study, rows, [outcome]))

    def test_of_levels_of_one_size_show_no_order(self):
        for against in "finest", "richardson", 200.0:
            _, rows, outcome = evaluated(against, {"gimp": [3.0, 2.0, 1.0]},
                                         levels=[10, (20, 40), (40, 20)])
            self.assertTrue(all(row.bars == {} for row in rows))
            self.assertIsNone(next(iter(outcome.references.values())).order)

    def test_against_the_extrapolation_are_those_against_the_limit(self):
        _, rows, outcome = evaluated("richardson", {"gimp": ladder(200, 400, 1)})
        numpy.testing.assert_allclose(errors(rows), [0.2, 0.1, 0.05, 0.025])
        self.assertIn("order 1.00", next(iter(outcome.references.values())).words)
        self.assertEqual(outcome.warnings, [])

    def test_fall_back_to_the_finest_where_nothing_can_be_extrapolated(self):
        _, rows, outcome = evaluated("richardson", {"gimp": [1.0, 3.0, 2.0]})
        self.assertEqual(rows[-1].remarks["modulus"], evaluation.IS_REFERENCE)
        self.assertTrue(any("no extrapolation" in text for text in outcome.warnings))

    def test_of_runs_that_are_unstable_or_failed_make_no_reference_and_no_front(self):
        for state in (evaluation.UNSTABLE, evaluation.FAILED):
            _, rows, outcome = evaluated("finest", {"gimp": ladder(200, 400, 1)}, states={3: state})
            self.assertEqual(rows[2].remarks["modulus"], evaluation.IS_REFERENCE)
            self.assertTrue(any("gave no good value: [80, 80]" in w for w in outcome.warnings))
            self.assertEqual([r for r in rows if r in outcome.fronts["wall_seconds"]], rows[:2])


    def test_without_a_reference_there_are_none(self):
        study, rows, outcome = evaluated(None, {"gimp": ladder(200, 400, 1)})
        self.assertEqual(errors(rows), [None] * 4)
        self.assertEqual((outcome.targets, outcome.warnings), ([], []))
        titles = tables.csv_text(study, rows).splitlines()[0].split(",")
        self.assertIn("value_modulus [SI]", titles)
        self.assertFalse(any(title.startswith(("error_", "bar_")) for title in titles), titles)


class Bars(unittest.TestCase):
    def test_belong_to_the_finest_run_of_a_ladder_and_hold_its_limit(self):
        study, rows, _ = evaluated("finest", {"gimp": ladder(200, 400, 1),
                                              "quadratic": ladder(220, 100, 1)},
                                   series=("gimp", "quadratic"))
        barred = [row for row in rows if row.bars]
        self.assertEqual(barred, [rows[3], rows[7]])
        for row, limit in zip(barred, (200, 220)):
            away = abs(row.values["modulus"] - limit)
            self.assertGreaterEqual(row.bars["modulus"].uncertainty, away)
            self.assertLessEqual(row.bars["modulus"].uncertainty, 2.5 * away)
        table = list(csv.DictReader(io.StringIO(tables.csv_text(study, rows))))
        self.assertEqual([bool(line["bar_modulus [SI]"]) for line in table],
                         [False, False, False, True] * 2)


class Known(unittest.TestCase):
    def test_figures_stand_beside_those_found(self):
        study, rows, outcome = evaluated(None, {"gimp": [190.0, 205.0]})
        study.known = [known_values.Known(((SHAPE, "gimp"),), {"modulus": 200.0})]
        for row in rows:
            row.known = study.known_of(row.combination)
        table = list(csv.DictReader(io.StringIO(tables.csv_text(study, rows))))
        self.assertEqual({line["known_modulus [SI]"] for line in table}, {"200"})
        self.assertIn("200", tables.terminal_text(study, rows, [outcome]))


class SeveralSeries(unittest.TestCase):
    values = {"gimp": ladder(200, 400, 1), "quadratic": ladder(220, 100, 1)}

    def test_are_judged_each_by_its_own_limit_and_told_how_far_these_are_apart(self):
        _, rows, outcome = evaluated("richardson", self.values, series=("gimp", "quadratic"))
        self.assertAlmostEqual(errors(rows)[0], 0.2)
        self.assertAlmostEqual(errors(rows)[4], 10 / 220)
        self.assertTrue(any("differ by up to 10 %" in text for text in outcome.warnings))

    def test_or_all_by_the_one_that_is_named(self):
        _, rows, outcome = evaluated("richardson", self.values, series=("gimp", "quadratic"),
                                     reference=((SHAPE, "gimp"),))
        self.assertAlmostEqual(errors(rows)[4], 0.15)
        self.assertEqual(outcome.warnings, [])


class Targets(unittest.TestCase):
    def test_name_the_cheapest_run_that_reaches_them(self):
        _, _, outcome = evaluated(200.0, {"gimp": ladder(200, 400, 2)}, targets=(0.01, 0.001))
        self.assertTrue(outcome.targets[0].startswith("1 %: gimp, cells [20, 20], error 0.5 %"))
        self.assertTrue(outcome.targets[1].startswith("0.1 %: gimp, cells [80, 80]"))

    def test_say_what_is_best_where_none_does(self):
        _, _, outcome = evaluated(200.0, {"gimp": ladder(200, 400, 1)}, targets=(0.001,))
        self.assertIn("not reached: the best is gimp, cells [80, 80], error 2.5 %",
                      outcome.targets[0])

    def test_are_not_reached_where_the_error_only_passes_through_zero(self):
        _, _, outcome = evaluated(200.0, {"gimp": [220.0, 200.1, 190.0, 194.0]}, targets=(0.01,))
        self.assertIn("not reached: the best is gimp, cells [80, 80], error 3 %",
                      outcome.targets[0])
        self.assertIn("cells [20, 20] has less by chance", outcome.targets[0])


class Tables(unittest.TestCase):
    def test_hold_a_row_a_run_with_empty_cells_for_what_is_not_there(self):
        study, rows, _ = evaluated("finest", {"gimp": ladder(200, 400, 1)},
                                   states={0: evaluation.FAILED})
        table = list(csv.DictReader(io.StringIO(tables.csv_text(study, rows))))
        self.assertEqual(len(table), 4)
        self.assertEqual(table[0]["status"], "what went wrong")
        self.assertEqual((table[0]["exit_status"], table[0]["wall_seconds [s]"]), ("3", ""))
        self.assertEqual(table[1]["grid.cells"], "[20, 20]")
        self.assertAlmostEqual(float(table[1]["error_modulus [1]"]), 15 / 205)

    def test_json_names_rows_of_the_front_and_is_strict(self):
        study, rows, outcome = evaluated(200.0, {"gimp": [None, 210.0, 205.0]})
        rows[1].energy_error = float("nan")
        found = json.loads(tables.json_text(study, rows, [outcome], {"machine": "m"}, "results"),
                           parse_constant=self.fail)
        self.assertEqual(found["measures"][0]["pareto"]["wall_seconds"][-1], 2)
        self.assertEqual(found["machine"], "m")

    def test_terminal_has_80_columns(self):
        study, rows, outcome = evaluated(
            "richardson", {"gimp": ladder(200, 400, 1), "a_rather_long_name_of_a_shape":
                           ladder(220, 100, 1)}, series=("gimp", "a_rather_long_name_of_a_shape"),
            states={1: evaluation.FAILED, 2: evaluation.FAILED})
        text = tables.terminal_text(study, rows, [outcome])
        self.assertLessEqual(max(map(len, text.splitlines())), 80, text)
        self.assertIn("gimp, cells [20, 20] and 1 more: what went wrong", text)


if __name__ == "__main__":
    unittest.main()
