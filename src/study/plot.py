"""Error over cost, log-log: a picture of three panels for each measure."""
import io
import itertools
import math
import os

from mpm_par.matplotlib_files import keep_out_of_home

keep_out_of_home()

import matplotlib  # noqa: E402

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

import evaluation  # noqa: E402
import store  # noqa: E402

PANELS = (("wall_seconds", "wall time of the steps (s)"), ("core_seconds", "core-seconds"),
          ("particle_steps", "particle-steps"))
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#555555")
MARKERS = "osD^vPXh"
STYLE = {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
         "svg.hashsalt": "mpm_study", "axes.titlesize": 12}


def _plain(value, _=None):
    """1e-4 as 0.01 %, without digits that say nothing."""
    return f"{100 * value:.3g} %"


def _limits(values):
    """The range of values, at least half a decade, with room for labels, most at its lower end."""
    low, high = min(values), max(values)
    middle, half = (low * high) ** 0.5, max((high / low) ** 0.5, 3 ** 0.5)
    return middle / half ** 1.35, middle * half ** 1.25


def _front(axes, front, cost, name):
    """The staircase below which no run lies, and rings around those that make it."""
    if not front:
        return
    x = [getattr(row, cost) for row in front]
    y = [row.errors[name] for row in front]
    axes.step([*x, axes.get_xlim()[1]], [*y, y[-1]], where="post", color="#bbbbbb", lw=5,
              alpha=0.55, solid_capstyle="butt", zorder=1)
    axes.plot(x, y, "o", ms=13, mfc="none", mec="#222222", mew=1.2, zorder=4)


def _levels(axes, front, cost, name):
    """The level beside each run of the front, to the lower left, where no run lies; left away where
    it would cover the one before."""
    placed = []  # in parts of the panel, of which a label takes about 0.15 by 0.045
    for row in sorted(front, key=lambda row: row.errors[name]):
        place = (getattr(row, cost), row.errors[name])
        x, y = (math.log(value / low) / math.log(high / low)
                for value, (low, high) in zip(place, (axes.get_xlim(), axes.get_ylim())))
        if not row.level or any(abs(x - a) < 0.15 and abs(y - b) < 0.045 for a, b in placed):
            continue
        placed.append((x, y))
        axes.annotate(row.level, place, (-7, -7), textcoords="offset points", ha="right", va="top",
                      fontsize=8, color="#222222", zorder=6,
                      bbox={"boxstyle": "square,pad=0.1", "fc": "white", "ec": "none",
                            "alpha": 0.7})


def _crosses(axes, rows, cost, colour_of):
    """Runs that are unstable or failed, at the upper edge; without a cost at the right one. Those
    that would hide each other stand below each other."""
    used = []
    left, right = axes.get_xlim()
    width = (right / left) ** 0.025
    for row in rows:
        x = getattr(row, cost) or right / width
        x = min(max(x, left * width), right / width)
        depth = sum(1 for other in used if max(x / other, other / x) < 1.001 * width)
        used.append(x)
        axes.plot([x], [0.985 - 0.045 * depth], "x", transform=axes.get_xaxis_transform(), ms=9,
                  mew=2.2, color=colour_of(row), clip_on=False, zorder=7)


def _panel(axes, study, rows, outcome, cost, looks):
    name = outcome.measure.name
    handles = []
    for series, (colour, marker, label) in looks.items():
        own = sorted((row for row in rows if row.state == evaluation.OK and row.errors[name]
                      and evaluation.series_of(study, row) == series
                      and not row.combination.only_reference),
                     key=lambda row: getattr(row, cost))
        slope = outcome.slopes[series, cost]
        words = label + (f": slope {slope:.2f}" if slope is not None else "")
        joined = "-" if study.along else "none"
        axes.plot([getattr(row, cost) for row in own], [row.errors[name] for row in own],
                  ls=joined, marker=marker, color=colour, ms=6, lw=1.6, zorder=3)
        handles.append(Line2D([], [], ls=joined, marker=marker, color=colour, ms=6, label=words))
    return handles


def _frame(axes, rows, outcome, cost, targets):
    """Scales and ranges from all points; targets as far as they are near."""
    name = outcome.measure.name
    good = [row for row in rows if row.state == evaluation.OK and row.errors[name]]
    x = [getattr(row, cost) for row in rows if getattr(row, cost)] or [1.0]
    y = [row.errors[name] for row in good] or [0.01]
    axes.set(xscale="log", yscale="log", xlim=_limits(x), ylim=_limits(y))
    bottom, top = axes.get_ylim()
    for target in targets:
        if bottom < target < top:
            axes.axhline(target, color="#999999", lw=0.9, ls=(0, (5, 4)), zorder=0)
    axes.grid(which="major", color="#e2e2e2", lw=0.7)
    axes.yaxis.set_major_formatter(FuncFormatter(_plain))
    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_minor_formatter(NullFormatter())
        if limits[1] / limits[0] < 30:  # hardly a decade: more numbers than its powers of ten
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    if cost != "particle_steps":
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def draw(study, rows, outcome, folder):
    """Writes error_NAME.svg and .png; returns their paths."""
    pyplot.rcParams.update(STYLE)
    name = outcome.measure.name
    looks = {}
    styles = itertools.cycle(zip(COLOURS, MARKERS))
    for row in rows:
        series = evaluation.series_of(study, row)
        if series not in looks:
            looks[series] = (*next(styles), row.label or study.scene.stem)
    bad = [row for row in rows if row.state != evaluation.OK]
    legend_rows = len(looks) + 1 + bool(bad)
    figure, panels = pyplot.subplots(1, 3, sharey=True, layout="constrained",
                                     figsize=(13.5, 4.6 + 0.21 * legend_rows))
    for axes, (cost, title) in zip(panels, PANELS):
        _frame(axes, [row for row in rows if not row.combination.only_reference], outcome, cost,
               study.targets)
        handles = _panel(axes, study, rows, outcome, cost, looks)
        front = [row for row in outcome.fronts[cost] if row.errors[name]]  # 0 has no logarithm
        _front(axes, front, cost, name)
        _levels(axes, front, cost, name)
        _crosses(axes, bad, cost, lambda row: looks[evaluation.series_of(study, row)][0])
        handles.append(Line2D([], [], color="#bbbbbb", lw=5, alpha=0.55, marker="o", ms=11,
                              mfc="none", mec="#222222", label="Pareto front"))
        if bad:
            handles.append(Line2D([], [], ls="none", marker="x", mew=2, ms=8, color="#222222",
                                  label="unstable or failed"))
        axes.set_xlabel(title)
        axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0, -0.15), frameon=False,
                    fontsize=9, borderaxespad=0)
    against = {reference.words for reference in outcome.references.values() if reference}
    words = next(iter(against)) if len(against) == 1 else "the limit of each series"
    shown = name.replace("_", " ")
    panels[0].set_ylabel(f"error of {shown}")
    figure.suptitle(f"{study.title}: error of {shown} against {words}"
                    if outcome.measure.against != "exact" else f"{study.title}: {shown}")
    paths = []
    for ending in ("svg", "png"):
        path = folder / f"error_{name}.{ending}"
        picture = io.BytesIO()
        # Without a date the same study gives the same file.
        figure.savefig(picture, format=ending, dpi=130,
                       metadata={"Date": None} if ending == "svg" else None)
        store.write_whole(path, picture.getvalue())
        paths.append(os.fspath(path))
    pyplot.close(figure)
    return paths
