"""Both formulations on the same geometries, to 40 % strain: rings, crops and shipped woods.

    formulations.py MPM_PAR [--quick] [--geometry NAME ...] [--formulation NAME ...]
                            [--smallest K] [--largest K] [--real DIR] [--work DIR] [--write | --beside] [--kept]
    formulations.py MPM_PAR --hinges | --anew [--geometry NAME ...] [--largest K] [--real DIR] [--work DIR] [--write]

Rings are drawn anew at every level. Of a picture the geometry is that of the coarsest level: each of its
locations becomes k x k particles at the level of k times as many cells. --real adds the micrographs of DIR, which are not shipped. --write puts what is
kept in DIR into docs/formulations, --beside lets runs stay there that are not in DIR, --kept makes no other runs; --quick runs the coarsest level of rings
and crops and writes nothing.

--hinges runs the two coarsest levels of pictures by the total Lagrangian step with every hinge, where locations
of wall meet at a corner alone, cut or filled. --anew runs all levels of pictures by it, sampled anew at each.
"""
import argparse
import struct
from pathlib import Path

import numpy

import runs
from loblolly import base_picture, bitmap, figures

PAGES = runs.PROJECT / "docs" / "formulations"
WOOD = runs.PROJECT / "inputs" / "wood"
RING = runs.PROJECT / "inputs" / "benchmarks" / "crushed_ring.yaml"
LOBLOLLY = WOOD / "loblolly_radial.yaml"
REAL = {"spruce": ("spruce_sem/spruce_ring_boundary_x4.bmp", 0.974),
        "lomatia": ("hardwood/lomatia_arborescens_621x418.bmp", 0.96)}
# As fast as the founding paper's: the work is within 2 % of that at 10 m/s, for a fifth of the time.
FAST = "loading.speed=50 m/s"
FORMULATIONS = {"updated": [runs.UPDATED], "total": ["numerics.formulation=total_lagrangian"]}
STRAINS = numpy.linspace(0, 0.4, 201)


class Geometry:
    """Of a scene at its coarsest level: `cells`, and the `size` of the specimen, m. `levels`: k of both
    formulations; `drawn`: at every level."""

    def __init__(self, scene, size, cells, levels, settings=(), drawn=False):
        self.scene, self.size, self.cells, self.settings = scene, size, cells, [*settings]
        self.drawn = drawn
        self.levels = dict(zip(FORMULATIONS, levels))

    def base(self, mpm_par, work, name):
        return self.drawn or base_picture(mpm_par, work / f"{name}.bmp", self.scene, self.size, self.cells,
                            self.settings)

    def location_area(self, k):
        return self.size[0] / (2 * k * self.cells[0]) * self.size[1] / (2 * k * self.cells[1])  # m2

    def settings_at(self, formulation, k, picture=None):
        """With `picture` for the geometry, else the scene's own, sampled anew."""
        specimen = [word for word in self.settings if word.startswith("specimen")]
        if picture and not self.drawn:
            lengths = ", ".join(f"{1e6 * length:.8g} um" for length in self.size)
            specimen = [f"specimen={{micrograph: {picture}, image_size: [{lengths}], threshold: 128, "
                        "sampling: threshold}"]
        return [*(word for word in self.settings if not word.startswith("specimen")), *specimen,
                "loading.strain=40 %", "output.snapshots=0", "output.history_lines=600",
                f"grid.cells={[k * n for n in self.cells]}", *FORMULATIONS[formulation]]


def around(solid, row, column):
    """How many of a location and its eight neighbours are solid."""
    return solid[max(row - 1, 0):row + 2, max(column - 1, 0):column + 2].sum()


def filled(solid):
    """`solid` without pairs of locations that meet at a corner alone, and how many locations were filled for it:
    of the two empty ones there, one by one, that with more solid around it."""
    solid, count = solid.copy(), 0
    while True:
        low_left, low_right, up_left, up_right = solid[:-1, :-1], solid[:-1, 1:], solid[1:, :-1], solid[1:, 1:]
        rising = low_left & up_right & ~low_right & ~up_left
        falling = ~low_left & ~up_right & low_right & up_left
        found = numpy.argwhere(rising | falling)
        if not len(found):
            return solid, count
        row, column = found[0]
        empty = ([(row, column + 1), (row + 1, column)] if rising[row, column]
                 else [(row, column), (row + 1, column + 1)])
        solid[max(empty, key=lambda place: around(solid, *place))] = True
        count += 1


def without_hinges(picture):
    """{"cut" or "filled": (picture beside `picture`, locations that changed)}."""
    from PIL import Image
    with Image.open(picture) as image:
        solid = numpy.asarray(image)[::-1] > 127
    (void, emptied), (wall, added) = filled(~solid), filled(solid)
    found = {}
    for how, walls, changed in (("cut", ~void, emptied), ("filled", wall, added)):
        found[how] = picture.with_name(f"{picture.stem}_{how}.bmp"), changed
        found[how][0].write_bytes(bitmap(walls))
    return found


def run_hinges(mpm_par, found, work):
    """Rows of the coarsest two levels with hinges cut and filled."""
    table = runs.CurveTable(STRAINS, figures_of)
    for name, geometry in found.items():
        if geometry.drawn:
            continue
        for how, (picture, changed) in without_hinges(geometry.base(mpm_par, work, name)).items():
            for k in (1, 2):
                table.add({"geometry": name, "hinges": how, "changed": changed, "cells": k * geometry.cells[0], "k": k},
                          runs.run(mpm_par, geometry.scene, geometry.settings_at("total", k, picture), work))
    return table.rows


def run_anew(mpm_par, found, largest, work):
    """Rows of all levels of the pictures themselves."""
    table = runs.CurveTable(STRAINS, figures_of)
    for name, geometry in found.items():
        for k in [] if geometry.drawn else [k for k in geometry.levels["total"] if k <= largest]:
            table.add({"geometry": name, "cells": k * geometry.cells[0], "k": k},
                      runs.run(mpm_par, geometry.scene, geometry.settings_at("total", k), work))
    return table.rows


def crop(x):
    """90 x 70 of the 360 x 234 pixels of loblolly, in cells as small as 150 across the whole."""
    return Geometry(LOBLOLLY, [0.208e-3, 0.541e-3 * 70 / 234], [38, 29], ([1, 2, 4, 8], [1, 2, 4]),
                    [FAST, "specimen={micrograph: loblolly.bmp, image_size: [0.832 mm, 0.541 mm], "
                     f"threshold: 150, crop: [{x}, 60, 90, 70]}}"])


def wood(name, size, cells):
    return Geometry(WOOD / f"{name}.yaml", size, cells, ([1, 2, 4, 8],) * 2, [FAST])


def geometries():
    loblolly, poplar = ([0.832e-3, 0.541e-3], [75, 49]), ([0.802e-3, 0.524e-3], [75, 49])
    thin = ("specimen.shapes=[{disc: {centre: [50 um, 50 um], radius: 50 um}}, {disc: {centre: "
            "[50 um, 50 um], radius: 45 um}, material: void}]")
    return {"ring": Geometry(RING, [100e-6, 100e-6], [10, 10], ([1, 2, 4, 8, 16], [1, 2, 4, 8]),
                             drawn=True),
            "thin_ring": Geometry(RING, [100e-6, 100e-6], [10, 10], ([1, 2, 4, 8, 16], [1, 2, 4, 8]),
                                  [thin], drawn=True),
            "earlywood": crop(40), "latewood": crop(190),
            "loblolly_radial": wood("loblolly_radial", *loblolly),
            "loblolly_tangential": wood("loblolly_tangential", *loblolly),
            "poplar_radial": wood("poplar_radial", *poplar),
            "poplar_tangential": wood("poplar_tangential", *poplar),
            "ponderosa_tangential": wood("ponderosa_tangential", [1e-3, 1.29e-3], [75, 97])}


def real(folder, work):
    """Of the micrographs in `folder`, scenes as short as a user would write them, kept in `work`."""
    found = {}
    for name, (file, pixel) in REAL.items():
        picture = (folder / file).resolve()
        width, height = struct.unpack("<ii", picture.read_bytes()[18:26])
        scene = work / f"{name}.yaml"
        scene.write_text(f"specimen: {{micrograph: {picture}, pixel_size: {pixel} um, threshold: 128}}\n"
                         "loading: {piston: right, speed: 50 m/s, strain: 40 %}\n")
        found[name] = Geometry(scene, [1e-6 * pixel * width, 1e-6 * pixel * abs(height)],
                               [75, round(75 * abs(height) / width)], ([1, 2, 4, 8],) * 2)
    return found


def planned(found, formulations, smallest, largest):
    """(name, formulation, k), the cheapest first."""
    plan = [(name, formulation, k) for name, geometry in found.items() for formulation in formulations
            for k in geometry.levels[formulation] if smallest <= k <= largest]
    return sorted(plan, key=lambda one: (one[2] ** 3 * (8 if one[1] == "total" else 1)))


def figures_of(folder, strains):
    """As `figures`, with what contact did; shares of the wall at rest."""
    found, curve = figures(folder, strains)
    history = numpy.genfromtxt(folder / "history.csv", delimiter=",", names=True)
    beyond = history["strain_1"] > 0.005
    found["largest_energy_error"] = float(f"{abs(history['energy_error_1'][beyond]).max():.3g}")
    if "overlapped_area_m2" in history.dtype.names:
        found["overlapped_area"] = float(f"{history['overlapped_area_m2'].max():.4g}")
        found["contact_pairs"] = int(history["contact_pairs_1"].max())
    return found, curve


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    kinds = arguments.add_mutually_exclusive_group()
    for kind in ("--quick", "--hinges", "--anew"):
        kinds.add_argument(kind, action="store_true")
    arguments.add_argument("--geometry", nargs="+")
    arguments.add_argument("--formulation", nargs="+", choices=FORMULATIONS, default=[*FORMULATIONS])
    arguments.add_argument("--smallest", type=int, default=1)
    arguments.add_argument("--largest", type=int, default=16)
    arguments.add_argument("--real", type=Path)
    arguments.add_argument("--work", type=Path, default=runs.PROJECT / "results" / "formulations")
    arguments.add_argument("--write", action="store_true")
    arguments.add_argument("--beside", action="store_true")
    arguments.add_argument("--kept", action="store_true")
    given = arguments.parse_args()
    given.work.mkdir(parents=True, exist_ok=True)
    found = geometries()
    if given.real:
        found |= real(given.real, given.work)
    if given.geometry:
        found = {name: found[name] for name in given.geometry}
    elif given.quick:
        found = {name: found[name] for name in ("ring", "thin_ring", "earlywood", "latewood")}
    if given.hinges or given.anew:
        name, rows = (("hinges", run_hinges(given.mpm_par, found, given.work)) if given.hinges else
                      ("anew", run_anew(given.mpm_par, found, given.largest, given.work)))
        if given.write:
            runs.write_rows(f"{name}.csv", rows, PAGES)
        return
    pictures = {name: geometry.base(given.mpm_par, given.work, name)
                for name, geometry in found.items()}
    table = runs.CurveTable(STRAINS, figures_of)
    for name, formulation, k in planned(found, given.formulation, given.smallest, 1 if given.quick else given.largest):
        geometry = found[name]
        settings = geometry.settings_at(formulation, k, pictures[name])
        if given.kept and not runs.kept_cost(given.mpm_par, geometry.scene, settings, given.work):
            continue
        table.add({"geometry": name, "method": formulation, "cells": k * geometry.cells[0], "k": k,
                   "location_area": float(f"{geometry.location_area(k):.8g}")},
                  runs.run(given.mpm_par, geometry.scene, settings, given.work))
    if given.quick:
        return
    if given.write:
        table.write("ladders", PAGES)
    elif given.beside:
        table.write_beside("ladders", PAGES)


if __name__ == "__main__":
    main()
