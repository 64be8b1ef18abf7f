"""A thin ring between two plates without friction: an inextensible elastica (Frisch-Fay 1962, Flexible
Bars). With EI and the radius 1, a quarter of it turns by theta(s) from the plate on, theta'' = P cos theta,
from theta = 0 to pi/2, P half of the force. Once the curvature at the plate is 0 the ring lies flat there,
and what hangs free between is shorter.

    ring.py    mean stress of the scene, Pa, to 40 % strain
"""
import numpy
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.optimize import brentq

DIAMETER, WALL, MODULUS = 100e-6, 5e-6, 10e9 / (1 - 0.3**2)  # of the scene; in plane strain


def end(force, curvature, length):
    """theta and height at the end of this length that starts at the plate with this curvature."""
    found = solve_ivp(lambda s, state: (state[1], force * numpy.cos(state[0]), numpy.sin(state[0])),
                      (0, length), (0, curvature, 0), rtol=1e-9, atol=1e-12)
    return found.y[0, -1], found.y[2, -1]


def half_height(force):
    """Of the plates' distance, over the radius."""
    whole = numpy.pi / 2
    if end(force, 0, whole)[0] < whole:
        curvature = brentq(lambda one: end(force, one, whole)[0] - whole, 0, 2)
        return end(force, curvature, whole)[1]
    length = brentq(lambda one: end(force, 0, one)[0] - whole, 0.1, whole)
    return end(force, 0, length)[1]


def mean_stress(strain=0.4, steps=200):
    """Force over the diameter, per depth, averaged over the strain of the diameter."""
    radius, stiffness = (DIAMETER - WALL) / 2, MODULUS * WALL**3 / 12
    forces = numpy.linspace(0, 4, steps + 1)
    strains = [2 * radius * (1 - half_height(force)) / DIAMETER for force in forces]
    stresses = 2 * forces * stiffness / radius**2 / DIAMETER
    return numpy.interp(strain, strains, cumulative_trapezoid(stresses, strains, initial=0)) / strain


if __name__ == "__main__":
    print(f"{mean_stress():.6g}")
