"""Builds the code that docs/contributing.md shows, and runs the tests that all of a kind share.
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
mpm_type_list(transfer/orders.list OrderTypes transfer/order_types.hpp orders)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
file(GLOB kinds src/materials/*.cpp src/conditions/*.cpp src/grid/*.cpp)
add_library(shown ${kinds} src/shape/shapes.cpp src/core/bound.cpp src/core/error.cpp
            src/core/formula.cpp src/core/lane_vector.cpp src/particles/particle_store.cpp
            src/transfer/schemes.cpp)
target_include_directories(shown PUBLIC include ${MPM_GENERATED})
target_link_libraries(shown PUBLIC Eigen3::Eigen fmt::fmt PkgConfig::MUPARSER mpm_flags)
file(GLOB law_tests tests/unit/materials/ciarlet_test.cpp
     tests/unit/materials/law_contract_test.cpp tests/unit/materials/law_list_test.cpp)
add_executable(laws_test ${law_tests})
add_executable(shapes_test tests/unit/shape/shape_contract_test.cpp)
set(MPM_SHAPE_KEYWORD narrow_gimp)
set(MPM_SHAPE_TYPE NarrowGimp)
configure_file(src/transfer/shape_transfer.cpp.in ${MPM_GENERATED}/narrow_gimp_transfer.cpp @ONLY)
file(GLOB transfer_tests tests/unit/transfer/*_test.cpp)
add_executable(passes_test ${transfer_tests} ${MPM_GENERATED}/narrow_gimp_transfer.cpp
               src/transfer/make_transfer.cpp)
target_include_directories(passes_test PRIVATE src/transfer)
add_executable(conditions_test tests/unit/conditions/quadratic_drag_test.cpp
               tests/unit/conditions/glued_side_test.cpp)
foreach(test laws_test shapes_test passes_test conditions_test)
  target_include_directories(${test} PRIVATE tests/support)
  target_link_libraries(${test} PRIVATE shown GTest::gmock_main)
endforeach()
"""
# What has to run, and be right, of each.
EXPECTED = {"laws_test": ("*", ["ciarlet_space", "Ciarlet.SimpleShear"]),
            "shapes_test": ("*", ["ShapeContract/2.WeightsSumToOne"]),
            "passes_test": ("*narrow_gimp*", ["narrow_gimp_aflip"]),
            "conditions_test": ("*", ["QuadraticDrag.SlowsAlong", "GluedSide.HoldsAll"])}
# The other lines of these lists are left out: what they name is built and tested everywhere else.
SHORTENED = ("include/mpm/shape/shapes.list", "include/mpm/transfer/schemes.list")


def place_blocks(page, tree):
    blocks = re.findall(r"```cpp\n// (at the end of )?(\S+)\n(.*?)```", page, re.S)
    for at_the_end, path, code in blocks:
        file = tree / path
        if at_the_end:
            file.write_text(code if path in SHORTENED else file.read_text() + code)
        elif file.exists():
            sys.exit(f"{path} is there already: the page shows how to add what is not")
        else:
            file.write_text(code)
    return [path for _, path, _ in blocks]


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout[-5000:]}{done.stderr[-5000:]}")
    return done.stdout


def main(project, cmake, compiler):
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder, "tree")
        for part in ("include", "src", "cmake", "tests/unit", "tests/support"):
            shutil.copytree(Path(project, part), tree / part)
        placed = place_blocks(Path(project, "docs/contributing.md").read_text(), tree)
        if len(placed) < 13:
            sys.exit(f"only {len(placed)} blocks of code found in docs/contributing.md")
        (tree / "CMakeLists.txt").write_text(PROJECT)
        build = Path(folder, "build")
        run(cmake, "-S", tree, "-B", build, f"-DCMAKE_CXX_COMPILER={compiler}",
            "-DCMAKE_BUILD_TYPE=Developer", "-DCMAKE_CXX_FLAGS_DEVELOPER=-O1 -Werror")
        run(cmake, "--build", build, "--parallel", "2")
        for test, (selection, names) in EXPECTED.items():
            output = run(build / test, f"--gtest_filter={selection}")
            for name in names:
                if name not in output:
                    sys.exit(f"{test} did not run {name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
