"""Recipes for packagers whose tools are not here name what the build needs, and no more."""
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.append(str(ROOT / "src" / "python"))
from mpm_par.report.__main__ import PACKAGES  # noqa: E402

RECIPE = ROOT / "packaging/spack/packages/mpm-par/package.py"
DEFINITION = ROOT / "packaging/apptainer/mpm_par.def"
TOP = (ROOT / "CMakeLists.txt").read_text()
TYPES = (ROOT / "cmake/build_types.cmake").read_text()
STUDY = (ROOT / "src/study/CMakeLists.txt").read_text()
REPORT = (ROOT / "src/python/CMakeLists.txt").read_text()
# What CMake asks for, by Spack's name; pkg-config and Python are tools, threads the compiler's.
IN_SPACK = {"MPI": "mpi", "PETSc": "petsc", "HDF5": "hdf5", "metis.h": "metis", "Eigen3": "eigen",
            "yaml-cpp": "yaml-cpp", "CLI11": "cli11", "fmt": "fmt", "spdlog": "spdlog",
            "udunits": "udunits", "muparser": "muparser", "TIFF": "libtiff",
            "stb_image.h": "stb", "ZLIB": "zlib-api",
            "pugixml": "pugixml", "nlohmann_json": "nlohmann-json", "PkgConfig": "pkgconfig",
            "Threads": "cxx"}
# What the report imports, by Spack's name where that is not the module's own.
MODULES_IN_SPACK = {"PIL": "py-pillow", "yaml": "py-pyyaml"}


class Recorded:
    """The words of a recipe, of which only names are kept."""

    def __init__(self):
        self.needs, self.versions, self.variants = {}, [], {}

    def words(self):
        class Nothing:
            def __enter__(self):
                return self

            def __exit__(self, *_):
                return False

        def depends_on(spec, type=("build", "link")):
            self.needs[re.match(r"[\w-]+", spec)[0]] = spec

        return {"CMakePackage": object, "version": self.versions.append, "depends_on": depends_on,
                "variant": lambda name, **more: self.variants.update({name: more}),
                "when": lambda _: Nothing(), "license": lambda *_: None,
                "conflicts": lambda *_, **__: None}


def asked_for():
    """Names in the build's list of dependencies, with the least version where there is one."""
    text = (ROOT / "cmake/dependencies.cmake").read_text()
    found = dict(re.findall(r"find_package\((\w[\w-]*)(?: ([\d.]+))?", text))
    for name, version in re.findall(r"pkg_check_modules\(.* (\w+)(?:>=([\d.]+))?\)", text):
        found[name] = version
    found.update({name: "" for name in re.findall(r"find_path\(\w+ (\S+)", text)})
    return found


class Recipes(unittest.TestCase):
    def recipe(self):
        recorded = Recorded()
        text = RECIPE.read_text().replace("from spack.package import *", "")
        exec(compile(text, RECIPE, "exec"), recorded.words())
        return recorded

    def test_spack_has_every_dependency_of_the_build_and_its_least_version(self):
        needs, asked = self.recipe().needs, asked_for()
        self.assertEqual(set(asked), set(IN_SPACK), "a dependency is new, or gone")
        for name, version in asked.items():
            self.assertIn(IN_SPACK[name], needs)
            if version and name != "MPI":
                self.assertIn(f"@{version}:", needs[IN_SPACK[name]])
        others = set(needs) - set(IN_SPACK.values())
        imported = {MODULES_IN_SPACK.get(module, f"py-{module}") for module in PACKAGES}
        self.assertEqual(others, {"c", "cmake", "python"} | imported)
        minimum = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)", TOP)
        self.assertIn(f"@{minimum[1]}:", needs["cmake"])

    def test_spack_builds_this_version_with_options_that_there_are(self):
        recipe = self.recipe()
        version = re.search(r"project\(mpm_par VERSION ([\d.]+)", TOP)[1]
        self.assertEqual(recipe.versions, [version])
        vectors = re.search(r"STRINGS (native[\w ]*)\)", TYPES)[1]
        self.assertEqual(sorted(recipe.variants["vector"]["values"]), sorted(vectors.split()))
        listed = TOP + TYPES + STUDY + REPORT
        for text in RECIPE, DEFINITION:
            for option in re.findall(r"\bMPM_\w+", text.read_text()):
                self.assertIn(option, listed)

    def test_apptainer_takes_the_packages_of_the_install_script(self):
        text = re.sub(r"\\\n", " ", DEFINITION.read_text())
        script = ROOT / "jobscripts/install_packages.sh"
        listed = set(subprocess.run(["sh", script, "--list"], check=True, capture_output=True,
                                    text=True).stdout.split())
        self.assertIn("sh jobscripts/install_packages.sh --without-pictures\n", text)
        installed = [word for line in re.findall(r"apt-get install (.*)", text)
                     for word in shlex.split(line) if not word.startswith(("-", "/"))]
        self.assertEqual(set(installed), set(PACKAGES.values()))
        self.assertLessEqual(set(installed), listed)
        [files] = re.findall(r"%files\n +(.*)\n", text)
        *sources, target = files.split()
        for name in sources:
            self.assertTrue((ROOT / name).exists(), name)
        self.assertIn(f"cd {target.rstrip('/')}\n", text)

    def test_shell_of_apptainer_is_well_formed(self):
        text = DEFINITION.read_text()
        for section in re.findall(r"^%(?:post|test|runscript|environment)\n((?:    .*\n)+)", text,
                                  re.M):
            subprocess.run(["sh", "-n"], input=section, check=True, text=True)
        stages = re.findall("^Bootstrap: docker\nFrom: debian:12\nStage: (.*)\n", text, re.M)
        self.assertEqual(stages, ["build", "final"])

    def test_what_a_study_imports_is_among_what_the_report_does(self):
        def looked_for(text):
            return set(re.search(r'mpm_find_python\(\w+ "([^"]+)"', text)[1].split(", "))

        self.assertEqual(looked_for(REPORT), set(PACKAGES))
        self.assertLessEqual(looked_for(STUDY), set(PACKAGES))


if __name__ == "__main__":
    unittest.main()
