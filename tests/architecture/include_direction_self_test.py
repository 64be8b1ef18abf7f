"""The include test on made-up trees: it accepts a good one and names every fault of a bad one."""
import tempfile
import unittest
from pathlib import Path

from include_direction_test import problems


class IncludeDirection(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text + "\n")
            return [line.replace(folder + "/", "") for line in problems(Path(folder))]

    def test_includes_that_follow_the_direction_pass(self):
        self.assertEqual([], self.found({
            "include/mpm/materials/law.hpp": "#include <mpm/core/types.hpp>\n#include <Eigen/Core>",
            "src/materials/law.cpp": '#include <cmath>\n#include "catalogue.hpp"',
            "src/parallel/halo.cpp": "#include <petscsf.h>\n#include <mpm/grid/box.hpp>",
            "src/output/hdf5_file.cpp": "#include <hdf5.h>\n#include <mpi.h>",
            "src/main.cpp": "#include <mpm/simulation/simulation.hpp>"}))

    def test_every_forbidden_include_is_named_with_its_place(self):
        for file, include, reason in (
                ("src/core/error.cpp", "<mpm/grid/box.hpp>", "core may not include"),
                ("src/particles/store.cpp", "<mpm/grid/box.hpp>", "particles may not include"),
                ("src/materials/law.cpp", "<mpm/parallel/halo.hpp>", "materials may not include"),
                ("src/output/xdmf.cpp", "<mpm/simulation/clock.hpp>", "output may not include"),
                ("src/grid/box.cpp", '"../core/secret.hpp"', "grid may not include"),
                ("src/simulation/step.cpp", "<petsc.h>", "belongs in parallel/"),
                ("src/main.cpp", "<petscsys.h>", "belongs in parallel/"),
                ("src/scene/reader.cpp", "<mpi.h>", "belongs in parallel/ output/"),
                ("src/output/xdmf.cpp", "<hdf5.h>", "belongs in output/hdf5_"),
                ("src/scene/value.cpp", "<muParser.h>", "belongs in core/formula"),
                ("src/micrograph/image.cpp", "<yaml-cpp/yaml.h>", "belongs in scene/"),
                ("src/transfer/scatter.cpp", "<fmt/format.h>", "physics sees Eigen"),
                ("src/odds/ends.cpp", "<vector>", "no row")):
            with self.subTest(file=file, include=include):
                lines = self.found({file: f"// first line\n#include {include}"})
                self.assertEqual(1, len(lines), lines)
                self.assertIn(reason, lines[0])
                self.assertTrue(lines[0].startswith(file + (":1:" if "odds" in file else ":2:")))

    def test_a_path_of_one_machine_is_found_in_any_text_file(self):
        home = "/" + "home/somebody/scene.yaml"   # in two pieces: this file is looked through too
        self.assertEqual([f"docs/page.md:1: path of one machine: see {home}"],
                         self.found({"src/core/a.cpp": "", "docs/page.md": f"see {home}"}))

    def test_a_tree_without_sources_is_a_mistake_in_the_call(self):
        self.assertEqual(1, len(self.found({"docs/page.md": "nothing"})))


if __name__ == "__main__":
    unittest.main()
