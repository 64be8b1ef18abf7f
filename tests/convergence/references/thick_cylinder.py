"""A thick-walled cylinder under the radial body force b = B/r, in plane strain, without hardening.

For an incompressible solid this is Hill's cylinder under the pressure p = B ln(b/a) (1950, The
Mathematical Theory of Plasticity, V.2): s_r = s_r(Hill) + B ln(r/b), so that the stress differences are the same:
p = 2k ln(c/a) + k (1 - c^2/b^2), k = yield stress / sqrt(3), c the radius up to which it flows, and
u = k c^2 / (2 G r). Compressible solids, as in the scene, have no closed form.

    thick_cylinder.py    mean radial displacement over a k/G, against Hill's and at nu = 0.3
"""
import numpy

from finite_elements import Plane, patch

INNER, OUTER, PLASTIC = 1.0, 2.0, 1.5
YIELD = 1e-3  # over Young's modulus
K = YIELD / numpy.sqrt(3)
PRESSURE = 2 * K * numpy.log(PLASTIC / INNER) + K * (1 - (PLASTIC / OUTER)**2)


def mean_displacement(n, poisson_ratio, increments=12):
    """n elements along the radius and along a quarter of the circle."""
    def place(u, v):
        r, angle = INNER + (OUTER - INNER) * u, numpy.pi / 2 * v
        return [r * numpy.cos(angle), r * numpy.sin(angle)]
    ends = numpy.linspace(0, 1, n + 1)
    body = Plane([patch(place, ends, ends)], 1.0, poisson_ratio, YIELD)
    still = dict.fromkeys([*(2 * body.at(0, 0.0)), *(2 * body.at(1, 0.0) + 1)], 0.0)
    load = body.body_force(lambda x: x / (x**2).sum(-1, keepdims=True)) / numpy.log(OUTER / INNER)
    u = numpy.zeros(2 * len(body.nodes))
    for share in numpy.linspace(0, 1, increments + 1)[1:]:
        u, _ = body.advance(u, still, load=share * PRESSURE * load)
    radial = (u.reshape(-1, 2) * body.nodes).sum(-1) / numpy.linalg.norm(body.nodes, axis=-1)
    over = numpy.einsum("ep,pn,en->", body.weight, body.functions, radial[body.elements])
    return over / body.weight.sum()


def main():
    nu = 0.4999
    shear = 1 / (2 + 2 * nu)
    # mean of k c^2 / (2 G r) over the section
    hill = K * PLASTIC**2 / (2 * shear) * 2 * (OUTER - INNER) / (OUTER**2 - INNER**2)
    for n in (4, 8, 16):
        print(f"n {n}: over Hill's at nu {nu}: {mean_displacement(n, nu) / hill:.5f}; "
              f"at nu 0.3: {mean_displacement(n, 0.3):.6e}", flush=True)
    print(f"pressure over yield stress {PRESSURE / YIELD:.6f}, B {PRESSURE / numpy.log(2):.6e}")


if __name__ == "__main__":
    main()
