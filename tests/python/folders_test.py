"""Folders that are missing, half-written or broken: one sentence with place and remedy each."""
import pathlib
import tempfile
import unittest

import needed

needed.modules("numpy", "h5py", "yaml")

import numpy  # noqa: E402

import made_up  # noqa: E402
import mpm_par  # noqa: E402


class Folders(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = made_up.write_run(pathlib.Path(scratch.name) / "results")

    def wrong(self, words, read):
        with self.assertRaises(mpm_par.ResultsError) as caught:
            read()
        said = str(caught.exception)
        self.assertRegex(said, words)
        self.assertRegex(said, r"\. [A-Z].*\.$", "ends with a remedy")
        self.assertNotIn("\n", said)

    def opened(self):
        return mpm_par.open_run(self.folder)

    def test_a_whole_one(self):
        run = self.opened()
        self.assertEqual(len(run.history), 3)
        self.assertEqual([s.strain for s in run.snapshots], [0, 0.1])
        self.assertEqual(run.thickness, 2)
        self.assertAlmostEqual(run.history.at("plastic_work", 0.075), 0.5 * (0.4 + 1.9))
        # Stresses are means since the last line: 2 MPa is that of 2.5 %.
        self.assertAlmostEqual(run.history.at("stress", 0.05), 3e6)
        numpy.testing.assert_allclose(run.history.strain_of("stress"), [0, 0.025, 0.075])
        self.assertTrue(run.history.at("stress", 0.2) != run.history.at("stress", 0.2), "NaN")

    def test_no_folder_and_no_run(self):
        self.wrong("nowhere: is no folder", lambda: mpm_par.open_run(self.folder / "nowhere"))
        self.wrong("history.csv: is no folder",
                   lambda: mpm_par.open_run(self.folder / "history.csv"))
        self.wrong("snapshots: holds no history.csv",
                   lambda: mpm_par.open_run(self.folder / "snapshots"))

    def test_histories(self):
        path = self.folder / "history.csv"
        whole = path.read_text()
        path.write_text(whole + "3e-6,0.2,")  # the run was killed
        self.assertEqual(len(self.opened().history), 3)
        lines = whole.split("\n")
        for text, words in (("", "has no titles"), (lines[0] + "\n", "no line of values"),
                            (whole + "3e-6,0.2\n", "history.csv:5: is no line of a history"),
                            (whole + "x" + lines[2] + "\n", "history.csv:5: is no line")):
            path.write_text(text)
            self.wrong(words, self.opened)
        path.write_bytes(b"\xff\xfe\x00")
        self.wrong("is no text", self.opened)
        path.write_text(whole)
        self.wrong("has no column stress_load_cell. There are: time, strain",
                   lambda: self.opened().history["stress_load_cell"])

    def test_a_run_that_has_not_ended(self):
        (self.folder / "summary.json").unlink()
        (self.folder / "made_up.xdmf").unlink()
        run = self.opened()
        self.assertIsNone(run.summary)
        self.assertEqual((run.properties, run.snapshots, run.checkpoints), ({}, [], []))

    def test_broken_files(self):
        for name, text, words in (("summary.json", '{"name": ', "summary.json: is no summary"),
                                  ("scene.yaml", "a: [", "scene.yaml: is no scene"),
                                  ("scene.yaml", "- a", "scene.yaml: is no scene")):
            whole = (self.folder / name).read_text()
            (self.folder / name).write_text(text)
            self.wrong(words, self.opened)
            (self.folder / name).write_text(whole)
        (self.folder / "made_up.xdmf").write_text("<Xdmf>")
        self.wrong("made_up.xdmf: is no XDMF", lambda: self.opened().snapshots)

    def test_broken_snapshots(self):
        second = self.folder / "snapshots" / "000001.h5"
        kept = self.opened().snapshots
        made_up.write_snapshot(second, 0.1, complete=0)
        self.wrong("000001.h5: was not written to its end", lambda: self.opened().snapshots)
        second.write_bytes(second.read_bytes()[:200])
        self.wrong("000001.h5: cannot be read", lambda: self.opened().snapshots)
        second.unlink()
        self.wrong("000001.h5: is not there", lambda: self.opened().snapshots)
        self.wrong("000001.h5: is not there", lambda: kept[1]["plastic_work"])
        self.wrong("has no field stress .there are: .*plastic_work.*output.fields",
                   lambda: kept[0]["stress"])
        import h5py
        with h5py.File(self.folder / "snapshots" / "000000.h5", "r+") as file:
            del file.attrs["particle_volume"]
        self.wrong("is no snapshot of this version .without particle_volume",
                   lambda: self.opened().snapshots)

    def test_studies(self):
        self.wrong("holds no study.json.*let it end", lambda: mpm_par.read_study(self.folder))
        self.wrong("holds no error_bar.json", lambda: mpm_par.read_error_bar(self.folder))
        (self.folder / "study.json").write_text("{")
        self.wrong("study.json: is broken", lambda: mpm_par.read_study(self.folder))
        (self.folder / "study.json").write_text('{"title": "t"}')
        self.wrong("study.csv: is missing or empty", lambda: mpm_par.read_study(self.folder))


if __name__ == "__main__":
    unittest.main()
