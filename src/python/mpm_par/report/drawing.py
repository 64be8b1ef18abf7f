"""Figures as files: what they show, in words as well, and their bytes."""
import dataclasses
import io

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402

from mpm_par import pictures  # noqa: E402

WIDTH = 5.2  # inches: as wide as half a page on a desk, and legible on a telephone
DOTS = 160  # per inch, of PNG files


@dataclasses.dataclass
class Drawing:
    """`stem`: of the file's name; `files`: bytes by ending; `shown`: the ending that stands on the
    page; `alt`: what is to be seen, for those who do not see it; `caption`: what it is."""
    stem: str
    files: dict
    shown: str
    alt: str
    caption: str


def _bytes(figure, ending):
    made = io.BytesIO()
    # Without a date the same results give the same file.
    figure.savefig(made, format=ending, dpi=DOTS,
                   metadata={"Date": None} if ending == "svg" else {"Software": None})
    return made.getvalue()


def legend_below(axes, columns, size):
    """A legend in letters of `size` points, or as much smaller as lets its names stand within the
    figure."""
    room = 0.98 * axes.figure.bbox.width
    width = room + 1
    while width > room:
        legend = axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.14),
                             ncols=columns, fontsize=size)
        width = legend.get_window_extent(axes.figure.canvas.get_renderer()).width
        size *= min(0.98, room / width)


def plot(stem, draw, alt, caption, height=4.1, endings=("svg", "png")):
    """A Drawing of what `draw(axes)` makes."""
    with pyplot.rc_context(pictures.STYLE):
        figure, axes = pyplot.subplots(figsize=(WIDTH, height), layout="constrained")
        try:
            draw(axes)
            figure.canvas.draw()
            figure.set_layout_engine("none")  # it is laid out now, for all files
            return Drawing(stem, {ending: _bytes(figure, ending) for ending in endings},
                           endings[0], alt, caption)
        finally:
            pyplot.close(figure)


def picture(stem, draw, alt, caption, aspect):
    """A Drawing of a structure with room below it for scale bar and colour bar. `draw(axes, bar)`
    gets the axes of both; `aspect`: the structure's height over its width."""
    width = min(WIDTH - 0.2, 5.2 / aspect)  # inches; tall specimens are no taller than a screen
    height = max(width * aspect, 0.4)
    above, below = 0.34, 0.78
    total = above + height + below
    with pyplot.rc_context(pictures.STYLE):
        figure = pyplot.figure(figsize=(WIDTH, total))
        try:
            left = 0.5 * (WIDTH - width)
            axes = figure.add_axes([left / WIDTH, below / total, width / WIDTH, height / total])
            bar = figure.add_axes([0.36, 0.47 / total, 0.6, 0.12 / total])
            draw(axes, bar)
            return Drawing(stem, {"png": _bytes(figure, "png")}, "png", alt, caption)
        finally:
            pyplot.close(figure)
