"""What is done is not done again, what has changed or was broken off is."""
import json
import pathlib
import tempfile
import unittest

import store
from program import Ended
from yaml_tree import read_value, read_yaml


class Counting:
    """Stands for mpm_par: counts its runs and ends as told."""

    def __init__(self, exit_status=0, seconds=1.0, stopped=False):
        self.runs = 0
        self.end = Ended(exit_status, "" if exit_status == 0 else "wrong", seconds, seconds,
                         2 ** 20, stopped)

    def run(self, scene, assignments, ranks, folder, time_limit=None):
        self.runs += 1
        folder.mkdir(parents=True)
        if self.end.exit_status == 0:
            (folder / "summary.json").write_text(json.dumps({"settings": assignments}))
        return self.end


class Kept(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene = self.folder / "scene.yaml"
        self.scene.write_text("specimen: {micrograph: picture.png}\n")
        (self.folder / "picture.png").write_bytes(b"black")

    def store(self, of_program="one"):
        printed = store.scene_print(self.scene, [read_yaml(self.scene)])
        return store.Store(self.folder / "output", printed, of_program)

    def needed(self, program, kept=None, settings=(("a", "1"),), ranks=1, turn=1, limit=None):
        """Whether the run was run: what a study does for each."""
        kept = kept or self.store()
        if kept.find(settings, ranks, turn, limit):
            return False
        kept.run(program, self.scene, settings, ranks, turn, limit)
        return True

    def test_the_same_run_is_done_once(self):
        program = Counting()
        self.assertEqual([self.needed(program) for _ in range(3)], [True, False, False])
        self.assertEqual(program.runs, 1)

    def test_settings_ranks_rounds_program_scene_and_picture_each_make_another_run(self):
        program = Counting()
        self.assertTrue(self.needed(program))
        self.assertTrue(self.needed(program, settings=(("a", "2"),)))
        self.assertTrue(self.needed(program, ranks=2))
        self.assertTrue(self.needed(program, turn=2))
        self.assertTrue(self.needed(program, kept=self.store("another")))
        (self.folder / "picture.png").write_bytes(b"white")
        self.assertTrue(self.needed(program))
        self.scene.write_text("specimen: {micrograph: picture.png}  # changed\n")
        self.assertTrue(self.needed(program))
        self.assertEqual(program.runs, 7)

    def test_each_slice_of_a_stack_counts(self):
        self.scene.write_text("specimen: {micrograph: slice_*.png, depth: 2 * 3 um}\n")
        program = Counting()
        for expected in True, False:
            self.assertEqual(self.needed(program), expected)
        for content in b"black", b"white":
            (self.folder / "slice_2.png").write_bytes(content)
            self.assertTrue(self.needed(program))

    def test_each_slice_of_a_stack_counts_whatever_else_its_name_holds(self):
        self.scene.write_text("specimen: {micrograph: 'scan[1]?_*.png', depth: 2 * 3 um}\n")
        program = Counting()
        self.assertTrue(self.needed(program))
        for content in b"black", b"white":
            (self.folder / "scan[1]?_2.png").write_bytes(content)
            self.assertTrue(self.needed(program))

    def test_a_text_that_is_too_long_for_the_name_of_a_file_is_none(self):
        self.scene.write_text(f"title: {300 * 'long '}\nspecimen: {{micrograph: picture.png}}\n")
        self.assertTrue(self.needed(Counting()))

    def test_a_picture_in_a_map_of_a_setting_counts(self):
        prints = []
        for content in b"black", b"white":
            (self.folder / "b.png").write_bytes(content)
            value = read_value("{micrograph: b.png, pixel_size: 1 um}", "--set")
            prints.append(store.scene_print(self.scene, [read_yaml(self.scene), value]))
        self.assertNotEqual(*prints)
        self.assertEqual(read_value("[1, 2", "--set").text, "[1, 2")

    def test_what_fails_by_its_input_is_done(self):
        for status in (2, 3):
            program = Counting(status)
            settings = (("status", str(status)),)
            self.assertTrue(self.needed(program, settings=settings))
            self.assertFalse(self.needed(program, settings=settings))

    def test_what_a_full_disk_or_a_signal_ended_is_not(self):
        for status in (4, -9, 137):
            program = Counting(status)
            settings = (("status", str(status)),)
            self.assertTrue(self.needed(program, settings=settings))
            self.assertTrue(self.needed(program, settings=settings))

    def test_what_was_stopped_is_done_until_it_may_take_longer(self):
        program = Counting(143, seconds=10.1, stopped=True)
        self.assertTrue(self.needed(program, limit=10))
        self.assertFalse(self.needed(program, limit=10))
        self.assertTrue(self.needed(program, limit=20))
        self.assertTrue(self.needed(program, limit=None))

    def test_a_record_without_its_results_counts_for_nothing(self):
        program = Counting()
        self.needed(program)
        (self.store().place((("a", "1"),), 1, 1) / "summary.json").unlink()
        self.assertTrue(self.needed(program))

    def test_a_run_that_was_broken_off_leaves_no_record(self):
        class Broken(Counting):
            def run(self, scene, assignments, ranks, folder, time_limit=None):
                folder.mkdir(parents=True)
                raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.needed(Broken())
        self.assertTrue(self.needed(Counting()))


class WriteWhole(unittest.TestCase):
    def test_replaces_and_leaves_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "table.csv"
            store.write_whole(path, "one")
            store.write_whole(path, b"two")
            self.assertEqual(path.read_text(), "two")
            self.assertEqual(list(path.parent.iterdir()), [path])


if __name__ == "__main__":
    unittest.main()
