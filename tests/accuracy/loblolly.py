"""The ladder of Nairn (2006, Wood Fiber Sci. 38(4), Fig. 3) on the loblolly model, to 40 % strain.

    loblolly.py MPM_PAR [--quick] [--method "SHAPE SCHEME" ...] [--largest N]
                        [--work DIR] [--write] [--kept]

Twice: with the picture as it is, sampled anew at every level, and with the geometry of the coarsest
level, each location of which becomes k x k particles at the level of k times as many cells. --write
puts what is kept in DIR into docs/accuracy, --kept makes no other runs; --quick runs the four coarsest
levels of the picture and the two coarsest of the fixed geometry with one method and writes nothing.
"""
import argparse
import json
import struct
from pathlib import Path

import numpy

import runs
import results

SCENE = runs.PROJECT / "inputs" / "wood" / "loblolly_radial.yaml"
# 150, 200, 250, 300 and 360 particles across are the paper's.
PICTURE = [[75, 49], [100, 65], [125, 81], [150, 97], [180, 117], [240, 156],
           [300, 195], [360, 234], [480, 312], [600, 390]]
BASE = [75, 49]
SIZE = [0.832e-3, 0.541e-3]  # m, image_size of the scene
FIXED = [1, 2, 3, 4]
LARGEST = {"gimp flip": 600, "quadratic flip": 300, "cubic flip": 225}  # cells across
METHODS = list(LARGEST)
# On the picture only.
VARIANTS = {method: 150 for method in (
    "gimp apic", "gimp xpic", "cpdi flip", "gimp flip domain=0.5", "gimp flip particles_per_cell=3",
    "gimp flip update_order=musl_displacement")}
SHARED = ["loading.strain=40 %"]
STRAINS = numpy.linspace(0, 0.4, 101)
PLATEAU = (0.05, 0.15)


def bitmap(solid):
    """An 8-bit BMP; solid[row from below][column] says where cell wall is. Rows begin below, as in
    the format, and are padded to four bytes."""
    height, width = solid.shape
    padded = -(-width // 4) * 4
    gray = numpy.zeros((height, padded), numpy.uint8)
    gray[:, :width] = numpy.where(solid, 255, 0)
    start = 14 + 40 + 1024
    palette = b"".join(bytes((k, k, k, 0)) for k in range(256))
    return (struct.pack("<2sIHHI", b"BM", start + gray.size, 0, 0, start)
            + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 8, 0, gray.size, 0, 0, 256, 0)
            + palette + gray.tobytes())


def locations(folder, size, cells):
    """Which of 2 x 2 locations per cell hold a particle in the first snapshot; `size` in m."""
    import h5py
    with h5py.File(sorted(Path(folder, "snapshots").glob("*.h5"))[0]) as file:
        place = file["particles/position"][:, :2]
    index = numpy.floor(place / numpy.array(size) * 2 * numpy.array(cells)).astype(int)
    solid = numpy.zeros((2 * cells[1], 2 * cells[0]), bool)
    solid[index[:, 1], index[:, 0]] = True
    if solid.sum() != len(place):
        raise RuntimeError(f"{folder}: {len(place)} particles lie in {solid.sum()} locations")
    return solid


def base_picture(mpm_par, picture, scene, size, cells, settings=()):
    """The geometry of a scene at these cells, as a picture with one pixel a location."""
    folder, _ = runs.run(mpm_par, scene, [*settings, runs.UPDATED, f"grid.cells={cells}",
                                          "loading.strain=0.1 %",
                                          "output.snapshots={strains: [0 %]}"], picture.parent)
    picture.write_bytes(bitmap(locations(folder, size, cells)))
    return picture


def settings_of(geometry, method, cells, picture):
    found = [*SHARED, "output.snapshots=0", f"grid.cells={cells}", *runs.method_settings(method)]
    if geometry == "fixed":
        found += [f"specimen.micrograph={picture}", "specimen.threshold=128",
                  "specimen.sampling=threshold"]
    return found


def figures(folder, strains):
    """The figures of a run, and its stress at these strains."""
    summary = json.loads((folder / "summary.json").read_text())
    found = {"relative_density": round(summary["relative_density"], 6)}
    for name, path in (("modulus", "compression.modulus"),
                       ("densification_strain", "compression.densification.strain"),
                       ("densification_stress", "compression.densification.stress")):
        try:
            found[name] = float(f"{results.figure(summary, path):.6g}")
        except results.Missing:
            found[name] = ""
    fine = results.curve(folder / "history.csv", "stress", strains[0], strains[-1])
    curve = numpy.interp(strains, numpy.linspace(strains[0], strains[-1], len(fine)), fine)
    found["plateau_stress"] = float(
        f"{results.mean(folder / 'history.csv', 'stress', *PLATEAU):.6g}")
    found["work"] = float(f"{fine.mean() * strains[-1]:.6g}")  # J/m3
    return found, curve


def planned(methods, largest):
    """(geometry, method, cells), the cheapest first."""
    found = [("picture", method, cells) for method in methods for cells in PICTURE]
    found += [("fixed", method, [k * n for n in BASE])
              for method in methods if method not in VARIANTS for k in FIXED]
    reach = LARGEST | VARIANTS
    found = [one for one in found if one[2][0] <= min(largest, reach.get(one[1], largest))]
    return sorted(found, key=lambda one: one[2][0])


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--quick", action="store_true")
    arguments.add_argument("--method", nargs="+", default=[*METHODS, *VARIANTS])
    arguments.add_argument("--largest", type=int, default=PICTURE[-1][0],
                           help="cells across")
    arguments.add_argument("--work", type=Path, default=runs.PROJECT / "results" / "accuracy")
    arguments.add_argument("--write", action="store_true")
    arguments.add_argument("--kept", action="store_true")
    given = arguments.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    plan = planned(given.method, given.largest)
    if given.quick:
        plan = planned(METHODS[:1], 150)
    picture = base_picture(given.mpm_par, given.work / "base.bmp", SCENE, SIZE, BASE)
    table = runs.CurveTable(STRAINS, figures)
    for geometry, method, cells in plan:
        settings = settings_of(geometry, method, cells, picture)
        if given.kept and not runs.kept_cost(given.mpm_par, SCENE, settings, given.work):
            continue
        table.add({"geometry": geometry, "method": method, "cells": cells[0],
                   "cells_high": cells[1]}, runs.run(given.mpm_par, SCENE, settings, given.work))
    if given.write and not given.quick:
        table.write("loblolly")


if __name__ == "__main__":
    main()
