"""What is known in closed form of cellular solids: honeycombs of regular hexagons, and composites
of two layers.

Gibson, Ashby, Schajer and Robertson 1982, Proc. R. Soc. A 382:25; the thickness ratio at any
density from Nairn 2006, Wood Fiber Sci. 38(4):576, eq. 8. Walls bend, and the lateral sides are free: at
relative densities above some 0.3 the formulae are beyond what they were derived for.
"""
import dataclasses
import math

PLANE_STRAIN_COLLAPSE = 2 / math.sqrt(3)  # of a wall that bends plastically in plane strain


@dataclasses.dataclass(frozen=True)
class Honeycomb:
    """`thickness_ratio`: of wall over side; modulus, elastic buckling and plastic collapse in the
    unit of the wall's modulus and yield stress; `plastic_collapse` is None of an elastic wall."""
    thickness_ratio: float
    modulus: float
    elastic_buckling: float
    plastic_collapse: float

    @property
    def plateau(self):
        """The lower of the two stresses at which the cells give way."""
        if self.plastic_collapse is None:
            return self.elastic_buckling
        return min(self.elastic_buckling, self.plastic_collapse)


def thickness_ratio(relative_density):
    """Wall over side of regular hexagons, t/l = sqrt(3) (1 - sqrt(1 - rho)): exact at any density.
    Raises ValueError beyond 0 to 1."""
    if not 0 < relative_density <= 1:
        raise ValueError(f"a relative density of {relative_density:g} does not lie between 0 and 1")
    return math.sqrt(3) * (1 - math.sqrt(1 - relative_density))


def honeycomb(relative_density, modulus, yield_stress=None, plane_strain=False, poisson_ratio=0.0):
    """The Honeycomb of this density: E = 4 E_w (t/l)^3 / sqrt(3), elastic buckling at 0.22 E_w
    (t/l)^3, plastic collapse at 2/3 s_y (t/l)^2.

    With `plane_strain` the wall's modulus is E_w/(1 - nu^2) and its yield stress 2/sqrt(3) times
    that in tension; without it these are as the founding paper takes them, but for its factor 1.133
    of plane strain on the yield stress and for the power of t/l in its eq. 6, which is printed as
    3 where its Table 2 holds what 2 gives."""
    ratio = thickness_ratio(relative_density)
    if plane_strain:
        modulus = modulus / (1 - poisson_ratio ** 2)
    collapse = None
    if yield_stress is not None:
        factor = PLANE_STRAIN_COLLAPSE if plane_strain else 1.0
        collapse = 2 / 3 * factor * yield_stress * ratio ** 2
    return Honeycomb(ratio, 4 * modulus * ratio ** 3 / math.sqrt(3), 0.22 * modulus * ratio ** 3,
                     collapse)


def layer_moduli(across, along, share):
    """(soft, stiff) moduli of the two layers of a composite with the modulus `across` in series
    (Reuss) and `along` in parallel (Voigt), where `share` of the volume is the soft one: earlywood
    and latewood out of radial and tangential modulus (Nairn 2006, eqs. 4 and 5). None where no two
    layers have these: along has to be the larger.

    1/across = v/a + (1 - v)/b and along = v a + (1 - v) b have two roots; it is the one with a < b.
    """
    if not 0 < share < 1 or not 0 < across <= along:
        return None
    # b out of the second equation, in the first:
    #   v a^2 - (along + (v^2 - (1 - v)^2) across) a + v across along = 0
    other = 1 - share
    linear = along + (share ** 2 - other ** 2) * across
    inside = linear ** 2 - 4 * share ** 2 * across * along
    if inside < 0:
        return None
    roots = [(linear + sign * math.sqrt(inside)) / (2 * share) for sign in (-1, 1)]
    pairs = [(soft, (along - share * soft) / other) for soft in roots]
    return next((pair for pair in pairs if 0 < pair[0] <= pair[1]), None)
