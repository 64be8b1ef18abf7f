"""What the energies of a run show."""

import numpy

from measures.history import History


def stiffness(folder, level, strain, volume):
    """twice the elastic energy at the end, per volume and squared strain"""
    return 2 * History(folder)["elastic_energy"][-1] / (volume * strain**2)


def power(folder, level, rate, volume):
    """work done per volume and strain over the last fifth of the run"""
    history = History(folder)
    time, work = history["time"], history["external_work"]
    late = time > 0.8 * time[-1]
    return numpy.polyfit(time[late], work[late], 1)[0] / (volume * rate)


def dead_load_stiffness(folder, level):
    """one over the elastic energy at rest under a load that is given"""
    return 1 / History(folder)["elastic_energy"][-1]


def kept(folder, level):
    """kinetic and elastic energy at the end over that at the start"""
    history = History(folder)
    energy = history["kinetic_energy"] + history["elastic_energy"]
    return energy[-1] / energy[0]
