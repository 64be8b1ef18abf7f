"""Writes docs/formulations.md and its figures from the files in docs/formulations.

    formulations_page.py [--check]    --check: only says whether the page is the one that would be written
"""
import json
import sys
from pathlib import Path

import numpy

import runs
from words import giga, mega, percent, points, seconds, table, wrapped

FOLDER = runs.PROJECT / "docs" / "formulations"
PAGE = runs.PROJECT / "docs" / "formulations.md"
TEXT = Path(__file__).with_name("formulations_page.md")
METHODS = {"updated": "updated Lagrangian", "total": "total Lagrangian"}
STRAIN = 0.4


def rows():
    found = [row for row in runs.read_rows("ladders.csv", FOLDER) if row["status"] == "ok"]
    return sorted(found, key=lambda row: (row["geometry"], row["method"] == "total", row["k"]))


def geometries(found):
    return list(dict.fromkeys(row["geometry"] for row in found))


def ladder(found, geometry, method):
    return [row for row in found if row["geometry"] == geometry and row["method"] == method]


def limit(found, geometry):
    """Work that finer cells would go to, J/m3, and how it is known: Richardson's of the three finest
    levels of the total Lagrangian step with an order from 0.5 to 3, else its finest level."""
    levels = ladder(found, geometry, "total")
    if len(levels) > 2:
        coarse, middle, fine = (row["work"] for row in levels[-3:])
        ratio = (coarse - middle) / (middle - fine) if middle != fine else 0
        if 2 ** 0.5 <= ratio <= 2 ** 3:
            return fine - (middle - fine) / (ratio - 1), "extrapolated"
    return levels[-1]["work"], f"{levels[-1]['cells']:.0f} cells"


def error(row, found):
    return row["work"] / limit(found, row["geometry"])[0] - 1


def geometry_table(found, geometry):
    lines = []
    for method in METHODS:
        for row in ladder(found, geometry, method):
            wall = row.get("overlapped_area")
            lines.append([METHODS[method], f"{row['cells']:.0f}", seconds(row["seconds"]),
                          giga(row["modulus"]), mega(row["plateau_stress"]),
                          f"{row['work'] / 1e6:.4g}", percent(error(row, found)),
                          percent(row["largest_energy_error"]),
                          "-" if wall is None else percent(wall / wall_area(row))])
    return table(["formulation", "cells", "run time", "modulus [GPa]", "plateau [MPa]",
                  "work [MJ/m3]", "error of the work", "energy error", "overlap"], lines)


def wall_area(row):
    return row["particles"] * row["location_area"]


def cheaper(found, geometry):
    """Run times of the updated step at the errors of the total one: on the power law through its two
    finest levels where no level has that error."""
    updated = ladder(found, geometry, "updated")
    lines = []
    for row in ladder(found, geometry, "total"):
        aim = abs(error(row, found))
        if aim < 0.005:
            continue  # of the limit itself as little is known
        last, finest = updated[-2:]
        e1, e2 = abs(error(last, found)), abs(error(finest, found))
        slope = numpy.log(finest["seconds"] / last["seconds"]) / numpy.log(e1 / e2)
        time = finest["seconds"] * (e2 / aim) ** slope
        lines.append([geometry.replace("_", " "), f"{row['cells']:.0f}", percent(aim),
                      seconds(row["seconds"]), seconds(time), f"{time / row['seconds']:.2g}"])
    return lines


def curves():
    data = numpy.genfromtxt(FOLDER / "ladders_curves.csv", delimiter=",", names=True,
                            deletechars="", replace_space="_")
    return data


def draw(found):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    names = geometries(found)
    across = 3
    high = -(-len(names) // across)
    data = curves()
    figure, axes = pyplot.subplots(high, across, figsize=(12, 3.2 * high))
    for axis, name in zip(axes.flat, names):
        top = 0
        for method, colours, line in (("updated", "Blues", "--"), ("total", "Oranges", "-")):
            levels = ladder(found, name, method)
            for n, row in enumerate(levels):
                stress = data[f"{name}_{method}_{row['cells']:.0f}"] / 1e6
                top = max(top, numpy.interp(0.3, data["strain"], stress)) if method == "total" else top
                axis.plot(100 * data["strain"], stress, line, linewidth=1.2,
                          color=pyplot.get_cmap(colours)(0.35 + 0.6 * (n + 1) / len(levels)),
                          label=f"{method}, {row['cells']:.0f}")
        axis.set(title=name.replace("_", " "), ylim=(0, 2.5 * top))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6)
    for axis in axes[-1]:
        axis.set_xlabel("strain [%]")
    for axis in axes[:, 0]:
        axis.set_ylabel("stress [MPa]")
    figure.tight_layout()
    figure.savefig(FOLDER / "curves.png", dpi=80)
    figure, axes = pyplot.subplots(high, across, figsize=(12, 3.2 * high), sharex=True)
    for axis, name in zip(axes.flat, names):
        for method, colour in (("updated", "tab:blue"), ("total", "tab:orange")):
            levels = [row for row in ladder(found, name, method) if abs(error(row, found)) > 1e-9]
            axis.loglog([row["seconds"] for row in levels],
                        [100 * abs(error(row, found)) for row in levels], "o-", color=colour,
                        label=method)
        axis.set(title=name.replace("_", " "))
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    for axis in axes[-1]:
        axis.set_xlabel("run time [s]")
    for axis in axes[:, 0]:
        axis.set_ylabel("error of the work [%]")
    figure.tight_layout()
    figure.savefig(FOLDER / "errors.png", dpi=80)


def written():
    found = rows()
    machine = json.loads((FOLDER / "machine.json").read_text())
    parts = []
    for name in geometries(found):
        value, how = limit(found, name)
        parts.append(f"**{name.replace('_', ' ').capitalize()}** (limit of the work "
                     f"{value / 1e6:.4g} MJ/m3, {how})\n\n{geometry_table(found, name)}")
    ratios = [line for name in geometries(found) for line in cheaper(found, name)]
    values = {
        "machine": f"{machine['cores']} cores of an {machine['processor']} processor, "
                   f"{machine['memory_gib']:.0f} GiB, {machine['compiler']}",
        "version": f"{machine['mpm_par']} ({machine['git']})",
        "ladders": "\n\n".join(parts),
        "ratios": table(["geometry", "cells, total Lagrangian", "error of the work", "run time",
                         "updated step to the same error", "ratio"], ratios)}
    page = TEXT.read_text()
    for key, value in values.items():
        if "{" + key + "}" not in page:
            raise RuntimeError(f"{TEXT.name} does not use {key}")
        page = page.replace("{" + key + "}", value.rstrip("\n"))
    return wrapped(page)


def main():
    page = written()
    if "--check" in sys.argv[1:]:
        if PAGE.read_text() != page:
            sys.exit(f"{PAGE} is not what {Path(__file__).name} writes: run it")
        return
    PAGE.write_text(page)
    draw(rows())


if __name__ == "__main__":
    main()
