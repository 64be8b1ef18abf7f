"""Holds the direction of includes between folders, the walls around libraries, and portable paths.
Usage: include_direction_test.py PROJECT_DIRECTORY. A new dependency is one word in a table here."""
import re
import sys
from pathlib import Path

PHYSICS = "core shape particles grid materials transfer conditions"
MAY_INCLUDE = {folder: set(others.split()) | {folder} for folder, others in {
    "core": "", "shape": "core", "particles": "core", "grid": "core",
    "materials": "core particles", "transfer": "core shape particles grid materials",
    "conditions": "core particles grid materials transfer", "parallel": PHYSICS, "scene": PHYSICS,
    "micrograph": "core scene", "output": "core scene parallel", "analysis": "core output",
    "stepping": PHYSICS + " parallel",
    "lagrangian": PHYSICS + " parallel stepping",
    "simulation": PHYSICS + " parallel stepping lagrangian scene micrograph output analysis",
    "main.cpp": PHYSICS + " parallel stepping lagrangian scene micrograph output analysis simulation"}.items()}
MPI, TOOLS = "parallel/ output/", "scene/ micrograph/draw_wood analysis/mpm_curve main.cpp"
WALLS = {r"petsc\w*\.h": "parallel/", r"mpi\.h": MPI, r"metis\.h": "parallel/",
         r"(hdf5|H5\w+)\.h": "output/hdf5_", r"yaml-cpp/.*": "scene/ micrograph/anatomy",
         r"CLI/.*": TOOLS, r"udunits2\.h": "core/units", r"muParser\.h": "core/formula", r"stb_\w+\.h|tiff\w*\.h": "micrograph/",
         r"pugixml\.hpp": "output/", r"nlohmann/.*": "output/ analysis/ scene/"}
FREE_IN_PHYSICS = r"Eigen/\w+|experimental/simd|\w+"  # \w+: the standard library
OF_A_MACHINE = re.compile(r"(?<![\w.}/])/(work|root|home|tmp|Users)/\w")


def problems(root):
    sources = [p for top in ("include/mpm", "src") for p in root.glob(top + "/**/*.[ch]pp")]
    for path in sources or [root / "src"]:
        place = re.sub(r"^(include/mpm|src)/", "", path.relative_to(root).as_posix())
        folder = place.split("/")[0]
        if folder not in MAY_INCLUDE:
            yield f"{path}:1: folder '{folder}' has no row in the table of folders"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            name = (re.match(r'\s*#\s*include\s*[<"]([^>"]+)', line) or [0, ""])[1]
            own, walls = name.startswith("mpm/"), [w for w in WALLS if re.fullmatch(w, name)]
            if "../" in name or own and name.split("/")[1] not in MAY_INCLUDE[folder]:
                yield f"{path}:{number}: {folder} may not include {name}"
            elif any(not place.startswith(tuple(WALLS[w].split())) for w in walls):
                yield f"{path}:{number}: {name} belongs in {WALLS[walls[0]]} only"
            elif (folder in PHYSICS.split()[1:] and "<" in line and name and not own
                  and not re.fullmatch(FREE_IN_PHYSICS, name)):
                yield f"{path}:{number}: physics sees Eigen and the standard library, not {name}"
    for top in "CMakeLists.txt README.md cmake src include tests inputs jobscripts packaging docs .ci".split():
        for path in filter(Path.is_file, [root / top, *(root / top).rglob("*")]):
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                if path.suffix not in (".bmp", ".png", ".pyc") and OF_A_MACHINE.search(line):
                    yield f"{path}:{number}: path of one machine: {line.strip()}"


if __name__ == "__main__":
    found = list(problems(Path(sys.argv[1])))
    sys.exit("\n".join(found) if found else 0)
