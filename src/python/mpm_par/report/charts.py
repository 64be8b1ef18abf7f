"""Curves of a report: stress, energies, windows, ranks."""
import numpy

from mpm_par import pictures
from mpm_par.report import drawing

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#aa4499", "#e69f00", "#56b4e9", "#555555")


def curve(run, bars):
    """Stress over strain with its construction lines."""
    found = run.properties
    points = [f"{name} at {100 * found[key]['strain']:.3g} % strain and "
              f"{found[key]['stress'] / 1e6:.3g} MPa"
              for key, name in (("buckling", "onset of buckling"),
                                ("densification", "onset of densification")) if found.get(key)]
    if found.get("toe"):
        points.insert(0, f"modulus beyond the toe {found['toe']['modulus'] / 1e6:.4g} MPa")
    if found.get("modulus"):
        points.insert(0, f"modulus {found['modulus'] / 1e6:.4g} MPa")
    last = 100 * run.history["strain"][-1]
    highest = numpy.nanmax(run.history["stress"]) / 1e6
    caption = ("Stress at the piston and at the fixed edge over the first cross-section, and their "
               "mean, which is the curve to read. ")
    caption += ("Lines and points are those of summary.json, as mpm_curve reads them off the mean. "
                if found else "The run has no summary, so no lines are drawn into the curve. ")
    if bars is not None:
        caption += "Bars are the numerical errors that mpm_study --error-bar estimates. "
    elif found.get("buckling"):
        caption += "Bars, where they can be seen, are the error of reading the curve. "
    top = pictures.curve_top(run) / 1e6
    if highest > 1.05 * top:
        caption += f"The curve goes on to {highest:.4g} MPa."
    alt = f"Stress over strain to {last:.3g} % strain; " + (", ".join(points) or "no onsets") + "."
    return drawing.plot("curve", lambda axes: pictures.draw_curve(axes, run, bars), alt,
                        caption.strip(), height=4.6)


def energies(run):
    """Where the work goes, and what the balance is off."""
    history = run.history
    over = "strain" if run.axis is not None else "time"
    work, plastic = history["external_work"][-1], history["plastic_work"][-1]
    share = ""
    if work > 0:
        share = f" Plastic work is {100 * plastic / work:.3g} % of the work at the end."
    of = "" if run.is_in_space else f" Energies are those of a specimen {run.thickness:g} m thick."
    error = 100 * history["energy_error"][-1]
    error = f"{error:.2g} %" if abs(error) >= 1e-4 else "below 0.0001 %"
    return [drawing.plot("energies", lambda axes: pictures.draw_energies(axes, run),
                         f"Energies over {over}.{share}",
                         "Where the work done on the specimen goes." + of + share, height=4.3),
            drawing.plot("energy_error", lambda axes: pictures.draw_energy_error(axes, run),
                         f"Energy error over {over}: {error} of the work at the end.",
                         "What the energy balance is off, as a share of the work done: how far to "
                         f"trust the run. At the end {error}.", height=3.6)]


def windows(run, names, shares):
    """The windows' shares of the plastic work at each snapshot, shape (snapshots, windows)."""
    strain = [snapshot.strain * 100 if run.axis is not None else snapshot.time
              for snapshot in run.snapshots]
    factor, title = 1.0, "compressive strain (%)"
    if run.axis is None:
        factor, unit = pictures.prefixed(strain[-1], "s")
        title = f"time ({unit})"
    along = numpy.array(strain) / factor

    def draw(axes):
        for k, name in enumerate(names):
            axes.plot(along, 100 * shares[:, k], "o-", ms=4, lw=1.5, label=name,
                      color=COLOURS[k % len(COLOURS)])
        axes.set(xlabel=title, ylabel="share of plastic work (%)", ylim=(0, 100),
                 xlim=(along[0], max(along[-1], 1e-300)))
        axes.grid(color="#e6e8eb", lw=0.7)
        axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.17), ncols=3)

    last = ", ".join(f"{name} {100 * share:.3g} %" for name, share in zip(names, shares[-1])
                     if numpy.isfinite(share))
    return drawing.plot("windows", draw, f"Shares of plastic work; at the end {last}.",
                        "Share of each window in all plastic work done so far, at each snapshot. A "
                        "window is a part of the specimen as it was at the start, and keeps its "
                        "cell walls wherever they go.", height=3.9)


def ranks(run):
    """Particles of each rank at the first and the last snapshot; None if that was not written."""
    if not run.snapshots or "rank" not in run.snapshots[0] or run.summary["ranks"] < 2:
        return None
    blocks = [[rank for rank, in snapshot.blocks("rank")]
              for snapshot in (run.snapshots[0], run.snapshots[-1])]
    # A run may have begun on more ranks than it ended on.
    count = max(run.summary["ranks"], *(rank.max(initial=-1) + 1 for part in blocks for rank in part))
    counts = [sum(numpy.bincount(rank, minlength=count) for rank in part) for part in blocks]
    numbers = numpy.arange(len(counts[0]))

    def draw(axes):
        for k, (count, name) in enumerate(zip(counts, ("at the start", "at the end"))):
            axes.bar(numbers + 0.4 * (k - 0.5), count, 0.38, color=COLOURS[k], label=name)
        axes.axhline(counts[1].mean(), color=pictures.INK, lw=0.9, ls="--", label="mean")
        axes.set(xlabel="rank", ylabel="particles")
        axes.xaxis.get_major_locator().set_params(integer=True)
        axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.46, -0.17), ncols=3)

    return drawing.plot("ranks", draw,
                        f"Particles of {len(numbers)} ranks; at the end from {counts[1].min()} to "
                        f"{counts[1].max()}.", "Particles of each rank.", height=3.4)
