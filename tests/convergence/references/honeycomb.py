"""A regular honeycomb in plane strain, per modulus and yield stress of its solid: a quarter of the
period between mirror planes, with one Y joint at each end of the one inclined wall. Loaded along y, in
which a third of the walls stand.

    honeycomb.py [WALL_THICKNESS_OVER_SIDE] [POISSON_RATIO]

prints the moduli C11 (no strain along x) and E (no stress along x), the ratio nu of the strains along x
and y, and the collapse stresses without strain or stress along x, with the ratio of the strain rates.
"""
import sys

import numpy

from finite_elements import (Plane, extrapolated, four_sided, patch, towards_both,
                             towards_start)


def cell(thickness, n, poisson_ratio, yield_stress=numpy.inf):
    """Sides of length 1; n elements across half a wall, finer at the corners. Width
    sqrt(3)/2, height 3/2."""
    width, height, t = numpy.sqrt(3) / 2, 1.5, thickness
    p = numpy.array([width - t / 2, 0.5 - t / numpy.sqrt(12)])  # inner corner
    q = numpy.array([width, 0.5 + t / numpy.sqrt(3)])           # where both inclined walls meet
    m = numpy.array([width, p[1]])
    foot = [numpy.array([width - t / 2, 0]), numpy.array([width, 0])]
    centre = (p + q + m) / 3
    wall = [patch(four_sided([foot[0], foot[1], m, p]), towards_both(2 * n),
                  1 - towards_start(max(1, round(p[1] / t)) * 2 * n)[::-1])]
    for a, b, c in ((p, m, q), (m, q, p), (q, p, m)):
        wall.append(patch(four_sided([a, (a + b) / 2, centre, (a + c) / 2]), towards_start(n),
                          towards_start(n)))
    turned = [numpy.array([width, height]) - numpy.flip(x, axis=0)[..., :] for x in wall]
    far = numpy.array([width, height])
    length = 1 - t / numpy.sqrt(3)
    inclined = patch(four_sided([p, q, far - p, far - q]), towards_both(2 * n),
                     towards_both(max(1, round(length / t)) * 2 * n))
    return Plane(wall + turned + [inclined], 1.0, poisson_ratio, yield_stress)


def loaded(body, strains, along_x=None):
    """Stresses along y and x, and strain along x, at growing strains along y; `along_x`: ratio of the
    strain along x, none: no stress along x."""
    width, height = numpy.sqrt(3) / 2, 1.5
    right, top = 2 * body.at(0, width), 2 * body.at(1, height) + 1
    still = dict.fromkeys([*(2 * body.at(0, 0.0)), *(2 * body.at(1, 0.0) + 1)], 0.0)
    u = before = numpy.zeros(2 * len(body.nodes))
    found = []
    for strain in strains:
        prescribed = still | dict.fromkeys(top, -strain * height)
        if along_x is not None:
            prescribed |= dict.fromkeys(right, along_x * strain * width)
        now, forces = body.advance(2 * u - before, prescribed, [] if along_x is not None else [right])
        u, before = now, u
        found.append([-forces[top].sum() / width, -forces[right].sum() / height,
                      u[right[0]] / width])
    return numpy.array(found)


def main():
    t = float(sys.argv[1]) if len(sys.argv) > 1 else 0.3
    nu = float(sys.argv[2]) if len(sys.argv) > 2 else 0.33
    moduli = []
    for n in (2, 4, 8):
        c11 = loaded(cell(t, n, nu), [1.0], 0.0)[0, 0]
        e, _, ratio = loaded(cell(t, n, nu), [1.0])[0]
        moduli.append([c11, e, ratio])
        print(f"n {n}: C11/Es {c11:.6f} E/Es {e:.6f} nu {ratio:.5f}", flush=True)
    print("limit:", " ".join(f"{extrapolated(*column):.5f}" for column in zip(*moduli)))
    yield_stress = 1e-3
    for kind, elastic, confined in (("free", moduli[-1][1], None), ("confined", moduli[-1][0], 0.0)):
        end = (4 if confined is None else 8) * t * t * yield_stress / elastic
        strains = numpy.linspace(0, end, 161)
        collapse = []
        for n in (2, 4, 8):
            found = loaded(cell(t, n, nu, yield_stress), strains[1:], confined)
            collapse.append(found[-1, 0] / yield_stress)
            rate = numpy.polyfit(strains[-6:], found[-6:, 2], 1)[0]
            print(f"{kind}, n {n}: stress over yield stress {collapse[-1]:.5f}, strain rate along x "
                  f"over that along y {rate:.4f}", flush=True)
        if confined is None:
            print(f"limit: {extrapolated(*collapse):.5f}")


if __name__ == "__main__":
    main()
