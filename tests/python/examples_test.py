"""Every example of docs/python.md, as it stands, on results of a small run and small studies."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import needed

needed.modules("numpy", "h5py", "yaml", "matplotlib")

from program import ProgramTest, mpm_par, scene, set_options  # noqa: E402

ROOT = pathlib.Path(__file__).parents[2]
BUILD = pathlib.Path(os.environ["MPM_BUILD"])
BLOCK = ROOT / "tests" / "support" / "block.yaml"
STUDY = """\
title: Cells of a block
scene: block.yaml
vary: {grid.cells: [[8, 2], [16, 4], [32, 8]]}
error: {name: modulus, of: compression.modulus, against: finest}
"""


class Examples(ProgramTest):
    def test_all_run(self):
        results = self.folder / "results"
        run = mpm_par(scene("honeycomb"), "--output", results / "my_wood",
                      *set_options(["output.snapshots=4", "output.fields=[plastic_work, id]"]), ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        shutil.copy(BLOCK, self.folder)
        (self.folder / "study.yaml").write_text(STUDY)
        for words in (["study.yaml", "-o", "results/my_study"],
                      ["--error-bar", "block.yaml", "-o", "results/my_bar"]):
            made = subprocess.run([BUILD / "mpm_study", *words], cwd=self.folder,
                                  capture_output=True, text=True, timeout=240)
            self.assertEqual(made.returncode, 0, made.stderr)
        examples = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs" / "python.md").read_text(),
                              re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(examples), 7)
        said = [self.told(["-c", example]) for example in examples]
        self.assertIn("Crushed honeycomb", said[0])
        self.assertIn("results/my_wodo: is no folder", said[-1])
        for picture in "curve.png", "structure.png":
            self.assertTrue((self.folder / picture).read_bytes().startswith(b"\x89PNG"))
        held = self.told(["-m", "mpm_par", "results/my_wood"])
        self.assertIn("fields: ", held)
        self.assertIn("plastic_work [J]", held)

    def told(self, words):
        """With the package of the build."""
        run = subprocess.run([sys.executable, *words], cwd=self.folder, text=True, timeout=120,
                             capture_output=True,
                             env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
        self.assertEqual(run.returncode, 0, f"{words[-1]}\n{run.stderr}")
        return run.stdout

    def test_an_installation_has_the_package_and_the_report(self):
        prefix = self.folder / "prefix"
        made = subprocess.run([shutil.which("cmake"), "--install", BUILD, "--prefix", prefix],
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(made.returncode, 0, made.stderr)
        for place in prefix / "share" / "mpm_par" / "python", BUILD / "python":
            self.assertEqual({str(path.relative_to(place)) for path in place.rglob("*.*")},
                             {str(path.relative_to(ROOT / "src" / "python"))
                              for path in (ROOT / "src" / "python" / "mpm_par").rglob("*.*")})
        shown = subprocess.run([prefix / "bin" / "mpm_report", "--help"], capture_output=True,
                               text=True, timeout=60)
        self.assertEqual(shown.returncode, 0, shown.stderr)


if __name__ == "__main__":
    unittest.main()
