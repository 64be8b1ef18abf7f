"""The crush as an animated PNG: the structure above, the point on the curve below it."""
import io

import matplotlib
import numpy
from matplotlib import pyplot
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Normalize
from PIL import Image

from mpm_par import pictures
from mpm_par.report import drawing, structure

FRAMES = 60  # at most
DOTS = 110  # per inch
PIXELS_ACROSS = 570  # of the structure
LAST_FRAME = 2000  # ms
COLOURS, GREYS = 200, 16  # of the film
SMALLEST = 240  # pixels across


def _frames(run, stage, colouring, snapshots, limit):
    """Pictures of all snapshots, in the colours of the last one."""
    largest = structure.limits_of([stage.paint(snapshots[-1], colouring)], colouring.diverging,
                                  limit)
    width, above, below = drawing.WIDTH - 0.4, 0.34, 0.25
    height = min(max(width * stage.aspect, 0.4), 5.0)
    curve = 1.5 if run.axis is not None else 0.0
    total = above + height + below + (curve + 0.45 if curve else 0)
    with pyplot.rc_context({**pictures.STYLE, "font.size": 9}):
        figure = pyplot.figure(figsize=(drawing.WIDTH, total), dpi=DOTS)
        canvas = FigureCanvasAgg(figure)
        try:
            left = 0.5 * (drawing.WIDTH - width) / drawing.WIDTH
            axes = figure.add_axes([left, 1 - (above + height) / total, width / drawing.WIDTH,
                                    height / total])
            image = pictures.draw_structure(axes, stage.paint(snapshots[0], colouring),
                                            stage.canvas, Normalize(*largest), colouring.colours)
            title = axes.set_title("", loc="left")
            axes.set_title(f"{colouring.name}, to {largest[1]:g} {colouring.unit}", loc="right",
                           fontsize=8)
            point = _curve(figure, run, curve, total) if curve else None
            for snapshot in snapshots:
                painting = stage.paint(snapshot, colouring)
                image.set_data(numpy.ma.masked_invalid(painting))
                title.set_text(structure.moment_of(run, snapshot))
                if point:
                    point.set_data([100 * snapshot.strain],
                                   [run.history.at("stress", snapshot.strain) / 1e6])
                canvas.draw()
                yield Image.fromarray(numpy.asarray(canvas.buffer_rgba())).convert("RGB")
        finally:
            pyplot.close(figure)


def _curve(figure, run, height, total):
    axes = figure.add_axes([0.13, 0.42 / total, 0.83, height / total])
    axes.plot(100 * run.history.strain_of("stress"), run.history["stress"] / 1e6,
              color=pictures.INK, lw=1.2)
    axes.set(xlabel="compressive strain (%)", ylabel="stress (MPa)",
             xlim=(0, 100 * run.history["strain"][-1]), ylim=(0, pictures.curve_top(run) / 1e6))
    return axes.plot([], [], "o", color=pictures.RED, ms=7, clip_on=False, zorder=5)[0]


def _palette(colours):
    """One for all frames, as a changing one would flicker: colours of the structure, greys of lines
    and letters, and those of the point."""
    white, ink, red = (numpy.array(matplotlib.colors.to_rgb(colour))
                       for colour in ("white", pictures.INK, pictures.RED))
    steps = numpy.linspace(0, 1, GREYS)[:, None]
    table = numpy.concatenate([
        matplotlib.colormaps[colours](numpy.linspace(0, 1, COLOURS))[:, :3],
        white + steps * (ink - white), white + steps[1:8] * (red - white), [red]])
    palette = Image.new("P", (1, 1))
    palette.putpalette(numpy.round(255 * table).astype(int).ravel().tolist())
    return palette


def _written(frames, scale, colours):
    if scale < 1:
        size = tuple(max(1, round(scale * edge)) for edge in frames[0].size)
        frames = [frame.resize(size, Image.Resampling.LANCZOS) for frame in frames]
    palette = _palette(colours)
    reduced = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    made = io.BytesIO()
    pause = max(80, min(400, 8000 // len(reduced)))
    reduced[0].save(made, format="PNG", save_all=True, append_images=reduced[1:], loop=0,
                    duration=[pause] * (len(reduced) - 1) + [LAST_FRAME])
    return made.getvalue()


def _bounded(frames, most_bytes, colours):
    """The bytes of the largest film that is below the bound: made smaller, then of fewer frames."""
    scale = 1.0
    while True:
        made = _written(frames, scale, colours)
        if len(made) <= most_bytes:
            return made
        scale *= min(0.85, 0.95 * (most_bytes / len(made)) ** 0.5)
        if scale * frames[0].size[0] < SMALLEST and len(frames) > 2:
            frames, scale = [*frames[:-1:2], frames[-1]], 1.0


def draw(run, stage, colouring, most_bytes, limit=None):
    """The Drawing; `most_bytes`: how large its file may be."""
    there = run.snapshots
    count = min(FRAMES, len(there))
    chosen = [there[round(k * (len(there) - 1) / (count - 1))] for k in range(count)]
    frames = list(_frames(run, stage, colouring, chosen, limit))
    moments = [structure.moment_of(run, snapshot) for snapshot in (chosen[0], chosen[-1])]
    return drawing.Drawing(
        "film", {"png": _bounded(frames, most_bytes, colouring.colours)}, "png",
        f"Film of the structure from {moments[0]} to {moments[1]}, coloured by {colouring.name}.",
        f"{len(chosen)} snapshots from {moments[0]} to {moments[1]}, coloured by "
        f"{colouring.name}." + stage.words)
