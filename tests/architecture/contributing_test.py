"""Builds the code that docs/contributing.md shows, and runs the contract tests over it.
Usage: contributing_test.py PROJECT_DIRECTORY CMAKE COMPILER. In a copy of the physics every block is
put where its first line says: `// PATH` is a file of its own, `// at the end of PATH` lines of one."""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = """cmake_minimum_required(VERSION 3.22)
project(shown LANGUAGES CXX)
list(APPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)
include(build_types)
include(type_list)
find_package(Eigen3 REQUIRED)
find_package(fmt REQUIRED)
find_package(GTest REQUIRED)
mpm_type_list(shape/shapes.list ShapeTypes shape/shape_types.hpp shapes)
mpm_type_list(transfer/schemes.list SchemeTypes transfer/scheme_types.hpp schemes)
file(GLOB laws src/materials/*.cpp)
add_library(shown ${laws} src/shape/shapes.cpp src/core/bound.cpp src/core/error.cpp
            src/core/lane_vector.cpp src/particles/particle_store.cpp src/transfer/schemes.cpp)
target_include_directories(shown PUBLIC include ${MPM_GENERATED})
target_link_libraries(shown PUBLIC Eigen3::Eigen fmt::fmt mpm_flags)
file(GLOB law_tests tests/unit/materials/neo_hookean_test.cpp
     tests/unit/materials/law_contract_test.cpp tests/unit/materials/law_list_test.cpp)
add_executable(laws_test ${law_tests})
add_executable(shapes_test tests/unit/shape/shape_contract_test.cpp)
add_executable(pair_test pair_test.cpp src/grid/node_grid.cpp)
foreach(test laws_test shapes_test pair_test)
  target_link_libraries(${test} PRIVATE shown GTest::gmock_main)
endforeach()
"""
# One pass of the new pair of shape function and scheme, which every pass of the list is made of.
PAIR = """#include <mpm/shape/cubic.hpp>
#include <mpm/transfer/aflip.hpp>
#include <mpm/transfer/kernel_transfer.hpp>
#include <gmock/gmock.h>

TEST(Pair, IsCompiledAndHasTheColumnsOfItsRow)
{
  const mpm::KernelTransfer<2, mpm::Cubic, mpm::Aflip> transfer(mpm::Cubic::make(2));
  EXPECT_EQ(transfer.support(), 4);
  EXPECT_EQ(transfer.motion_columns(false).back().name, "affine_velocity");
  EXPECT_EQ(mpm::OneOf<mpm::ShapeRow>("cubic")->words, "cubic B-spline");
  EXPECT_EQ(mpm::OneOf<mpm::SchemeRow>("aflip")->book, mpm::ReactionBook::increments);
}
"""
EXPECTED = {"laws_test": ["neo_hookean_space", "NeoHookean.SimpleShear"], "shapes_test": [],
            "pair_test": ["Pair.IsCompiled"]}


def place_blocks(page, tree):
    blocks = re.findall(r"```cpp\n// (at the end of )?(\S+)\n(.*?)```", page, re.S)
    for at_the_end, path, code in blocks:
        file = tree / path
        if at_the_end:
            file.write_text(file.read_text() + code)
        elif file.exists():
            sys.exit(f"{path} is there already: the page shows how to add what is not")
        else:
            file.write_text(code)
    return [path for _, path, _ in blocks]


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def main(project, cmake, compiler):
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder, "tree")
        for part in ("include", "src", "cmake", "tests/unit"):
            shutil.copytree(Path(project, part), tree / part)
        placed = place_blocks(Path(project, "docs/contributing.md").read_text(), tree)
        if len(placed) < 7:
            sys.exit(f"only {len(placed)} blocks of code found in docs/contributing.md")
        (tree / "CMakeLists.txt").write_text(PROJECT)
        (tree / "pair_test.cpp").write_text(PAIR)
        build = Path(folder, "build")
        run(cmake, "-S", tree, "-B", build, f"-DCMAKE_CXX_COMPILER={compiler}",
            "-DCMAKE_BUILD_TYPE=Developer", "-DCMAKE_CXX_FLAGS_DEVELOPER=-O1 -Werror")
        run(cmake, "--build", build)
        for test, names in EXPECTED.items():
            output = run(build / test)
            for name in names:
                if name not in output:
                    sys.exit(f"{test} did not run {name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
