"""Contact of a cylinder and a block, from the pressure under it."""
import h5py
import numpy

from measures.history import History
from measures.places import snapshots


def profile(folder, level, radius, top):
    """Places along the block's uppermost cells and the pressures there, at the end."""
    with h5py.File(snapshots(folder)[0]) as held:
        start = held["particles/position"][:][numpy.argsort(held["particles/id"][:])]
    with h5py.File(snapshots(folder)[-1]) as held:
        order = numpy.argsort(held["particles/id"][:])
        end, stress = held["particles/position"][:][order], held["particles/stress"][:][order]
    height = radius / (2 * level)
    row = numpy.abs(start[:, 1] - (top - height / 2)) < height / 4
    return end[row, 0], -stress[row, 1]


def force(folder, area):
    """Between the bodies at the end, twice that of the half that is there."""
    history = History(folder)
    return 2 * area * 0.5 * (history["stress_piston"][-1] + history["stress_edge"][-1])


def half_width(folder, level, radius, top, modulus):
    """half width of the contact, twice the root of the mean square of the distance from its middle, over that of Hertz under the same force"""
    exact = numpy.sqrt(4 * force(folder, radius) * radius / (numpy.pi * modulus))
    x, pressure = profile(folder, level, radius, top)
    near = x < 2 * exact
    return 2 * numpy.sqrt((pressure * x**2)[near].sum() / pressure[near].sum()) / exact


def pressure_in_the_middle(folder, level, radius, top, modulus):
    """pressure on the two cells next to the middle, over that of Hertz under the same force"""
    exact = numpy.sqrt(force(folder, radius) * modulus / (numpy.pi * radius))
    x, pressure = profile(folder, level, radius, top)
    return pressure[numpy.argsort(x)[:2]].mean() / exact
