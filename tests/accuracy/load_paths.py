"""By what a specimen bears its load, of snapshots with the Cauchy stress."""
import subprocess
import tempfile
from pathlib import Path

import numpy
from PIL import Image, ImageFilter

import runs  # which makes the project's modules known

from mpm_par.report import study_facts
from mpm_par.windows import windows_of_scene

DRAW_WOOD = runs.PROJECT / "build" / "draw_wood"
WOODS = runs.PROJECT / "inputs" / "wood"
SOLID_RAYS = {"poplar.bmp": "poplar_filled_rays.anatomy.yaml"}  # the same wood but for its rays
WALL_PIXELS = 2  # of a ray cell's wall, 2.2 um, on pixels of 1.6 um
LONG = {"poplar.bmp": 50e-6, "loblolly.bmp": 100e-6}  # m, three fibres or cells


def rays(picture, threshold):
    """Pixels (rows from the top) of the rays of a drawn picture, lumens with their walls: where the same wood
    with solid rays is wall and this is not, and what is next to it."""
    with tempfile.TemporaryDirectory() as place:
        drawn = Path(place) / "solid.bmp"
        subprocess.run([DRAW_WOOD, WOODS / SOLID_RAYS[picture], "-o", drawn], check=True, stdout=subprocess.DEVNULL)
        solid = numpy.asarray(Image.open(drawn).convert("L"))
    lumens = (solid >= threshold) & (numpy.asarray(Image.open(WOODS / picture).convert("L")) < threshold)
    with_walls = Image.fromarray(255 * lumens.astype(numpy.uint8)).filter(ImageFilter.MaxFilter(2 * WALL_PIXELS + 1))
    return numpy.asarray(with_walls) > 0


def in_order(snapshot, field):
    """Of all particles, in the same order at all times: that of their id, or without one that of the file, which
    cells of the total Lagrangian step keep."""
    return snapshot[field][numpy.argsort(snapshot["id"])] if "id" in snapshot else snapshot[field]


def long_paths(place, load, longest):
    """Share of the load that is borne in unbroken rows longer than `longest` along the load, each location of
    which bears more than the mean; place (N, 2) across and along the load, m."""
    spacings = [numpy.diff(numpy.unique(coordinates.round(9))).min() for coordinates in place.T]
    across, along = numpy.rint((place - place.min(axis=0)) / spacings).astype(int).T
    lines = numpy.zeros((across.max() + 1, along.max() + 3))  # with an end that bears nothing on both sides
    lines[across, along + 1] = load
    bears = (lines > load.mean()).astype(int)
    total = 0.0
    for line, first_and_behind in zip(lines, numpy.diff(bears)):
        for first, behind in zip(numpy.flatnonzero(first_and_behind == 1), numpy.flatnonzero(first_and_behind == -1)):
            if (behind - first) * spacings[1] > longest:
                total += line[first + 1:behind + 1].sum()
    return total / load.sum()


def load_path_rows(study, runs_of_it):
    """(titles, rows): at each snapshot's strain how much of the load, the sum of the axial stress over
    particles, is borne by the rays, where they are known, and in long paths; of windows that the scene names how
    much of their load is. Paths, rays and windows are those of the undeformed specimen."""
    rows = []
    for entry, run in runs_of_it:
        picture = Path(run.scene.get("specimen", {}).get("micrograph", "")).name
        if picture not in LONG or not run.snapshots or "stress" not in run.snapshots[0]:
            continue
        first = in_order(run.snapshots[0], "position")
        place = first[:, [1 - run.axis, run.axis]]
        loads = [(snapshot.strain, -in_order(snapshot, "stress")[:, run.axis]) for snapshot in run.snapshots[1:]]
        parts = []  # name, which particles, and their share of each load
        if picture in SOLID_RAYS:
            mask = rays(picture, run.summary["threshold"])
            right, up = (first[:, :2] / run.summary["size"] * mask.shape[::-1]).astype(int).T
            ray = mask[mask.shape[0] - 1 - up, right]
            parts.append(("rays", ray, [load[ray].sum() / load.sum() for _, load in loads]))
        whole = [("", numpy.ones(len(first), bool))]
        for window, inside in [(f"{one.name}, ", one.holds(first)) for one in windows_of_scene(run)] or whole:
            parts.append((f"{window}paths of more than {1e6 * LONG[picture]:.0f} um", inside,
                          [long_paths(place[inside], load[inside], LONG[picture]) for _, load in loads]))
        for name, inside, shares in parts:
            found = [f"{100 * share:.3g} at {100 * strain:.3g} %" for share, (strain, _) in zip(shares, loads)]
            wall = "-" if inside.all() else f"{100 * inside.mean():.3g}"
            rows.append([study_facts.name_of(study, entry), name, wall, ", ".join(found)])
    return ["run", "part", "share of the cell wall (%)", "share of the load (%), at strain"], rows
