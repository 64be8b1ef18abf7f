"""Exit statuses and what is printed and written, on several ranks as mpirun hands them on.

Every message is looked for on two ranks: each must be there exactly once.
"""
import os
import pathlib
import resource
import signal
import subprocess
import unittest

from program import History, ProgramTest, command_of, mpm_par, scene, seconds, start, summary
from terminal import on_terminal

WOOD = pathlib.Path(__file__).parents[2] / "inputs" / "wood" / "poplar_radial.yaml"
SHORT = ["--set", "loading.strain=0.05 %"]


class CommandLine(ProgramTest):
    def run_here(self, *arguments, ranks=2):
        return mpm_par(*arguments, ranks=ranks, folder=self.folder)

    def files(self):
        return sorted(path.relative_to(self.folder).as_posix()
                      for path in self.folder.rglob("*") if path.is_file())

    def check_refused(self, *arguments, words, status=2):
        run = self.run_here(*arguments)
        self.assertEqual(run.returncode, status, run.stderr + run.stdout)
        for word in words:
            self.assertEqual(run.stderr.count(word), 1, f"{word!r} in\n{run.stderr}")
        self.assertEqual(run.stdout, "")
        return run

    # What goes well.

    def test_run_leaves_its_files_in_the_folder_asked_for(self):
        run = self.run_here(scene("confined_block"), "--output", "here", *SHORT,
                            "--set", "output.snapshots=2", "--set", "name=pressed")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("warning", run.stderr)
        self.assertNotIn("error", run.stderr)
        self.assertLessEqual({"here/history.csv", "here/summary.json", "here/scene.yaml",
                              "here/specimen.png"}, set(self.files()))
        self.assertTrue(any(file.endswith(".xdmf") for file in self.files()), self.files())
        self.assertEqual(run.stdout.count("results in here"), 1, run.stdout)
        found = summary(self.folder / "here")
        self.assertEqual(found["name"], "pressed")
        self.assertEqual(found["particles"], 800)
        self.assertEqual(found["ranks"], 2)
        self.assertAlmostEqual(found["strain"], 0.0005, delta=1e-12)
        self.assertEqual(History(self.folder / "here")["particles"][-1], 800)

    def test_results_go_to_results_and_the_scenes_name_by_default(self):
        run = self.run_here(scene("confined_block"), "--set", "steps=2", ranks=1)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("results/confined_block/history.csv", self.files())

    def test_effective_scene_runs_again_to_the_same_history(self):
        first = self.run_here(scene("confined_block"), "-o", "first", *SHORT, ranks=1)
        self.assertEqual(first.returncode, 0, first.stderr)
        again = self.run_here("first/scene.yaml", "-o", "again", ranks=1)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual((self.folder / "first/history.csv").read_text(),
                         (self.folder / "again/history.csv").read_text())

    def test_effective_scene_names_what_the_program_chose(self):
        (self.folder / "wood.yaml").write_text(
            f"specimen: {{micrograph: {WOOD.parent / 'poplar.bmp'}, image_size: [0.802 mm, 0.524 mm]}}\n"
            "loading: {piston: right, speed: 10 m/s}\nsteps: 20\n")
        first = self.run_here("wood.yaml", "-o", "first", ranks=1)
        self.assertEqual(first.returncode, 0, first.stderr)
        effective = (self.folder / "first/scene.yaml").read_text()
        for chosen in ("cells: [150, 98]", "contact_stiffness: 2", "mass_scaling: 0.8", "cfl: ", "ramp_time: "):
            self.assertIn(chosen, effective)
        again = self.run_here("first/scene.yaml", "-o", "again", ranks=1)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual((self.folder / "first/history.csv").read_text(),
                         (self.folder / "again/history.csv").read_text())

    def test_a_signal_before_the_run_begins_is_taken_down(self):
        """SIGUSR1 as soon as the program looks for it: while MPI starts, or the scene is read."""
        run = start(scene("confined_block"), "--output", self.folder / "here", "--set", "grid.cells=[200, 100]")
        caught = 1 << (signal.SIGUSR1 - 1)
        status = pathlib.Path(f"/proc/{run.pid}/status")
        while run.poll() is None:
            line = next(line for line in status.read_text().splitlines() if line.startswith("SigCgt"))
            if int(line.split()[1], 16) & caught:
                break
        run.send_signal(signal.SIGUSR1)
        _, errors = run.communicate(timeout=seconds(120))
        self.assertEqual(run.returncode, 75, errors)
        self.assertIn("Ended after step 20", errors)
        self.assertTrue((self.folder / "here/checkpoints/000000000020.h5").exists())

    def test_memory_that_is_not_there_is_said_before_the_run(self):
        limit = 3 << 30

        def within(file, cells):
            return subprocess.run([os.environ["MPM_PAR"], file, "--quiet", "-o", "here", "--set", f"grid.cells={cells}"],
                                  cwd=self.folder, capture_output=True, text=True, timeout=seconds(120),
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))

        if seconds(1) > 1:
            self.skipTest("sanitizers reserve terabytes")
        for file, cells, says in ((WOOD, "[20000, 13000]", "which take"),
                                  (scene("confined_block"), "[5000, 2000]", "of memory and more")):
            run = within(file, cells)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(says, run.stderr)
            self.assertIn("fewer", run.stderr)
        self.assertEqual(self.files(), [])

    def test_quiet_leaves_warnings_and_errors_alone(self):
        for words in SHORT, ["--check"]:
            run = self.run_here(scene("confined_block"), "-o", "out", "--quiet", *words)
            self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertIn("out/summary.json", self.files())
        every = ["-o", "goes_on", "--quiet", "--set", "output.checkpoints={steps: 20}"]
        for words in ["--set", "steps=30"], ["--restart", *SHORT]:
            run = self.run_here(scene("confined_block"), *every, *words)
            self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.check_refused("nowhere.yaml", "--quiet", words=["nowhere.yaml: no such scene file"])

    def test_set_changes_the_run_and_the_last_one_holds(self):
        run = self.run_here(scene("confined_block"), "-o", "out", "--set", "grid.cells=[8, 4]",
                            "--set", "grid.particles_per_cell=3", "--set", "steps=9",
                            "--set", "steps=7")
        self.assertEqual(run.returncode, 0, run.stderr)
        found = summary(self.folder / "out")
        self.assertEqual((found["particles"], found["steps"]), (8 * 4 * 9, 7))

    def test_check_prints_the_plan_once_and_writes_nothing(self):
        run = self.run_here(scene("confined_block"), "--check", "--output", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        for words in ("Uniform block in confined compression", "time step", "left out", "memory"):
            self.assertEqual(run.stdout.count(words), 1, run.stdout)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_version_names_the_source_and_the_libraries(self):
        run = self.run_here("--version")
        self.assertEqual(run.returncode, 0, run.stderr)
        names = [line.split()[0] for line in run.stdout.splitlines() if line.strip()]
        self.assertEqual(len(names), len(set(names)), "a line stands there twice")
        for name in ("mpm_par", "git", "compiler", "MPI", "PETSc", "HDF5", "Eigen"):
            self.assertIn(name, names)
        for line in run.stdout.splitlines():
            self.assertGreaterEqual(len(line.split()), 2, f"{line!r} says no version")

    def test_help_and_reference_are_printed_once_without_a_scene(self):
        run = self.run_here("--help")
        self.assertEqual(run.returncode, 0, run.stderr)
        for option in ("--check", "--output", "--set", "--version", "--input-reference",
                       "--input-schema"):
            self.assertIn(option, run.stdout)
        self.assertEqual(run.stdout.count("--check"), 1)
        reference = self.run_here("--input-reference")
        self.assertEqual(reference.returncode, 0, reference.stderr)
        self.assertIn("| `stiffness_ratio` |", reference.stdout)
        self.assertEqual(reference.stdout.count("| `stiffness_ratio` |"), 1)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_options_behind_the_scene_reach_petsc(self):
        run = self.run_here(scene("confined_block"), "-o", "out", "--set", "steps=3", "-log_view")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("PETSc Performance Summary", run.stdout)
        self.assertIn("Distributed Mesh", run.stdout)

    # What the user did wrong: status 2, and nothing is written.

    def test_messages_are_folded_where_a_person_reads_them_and_nowhere_else(self):
        wrong = [scene("confined_block"), "-o", "r", "--set", "loading.speed=10 smoots per fortnight",
                 "--set", "numerics.shape_function=quadratic_bspline_of_some_kind"]
        for ranks in 1, 2:
            status, shown = on_terminal(command_of(wrong, ranks), self.folder)
            piped = self.run_here(*wrong, ranks=ranks).stderr
            self.assertEqual(status, 2, shown)
            lines = [line for line in piped.splitlines() if line.startswith("--set")]
            self.assertEqual(len(lines), 2, piped)
            self.assertGreater(min(map(len, lines)), 80)
            for line in lines:
                self.assertIn(line, shown.replace("\n    ", " "))
            own = shown.split("\n-----")[0]  # what follows is the launcher's own
            self.assertLessEqual(max(map(len, own.splitlines())), 80, own)

    def test_every_wrong_key_is_reported_with_its_place(self):
        wrong = self.folder / "wrong.yaml"
        text = scene("confined_block").read_text()
        wrong.write_text(text.replace("youngs_modulus", "youngs_modulas")
                         .replace("history_lines", "history_line"))
        run = self.check_refused(wrong.name, words=["unknown key 'youngs_modulas'",
                                                    "did you mean 'youngs_modulus'?",
                                                    "unknown key 'history_line'"])
        lines = text.splitlines()
        material = next(k for k, line in enumerate(lines) if line.startswith("material:"))
        self.assertIn(f"wrong.yaml:{material + 1}:", run.stderr)
        self.assertEqual(self.files(), ["wrong.yaml"])

    def test_wrong_value_in_an_option_is_reported(self):
        self.check_refused(scene("confined_block"), "--set", "loading.speed=-3 m/s",
                           words=["--set loading.speed=-3 m/s: loading.speed is"])
        self.assertEqual(self.files(), [])

    def test_missing_micrograph_is_reported(self):
        wrong = self.folder / "wood.yaml"
        wrong.write_text("specimen: {micrograph: nowhere.png, pixel_size: 1 um}\n"
                         "loading: {speed: 10 m/s}\n")
        self.check_refused(wrong.name, words=["wood.yaml:1:", "nowhere.png)"])
        self.assertEqual(self.files(), ["wood.yaml"])

    def test_damaged_micrograph_is_reported(self):
        (self.folder / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n no picture")
        (self.folder / "wood.yaml").write_text(
            "specimen: {micrograph: broken.png, pixel_size: 1 um}\nloading: {speed: 10 m/s}\n")
        self.check_refused("wood.yaml", words=["broken.png"])
        self.assertEqual(self.files(), ["broken.png", "wood.yaml"])

    def test_missing_scene_is_reported(self):
        self.check_refused("nowhere.yaml", words=["nowhere.yaml: no such scene file"])
        self.assertEqual(self.files(), [])

    def test_wrong_usage_is_reported(self):
        for arguments, words in (
                (["--chek", "a.yaml"], "did you mean '--check'?"),
                (["a.yaml", "--outptu", "b"], "unknown option '--outptu'"),
                (["a.yaml", "b.yaml"], "'b.yaml' is a second scene"),
                (["-log_view", "a.yaml"], "unknown option '-log_view'"),
                ([], "no scene named")):
            with self.subTest(arguments=arguments):
                self.check_refused(*arguments, words=[words])
        self.assertEqual(self.files(), [])

    def test_ranks_that_cannot_be_arranged_are_reported(self):
        self.check_refused(scene("confined_block"), "-o", "out", "--set", "numerics.ranks=[3, 1]",
                           words=["2 ranks cannot be arranged as 3 x 1"])
        self.assertEqual(self.files(), [])

    # Where the disk says no: status 4.

    def test_file_where_the_folder_of_results_should_be_is_reported(self):
        (self.folder / "plain").write_text("a file")
        for place in ("plain", "plain/below"):
            with self.subTest(place=place):
                run = self.run_here(scene("confined_block"), "--output", place)
                self.assertEqual(run.returncode, 4, run.stderr)
                self.assertEqual(run.stderr.count(f"{place}"), 1, run.stderr)
                self.assertIn("--output", run.stderr)
        self.assertEqual((self.folder / "plain").read_text(), "a file")
        self.assertEqual(self.files(), ["plain"])


if __name__ == "__main__":
    unittest.main()
