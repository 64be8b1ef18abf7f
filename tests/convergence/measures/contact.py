"""When bodies in one velocity field begin to feel each other."""
import numpy

from measures.history import History


def remaining_width(folder, level, gap, length, modulus):
    """width between the blocks, in cells, when the edge feels 0.1 % of Young's modulus"""
    history = History(folder)
    stress = history["stress_edge"]
    first = numpy.argmax(stress > 1e-3 * modulus)
    if first == 0:
        raise RuntimeError(f"{folder}: the edge feels nothing")
    part = (1e-3 * modulus - stress[first - 1]) / (stress[first] - stress[first - 1])
    strain = numpy.interp(first - 1 + part, [first - 1, first], history["strain"][first - 1:first + 1])
    shortened = 1e-3 * (length - gap)  # blocks under that stress
    return (gap - strain * length + shortened) / length * level


def early_contact(folder, level, time, speed, size):
    """width between the bodies, in cells, when a hundredth of their kinetic energy is gone"""
    history = History(folder)
    energy = history["kinetic_energy"]
    first = history["time"][numpy.argmax(energy < 0.99 * energy[0])]
    return speed * (time - first) / size * level
