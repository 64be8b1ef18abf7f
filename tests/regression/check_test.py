"""What --check says of a run before there is one: its time by steps that it made, its files and their
sizes, and the specimen as it was understood."""
import re
import shutil
import struct
import time
import unittest
import zlib

from program import ProgramTest, mpm_par, scene, set_options

BLOCK = scene("confined_block")


def words_of(text):
    """What stands behind each word of the plan, lines that go on joined."""
    found, last = {}, None
    for line in text.splitlines()[1:]:
        last = line[2:20].strip() or last
        found[last] = (found.get(last, "") + " " + line[21:]).strip()
    return found


def pixels(file):
    """Width, height and rows of an 8-bit grey PNG without filters but those of its encoder."""
    data, at, packed = file.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height = struct.unpack(">II", data[at + 8:at + 16])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    return width, height, zlib.decompress(packed)


class Check(ProgramTest):
    def check(self, *arguments, ranks=1):
        run = mpm_par("--check", *arguments, ranks=ranks, folder=self.folder)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout

    def test_memory_that_moving_borders_take_is_said_where_they_move(self):
        for formulation, ranks in (("total", 1), ("total", 2), ("updated", 2)):
            words = words_of(self.check(BLOCK, "--set", f"numerics.formulation={formulation}_lagrangian",
                                        ranks=ranks))
            said = words["last sound state"].split(" at most")[0] + " for a moment"
            self.assertEqual(words.get("moving borders"),
                             said if (formulation, ranks) == ("total", 2) else None)

    def test_run_time_is_that_of_measured_steps(self):
        for ranks in (1, 2):
            started = time.monotonic()
            words = words_of(self.check(BLOCK, "--set", "grid.cells=[200, 40]", ranks=ranks))
            took = time.monotonic() - started
            found = re.fullmatch(r"([\d.]+) (s|min|h) on (\d) ranks?: ([\d.e+-]+) ms a step "
                                 r"\((\d+) steps? measured\)", words["run time"])
            self.assertTrue(found, words["run time"])
            value, unit, on, ms, steps = found.groups()
            self.assertEqual(int(on), ranks)
            # A second of steps, the first one not counted; no more of them than there was time for.
            self.assertGreater(1e-3 * float(ms) * int(steps), 0.5)
            self.assertLess(1e-3 * float(ms) * int(steps), took)
            planned = float(re.match(r"(?:at least )?(\d+)", words["steps"]).group(1))
            expected = 1e-3 * float(ms) * planned
            said = float(value) * {"s": 1, "min": 60, "h": 3600}[unit]
            self.assertAlmostEqual(said / expected, 1, delta=0.1)

    def test_a_run_takes_about_what_was_said(self):
        words = words_of(self.check(BLOCK, "--set", "grid.cells=[100, 20]"))
        ms = float(re.search(r"([\d.e+-]+) ms a step", words["run time"]).group(1))
        folder = self.folder / "results"
        run = mpm_par(BLOCK, "--set", "grid.cells=[100, 20]", "--set", "steps=2000", "--output", folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        seconds = float(re.search(r"steps in ([\d.]+) s", run.stdout).group(1))
        # Machines are shared: a wrong unit or a wrong number of steps is what must not pass.
        self.assertLess(seconds, 1e-3 * ms * 2000 * 10)
        self.assertGreater(seconds, 1e-3 * ms * 2000 / 10)

    def test_files_are_as_large_as_said(self):
        settings = set_options(["output.snapshots=3", "output.checkpoints={steps: 100, keep: 1}",
                                "output.history_lines=50", "loading.strain=1 %"])
        words = words_of(self.check(BLOCK, *settings))["files"]
        lines, count, each, kept = re.search(
            r"history of (\d+) lines (\d+) snapshots, (\d+) kB each, .* "
            r"checkpoints, (\d+) kB each, the last 1 kept", words).groups()
        folder = self.folder / "results"
        run = mpm_par(BLOCK, *settings, "--output", folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len((folder / "history.csv").read_text().splitlines()) - 1, int(lines) + 1)
        snapshots = sorted((folder / "snapshots").glob("*.h5"))
        self.assertEqual(len(snapshots), int(count))
        for file, said in [(file, each) for file in snapshots] + [
                (file, kept) for file in (folder / "checkpoints").glob("*.h5")]:
            size, said = file.stat().st_size / 1e3, float(said)
            # Beside the numbers there are names and headers, and the history so far.
            self.assertGreater(size, 0.99 * said, file)
            self.assertLess(size, 1.1 * said + 600, file)

    def test_a_scene_that_breaks_is_measured_as_far_as_it_goes(self):
        words = words_of(self.check(scene("fast_disc"), "--set", "steps=400"))
        steps = int(re.search(r"\((\d+) steps measured\)", words["run time"]).group(1))
        self.assertLess(steps, 50)  # its run ends there with an error, and this is the run's to say

    def test_quiet_measures_nothing_and_nothing_is_left(self):
        self.assertEqual(self.check(BLOCK, "--quiet"), "")
        self.check(BLOCK)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_preview_is_the_specimen(self):
        for ranks in (1, 2):
            file = self.folder / f"seen {ranks}.png"
            self.check(BLOCK, "--preview", file, "--quiet", ranks=ranks)
            folder = self.folder / f"results_{ranks}"
            run = mpm_par(BLOCK, "--set", "steps=1", "--output", folder)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(pixels(file), pixels(folder / "specimen.png"))

    def test_preview_does_not_take_the_place_of_the_micrograph(self):
        picture, text = self.folder / "wall.png", self.folder / "wall.yaml"
        self.check(BLOCK, "--preview", picture, "--quiet")
        before = picture.read_bytes()
        text.write_text(
            "material: {law: isotropic, youngs_modulus: 10 GPa, poisson_ratio: 0.3, "
            "density: 1500 kg/m^3}\n"
            "specimen: {micrograph: wall.png, pixel_size: 10 um, threshold: 100}\n"
            "grid: {cells: [20, 10]}\n"
            "loading: {piston: right, speed: 10 m/s, strain: 10 %}\n")
        for name in ("wall.png", "./wall.png"):
            run = mpm_par("--check", "--quiet", text, "--preview", name, folder=self.folder)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn("is the micrograph of the scene. Name another file.", run.stderr)
        self.assertEqual(picture.read_bytes(), before)
        for k in 1, 2:
            (self.folder / f"slice_{k}.png").write_bytes(before)
        text.write_text(text.read_text().replace("micrograph: wall.png, pixel_size: 10 um",
                                                 "micrograph: slice_*.png, pixel_size: 10 um, depth: 20 um")
                        .replace("[20, 10]", "[20, 10, 2]"))
        run = mpm_par("--check", "--quiet", text, "--preview", "slice_2.png", folder=self.folder)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("--preview slice_2.png is the micrograph of the scene", run.stderr)
        self.assertEqual((self.folder / "slice_2.png").read_bytes(), before)

    def test_a_preview_that_cannot_be_written_is_said(self):
        run = mpm_par("--check", "--quiet", BLOCK, "--preview", self.folder / "none" / "a.png",
                      ranks=2)
        self.assertIn("the picture cannot be written", run.stderr)
        self.assertEqual(run.returncode, 4)
        shutil.rmtree(self.folder)

    def test_a_preview_on_a_full_disk_is_said(self):
        (self.folder / "full.png").symlink_to("/dev/full")
        run = mpm_par("--check", "--quiet", BLOCK, "--preview", self.folder / "full.png")
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertIn("full.png: the picture cannot be written", run.stderr)


if __name__ == "__main__":
    unittest.main()
