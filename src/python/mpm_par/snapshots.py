"""Particles of the updated Lagrangian formulation, or cells of the total Lagrangian one."""
import dataclasses
import pathlib
import xml.etree.ElementTree as ElementTree

import h5py
import numpy

from mpm_par.problems import ResultsError

BLOCK_ROWS = 1 << 17  # of blocks(): some MB, whatever the snapshot holds


def _unit(dataset):
    unit = dataset.attrs.get("unit", "1")
    return unit.decode() if isinstance(unit, bytes) else str(unit)


@dataclasses.dataclass(frozen=True)
class Snapshot:
    """One HDF5 file, read when asked. `time` [s], `strain` [1] (0 without a piston), `step`,
    `count` particles N, `particle_volume` [m3] of a location at the start, `components`: values a
    particle by field, `units` by field. A particle is a cell where the formulation is total
    Lagrangian, and its position the cell's centre."""
    path: pathlib.Path
    time: float
    strain: float
    step: int
    count: int
    particle_volume: float
    components: dict
    units: dict

    def __contains__(self, field):
        return field in self.components

    def need(self, *fields):
        """Raises ResultsError unless it holds all of them."""
        for field in fields:
            if field not in self:
                raise ResultsError(f"{self.path}: has no field {field} (there are: "
                                   f"{', '.join(self.components)}). Run again with "
                                   f"output.fields: [..., {field}].")

    def unit(self, field):
        """Such as "m" of position, "J" of plastic_work, "1" of a plain number."""
        self.need(field)
        return self.units[field]

    def __getitem__(self, field):
        """All of a field: shape (N,), vectors (N, 3), symmetric tensors (N, 6): xx yy zz xy yz xz.
        Raises ResultsError if there is no such field."""
        self.need(field)
        with _opened(self.path) as file:
            return file["particles"][field][:]

    def blocks(self, *fields, rows=BLOCK_ROWS):
        """The fields in turns of at most `rows` particles, a list of arrays each: for snapshots
        that are larger than memory."""
        self.need(*fields)
        with _opened(self.path) as file:
            for first in range(0, self.count, rows):
                yield [file["particles"][field][first:first + rows] for field in fields]

    def total(self, field):
        """The sum over all particles of a field with one value each, such as plastic_work [J]."""
        return float(sum(block.sum(dtype=float) for block, in self.blocks(field)))

    def bounds(self):
        """The corners of the box of all positions [m], shape (2, 3)."""
        lowest, highest = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)
        for position, in self.blocks("position"):
            lowest = numpy.minimum(lowest, position.min(axis=0))
            highest = numpy.maximum(highest, position.max(axis=0))
        return numpy.array([lowest, highest])


def _opened(path):
    try:
        return h5py.File(path, "r")
    except OSError as error:
        reason = "is not there" if not path.exists() else f"cannot be read ({error})"
        raise ResultsError(f"{path}: {reason}. Copy the folder snapshots together with the .xdmf "
                           "file, or run again.") from None


def read_snapshot(path):
    """The Snapshot in an HDF5 file. Raises ResultsError if it is missing, half-written, or no
    snapshot."""
    path = pathlib.Path(path)
    with _opened(path) as file:
        if int(file.attrs.get("complete", 0)) != 1:
            raise ResultsError(f"{path}: was not written to its end. Leave it out, or run again.")
        missing = {"time", "strain", "step", "particle_volume"} - set(file.attrs)
        try:
            if missing:
                raise KeyError("without " + ", ".join(sorted(missing)))
            particles, attributes = file["particles"], file.attrs
            fields = {name: values for name, values in particles.items() if name != "connectivity"}
            return Snapshot(
                path, float(attributes["time"]), float(attributes["strain"]),
                int(attributes["step"]), int(fields["position"].shape[0]),
                float(attributes["particle_volume"]),
                {name: 1 if values.ndim == 1 else values.shape[1]
                 for name, values in fields.items()},
                {name: _unit(values) for name, values in fields.items()})
        except KeyError as error:
            raise ResultsError(f"{path}: is no snapshot of this version ({error.args[0]}). "
                               "Run again.") from None


def read_series(path):
    """The Snapshots that a .xdmf file lists, in the order of time. Raises ResultsError if the list
    or one of them is missing or broken."""
    path = pathlib.Path(path)
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}. Name the .xdmf file of a run.") from None
    except ElementTree.ParseError as error:
        raise ResultsError(f"{path}: is no XDMF ({error}). Run again.") from None
    places = [item.text.partition(":")[0].strip() for item in root.iterfind(".//Geometry/DataItem")]
    return [read_snapshot(path.parent / place) for place in places]
