"""The structure at some moments, coloured by what happens in its cell walls."""
import dataclasses

import numpy
from matplotlib import pyplot
from matplotlib.colors import Normalize

from mpm_par import pictures, raster
from mpm_par.report import drawing

FRAMES = 6


@dataclasses.dataclass(frozen=True)
class Colouring:
    """What colours the structure. `value(*blocks)`: of `fields`, in the unit shown."""
    stem: str
    name: str
    unit: str
    fields: tuple
    value: object
    colours: str
    diverging: bool
    explained: str


def work_density(snapshot):
    """Plastic work over the first volume of the location, MJ/m3 of cell wall."""
    volume = snapshot.particle_volume
    return Colouring("plastic_work", "plastic work", "MJ/m³", ("plastic_work",),
                     lambda work: work / volume / 1e6, "viridis", False,
                     "Plastic work per volume of cell wall as it was at the start, so that runs of "
                     "other resolutions compare.")


def axial_stress(axis):
    """Cauchy stress along the piston's way, positive in compression, MPa."""
    name = "xyz"[axis]  # and the tensor's first three columns are xx, yy, zz
    return Colouring("axial_stress", "axial stress", "MPa", ("stress",),
                     lambda stress: -stress[:, axis] / 1e6, "coolwarm", True,
                     f"Cauchy stress along {name}, the way of the piston; compression is positive "
                     "(red), tension negative (blue).")


def von_mises():
    return Colouring("von_mises", "von Mises stress", "MPa", ("von_mises",),
                     lambda stress: stress / 1e6, "viridis", False,
                     "Von Mises stress of the cell walls.")


def colourings(run, snapshot):
    """Those that the run has the fields for, and words on what is missing."""
    found, missing = [], []
    if "plastic_work" in snapshot and run.history["plastic_work"][-1] > 0:
        found.append(work_density(snapshot))
    elif "plastic_work" in snapshot:
        missing.append("No plastic work has been done, so none is shown.")
    else:
        missing.append("The snapshots have no field plastic_work, so no plastic work is shown. "
                       "Run with output.fields: [plastic_work, stress].")
    if "stress" in snapshot and run.axis is not None:
        found.append(axial_stress(run.axis))
    elif "von_mises" in snapshot:
        found.append(von_mises())
    if "stress" not in snapshot and run.axis is not None:
        missing.append("The snapshots have no field stress, so no axial stress is shown. "
                       "Run with output.fields: [plastic_work, stress].")
    return found, missing


class Stage:
    """Where a run's structure is painted: the same place and pixels at all moments."""

    def __init__(self, run, place=None, across=raster.PIXELS_ACROSS):
        first = run.snapshots[0]
        # Under a piston a specimen grows wider, and not longer; what moves freely may come back.
        seen = run.snapshots if run.axis is None else (first, run.snapshots[-1])
        bounds = [snapshot.bounds() for snapshot in seen]
        whole = numpy.array([numpy.min([lower for lower, _ in bounds], axis=0),
                             numpy.max([upper for _, upper in bounds], axis=0)])
        self.edge = raster.edge_of(first, run.thickness, run.is_in_space)
        self.view = pictures.section_of(run, first, bounds[0], place)
        self.canvas = raster.canvas_of(whole, self.view, self.edge, across)
        left, right, bottom, top = self.canvas.extent
        self.width, self.aspect = right - left, (top - bottom) / (right - left)

    def paint(self, snapshot, colouring):
        return raster.paint(snapshot, colouring.value, colouring.fields, self.view, self.canvas,
                            self.edge)

    @property
    def words(self):
        """What is seen of a specimen in space; empty in the plane."""
        if self.view.normal is None:
            return ""
        across = "xyz"[self.view.normal]
        shown = " and ".join("xyz"[axis] for axis in self.view.axes)
        return (" The specimen is in space; shown is a section about one particle thick at "
                f"{across} = {pictures.length_text(self.view.place)}, {shown} in the plane of the "
                "picture.")


def moment_of(run, snapshot):
    """Such as `17 % strain`, or the time where there is no piston."""
    if run.axis is not None:
        return f"{100 * snapshot.strain:.3g} % strain"
    factor, unit = pictures.prefixed(snapshot.time, "s")
    return f"t = {snapshot.time / factor:.4g} {unit}"


def plain(number):
    """Three digits or all before the point."""
    return f"{number:.3g}" if abs(number) < 1000 else f"{number:,.0f}"


def limits_of(paintings, diverging, given=None):
    """Of the colours: round and the same for all, so that 2 of 100 pixels at most are beyond them
    in the picture with most; of a stress in half of the pictures, as solid contact at the end
    would leave no colour for the others."""
    if given is not None:
        return (-given, given) if diverging else (0.0, given)
    reached = [numpy.nanpercentile(numpy.abs(p), 98) for p in paintings if numpy.isfinite(p).any()]
    reached = sorted(value for value in reached if value > 0) or [1.0]
    highest = reached[len(reached) // 2] if diverging else reached[-1]
    power = 10.0 ** numpy.floor(numpy.log10(highest))
    highest = next(step * power for step in (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10.001)
                   if step * power >= highest)
    return (-highest, highest) if diverging else (0.0, highest)


def draw_frames(run, stage, snapshots, colouring, given_limit=None):
    """A Drawing for each snapshot, in the same colours."""
    paintings = [stage.paint(snapshot, colouring) for snapshot in snapshots]
    norm = Normalize(*limits_of(paintings, colouring.diverging, given_limit))
    made = []
    for snapshot, painting in zip(snapshots, paintings):
        moment = moment_of(run, snapshot)

        def draw(axes, bar, painting=painting, moment=moment):
            image = pictures.draw_structure(axes, painting, stage.canvas, norm, colouring.colours)
            axes.set_title(moment, loc="left")
            pictures.draw_scale_bar(axes, stage.width)
            colour_bar = pyplot.colorbar(image, cax=bar, orientation="horizontal",
                                         extend="both" if colouring.diverging else "max")
            colour_bar.outline.set_visible(False)
            colour_bar.set_label(f"{colouring.name} ({colouring.unit})", labelpad=1)

        seen = painting[numpy.isfinite(painting)]
        mean, high = (seen.mean(), seen.max()) if len(seen) else (0.0, 0.0)
        made.append(drawing.picture(
            f"{colouring.stem}_{snapshot.path.stem}", draw,
            f"Structure at {moment}, coloured by {colouring.name}.",
            f"{moment}: {plain(mean)} {colouring.unit} on average over what is seen, at most "
            f"{plain(high)} {colouring.unit}.", stage.aspect))
    return made


def choose(run, wanted):
    """The snapshots nearest to `wanted` ((dimension, value) pairs: strains or times), each once; up
    to six from first to last without them."""
    there = run.snapshots
    if not wanted:
        count = min(FRAMES, len(there))
        numbers = {round(k * (len(there) - 1) / max(count - 1, 1)) for k in range(count)}
    else:
        numbers = {min(range(len(there)), key=lambda k: abs(
            (there[k].time if dimension == "time" else there[k].strain) - value))
            for dimension, value in wanted}
    return [there[k] for k in sorted(numbers)]
