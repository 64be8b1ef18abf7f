"""Pictures on Matplotlib's axes: curve, energies, structure."""
import math

import matplotlib
import numpy
from matplotlib.colors import Normalize

from mpm_par import raster
from mpm_par.problems import ResultsError

INK, PALE = "#1f2328", "#d0d7de"
BLUE, ORANGE, GREEN, PURPLE, SKY, RED = ("#0072b2", "#d55e00", "#009e73", "#aa4499", "#56b4e9",
                                         "#b03a2e")
STYLE = {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
         "axes.edgecolor": INK, "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK,
         "ytick.color": INK, "axes.titlesize": 10, "legend.fontsize": 9,
         "svg.hashsalt": "mpm_par", "axes.axisbelow": True}
CURVES = (("stress_piston", "at the piston", SKY, 0.9),
          ("stress_edge", "at the fixed edge", ORANGE, 0.9), ("stress", "mean", INK, 1.8))
ENERGIES = (("external_work", "work done on it", INK, 1.8),
            ("plastic_work", "plastic work", ORANGE, 1.6),
            ("elastic_energy", "elastic", BLUE, 1.3), ("kinetic_energy", "kinetic", GREEN, 1.3),
            ("contact_energy", "contact", PURPLE, 1.3), ("friction_work", "friction", SKY, 1.3),
            ("failed_energy", "of failed cells", RED, 1.3))
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"),
            (1e-12, "p"))


def prefixed(size, unit):
    """(factor, unit) in which numbers of this size read well: 0.002 J is 2 mJ."""
    for factor, prefix in PREFIXES:
        if abs(size) >= factor:
            return factor, prefix + unit
    return 1, unit


def run_axis(run):
    """What a run is drawn over, and its title: strain in %, or time without a piston."""
    if run.axis is not None:
        return 100 * run.history["strain"], "compressive strain (%)"
    factor, unit = prefixed(run.history["time"][-1], "s")
    return run.history["time"] / factor, f"time ({unit})"


def _grid(axes):
    axes.grid(color="#e6e8eb", lw=0.7)


def _finite_range(*columns):
    values = numpy.concatenate([column[numpy.isfinite(column)] for column in columns])
    return (values.min(), values.max()) if len(values) else (0.0, 1.0)


def curve_top(run):
    """The stress [Pa] up to which the curve is drawn: solid contact at the end is many times the
    plateau and would press it flat."""
    highest = 1.05 * _finite_range(run.history["stress"])[1]
    dense, buckling = (run.properties.get(key) for key in ("densification", "buckling"))
    if dense:
        highest = min(highest, 5 * dense["stress"])
    return max(highest, 1.08 * buckling["stress"]) if buckling else highest


def _lines(axes, properties, top, end):
    """The lines that modulus and onsets are read from, as summary.json has them."""
    buckling, dense = properties.get("buckling"), properties.get("densification")
    style = {"color": RED, "lw": 1.1, "zorder": 4}
    modulus = properties.get("modulus")
    toe = properties.get("toe")
    if modulus:
        start = properties.get("elastic_intercept") or 0.0
        line_end = toe or buckling
        reach = min(1.6 * line_end["strain"] if line_end else 0.3 * end,
                    0.92 * (top - start) / modulus)
        axes.plot([0, 100 * reach], [start / 1e6, (start + modulus * reach) / 1e6], ls="--",
                  label=f"modulus {modulus / 1e6:.0f} MPa", **style)
    if toe:
        rise = min(1.2 * buckling["stress"] if buckling else 0.3 * end * toe["modulus"], 0.92 * top)
        axes.plot([100 * toe["strain"], 100 * (toe["strain"] + rise / toe["modulus"])],
                  [0, rise / 1e6], ls=(0, (6, 2)),
                  label=f"beyond the toe {toe['modulus'] / 1e6:.0f} MPa", **style)
    if buckling:
        slope = properties["plateau_slope"]
        to = dense["strain"] if dense else end
        rise = slope * (to - buckling["strain"])
        axes.plot([100 * buckling["strain"], 100 * to],
                  [buckling["stress"] / 1e6, (buckling["stress"] + rise) / 1e6], ls=":",
                  label="plateau", **style)
    if dense and properties["densification_slope"] > 0:
        slope = properties["densification_slope"]
        reach = min(0.9 * top - dense["stress"], 4 * dense["stress"]) / slope
        axes.plot([100 * dense["strain"], 100 * (dense["strain"] + reach)],
                  [dense["stress"] / 1e6, (dense["stress"] + slope * reach) / 1e6], ls="-.",
                  label="densification", **style)


def _point(axes, point, name, marker, errors):
    """A marked point; bars where an error is known."""
    strain_error, stress_error = errors
    place = 100 * point["strain"], point["stress"] / 1e6
    axes.errorbar(*place, xerr=100 * (strain_error or 0), yerr=(stress_error or 0) / 1e6,
                  fmt="none", ecolor=RED, elinewidth=1.3, capsize=3, zorder=5)
    axes.plot(*place, marker, ms=7, mec="white", color=RED, zorder=6, clip_on=False,
              label=f"{name}: {place[1]:.3g} MPa at {place[0]:.3g} %")


def _errors(bars, name, point):
    if bars is None:
        return point.get("strain_error"), point.get("stress_error")
    return [getattr(bars.get(f"{name}_{what}"), "error", None) for what in ("strain", "stress")]


def draw_curve(axes, run, bars=None):
    """Stress [MPa] over strain [%]: the columns of the history, and of the summary the points with
    the lines they are read from. `bars`: numerical errors, as read_error_bar gives them; without
    them points bear the error of reading the curve. Raises ResultsError without a stress."""
    end = run.history["strain"][-1]
    top = curve_top(run)
    for name, label, colour, width in CURVES:
        if name in run.history:
            axes.plot(100 * run.history.strain_of(name), run.history[name] / 1e6, color=colour, lw=width, label=label,
                      zorder=3 if name == "stress" else 2)
    properties = run.properties
    _lines(axes, properties, top, end)
    for name, label, marker in (("buckling", "onset of buckling", "o"),
                                ("densification", "onset of densification", "s")):
        if properties.get(name):
            _point(axes, properties[name], label, marker, _errors(bars, name, properties[name]))
    low = _finite_range(run.history["stress"])[0] / 1e6
    axes.set(xlabel="compressive strain (%)", ylabel="compressive stress (MPa)",
             xlim=(0, max(100 * end, 1e-9)), ylim=(max(min(low, 0), -0.1 * top / 1e6), top / 1e6))
    _grid(axes)
    axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.16), ncols=2,
                handlelength=1.7, columnspacing=1.4)


def draw_energies(axes, run):
    """Energies over strain, or time: those of the history that are ever above zero, J (in the plane
    of the whole thickness)."""
    along, title = run_axis(run)
    shown = [row for row in ENERGIES
             if row[0] in run.history and numpy.nanmax(numpy.abs(run.history[row[0]])) > 0]
    largest = max((_finite_range(numpy.abs(run.history[row[0]]))[1] for row in shown), default=1.0)
    factor, unit = prefixed(largest, "J")
    for name, label, colour, width in shown:
        axes.plot(along, run.history[name] / factor, color=colour, lw=width, label=label,
                  ls="--" if name == "external_work" else "-")
    axes.set(xlabel=title, ylabel=f"energy ({unit})", xlim=(along[0], along[-1]))
    _grid(axes)
    axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.16), ncols=3,
                handlelength=1.7, columnspacing=1.4)


def draw_energy_error(axes, run):
    """energy_error of the history in % over strain, or time. The first hundredth of the run, where
    hardly any work has been done, does not decide the range."""
    along, title = run_axis(run)
    error = 100 * run.history["energy_error"]
    axes.axhline(0, color=INK, lw=0.8)
    axes.plot(along, error, color=BLUE, lw=1.5)
    later = error[along >= along[0] + 0.01 * (along[-1] - along[0])]
    reach = max(1.15 * max(map(abs, _finite_range(later if len(later) else error))), 1e-3)
    axes.set(xlabel=title, ylabel="energy error (% of the work)", xlim=(along[0], along[-1]),
             ylim=(-reach, reach))
    _grid(axes)


def scale_bar_length(width):
    """A round length [m] of about a fifth of the width."""
    power = 10.0 ** math.floor(math.log10(width / 5))
    return max(step * power for step in (1, 2, 5) if step * power <= width / 5)


def length_text(length):
    factor, unit = prefixed(1.0001 * length, "m")
    return f"{length / factor:.3g} {unit}"


def draw_scale_bar(axes, width):
    """A bar of a round length below the left end of the axes, whose unit is the metre."""
    length = scale_bar_length(width)
    left = axes.get_xlim()[0]
    across = axes.get_xaxis_transform()
    axes.plot([left, left + length], [-0.045, -0.045], transform=across, color=INK, lw=3,
              clip_on=False, solid_capstyle="butt")
    axes.text(left, -0.075, length_text(length), transform=across, va="top", ha="left", fontsize=9)


def draw_structure(axes, painting, canvas, norm, colours):
    """A painting of raster.paint in its place, without ticks, unpainted where there is nothing.
    Returns what a colour bar takes."""
    image = axes.imshow(numpy.ma.masked_invalid(painting), origin="lower", extent=canvas.extent,
                        norm=norm, cmap=matplotlib.colormaps[colours], interpolation="nearest")
    axes.set(xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set(visible=True, color=PALE)
    return image


def draw_snapshot(axes, run, snapshot, field, limits=None, colours="viridis"):
    """A run's structure coloured by a field of one value a particle, in the field's unit; in space
    a section half way through. `limits`: of the colours (those of the snapshot). Returns what a
    colour bar takes. Raises ResultsError if there is no such field."""
    edge = raster.edge_of(snapshot, run.thickness, run.is_in_space)
    bounds = snapshot.bounds()
    view = section_of(run, snapshot, bounds)
    canvas = raster.canvas_of(bounds, view, edge)
    painting = raster.paint(snapshot, lambda values: values, [field], view, canvas, edge)
    norm = Normalize(*(limits or (numpy.nanmin(painting), numpy.nanmax(painting))))
    return draw_structure(axes, painting, canvas, norm, colours)


def section_of(run, snapshot, bounds, place=None):
    """The View of a run: the plane itself; in space x and y half way through the depth, or, if the
    piston moves along z, z and x half way through the height; or at `place` [m] instead."""
    if not run.is_in_space:
        return raster.View((0, 1))
    axes, normal = (((2, 0), 1) if run.axis == 2 else ((0, 1), 2))
    edge = raster.edge_of(snapshot, run.thickness, run.is_in_space)
    low, high = bounds[:, normal]
    if place is not None and not low <= place <= high:
        raise ResultsError(f"the section at {length_text(place)} does not meet the specimen, which "
                           f"reaches from {length_text(low)} to {length_text(high)} along "
                           f"{'xyz'[normal]}. Name a place there.")
    return raster.View(axes, normal, 0.5 * (low + high) if place is None else place,
                       raster.layer_of(snapshot, normal, edge))

