"""mpm_report on runs of each kind: a page that stands alone, and what it says."""
import html.parser
import io
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import types
import unittest

import needed

needed.modules("numpy", "h5py", "yaml", "matplotlib", "PIL")

import numpy  # noqa: E402
from PIL import Image  # noqa: E402

from program import ProgramTest, mpm_par, scene, set_options, summary  # noqa: E402

REPORT = pathlib.Path(os.environ["MPM_BUILD"]) / "mpm_report"
TUBES = pathlib.Path(__file__).parents[2] / "inputs" / "tutorial" / "tubes.yaml"
VOID = {"meta", "img", "source", "br", "link", "hr", "input"}
SPARSE = ["--at", "100%", "--film-size", "0"]  # the last snapshot only
SMALL = ["grid.cells=[26, 22]", "output.snapshots=4",
         "output.fields=[stress, plastic_work, id, rank]"]


class Page(html.parser.HTMLParser):
    """Raises if elements do not close in their order; keeps texts, pictures and addresses."""

    def __init__(self, text):
        super().__init__()
        self.open, self.seen, self.words, self.images = [], [], [], []
        self.ids, self.addresses = [], []
        self.feed(text)
        self.close()
        assert not self.open, f"not closed: {self.open}"

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.seen.append(tag)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "img":
            self.images.append(attributes)
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.addresses += [attributes[name] for name in ("src", "href", "srcset", "action")
                           if name in attributes]

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> in {self.open}"
        self.open.pop()

    def handle_data(self, data):
        if self.open[-1:] != ["style"]:
            self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


def mpm_report(*words):
    return subprocess.run([REPORT, *map(str, words)], capture_output=True, text=True, timeout=120)


class Report(ProgramTest):
    def page_of(self, folder, *words):
        run = mpm_report(folder, *words)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, rf"^report in {folder}/report.html \([0-9.]+ s\)\n$")
        return self.checked(folder)

    def checked(self, folder):
        """Well formed, alone, and with words for whoever does not see."""
        text = (folder / "report.html").read_text()
        page = Page(text)
        for address in page.addresses:
            self.assertTrue(address.startswith(("data:image/", "#")), address[:80])
        for rule in re.findall(r"url\(.*?\)|@import.*?;", text.split("</style>")[0]):
            self.fail(f"an address in the style: {rule}")
        for address in page.addresses:
            if address.startswith("#"):
                self.assertIn(address[1:], page.ids)
        self.assertEqual(len(page.ids), len(set(page.ids)))
        for image in page.images:
            self.assertGreater(len(image["alt"]), 20, image["alt"])
        self.assertEqual(page.seen.count("h1"), 1)
        self.assertGreaterEqual(page.seen.count("th"), 3)
        self.assertIn('lang="en"', text)
        self.assertIn('name="viewport"', text)
        self.assertIn("prefers-color-scheme: dark", text)
        self.assertNotIn("<script", text)
        pictures = {path.name for path in (folder / "report").iterdir()}
        self.assertFalse([name for name in pictures if not name.endswith((".png", ".svg"))])
        return page

    def test_updated_lagrangian_in_the_plane(self):
        folder = self.results("honeycomb", *SMALL, ranks=2)
        page = self.page_of(folder, "--at", "9%", "17%", "--window", "west=0:0.5mm",
                            "--window", "south east=0.5mm:1mm,0:0.4mm")
        found, text = summary(folder), page.text
        curve = found["compression"]
        for words in ("The run reached its end, 25 % strain", "modulus",
                      f"{curve['modulus'] / 1e6:.4g} ± {curve['modulus_error'] / 1e6:.2g} MPa",
                      "south east", "Ranks", "updated Lagrangian", found["provenance"]["git"], "Nairn",
                      *found["warnings"]):
            self.assertIn(" ".join(words.split()), text)
        onset = curve["buckling"]
        self.assertIn(f"{100 * onset['strain']:.4g} ± {100 * onset['strain_error']:.2g} %", text)
        files = {path.name for path in (folder / "report").iterdir()}
        self.assertEqual(files, {
            "curve.svg", "curve.png", "energies.svg", "energies.png", "energy_error.svg",
            "energy_error.png", "windows.svg", "windows.png", "ranks.svg", "ranks.png", "film.png",
            "plastic_work_000001.png", "plastic_work_000002.png", "axial_stress_000001.png",
            "axial_stress_000002.png"})
        with Image.open(folder / "report" / "film.png") as film:
            self.assertEqual(film.n_frames, 4)
        # Another report takes the place of the first.
        self.page_of(folder, "--film-size", "0")
        for name in "film.png", "windows.svg", "plastic_work_000001.png":
            self.assertEqual((folder / "report" / name).exists(), name.startswith("plastic"), name)

    def test_windows_and_error_bars_say_what_their_files_say(self):
        folder = self.results("honeycomb", *SMALL, ranks=2)
        page = self.page_of(folder, "--window", "all=-1mm:2mm", *SPARSE)
        row = re.search(r"all (\S+) mm³ (\S+) MJ/m³ 100 %", page.text)
        self.assertTrue(row, page.text)
        from mpm_par import open_run
        work = open_run(folder).history["plastic_work"][-1]
        self.assertAlmostEqual(float(row[1]) * 1e-9 * float(row[2]) * 1e6 / work, 1, delta=2e-3)
        self.check_error_bars(folder)

    def test_total_lagrangian_in_the_plane(self):
        folder = self.results(
            "honeycomb", *SMALL[:2], "numerics.formulation=total_lagrangian",
            "loading.strain=9 %", "output.fields=[plastic_work]",
            "specimen.windows=[{name: left half, x: [0 %, 50 %]}]", ranks=2)
        page = self.page_of(folder, *SPARSE)
        for words in ("total Lagrangian", "left half", "no axial stress is shown"):
            self.assertIn(words, page.text)

    def test_in_space_shows_a_section(self):
        folder = self.folder / "tubes"
        run = mpm_par(TUBES, "--output", folder,
                      *set_options(["loading.strain=8 %", "output.snapshots=3"]), ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("shown is a section about one particle thick at z = 5 µm",
                      self.page_of(folder, *SPARSE).text)
        self.assertIn("at z = 2 µm", self.page_of(folder, "--section", "2um", *SPARSE).text)

    def test_a_run_that_was_interrupted(self):
        folder = self.folder / "results"
        run = mpm_par(scene("honeycomb"), "--output", folder, "--time-limit", "0.2 s",
                      "--set", "grid.cells=[100, 86]", ranks=2)
        self.assertEqual(run.returncode, 75, run.stderr)
        text = self.page_of(folder).text
        for words in ("This run did not reach its end", "of 25 %", "--restart",
                      "no lines are drawn into the curve"):
            self.assertIn(words, text)
        self.assertIn("It fell ill & <ended>.",
                      self.page_of(folder, "--remark", "It fell ill & <ended>.", *SPARSE).text)

    def test_a_run_that_began_on_more_ranks(self):
        folder, settings = self.folder / "results", [*SMALL, "output.checkpoints={steps: 100}"]
        for ranks, words in (3, ["--set", "steps=300"]), (2, ["--restart"]):
            run = mpm_par(scene("honeycomb"), "--output", folder, *set_options(settings), *words, ranks=ranks)
            self.assertEqual(run.returncode, 0, run.stderr)
        said = " ".join(image.get("alt", "") for image in self.page_of(folder, *SPARSE).images)
        self.assertIn("Particles of 3 ranks; at the end from 0 to", said)

    def test_a_run_of_few_steps_says_so(self):
        folder = self.results("honeycomb", "steps=400", *SMALL)
        self.assertIn("This run stopped early: its scene limits the steps",
                      self.page_of(folder, *SPARSE).text)

    def test_without_piston_and_without_snapshots(self):
        folder = self.results("punch", "output.snapshots=3", "free_motion.end_time=6 us", ranks=2)
        text = self.page_of(folder).text
        for words in ("No piston loads this specimen", "t = 6 µs", "No plastic work has been done",
                      "von Mises stress"):
            self.assertIn(words, text)
        folder = self.results("confined_block", label="bare")
        self.assertIn("left no snapshots", self.page_of(folder).text)

    def check_error_bars(self, folder):
        """Taken of the same scene, refused of another."""
        modulus = summary(folder)["modulus"]
        bar = {"value": modulus, "error": 0.0123 * modulus, "basis": "gci", "remark": ""}
        record = self.folder / "bar" / "error_bar.json"
        record.parent.mkdir()
        record.write_text(json.dumps({"figures": {"modulus": bar}}))
        page = self.page_of(folder, "--error-bar", record.parent, *SPARSE)
        self.assertIn(f"{modulus / 1e6:.4g} ± {0.0123 * modulus / 1e6:.2g} MPa", page.text)
        record.write_text(json.dumps({"figures": {"modulus": {**bar, "value": 2 * modulus}}}))
        run = mpm_report(folder, "--error-bar", record.parent)
        self.assertEqual(run.returncode, 2)
        self.assertIn("is of another scene", run.stderr)
        # Walls that yield later have the same modulus.
        buckling = {**bar, "value": 40e6}
        record.write_text(json.dumps({"figures": {"modulus": bar, "buckling_stress": buckling}}))
        found = summary(folder)
        found["compression"]["buckling"] = {"strain": 0.01, "stress": 60e6, "strain_error": 0, "stress_error": 0}
        (folder / "summary.json").write_text(json.dumps(found))
        run = mpm_report(folder, "--error-bar", record.parent)
        self.assertEqual(run.returncode, 2)
        self.assertIn("(its stress of buckling is 40 MPa, this run's 60 MPa)", run.stderr)

    def test_wrong_use_has_status_2_and_one_message(self):
        folder = self.results("confined_block", label="bare")
        nowhere = self.folder / "nowhere"
        for words, said in (
                ([nowhere], f"{nowhere}: is no folder. Name the folder"),
                ([self.folder], "holds no history.csv"),
                ([folder, "--error-bar", nowhere], "holds no error_bar.json"),
                ([folder, "--at", "5 mm"], "--at 5 mm: is a length, not a number or a time"),
                ([folder, "--window", "a"], "--window a: is no window"),
                ([folder, "--window", "a=1mm:0"], "1mm:0 does not rise"),
                ([folder, "--window", "a=1:2"], "--window a 1: is a number, not a length"),
                ([folder, "--section", "5"], "--section 5: is a number"),
                ([folder, "--work-limit", "0"], "--work-limit 0: is not above 0"),
                ([folder, "--film-size", "0.05"], "--film-size 0.05: is below 0.1")):
            run = mpm_report(*words)
            self.assertEqual(run.returncode, 2, run.stdout)
            self.assertIn(said, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(mpm_report().returncode, 2)
        (folder / "history.csv").write_text("time [s]\n")
        run = mpm_report(folder)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("no line of values yet", run.stderr)
        self.assertFalse((folder / "report.html").exists())

    def test_leaves_no_file_outside_the_folder_of_results(self):
        mpm_par(scene("confined_block"), "--output", self.folder / "results", "--quiet",
                *set_options(["steps=60", "output.history_lines=5", "output.snapshots=0"]))
        home, scratch, named = (self.folder / name for name in ("home", "scratch", "named"))
        home.mkdir()
        scratch.mkdir()
        bare = {name: value for name, value in os.environ.items()
                if name != "MPLCONFIGDIR" and not name.startswith("XDG_")}
        places = {"HOME": str(home), "TMPDIR": str(scratch)}
        for own in {}, {"MPLCONFIGDIR": str(named)}:
            run = subprocess.run([REPORT, self.folder / "results"], capture_output=True, text=True,
                                 env={**bare, **places, **own}, timeout=120)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertEqual([*home.iterdir(), *scratch.iterdir()], [])
        self.assertTrue(list(named.iterdir()))  # the user's own place

    def test_help_fits_the_terminal(self):
        run = mpm_report("--help")
        self.assertEqual(run.returncode, 0)
        self.assertLessEqual(max(map(len, run.stdout.splitlines())), 80)
        self.assertIn("docs/reports.md", run.stdout)

    def test_a_python_without_matplotlib_is_told(self):
        """The standard library alone, as `python3 -I -S` has it."""
        alone = self.folder / "python"
        alone.write_text(f'#!/bin/sh\nexec {shutil.which("python3")} -S "$@"\n')
        alone.chmod(0o755)
        run = subprocess.run([REPORT, self.folder], capture_output=True, text=True,
                             env={**os.environ, "MPM_REPORT_PYTHON": str(alone)})
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertRegex(run.stderr, r"^no report: install .*python3-matplotlib.* for .*\.\n$")

    def test_a_build_that_found_no_python_asks_the_one_that_is_there(self):
        made = pathlib.Path(__file__).parents[2] / "src/python/mpm_report.in"
        launcher = self.folder / "mpm_report"
        launcher.write_text(made.read_text().replace("@MPM_REPORT_PYTHON@", ""))
        (self.folder / "python").symlink_to(REPORT.parent / "python")
        environment = {name: value for name, value in os.environ.items() if name != "MPM_REPORT_PYTHON"}
        run = subprocess.run(["sh", launcher, "--help"], capture_output=True, text=True, env=environment)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("usage: mpm_report", run.stdout)

    def test_of_studies_holds_their_figures_beside_theory_and_what_is_known(self):
        wood = pathlib.Path(__file__).parents[2] / "inputs" / "wood"
        study = (f"# Both directions of a wood.\nscene: {wood}/loblolly_radial.yaml\n"
                 "set: {grid.cells: [26, 17], loading.speed: 50 m/s, loading.strain: 8 %,\n"
                 "      material.yield_stress: 100 MPa,\n"
                 "      output.snapshots: 2, output.history_lines: 100}\n"
                 "vary: {loading.piston: [right, top], specimen.threshold_shift: [0, 20]}\n"
                 "error: [{name: stress, mean: {strain: [1 %, 6 %]}},\n"
                 "        {name: modulus, of: compression.modulus}]\n"
                 "known: {source: A book, run_time: [1 h, 10 h], runs: [{stress: 100 MPa}]}\n")
        folder = self.folder / "studies"
        folder.mkdir()
        files = [folder / "one.yaml", folder / "two.yaml"]
        files[0].write_text(study)
        files[1].write_text(study.replace("specimen.threshold_shift: [0, 20]", "specimen.seed: [2, 3]")
                            .replace("set: {", "set: {specimen.micrograph: loblolly.anatomy.yaml, "))
        made = subprocess.run([REPORT.with_name("mpm_study"), *files, "-o", folder],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(made.returncode, 0, made.stderr + made.stdout)
        text = self.page_of(folder).text
        from mpm_par import Window, foam, open_run, read_study, work_in_windows
        runs = read_study(folder / "one").record["runs"]
        for run in runs:
            stress, found = run["value_stress"], open_run(folder / "one" / run["folder"])
            self.assertIn(f"{stress / 1e6:.4g} / 100 ({stress / 1e6 - 100:+.0f} %)", text)
            faster = [float(format(hours * 3600 / run["wall_seconds"], ".2g")) for hours in (1, 10)]
            self.assertIn("{:,.0f} to {:,.0f}".format(*faster), text)
            densities = [found.summary["relative_density"]]
            if found.axis == 0:  # the windows across x are layers in series
                densities += found.summary["windows"].values()
            for density in densities:
                theory = foam.honeycomb(density, 10.6e9, 100e6, True, 0.33)
                self.assertIn(f"{theory.plastic_collapse / 1e6:.4g}", text)
            border = (0.473 * found.summary["size"][0], 1)
            inside, everywhere, _ = work_in_windows(found, [Window("earlywood", (0, 0), border)])
            self.assertIn(f"{100 * inside[-1, 0] / everywhere[-1]:.3g} at 8 %", text)
        self.assertEqual(text.count(": earlywood"), sum(run["settings"]["loading.piston"] == "right"
                                                        for run in runs) * 2)  # in either study
        by_key = {tuple(run["settings"].values()): run["value_stress"] for run in runs}
        change = 100 * (by_key["right", "20", "1"] / by_key["right", "0", "1"] - 1)
        self.assertIn(f"{change:+.0f} %", text)
        drawn = [run["value_stress"] / 1e6 for run in read_study(folder / "two").record["runs"]
                 if run["settings"]["loading.piston"] == "right"]
        self.assertNotEqual(*drawn)
        self.assertIn(f"{statistics.mean(drawn):.4g} ± {float(format(statistics.stdev(drawn), '.2g')):.4g} "
                      f"({min(drawn):.4g} to {max(drawn):.4g})", text)
        for words in ("All 8 runs ended well", "times faster than 60 min to 10 h", "Over drawn specimens",
                      "Both directions of a wood.", "Foam theory", "What the threshold is worth",
                      "How the picture was read", "Warnings", "All runs: the piston's speed, 50 m/s, is above",
                      "Plastic work in the windows", "one.yaml", "A book"):
            self.assertIn(words, text)
        read = next(open_run(folder / "one" / run["folder"]) for run in runs
                    if run["settings"]["specimen.threshold_shift"] == "20").summary
        self.assertEqual(read["threshold"], 170)
        self.assertIn(f"170 0 {read['bulk_density']:.0f} {read['relative_density']:.3f}", " ".join(text.split()))
        pictures = {path.name for path in (folder / "report").iterdir()}
        self.assertLessEqual({"one_curves.svg", "two_curves.png"}, pictures)
        self.assertTrue(any(name.startswith("two_3_plastic_work") for name in pictures), pictures)
        refused = mpm_report(folder, "--at", "5%")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("holds studies", refused.stderr)

    def test_studies_say_how_much_faster_runs_were_and_how_far_figures_are_known(self):
        from mpm_par.report import study_facts
        run = {"label": "a", "level": "", "state": "ok", "wall_seconds": 60.0, "energy_error": 1e-3,
               "value_modulus": 2e9, "bar_modulus": 3e7}
        record = {"runs": [run], "known_run_time": [3600.0, 36000.0],
                  "measures": [{"name": "modulus", "kind": "value", "path": "compression.modulus", "column": ""}]}
        study = types.SimpleNamespace(title="", record=record)
        self.assertEqual(study_facts.beside_known(study)[1], [])
        self.assertEqual(study_facts.figures(study), (
            ["run", "modulus (MPa)", "energy error", "wall time", "times faster than 60 min to 10 h"],
            [["a", "2000 ± 30", "0.1 %", "60 s", "60 to 600"]]))
        run["known_modulus"] = 1e9
        self.assertEqual(study_facts.beside_known(study)[1], [["a", "2000 ± 30 / 1000 (+100 %)", "60 to 600"]])
        self.assertEqual(study_facts.figures(study)[0][-1], "wall time")

    def test_many_ladders_of_studies_are_drawn_in_a_picture_each(self):
        from mpm_par.history import read_history
        from mpm_par.report import studies
        curve = self.folder / "history.csv"
        curve.write_text("time [s],strain,stress [Pa]\n0,0,0\n1,0.1,1e6\n2,0.2,2e6\n")
        run = types.SimpleNamespace(axis=0, properties={}, history=read_history(curve))
        study = types.SimpleNamespace(title="", record={"along": "grid.cells"})
        entries = [({"label": label, "level": str(level)}, run) for label in ("soft", "stiff") for level in range(6)]
        few, many = (studies._curves("s", study, entries[::step]) for step in (2, 1))
        self.assertEqual([made.stem for made in few], ["s_curves"])
        self.assertEqual([made.stem for made in many], ["s_curves_1", "s_curves_2"])

    def test_a_legend_of_long_names_stands_within_its_picture(self):
        from mpm_par.report import drawing

        def draw(axes):
            for k in range(18):
                axes.plot([0, 1], [0, k], label=f"threshold 10 higher, right, spacing {10 + k} um" +
                                                ", dry" * (k % 4))
            drawing.legend_below(axes, 2, 7.5)

        made = drawing.plot("long", draw, "", "", height=5.3)
        ink = numpy.asarray(Image.open(io.BytesIO(made.files["png"])).convert("L")) < 128
        columns = numpy.flatnonzero(ink.any(axis=0))
        self.assertGreater(columns[0], 0)
        self.assertLess(columns[-1], ink.shape[1] - 1)


if __name__ == "__main__":
    unittest.main()
