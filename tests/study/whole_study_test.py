"""A study of a few seconds from its file to its tables, with a run that fails in it."""
import csv
import json
import math
import os
import signal
import subprocess
import time
import unittest

from whole_run import WholeRun, mpm_study

BULK_AND_SHEAR = 50e9 * 0.7 / (1.3 * 0.4)  # modulus of uniaxial strain


def exact_mean(begin, end):
    """Of - M ln(1 - e)/(1 - e) from begin to end (docs/studies.md)."""
    logs = [math.log(1 - strain) ** 2 for strain in (begin, end)]
    return BULK_AND_SHEAR / 2 * (logs[1] - logs[0]) / (end - begin)


STUDY = f"""\
title: Block
scene: block.yaml
vary:
  numerics.shape_function: [gimp, linear]
  numerics.scheme: [flip, tpic]
  grid.cells: [[8, 2], [16, 4], [32, 8]]
repeat: 2
error: {{name: stress, mean: {{strain: [1 %, 4 %]}}, against: {exact_mean(0.01, 0.04) / 1e9} GPa}}
targets: [20 %, 0.001 %]
"""


class StudyTest(WholeRun):
    def write(self, text=STUDY):
        path = self.folder / "study.yaml"
        path.write_text(text)
        return path

    def table(self):
        with open(self.folder / "output" / "study.csv", newline="") as file:
            return list(csv.DictReader(file))

    def times_of_records(self):
        return {path: path.stat().st_mtime_ns
                for path in (self.folder / "output").glob("runs/*/*.json")}


class WholeStudy(StudyTest):
    def test_parts_together_are_the_study(self):
        study, output = self.write(STUDY.replace("repeat: 2", "repeat: 1")), self.folder / "output"
        for part, runs in ("1/5", 3), ("2/5", 3), ("5/5", 2):
            said = self.good(study, "--output", output, "--part", part)
            self.assertIn(f"{runs} of 12 runs done", said)
            self.assertEqual([path.name for path in output.iterdir()], ["runs"])
        self.assertEqual(len(self.times_of_records()), 8)
        for wrong in "0/3", "4/3", "2", "a/b":
            run = mpm_study(study, "--output", output, "--part", wrong)
            self.assertEqual(run.returncode, 2)
            self.assertIn(f"--part is {wrong}", run.stderr)
        before = self.times_of_records()
        self.assertIn("8 runs were done before", self.good(study, "--output", output))
        self.assertEqual(len(self.table()), 12)
        self.assertLessEqual(before.items(), self.times_of_records().items())

    def test_several_studies_have_a_folder_each_and_none_runs_before_all_are_understood(self):
        one = ("scene: block.yaml\nvary: {loading.speed: [10 m/s, 20 m/s]}\n"
               "error: {name: stress, mean: {strain: [1 %, 4 %]}}\n"
               "known: {source: A book, runs: [{stress: 2 GPa}]}\n")
        first, second = self.folder / "first.yaml", self.folder / "second.yaml"
        first.write_text(one)
        second.write_text("scene: nowhere.yaml\n" + one.split("\n", 1)[1])
        output = self.folder / "output"
        refused = mpm_study(first, second, "--output", output)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("second.yaml:1:", refused.stderr)
        self.assertFalse(output.exists())

        second.write_text(one)
        said = self.good(first, second, "--output", output)
        self.assertIn("study 2/2", said)
        for name in ("first", "second"):
            with open(output / name / "study.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([float(row["known_stress [SI]"]) for row in rows], [2e9, 2e9])
            self.assertEqual(list((output / name).glob("error_*")), [])
        twice = mpm_study(first, first, "--output", output)
        self.assertEqual(twice.returncode, 2)
        self.assertIn("same name", twice.stderr)

    def test_tables_plots_and_terminal(self):
        said = self.good(self.write(), "--output", self.folder / "output")
        rows = self.table()
        self.assertEqual(len(rows), 12)
        by = {(r["numerics.shape_function"], r["numerics.scheme"], r["grid.cells"]): r
              for r in rows}
        # The piston acts on whole nodes: first order, half a cell of eight at most.
        errors = [float(by["gimp", "flip", cells]["error_stress [1]"])
                  for cells in ("[8, 2]", "[16, 4]", "[32, 8]")]
        self.assertLess(errors[0], 0.12)
        self.assertGreater(errors[0], errors[1])
        self.assertGreater(errors[1], errors[2])
        for row in (row for row in rows if row["status"] == "ok"):
            self.assertEqual(float(row["core_seconds [s]"]), float(row["wall_seconds [s]"]))
            self.assertEqual(row["particle_steps [1]"],
                             str(int(row["particles [1]"]) * int(row["steps [1]"])))
            self.assertEqual(row["rounds [1]"], "2")
            self.assertGreater(float(row["peak_memory [MiB]"]), 5)
        # This pair is refused by the program: rows of the table, not the end.
        refused = by["linear", "tpic", "[8, 2]"]
        self.assertEqual(refused["exit_status"], "2")
        self.assertIn("exit status 2: --set numerics.scheme=tpic", refused["status"])
        self.assertIn("cheapest for 20 %: gimp", said)
        self.assertIn("cheapest for 0.001 %: not reached", said)
        self.assertLessEqual(max(map(len, said.split("  " + str(self.folder))[0].splitlines())),
                             80, said)
        for name in ("error_stress.svg", "error_stress.png"):
            self.assertGreater((self.folder / "output" / name).stat().st_size, 5000)
        found = json.loads((self.folder / "output" / "study.json").read_text())
        self.assertIn("processor", found["machine"])
        self.assertIn("git", found["mpm_par"])
        self.assertFalse(list(self.folder.glob("output/**/*.part")))

    def test_leaves_no_file_in_the_home_folder(self):
        home = self.folder / "home"
        home.mkdir()
        places = {name: value for name, value in os.environ.items()
                  if name != "MPLCONFIGDIR" and not name.startswith("XDG_")}
        study = self.write(STUDY.replace("[[8, 2], [16, 4], [32, 8]]", "[[8, 2]]"))
        run = mpm_study(study, "--output", self.folder / "output", env={**places, "HOME": str(home)})
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((self.folder / "output" / "error_stress.svg").exists())
        self.assertEqual(list(home.iterdir()), [])

    def test_what_is_done_is_not_done_again(self):
        output = self.folder / "output"
        text = STUDY.replace("[[8, 2], [16, 4], [32, 8]]", "[[8, 2]]")
        self.good(self.write(text), "--output", output)
        before, table = self.times_of_records(), (output / "study.csv").read_text()
        said = self.good(self.write(text), "--output", output)
        self.assertIn("7 runs were done before", said)  # two rounds, but of the refused one
        self.assertEqual(self.times_of_records(), before)
        self.assertEqual((output / "study.csv").read_text(), table)
        more = self.write(text.replace("[8, 2]]", "[8, 2], [12, 3]]"))
        self.good(more, "--output", output)
        after = self.times_of_records()
        self.assertEqual({path: after[path] for path in before}, before)
        self.assertEqual(len(after) - len(before), 7)

    def test_an_interrupted_study_goes_on(self):
        path, output = self.write(STUDY.replace("repeat: 2", "repeat: 9")), self.folder / "output"
        words = [os.environ["MPM_STUDY"], path, "--output", output]
        # A shell's background jobs, of which the tests may be one, ignore interrupts.
        study = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True,
                                 preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        limit = time.monotonic() + 60
        while len(self.times_of_records()) < 3 and time.monotonic() < limit:
            time.sleep(0.02)
        study.send_signal(signal.SIGINT)
        _, said = study.communicate(timeout=60)
        self.assertEqual(study.returncode, 130, said)
        self.assertIn("goes on", said)
        done = self.times_of_records()
        self.assertGreaterEqual(len(done), 3)
        self.good(self.write(), "--output", output)
        after = self.times_of_records()
        self.assertEqual({key: after[key] for key in done}, done)

    def test_several_ranks(self):
        text = STUDY.replace("numerics.scheme: [flip, tpic]", "ranks: [1, 2]").replace(
            "repeat: 2", "repeat: 1").replace("[gimp, linear]", "[gimp]")
        self.good(self.write(text), "--output", self.folder / "output")
        rows = self.table()
        self.assertEqual([row["ranks"] for row in rows], ["1"] * 3 + ["2"] * 3)
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        for one, two in zip(rows[:3], rows[3:]):
            self.assertAlmostEqual(float(one["value_stress [SI]"])
                                   / float(two["value_stress [SI]"]), 1, places=6)
            self.assertAlmostEqual(float(two["core_seconds [s]"]),
                                   2 * float(two["wall_seconds [s]"]), places=6)

    def test_a_run_past_its_limit_of_time_is_a_row(self):
        text = STUDY.replace("[[8, 2], [16, 4], [32, 8]]", "[[8, 2], [400, 100]]").replace(
            "repeat: 2", "repeat: 1\ntime_limit: 2 s").replace("[flip, tpic]", "[flip]").replace(
            "[gimp, linear]", "[gimp]")
        self.good(self.write(text), "--output", self.folder / "output")
        self.assertEqual([row["status"] for row in self.table()], ["ok", "stopped after 2 s"])


class WrongInput(StudyTest):
    def refused(self, text, *words, options=()):
        run = mpm_study(self.write(text), "--output", self.folder / "output", *options)
        self.assertEqual(run.returncode, 2, run.stderr + run.stdout)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertFalse((self.folder / "output").exists())

    def test_keys_that_no_scene_has_are_mistakes_of_the_study(self):
        self.refused(STUDY.replace("numerics.scheme:", "numerics.schema:"), "study.yaml:5:",
                     "numerics.schema is no key of the scene", "did you mean 'scheme'")

    def test_keys_that_no_study_has(self):
        self.refused(STUDY.replace("repeat:", "repetitions:"), "study.yaml:7:", "repetitions")

    def test_options_that_do_not_go_together(self):
        self.refused(STUDY, "--set belongs to --error-bar", options=("--set", "steps=3"))

    def test_a_study_whose_runs_all_fail_ends_with_the_status_of_failure(self):
        text = STUDY.replace("[gimp, linear]", "[linear]").replace("[flip, tpic]", "[tpic]")
        run = mpm_study(self.write(text), "--output", self.folder / "output")
        self.assertEqual(run.returncode, 3, run.stderr + run.stdout)
        self.assertIn("no run gave a figure", run.stderr)
        self.assertEqual(len(self.table()), 3)


if __name__ == "__main__":
    unittest.main()
