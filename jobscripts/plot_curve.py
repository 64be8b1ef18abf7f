#!/usr/bin/env python3
"""Draws the stress-strain curve of a crushed specimen.

    python3 jobscripts/plot_curve.py results/loblolly_radial/history.csv [-o curve.png]

Reads history.csv (columns strain, stress_piston, stress_edge) and, if it lies beside it,
summary.json (modulus, onsets of buckling and densification), prints those properties and draws
all of it into curve.png beside the history.
"""
import argparse
import csv
import json
import math
import sys
from pathlib import Path

CURVES = (("stress_piston", "at the piston", "#2e86c1", 2.2),
          ("stress_edge", "at the fixed edge", "#ca6f1e", 0.8))
ONSETS = (("buckling", "onset of buckling", "o"), ("densification", "onset of densification", "s"))


def read_history(path):
    """Columns by name without the unit: the header reads `strain [1],stress_piston [Pa]`."""
    with open(path, newline="") as file:
        header, *lines = list(csv.reader(file)) or [[]]
    if len(lines) < 2:
        raise ValueError(f"holds {len(lines)} lines of values, and a curve needs two")
    names = [title.split("[")[0].strip() for title in header]
    columns = dict(zip(names, zip(*[[float(value) for value in line] for line in lines])))
    missing = {"strain", "stress_piston"} - columns.keys()
    if missing:
        raise ValueError(f"no column {', '.join(sorted(missing))} (there are: {', '.join(names)})")
    return columns


def read_properties(path):
    """The part `compression` of summary.json, in SI units; empty without one."""
    if not path.exists():
        return {}, {}
    summary = json.loads(path.read_text())
    return summary, summary.get("compression") or {}


def describe(properties):
    modulus = properties.get("modulus")
    yield "modulus E", "not found" if modulus is None else f"{modulus / 1e6:.0f} MPa"
    for key, name, _ in ONSETS:
        onset = properties.get(key)
        yield name, ("not found" if not onset else
                     f"{onset['stress'] / 1e6:.1f} MPa at {100 * onset['strain']:.2f} % strain")
    if properties.get("remark"):
        yield "remark", properties["remark"]


def draw_plateau(axes, properties, top):
    """The lines that meet in the onset of densification, which need not lie on the curve."""
    buckling, densification = properties.get("buckling"), properties.get("densification")
    if not buckling or not densification or "plateau_slope" not in properties:
        return
    start, corner = ((100 * p["strain"], p["stress"] / 1e6) for p in (buckling, densification))
    slope = properties["densification_slope"] / 1e8  # MPa per % strain
    line = {"color": "#222222", "lw": 0.9, "ls": ":", "zorder": 4}
    axes.plot([start[0], corner[0]], [start[1], corner[1]], **line, label="plateau, densification")
    if slope > 0:
        end = corner[0] + min(top - corner[1], 4 * corner[1]) / slope
        axes.plot([corner[0], end], [corner[1], corner[1] + slope * (end - corner[0])], **line)


def draw(columns, properties, title, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = pyplot.subplots(figsize=(7.2, 4.6), layout="constrained")
    strain = [100 * value for value in columns["strain"]]
    for column, label, colour, width in CURVES:
        if column in columns:
            axes.plot(strain, [value / 1e6 for value in columns[column]], color=colour, lw=width,
                      label=label, zorder=2)
    finite = [value / 1e6 for value in columns["stress_piston"] if math.isfinite(value)]
    top = 1.05 * max(finite, default=1)

    onsets = [(properties[key], name, marker) for key, name, marker in ONSETS if properties.get(key)]
    if properties.get("modulus") is not None:
        # The line that the modulus is the slope of, drawn beyond the first onset to be seen.
        end = 1.8 * onsets[0][0]["strain"] if onsets else 0.02
        intercept = properties.get("elastic_intercept") or 0
        axes.plot([0, 100 * end],
                  [intercept / 1e6, (intercept + properties["modulus"] * end) / 1e6], "--",
                  color="#222222", lw=1.3, zorder=4,
                  label=f"E = {properties['modulus'] / 1e6:.0f} MPa")
    draw_plateau(axes, properties, top)
    for onset, name, marker in onsets:
        axes.plot(100 * onset["strain"], onset["stress"] / 1e6, marker, color="#b03a2e", ms=7,
                  mec="white", zorder=5, label=f"{name}: {onset['stress'] / 1e6:.1f} MPa "
                                               f"at {100 * onset['strain']:.1f} %")
    if properties.get("densification"):
        # Solid contact at the end is many times the plateau and would press it flat.
        top = min(top, 5 * properties["densification"]["stress"] / 1e6)

    axes.set(xlabel="compressive strain (%)", ylabel="compressive stress (MPa)", title=title,
             xlim=(0, max(strain)), ylim=(min(0, max(min(finite, default=0), -0.1 * top)), top))
    axes.grid(color="#dddddd", lw=0.6)
    axes.legend(frameon=False, loc="best")
    figure.savefig(path, dpi=160)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("history", type=Path, help="history.csv of a run")
    arguments.add_argument("-o", "--output", type=Path, help="picture (default: curve.png beside it)")
    given = arguments.parse_args()
    summary_file = given.history.with_name("summary.json")
    try:
        columns = read_history(given.history)
        summary, properties = read_properties(summary_file)
    except OSError as error:
        sys.exit(f"plot_curve.py: {error.filename}: {error.strerror}")
    except ValueError as error:
        sys.exit(f"plot_curve.py: {given.history.parent}: history.csv or summary.json: {error}")
    if properties:
        for name, value in describe(properties):
            print(f"  {name:24}{value}")
    output = given.output or given.history.with_name("curve.png")
    title = summary.get("title") or summary.get("name") or given.history.resolve().parent.name
    try:
        draw(columns, properties, title, output)
    except ImportError as error:
        sys.exit(f"plot_curve.py: no picture drawn: {error} (package python3-matplotlib)")
    print(f"  {'curve':24}{output}")


if __name__ == "__main__":
    main()
