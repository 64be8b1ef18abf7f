"""cmake --install gives a prefix that may be moved, from which everything runs and with which other
projects are built; and a Debian package that does the same."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.append(str(ROOT / "src" / "python"))
from mpm_par.report.__main__ import PACKAGES  # noqa: E402

BUILD = pathlib.Path(os.environ["MPM_BUILD"])
CMAKE = os.environ["MPM_CMAKE"]
SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
SCENE = "share/mpm_par/inputs/benchmarks/confined_block.yaml"


def run(*words, folder=SCRATCH, **environment):
    done = subprocess.run([str(word) for word in words], cwd=folder, text=True, capture_output=True,
                          env={**os.environ, **environment}, timeout=250)
    if done.returncode != 0:
        raise AssertionError(f"{words} ends with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class InstallTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        SCRATCH.mkdir(parents=True)
        run(CMAKE, "--install", BUILD, "--prefix", SCRATCH / "first")
        cls.prefix = SCRATCH / "elsewhere"
        (SCRATCH / "first").rename(cls.prefix)

    def programs_run(self, prefix, folder):
        """Those of a prefix, on scenes that come with it."""
        folder.mkdir()
        results = folder / "results"
        launch = [os.environ["MPM_MPIEXEC"], os.environ["MPM_NUMPROC_FLAG"], "2"]
        run(*launch, prefix / "bin/mpm_par", "--quiet", prefix / SCENE, "-o", results,
            "--set", "loading.strain=10 %", "--set", "grid.cells=[16, 8]", folder=folder)
        self.assertIn("modulus", run(prefix / "bin/mpm_curve", results / "history.csv"))
        drawn = folder / "wood.bmp"
        run(prefix / "bin/draw_wood", prefix / "share/mpm_par/inputs/wood/poplar.anatomy.yaml",
            "-o", drawn)
        self.assertEqual(drawn.read_bytes(), (ROOT / "inputs/wood/poplar.bmp").read_bytes())
        (folder / "study.yaml").write_text(
            f"scene: {prefix / SCENE}\nset: {{steps: 20, grid.cells: [16, 8]}}\n"
            "vary: {loading.speed: [10 m/s, 20 m/s]}\n"
            "error: {name: end, of: steps, against: finest}\n")
        if os.environ["MPM_STUDY_PYTHON"]:
            said = run(prefix / "bin/mpm_study", "study.yaml", "--output", "study", folder=folder)
            self.assertIn("study/error_end.svg", said)

    def test_programs_run_where_the_prefix_has_gone(self):
        self.programs_run(self.prefix, SCRATCH / "run")

    def test_nothing_in_it_names_where_it_was_made(self):
        for path in self.prefix.rglob("*"):
            if path.is_file() and not path.suffix == ".a" and path.parent.name != "bin":
                for place in BUILD, SCRATCH, ROOT:
                    self.assertNotIn(str(place).encode() + b"/", path.read_bytes(), path)

    def test_what_belongs_to_it_is_there(self):
        for name in ("copyright", "licences.md", "README.md", "docs/cluster.md"):
            self.assertTrue((self.prefix / "share/doc/mpm-par" / name).is_file(), name)
        scripts = {path.name for path in (self.prefix / "share/mpm_par/jobscripts").iterdir()}
        shipped = {path.name for path in (ROOT / "jobscripts").iterdir()
                   if path.suffix in (".slurm", ".pbs", ".bash")}
        self.assertLessEqual(shipped, scripts)
        self.assertGreaterEqual(len(shipped), 6)

    def test_another_project_is_built_with_it(self):
        run(CMAKE, "-S", pathlib.Path(__file__).parent / "consumer", "-B", SCRATCH / "consumer",
            "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_CXX_COMPILER={os.environ['MPM_CXX']}")
        run(CMAKE, "--build", SCRATCH / "consumer")
        said = run(SCRATCH / "consumer/consumer")
        version = run(self.prefix / "bin/mpm_par", "--version")
        lanes = re.search(r"vectors +\w+, (\d+) doubles", version)[1]
        self.assertEqual(said.strip(), "wave speed 1.000000 of the expected one, "
                                       f"modulus 2.000000 GPa, {lanes} lanes")

    def test_debian_package(self):
        cpack = shutil.which("cpack", path=f"{pathlib.Path(CMAKE).parent}:{os.environ['PATH']}")
        if not (cpack and shutil.which("dpkg-shlibdeps")):
            self.skipTest("cpack or dpkg-shlibdeps is not here")
        run(cpack, "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", SCRATCH / "packages")
        [package] = (SCRATCH / "packages").glob("*.deb")
        fields = dict(re.findall(r"^ ?([\w-]+): (.*)", run("dpkg-deb", "--info", package), re.M))
        self.assertEqual(fields["Package"], "mpm-par")
        for library in ("libpetsc", "libhdf5-openmpi", "libmetis", "libopenmpi", "libudunits2",
                        "libyaml-cpp"):
            self.assertIn(library, fields["Depends"])
        self.assertEqual(set(fields["Recommends"].split(", ")), set(PACKAGES.values()))
        self.assertLessEqual(len(fields["Description"]), 80)
        wrong = [line for line in run("dpkg-deb", "--contents", package).splitlines()
                 if line.split()[1] != "root/root"
                 or not re.match(r"drwxr-xr-x|-rw-r--r--|-rwxr-xr-x", line)
                 or not line.split()[5].startswith(("./usr/", "./"))]
        self.assertEqual(wrong, [])
        run("dpkg", "-x", package, SCRATCH / "root")
        self.programs_run(SCRATCH / "root/usr", SCRATCH / "run_of_the_package")


if __name__ == "__main__":
    unittest.main()
