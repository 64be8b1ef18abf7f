"""By what a specimen bears its load, of snapshots with the Cauchy stress."""
import subprocess
import tempfile
from pathlib import Path

import numpy
from PIL import Image, ImageFilter

import runs  # which makes the project's modules known

from mpm_par.report import study_facts

DRAW_WOOD = runs.PROJECT / "build" / "draw_wood"
WOODS = runs.PROJECT / "inputs" / "wood"
SOLID_RAYS = {"poplar.bmp": "poplar_filled_rays.anatomy.yaml"}  # the same wood but for its rays
WALL_PIXELS = 2  # of a ray cell's wall, 2.2 um, on pixels of 1.6 um
LONG = 50e-6  # m, three fibres


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


def long_paths(place, load):
    """Share of the load that is borne in unbroken rows of more than LONG along the load, each location of which
    bears more than the mean; place (N, 2) across and along the load, m."""
    spacing = numpy.diff(numpy.unique(place[:, 1].round(9))).min()
    across, along = (place / spacing).astype(int).T
    lines = numpy.zeros((across.max() + 1, along.max() + 3))  # with an end that bears nothing on both sides
    lines[across, along + 1] = load
    bears = (lines > load.mean()).astype(int)
    total = 0.0
    for line, first_and_behind in zip(lines, numpy.diff(bears)):
        for first, behind in zip(numpy.flatnonzero(first_and_behind == 1), numpy.flatnonzero(first_and_behind == -1)):
            if (behind - first) * spacing > LONG:
                total += line[first + 1:behind + 1].sum()
    return total / load.sum()


def load_path_rows(study, runs_of_it):
    """(titles, rows): at each snapshot's strain how much of the load, the sum of the axial stress over
    particles, is borne by the rays, and in long paths. Paths and rays are those of the undeformed specimen."""
    rows = []
    for entry, run in runs_of_it:
        picture = Path(run.scene.get("specimen", {}).get("micrograph", "")).name
        if picture not in SOLID_RAYS or not run.snapshots or "stress" not in run.snapshots[0]:
            continue
        first = in_order(run.snapshots[0], "position")[:, :2]
        mask = rays(picture, run.summary["threshold"])
        right, up = (first / run.summary["size"] * mask.shape[::-1]).astype(int).T
        ray = mask[mask.shape[0] - 1 - up, right]
        shares = {"rays": [], f"paths of more than {1e6 * LONG:.0f} um": []}
        for snapshot in run.snapshots[1:]:
            load = -in_order(snapshot, "stress")[:, run.axis]
            place = first[:, [1 - run.axis, run.axis]]
            for found, part in zip(shares.values(), (load[ray].sum() / load.sum(), long_paths(place, load))):
                found.append(f"{100 * part:.3g} at {100 * snapshot.strain:.3g} %")
        for what, wall in zip(shares, (f"{100 * ray.mean():.3g}", "-")):
            rows.append([study_facts.name_of(study, entry), what, wall, ", ".join(shares[what])])
    return ["run", "part", "share of the cell wall (%)", "share of the load (%), at strain"], rows
