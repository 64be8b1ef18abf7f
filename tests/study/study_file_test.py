"""Study files: which runs they stand for, and one clear error with its line for what is wrong."""
import pathlib
import tempfile
import unittest

import evaluation
import study_file
from problems import InputError

GOOD = """\
title: A study
scene: scene.yaml
set: {loading.strain: 25 %}
vary:
  numerics.shape_function: [gimp, quadratic]
  grid.cells: [[10, 20], [20, 40], [40, 80]]
repeat: 3
error: {of: compression.modulus, against: 12.5 MPa}
"""


class StudyFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.yaml").write_text("grid: {cells: [10, 20]}\n")

    def read(self, text, **options):
        path = self.folder / "study.yaml"
        path.write_text(text)
        return study_file.read_study(path, **options)

    def refused(self, old, new, line, *words, text=GOOD, **options):
        """The error names the line and all words, and is one line."""
        self.assertIn(old, text)
        with self.assertRaises(InputError) as caught:
            self.read(text.replace(old, new), **options)
        said = str(caught.exception)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn(f"study.yaml:{line}:", said)
        for word in words:
            self.assertIn(word, said)


class Runs(StudyFile):
    def test_are_the_product_of_the_lists(self):
        study = self.read(GOOD)
        self.assertEqual(len(study.combinations), 6)
        self.assertEqual(study.combinations[1].settings,
                         (("numerics.shape_function", "gimp"), ("grid.cells", "[20, 40]")))
        self.assertEqual(study.along, "grid.cells")
        self.assertEqual(study.repeat, 3)

    def test_write_no_snapshots_unless_asked_to(self):
        study = self.read(GOOD)
        self.assertEqual(dict(study.assignments(study.combinations[0])),
                         {"loading.strain": "25 %", "output.snapshots": "0",
                          "numerics.shape_function": "gimp", "grid.cells": "[10, 20]"})
        study = self.read(GOOD.replace("25 %", "25 %, output.snapshots.count: 3"))
        self.assertNotIn("output.snapshots", dict(study.assignments(study.combinations[0])))

    def test_ask_for_snapshots_in_a_map_of_all_output_too(self):
        asked = self.read(GOOD.replace("25 %", "25 %, output: {snapshots: {strains: [5 %]}}"))
        self.assertNotIn("output.snapshots", dict(asked.assignments(asked.combinations[0])))
        not_asked = self.read(GOOD + "runs:\n  - {output: {history_lines: 50}}\n")
        self.assertEqual(not_asked.assignments(not_asked.combinations[0])[-2:],
                         [("output", "{history_lines: 50}"), ("output.snapshots", "0")])

    def test_know_all_their_values_of_which_any_may_name_a_picture(self):
        nodes = self.read(GOOD.replace("[gimp, quadratic]", "[a.png, b.png, a.png]")).nodes
        self.assertEqual([node.text for node in nodes["numerics.shape_function"]], ["a.png", "b.png", "a.png"])
        self.assertEqual([node.text for node in nodes["loading.strain"]], ["25 %"])

    def test_of_a_list_go_with_every_combination(self):
        study = self.read(GOOD + "runs:\n  - {numerics.scheme: apic}\n"
                                 "  - {numerics.scheme: flip, numerics.cfl: 0.5}\n")
        self.assertEqual(len(study.combinations), 12)
        self.assertEqual(study.combinations[0].value("numerics.cfl"), None)
        self.assertEqual(study.combinations[11].value("numerics.cfl"), "0.5")

    def test_of_an_entry_with_a_label_are_called_by_it(self):
        study = self.read(GOOD + "runs:\n  - {label: slow and soft, numerics.scheme: apic}\n"
                                 "  - {numerics.scheme: flip}\n")
        first, last = study.combinations[0], study.combinations[-1]
        self.assertEqual((first.label, first.labelled), ("slow and soft", ("numerics.scheme",)))
        self.assertEqual(first.value("numerics.scheme"), "apic")
        self.assertEqual((last.label, last.labelled), ("", ()))
        self.assertNotIn("label", study.varied)
        self.assertEqual(evaluation.label_of(study, first), "slow and soft, gimp")
        self.assertEqual(evaluation.label_of(study, last), "quadratic, flip")

    def test_of_a_map_are_called_by_its_keys(self):
        study = self.read(GOOD.replace("[gimp, quadratic]", "{smooth: gimp, smoother: quadratic}"))
        last = study.combinations[-1]
        self.assertEqual(last.value("numerics.shape_function"), "quadratic")
        self.assertEqual(evaluation.label_of(study, last), "smoother")
        self.assertEqual(study.combinations[-1].settings, self.read(GOOD).combinations[-1].settings)
        self.refused("[gimp, quadratic]", "{smooth: gimp, smooth: cubic}", 5, "given twice")
        self.refused("[gimp, quadratic]", "{}", 5, "no list of values")
        self.refused("[[10, 20], [20, 40], [40, 80]]", "{coarse: [10, 20], fine: [20, 40]}", 6,
                     "along which the study refines, has names")
        twice = self.read(GOOD.replace("[gimp, quadratic]", "{smooth: gimp, round: gimp}"))
        self.assertEqual(len(twice.combinations), 3)
        ranks = self.read(GOOD.replace("[gimp, quadratic]", "[gimp]\n  ranks: {alone: 1, together: 2}"))
        self.assertEqual(evaluation.label_of(ranks, ranks.combinations[-1]), "gimp, together")

    def test_may_be_a_list_alone(self):
        text = GOOD.replace("vary:", "runs:").replace(
            "  numerics.shape_function: [gimp, quadratic]\n", "").replace(
            "  grid.cells: [[10, 20], [20, 40], [40, 80]]",
            "  - {grid.cells: [10, 20], ranks: 2}\n  - {grid.cells: [20, 40], ranks: 1}")
        self.assertEqual([run.ranks for run in self.read(text).combinations], [2, 1])

    def test_of_a_ladder_may_change_what_is_counted_in_cells(self):
        text = GOOD.replace("vary:", "runs:").replace(
            "  numerics.shape_function: [gimp, quadratic]\n", "").replace(
            "  grid.cells: [[10, 20], [20, 40], [40, 80]]",
            "  - {grid.cells: [10, 20], loading.load_cell.cells: 2, numerics.cfl: 0.2}\n"
            "  - {grid.cells: [20, 40], loading.load_cell.cells: 4, numerics.cfl: 0.3}")
        self.assertEqual(self.read(text).level_keys, ("grid.cells", "loading.load_cell.cells"))
        self.assertEqual(self.read(GOOD).level_keys, ("grid.cells",))

    def test_have_the_ranks_of_the_command_unless_the_study_says_so(self):
        self.assertEqual(self.read(GOOD, ranks=4).combinations[0].ranks, 4)
        text = GOOD.replace("25 %", "25 %, ranks: 2")
        self.assertEqual(self.read(text, ranks=4).combinations[0].ranks, 2)

    def test_of_a_reference_may_be_finer_than_all_others(self):
        text = GOOD.replace("12.5 MPa", "finest, reference: {numerics.shape_function: gimp, "
                                        "grid.cells: [80, 160]}")
        study = self.read(text)
        self.assertEqual(len(study.combinations), 7)
        self.assertTrue(study.combinations[-1].only_reference)
        self.assertEqual(study.combinations[-1].value("grid.cells"), "[80, 160]")

    def test_of_the_quick_variant(self):
        text = GOOD + "quick:\n  vary: {grid.cells: [[10, 20]]}\n  repeat: 1\n"
        study = self.read(text, quick=True)
        self.assertEqual((len(study.combinations), study.repeat), (2, 1))
        self.assertEqual(len(self.read(text).combinations), 6)


KNOWN = """\
known:
  source: A paper
  runs:
    - {modulus: 2 GPa}
    - {where: {numerics.shape_function: gimp}, modulus: 3 GPa}
"""


class Known(StudyFile):
    def test_figures_belong_to_the_runs_that_their_settings_name(self):
        study = self.read(GOOD + KNOWN)
        found = {run.value("numerics.shape_function"): study.known_of(run)
                 for run in study.combinations}
        self.assertEqual(found, {"gimp": {"modulus": 3e9}, "quadratic": {"modulus": 2e9}})
        self.assertEqual(study.known_source, "A paper")

    def test_figures_that_no_run_has_are_refused(self):
        text = GOOD + KNOWN
        self.refused("gimp}, modulus: 3", "cubic}, modulus: 3", 13, "where fits no run", text=text)
        self.refused("{numerics.shape_function: gimp}, ", "{numerics.scheme: flip}, ", 13,
                     "where has no key 'numerics.scheme'", text=text)
        self.refused("modulus: 2 GPa", "plateau: 2 GPa", 12, "no key 'plateau'", text=text)
        self.refused("2 GPa", "2 furlong", 12, "modulus is 2 furlong", "unknown unit", text=text)
        self.refused("  source: A paper\n", "", 10, "has no source", text=text)

    def test_figures_of_runs_that_the_quick_variant_leaves_out_are_no_mistake(self):
        text = GOOD + KNOWN + "quick:\n  vary: {numerics.shape_function: [quadratic]}\n"
        study = self.read(text, quick=True)
        self.assertEqual({tuple(study.known_of(run).items()) for run in study.combinations},
                         {(("modulus", 2e9),)})
        self.refused("gimp}, modulus: 3", "cubic}, modulus: 3", 13, "where fits no run", text=text)

    def test_how_long_others_took_is_a_pair_of_times(self):
        self.assertIsNone(self.read(GOOD + KNOWN).known_run_time)
        text = GOOD + KNOWN.replace("  runs:", "  run_time: [4 h, 5 h]\n  runs:")
        self.assertEqual(self.read(text).known_run_time, [4 * 3600, 5 * 3600])
        for wrong, words in (("4 h", "no list of two"), ("[4 h]", "no list of two"),
                             ("[4 m, 5 h]", "is a length, not a time"), ("[6 h, 5 h]", "falls")):
            self.refused("[4 h, 5 h]", wrong, 11, "known.run_time", words, text=text)
        named = GOOD.replace("[gimp, quadratic]", "{smooth: gimp, smoother: quadratic}") + \
            KNOWN.replace("numerics.shape_function: gimp", "numerics.shape_function: smooth")
        plain, called = (self.read(text) for text in (GOOD + KNOWN, named))
        self.assertEqual([plain.known_of(run) for run in plain.combinations],
                         [called.known_of(run) for run in called.combinations])
        alone = self.read(GOOD + "known: {source: A paper, run_time: [4 h, 5 h]}\n")
        self.assertEqual((alone.known, alone.known_run_time), ([], [4 * 3600, 5 * 3600]))
        self.refused(", run_time: [4 h, 5 h]", "", 9, "has no runs and no run_time",
                     text=GOOD + "known: {source: A paper, run_time: [4 h, 5 h]}\n")


class Wrong(StudyFile):
    def test_keys(self):
        self.refused("repeat: 3", "repetitions: 3", 7, "no key 'repetitions'", "Known:", "repeat")
        self.refused("title: A study\n", "title: A study\ntitle: B\n", 2, "given twice")
        self.refused("scene: scene.yaml\n", "", 1, "scene is missing")
        self.refused("error: {of: compression.modulus, against: 12.5 MPa}\n", "", 1,
                     "error is missing")

    def test_values(self):
        self.refused("repeat: 3", "repeat: 0", 7, "repeat is 0", "at least 1")
        self.refused("scene: scene.yaml", "scene: other.yaml", 2, "there is no file")
        self.refused("[gimp, quadratic]", "gimp", 5, "no list of values")
        self.refused("[[10, 20], [20, 40], [40, 80]]", "[[10, 20], fine]", 6,
                     "grid.cells", "is fine", "no list of numbers of cells")
        self.refused("repeat: 3", "targets: [1 m]", 7, "a target is 1 m", "length")
        self.refused("repeat: 3", "time_limit: 3 MPa", 7, "pressure, not a time")
        self.refused("repeat: 3", "along: numerics.scheme", 7, "no key that refines")
        self.refused("repeat: 3", "along: numerics.cfl", 7, "does not vary")
        self.refused("25 %", "25 %, ranks: none", 3, "ranks is none", "whole number")

    def test_a_figure_without_a_reference_has_no_error(self):
        study = self.read(GOOD.replace(", against: 12.5 MPa", ""))
        self.assertIsNone(study.measures[0].against)
        self.refused(", against: 12.5 MPa", ", reference: {numerics.shape_function: gimp}", 8,
                     "does not go with no against")

    def test_errors_to_take(self):
        line = "{of: compression.modulus, against: 12.5 MPa}"
        self.refused(line, "{against: finest}", 8, "no figure", "curve")
        self.refused(line, "{of: a, mean: {strain: [0, 1 %]}, against: finest}", 8, "of and mean")
        self.refused("12.5 MPa", "12.5 furlong", 8, "unknown unit 'furlong'", "MPa")
        self.refused("12.5 MPa", "0 MPa", 8, "is 0")
        self.refused(line, "{curve: {strain: [0 %, 25 %]}, against: 3 MPa}", 8, "of a curve")
        self.refused(line, "{mean: {strain: [5 %, 1 %]}, against: finest}", 8, "does not rise")
        self.refused("12.5 MPa", "finest, reference: {numerics.shape_function: linear}", 8,
                     "fits 0 series")
        self.refused("12.5 MPa", "finest, reference: {grid.cells: [80, 160]}", 8,
                     "fits 2 series", "numerics.shape_function")
        self.refused("12.5 MPa", "12.5 MPa, reference: {grid.cells: [80, 160]}", 8, "does not go")

    def test_finest_needs_a_key_that_refines(self):
        text = GOOD.replace("  grid.cells: [[10, 20], [20, 40], [40, 80]]\n", "")
        self.refused("12.5 MPa", "richardson", 7, "no key that refines varies", text=text)

    def test_text_that_is_no_yaml(self):
        self.refused("[gimp, quadratic]", "[gimp, quadratic", 6, "no YAML")

    def test_a_study_without_a_quick_variant(self):
        with self.assertRaisesRegex(InputError, "no quick variant"):
            self.read(GOOD, quick=True)

    def test_a_file_that_is_not_there(self):
        with self.assertRaisesRegex(InputError, "none.yaml: cannot be read"):
            study_file.read_study(self.folder / "none.yaml")


if __name__ == "__main__":
    unittest.main()
