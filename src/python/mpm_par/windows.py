"""Parts of the specimen, and what is done in them."""
import dataclasses

import numpy

from mpm_par.problems import ResultsError


@dataclasses.dataclass(frozen=True)
class Window:
    """A box of the specimen as it is in the first snapshot. `lower`, `upper`: corners, m; the third
    component counts in space only."""
    name: str
    lower: tuple
    upper: tuple

    def holds(self, position):
        """Which of these places, shape (N, 3), lie in it: shape (N,), bool."""
        along = range(len(self.lower))
        inside = [(position[:, d] >= self.lower[d]) & (position[:, d] < self.upper[d])
                  for d in along]
        return numpy.logical_and.reduce(inside)


def windows_of_scene(run):
    """The windows that the scene names, as parts of the specimen; none without a summary, which
    holds the specimen's size."""
    size = (run.summary or {}).get("size")
    if not size:
        return []
    found = []
    for window in run.scene.get("specimen", {}).get("windows") or []:
        ends = [window.get(axis, [0, 1]) for axis in "xyz"[:len(size)]]
        found.append(Window(window["name"], tuple(s * a for s, (a, _) in zip(size, ends)),
                            tuple(s * b for s, (_, b) in zip(size, ends))))
    return found


class _Members:
    """Which particles belong to a window, found again in every snapshot: by their id, or, of cells
    of the total Lagrangian formulation that stayed on their ranks, by their place in the file."""

    def __init__(self, first, windows, keeps_order):
        self.first = first
        self.by_id = "id" in first
        if not self.by_id and not keeps_order:
            raise ResultsError(f"{first.path}: has no field id, and particles change their order "
                               "from snapshot to snapshot. Run again with output.fields: "
                               "[..., id].")
        masks = [[] for _ in windows]
        ids = []
        for block in first.blocks("position", *(["id"] if self.by_id else [])):
            ids += block[1:]
            for window, mask in zip(windows, masks):
                mask.append(window.holds(block[0]))
        self.masks = [numpy.concatenate(mask) for mask in masks]
        if self.by_id:
            ids = numpy.concatenate(ids)
            order = numpy.argsort(ids)
            self.ids = ids[order]
            self.masks = [mask[order] for mask in self.masks]

    def of(self, snapshot):
        """Yields a block of plastic work, and for each window which of the block belong to it."""
        if self.by_id:
            for work, ids in snapshot.blocks("plastic_work", "id"):
                place = numpy.searchsorted(self.ids, ids).clip(max=len(self.ids) - 1)
                known = self.ids[place] == ids
                yield work, [mask[place] & known for mask in self.masks]
            return
        if snapshot.count != self.first.count:
            raise ResultsError(f"{snapshot.path}: has other cells than the first snapshot, and no "
                               "field id. Run again with output.fields: [..., id].")
        begin = 0
        for work, in snapshot.blocks("plastic_work"):
            yield work, [mask[begin:begin + len(work)] for mask in self.masks]
            begin += len(work)


def _check_order(earlier, later):
    """Plastic work never falls: where it seems to, rows are not those of the same cells."""
    for (before,), (after,) in zip(earlier.blocks("plastic_work"), later.blocks("plastic_work")):
        if (after < before - 1e-9 * numpy.abs(before)).any():
            raise ResultsError(f"{later.path}: has its cells in another order than the snapshot "
                               "before, and no field id. Run again with output.fields: [..., id].")


def work_in_windows(run, windows):
    """Plastic work [J] in each Window at each snapshot, shape (snapshots, windows); that of all
    particles, shape (snapshots,); and the volume [m3] of each window's cell wall, shape (windows,).

    Takes some bytes a particle of memory. Raises ResultsError if there are no snapshots, if
    plastic_work is not among their fields, or if a window holds no particle."""
    if not run.snapshots:
        raise ResultsError(f"{run.folder}: holds no snapshots. Run again with output.snapshots.")
    first = run.snapshots[0]
    members = _Members(first, windows, run.keeps_order)
    for window, mask in zip(windows, members.masks):
        if not mask.any():
            lower, upper = first.bounds()
            raise ResultsError(
                f"window {window.name}: holds no particle. The specimen reaches from "
                f"{' '.join(f'{1e6 * x:.4g}' for x in lower)} to "
                f"{' '.join(f'{1e6 * x:.4g}' for x in upper)} um: write it within.")
    inside = numpy.zeros((len(run.snapshots), len(windows)))
    everywhere = numpy.zeros(len(run.snapshots))
    for k, snapshot in enumerate(run.snapshots):
        if k and not members.by_id:
            _check_order(run.snapshots[k - 1], snapshot)
        for work, masks in members.of(snapshot):
            everywhere[k] += work.sum()
            inside[k] += [work[mask].sum() for mask in masks]
    volumes = numpy.array([mask.sum() for mask in members.masks]) * first.particle_volume
    return inside, everywhere, volumes
