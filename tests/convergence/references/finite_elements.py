"""Small-strain finite elements in plane strain: quadrilaterals of eight nodes with 2 x 2 points, which
neither lock in bending nor in plastic flow (Nagtegaal, Parks & Rice 1974, CMAME 4:153; Zienkiewicz,
Taylor & Too 1971, IJNME 3:275). They give the figures that no formula gives, independently of mpm_par.
"""
import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

NODES = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]])
POINTS = numpy.array([[s, t] for t in (-1, 1) for s in (-1, 1)]) / numpy.sqrt(3)


def shape(s, t):
    """The eight functions of a point (Zienkiewicz & Taylor, The Finite Element Method 1, 8.7)."""
    corners = [(1 + s * a) * (1 + t * b) * (s * a + t * b - 1) / 4 for a, b in NODES[:4]]
    middles = [(1 - s * s) * (1 + t * b) / 2 if a == 0 else (1 - t * t) * (1 + s * a) / 2
               for a, b in NODES[4:]]
    return numpy.array(corners + middles)


def shape_gradient(s, t, step=1e-3):
    """Central differences: exact but for rounding, as no function is of third degree in s or t."""
    return numpy.array([(shape(s + step, t) - shape(s - step, t)) / (2 * step),
                        (shape(s, t + step) - shape(s, t - step)) / (2 * step)])


def towards_start(count):
    """Ends of elements on [0, 1] that get finer towards 0."""
    return numpy.linspace(0, 1, count + 1)**2


def towards_both(count):
    """The same, finer towards 0 and 1; an even count."""
    half = towards_start(count // 2) / 2
    return numpy.concatenate([half, 1 - half[-2::-1]])


def patch(place, along, across):
    """Nodes of elements [element, node, 2]: `along` and `across` are their ends in the unit square that
    `place` maps."""
    a, b = numpy.meshgrid(numpy.arange(len(along) - 1), numpy.arange(len(across) - 1), indexing="ij")
    a, b, local = a.reshape(-1, 1), b.reshape(-1, 1), (NODES + 1) / 2
    u = along[a] + (along[a + 1] - along[a]) * local[:, 0]
    v = across[b] + (across[b + 1] - across[b]) * local[:, 1]
    return numpy.stack(place(u, v), axis=-1)


def four_sided(corners):
    """The map of a patch with straight sides and these corners, counter-clockwise."""
    c = numpy.asarray(corners, dtype=float)

    def place(u, v):
        return [(1 - u) * (1 - v) * c[0, d] + u * (1 - v) * c[1, d] + u * v * c[2, d] +
                (1 - u) * v * c[3, d] for d in range(2)]
    return place


class Plane:
    """A body: patches that share the nodes at which they meet."""

    def __init__(self, patches, youngs_modulus, poisson_ratio, yield_stress=numpy.inf):
        places = numpy.concatenate(patches)
        size = numpy.ptp(places.reshape(-1, 2), axis=0).max()
        # Places that are the same but for rounding fall on one number; none is near the shifted ends.
        _, first, inverse = numpy.unique(numpy.floor(places / size * 1e8 + 0.31416).astype(int)
                                            .reshape(-1, 2), axis=0, return_index=True,
                                            return_inverse=True)
        self.nodes = places.reshape(-1, 2)[first]
        self.elements = inverse.reshape(places.shape[:2])
        self.shear = youngs_modulus / (2 + 2 * poisson_ratio)
        self.bulk = youngs_modulus / (3 - 6 * poisson_ratio)
        self.yield_stress = yield_stress
        dof = numpy.stack([2 * self.elements, 2 * self.elements + 1], -1)
        self.dof = dof.reshape(len(self.elements), 16)
        gradients = numpy.array([shape_gradient(*p) for p in POINTS])
        jacobian = numpy.einsum("pdn,enk->epdk", gradients, places)
        self.weight = numpy.linalg.det(jacobian)
        assert (self.weight > 0).all()
        slope = numpy.linalg.solve(jacobian, numpy.broadcast_to(
            gradients, jacobian.shape[:2] + gradients.shape[1:]))
        self.b = numpy.zeros(self.weight.shape + (3, 16))  # strains xx, yy, 2 xy
        self.b[:, :, 0, 0::2] = self.b[:, :, 2, 1::2] = slope[:, :, 0]
        self.b[:, :, 1, 1::2] = self.b[:, :, 2, 0::2] = slope[:, :, 1]
        self.functions = numpy.array([shape(*p) for p in POINTS])
        self.plastic = numpy.zeros(self.weight.shape + (4,))  # strains xx, yy, zz, xy

    def at(self, axis, value):
        """Numbers of the nodes on a line."""
        return numpy.flatnonzero(abs(self.nodes[:, axis] - value) < 1e-7 * abs(self.nodes).max())

    def body_force(self, force):
        """Forces on the nodes of a force per volume, a function of places [..., 2]."""
        places = numpy.einsum("pn,enk->epk", self.functions, self.nodes[self.elements])
        of_nodes = numpy.einsum("ep,pn,epk->enk", self.weight, self.functions, force(places))
        return numpy.bincount(self.dof.ravel(), of_nodes.ravel(), 2 * len(self.nodes))

    def response(self, u):
        """Internal forces, stiffness triplets and plastic strains: radial return without hardening
        and its tangent (Simo & Hughes 1998, Computational Inelasticity, 3.3)."""
        strain = numpy.einsum("epij,ej->epi", self.b, u[self.dof])
        full = numpy.zeros(self.plastic.shape)
        full[..., :2], full[..., 3] = strain[..., :2], strain[..., 2] / 2
        volume = full[..., 0] + full[..., 1]
        one = numpy.array([1.0, 1.0, 1.0, 0.0])
        trial = 2 * self.shear * (full - volume[..., None] / 3 * one - self.plastic)
        size = numpy.sqrt(trial[..., 0]**2 + trial[..., 1]**2 + trial[..., 2]**2 +
                          2 * trial[..., 3]**2)
        radius = numpy.sqrt(2 / 3) * self.yield_stress
        flows = size > radius
        scale = numpy.where(flows, radius / numpy.maximum(size, 1e-300), 1.0)
        deviator = scale[..., None] * trial
        stress = deviator + (self.bulk * volume)[..., None] * one
        normal = trial / numpy.maximum(size, 1e-300)[..., None]
        unit = numpy.diag([1.0, 1.0, 1.0, 0.5]) - numpy.outer(one, one) / 3
        tangent = 2 * self.shear * scale[..., None, None] * unit + self.bulk * numpy.outer(one, one)
        tangent = tangent - (2 * self.shear * numpy.where(flows, scale, 0.0))[..., None, None] * (
            normal[..., :, None] * normal[..., None, :])
        inplane = [0, 1, 3]
        d = tangent[..., inplane, :][..., inplane]
        plastic = self.plastic + (trial - deviator) / (2 * self.shear)
        of_elements = numpy.einsum("ep,epij,epi->ej", self.weight, self.b, stress[..., inplane])
        forces = numpy.bincount(self.dof.ravel(), of_elements.ravel(), 2 * len(self.nodes))
        stiffness = numpy.einsum("ep,epki,epkl,eplj->eij", self.weight, self.b, d, self.b,
                                 optimize=True)
        return forces, stiffness, plastic

    def advance(self, u, prescribed, equal=(), load=0.0):
        """The equilibrium next to the guess u: `prescribed` {dof: displacement}, `equal` lists of dofs
        with one common displacement. Returns displacements and internal forces; keeps the plastic
        strains."""
        unknown = numpy.arange(len(u))
        for group in equal:
            unknown[group] = group[0]
        u = u.copy()
        held = numpy.array(list(prescribed), dtype=int)
        u[held] = list(prescribed.values())
        unknown[held] = -1
        kept, number = numpy.unique(unknown, return_inverse=True)
        number = number - (1 if kept[0] < 0 else 0)
        count = number.max() + 1
        free = number >= 0
        rows = numpy.repeat(number[self.dof], 16, axis=1).ravel()
        columns = numpy.tile(number[self.dof], (1, 16)).ravel()
        both = (rows >= 0) & (columns >= 0)
        def residual_of(forces):
            return numpy.bincount(number[free], (load - forces)[free], count)

        forces, stiffness, plastic = self.response(u)
        for _ in range(60):
            residual = residual_of(forces)
            if abs(residual).max() < 1e-7 * abs(forces).max():
                self.plastic = plastic
                return u, forces
            matrix = coo_matrix((stiffness.ravel()[both], (rows[both], columns[both])),
                                (count, count)).tocsc()
            way = numpy.zeros(len(u))
            way[free] = spsolve(matrix, residual)[number[free]]
            for part in 0.5**numpy.arange(8):  # as far along Newton's way as it gets better
                forces, stiffness, plastic = self.response(u + part * way)
                if numpy.linalg.norm(residual_of(forces)) < numpy.linalg.norm(residual):
                    break
            u = u + part * way
        raise RuntimeError("no equilibrium: shorter increments are needed")


def extrapolated(coarse, middle, fine):
    """Richardson's limit of three values on grids halved twice, with their own order."""
    return fine + (fine - middle) / ((middle - coarse) / (fine - middle) - 1)
