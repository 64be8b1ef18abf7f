"""Particles drawn as squares into the pixels of a picture, block by block: memory follows the
picture, not the snapshot."""
import dataclasses

import numpy

PIXELS_ACROSS = 900  # at most, along the longer side
PIXELS_OF_EDGE = 4  # at most: few particles need no more to be squares
OVERLAP = 1.15  # of a square's edge, so that bent rows of cells show no hairlines


@dataclasses.dataclass(frozen=True)
class View:
    """Which plane is seen. `axes`: those to the right and up. In space `normal` is the axis across,
    `place` [m] where the section is and `layer` [m] how thick, about a particle; in the plane there
    are none."""
    axes: tuple
    normal: int = None
    place: float = None
    layer: float = None

    def lies_in(self, position):
        """Which particles are seen, shape (N,), bool."""
        if self.normal is None:
            return numpy.ones(len(position), dtype=bool)
        # Half way between two layers both are seen, whatever rounding says.
        return numpy.abs(position[:, self.normal] - self.place) <= 0.5 * OVERLAP * self.layer


@dataclasses.dataclass(frozen=True)
class Canvas:
    """`lower`: left bottom corner, m; `pixel`: its edge, m; `shape`: rows (upwards), columns."""
    lower: tuple
    pixel: float
    shape: tuple

    @property
    def extent(self):
        """Left, right, bottom, top, m: as Matplotlib's imshow takes it."""
        rows, columns = self.shape
        x, y = self.lower
        return x, x + columns * self.pixel, y, y + rows * self.pixel


def edge_of(snapshot, thickness, in_space):
    """The edge [m] of a square, in space a cube, of a particle's first volume."""
    if in_space:
        return snapshot.particle_volume ** (1 / 3)
    return (snapshot.particle_volume / thickness) ** 0.5


def layer_of(snapshot, normal, edge):
    """How far layers of particles are apart along an axis, m: the edge of a cube, unless the first
    particles stand in clear layers, as they do at the start."""
    position, = next(snapshot.blocks("position"))
    places = numpy.unique(numpy.round(position[:, normal] / edge, 3))
    apart = numpy.diff(places)
    return edge * float(numpy.median(apart)) if 0 < len(apart) < 0.05 * len(position) else edge


def canvas_of(bounds, view, edge, across=PIXELS_ACROSS):
    """A Canvas for all places within bounds, shape (2, 3) [m]; `across`: pixels along its longer
    side, at most."""
    lower = bounds[0, list(view.axes)] - 0.5 * edge
    width = bounds[1, list(view.axes)] + 0.5 * edge - lower
    pixel = max(edge / PIXELS_OF_EDGE, width.max() / across)
    columns, rows = (int(numpy.ceil(extent / pixel)) for extent in width)
    return Canvas(tuple(lower), pixel, (max(rows, 1), max(columns, 1)))


def _along(place, half, count):
    """Numbers of the columns, or rows, that squares cover, and which of them do; in turns."""
    first = numpy.ceil(place - half - 0.5).astype(numpy.int64)
    for number in (first + k for k in range(int(2 * half) + 1)):
        yield number, (number + 0.5 <= place + half) & (number >= 0) & (number < count)


def _pixels(canvas, points, edge):
    """Numbers of the pixels that squares cover, and which of the squares do; in turns."""
    rows, columns = canvas.shape
    half = max(0.5 * OVERLAP * edge / canvas.pixel, 0.5)
    place = (points - canvas.lower) / canvas.pixel
    upwards = [(row * columns, covers) for row, covers in _along(place[:, 1], half, rows)]
    for column, covers_column in _along(place[:, 0], half, columns):
        for row, covers_row in upwards:
            covered = covers_column & covers_row
            yield (row + column)[covered], covered


def paint(snapshot, value, fields, view, canvas, edge):
    """The mean of a value over the particles that cover a pixel: an array of the canvas's shape,
    float64, NaN where there is none. `value(*blocks)` makes of blocks of `fields` one number a
    particle."""
    pixels = canvas.shape[0] * canvas.shape[1]
    sums, counts = numpy.zeros(pixels), numpy.zeros(pixels)
    for position, *blocks in snapshot.blocks("position", *fields):
        seen = view.lies_in(position)
        values = value(*blocks)[seen]
        for where, covered in _pixels(canvas, position[seen][:, list(view.axes)], edge):
            sums += numpy.bincount(where, values[covered], minlength=pixels)
            counts += numpy.bincount(where, minlength=pixels)
    with numpy.errstate(invalid="ignore"):
        means = (sums / numpy.where(counts > 0, counts, numpy.nan)).reshape(canvas.shape)
    return _closed(means, passes=2) if edge / canvas.pixel >= 2 else means


def _closed(means, passes):
    """Squares do not turn with their cells, and rows that have turned leave holes of a pixel or two
    between them: such a pixel takes the mean of its neighbours. Lumens are wider."""
    rows, columns = means.shape
    for _ in range(passes):
        padded = numpy.pad(means, 1, constant_values=numpy.nan)
        around = [padded[1 + i:1 + i + rows, 1 + j:1 + j + columns]
                  for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
        painted = sum(numpy.isfinite(neighbour).astype(int) for neighbour in around)
        total = sum(numpy.nan_to_num(neighbour) for neighbour in around)
        holes = numpy.isnan(means) & (painted >= 5)
        means[holes] = total[holes] / painted[holes]
    return means
