"""Where the particles are in the first and the last snapshot."""
from pathlib import Path

import h5py
import numpy


def snapshots(folder):
    """The HDF5 files of this run, in the order of time."""
    lines = next(Path(folder).glob("*.xdmf")).read_text()
    return [file for file in sorted(Path(folder, "snapshots").glob("*.h5")) if file.name in lines]


def first_and_last(folder):
    """Places at the start and at the end, particle by particle."""
    found = []
    for file in (snapshots(folder)[0], snapshots(folder)[-1]):
        with h5py.File(file) as held:
            particles = held["particles"]
            found.append(particles["position"][:][numpy.argsort(particles["id"][:])])
    return found


def tip_deflection(folder, level):
    """how far the end has come down: the last column of particles, and half a particle on along the last two"""
    start, end = first_and_last(folder)
    _, column = numpy.unique(start[:, 0].round(9), return_inverse=True)
    *_, before, last = numpy.bincount(column, start[:, 1] - end[:, 1]) / numpy.bincount(column)
    return last + 0.5 * (last - before)


def length(folder, level):
    """largest height of a particle and half the size that it had at first"""
    start, end = first_and_last(folder)
    return end[:, 2].max() + start[:, 2].min()


def foot_radius(folder, level):
    """largest distance from the axis, and half a particle"""
    start, end = first_and_last(folder)
    return numpy.hypot(end[:, 0], end[:, 1]).max() + start[:, 0].min()


def mean_expansion(folder, level):
    """mean growth of the particles' distances from the axis"""
    start, end = first_and_last(folder)
    return (numpy.hypot(end[:, 0], end[:, 1]) - numpy.hypot(start[:, 0], start[:, 1])).mean()


def half_length(folder, level):
    """half the distance between the outermost particles along z, and half a particle"""
    start, end = first_and_last(folder)
    return numpy.ptp(end[:, 2]) / 2 + start[:, 2].min()


def asymmetry(folder, level, centre):
    """largest distance of a particle from its twin's place mirrored at the centre [m]"""
    start, end = (places[:, :2] - centre for places in first_and_last(folder))
    digits = numpy.round(start, 9)
    one, twin = numpy.lexsort(digits.T), numpy.lexsort(-digits.T)
    if not numpy.allclose(start[one], -start[twin]):
        raise RuntimeError(f"{folder}: the particles do not start as mirror images")
    return numpy.linalg.norm(end[one] + end[twin], axis=1).max()
