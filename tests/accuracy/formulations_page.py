"""Writes docs/formulations.md and its figures from the files in docs/formulations.

    formulations_page.py [--check]    --check: only says whether the page is the one that would be written
"""
import functools
import json
from pathlib import Path

import numpy

import runs
import results
from words import filled_in, finished, percent, seconds
from written_page import table, write_or_check

PAGE = runs.PROJECT / "docs" / "formulations.md"
FOLDER = runs.PROJECT / "docs" / "formulations"
TEXT = Path(__file__).with_name("formulations_page.md")
METHODS = {"updated": "updated", "total": "total"}
KNOWN = 0.05  # errors below are not told from the reference's own
NAMES = {"ring": "ring, wall of a tenth of its diameter", "thin_ring": "ring, half of that",
         "earlywood": "loblolly, crop of earlywood", "latewood": "loblolly, crop of latewood",
         "loblolly_radial": "loblolly, radial", "loblolly_tangential": "loblolly, tangential",
         "poplar_radial": "poplar, radial", "poplar_tangential": "poplar, tangential",
         "ponderosa_tangential": "ponderosa, tangential", "spruce": "spruce (a real micrograph)",
         "lomatia": "Lomatia (a real micrograph)"}

read = functools.cache(lambda name: runs.read_rows(name, FOLDER))


def geometries(file="ladders.csv"):
    return list(dict.fromkeys(row["geometry"] for row in read(file)))


def ladder(geometry, method):
    """Rows of a ladder that ended, the coarsest first."""
    found = [row for row in read("ladders.csv") if row["status"] == "ok"
             and (row["geometry"], row["method"]) == (geometry, method)]
    return sorted(found, key=lambda row: row["k"])


def curve(row):
    """Strains and stresses, Pa."""
    name = f"{row['geometry']} {row['method']} {row['cells']:.0f}"
    lines = read("ladders_curves.csv")
    return (numpy.array([line["strain"] for line in lines]),
            numpy.array([line[name] for line in lines]))


def reference(geometry):
    """The finest run of the total formulation."""
    return ladder(geometry, "total")[-1]


def work_error(row):
    return row["work"] / reference(row["geometry"])["work"] - 1


def curve_error(row):
    return results.relative_error(curve(row)[1], curve(reference(row["geometry"]))[1])


def levels():
    """Every run."""
    heads = ["geometry", "formulation", "cells", "particles", "run time", "modulus [GPa]",
             "plateau [MPa]", "work [MJ/m3]", "work, from the reference", "curve, from the reference",
             "energy error", "overlap"]
    lines = []
    for geometry in geometries():
        for method, words in METHODS.items():
            for row in ladder(geometry, method):
                own = row is reference(geometry)
                lines.append([NAMES[geometry], words, f"{row['cells']:.0f}",
                              f"{row['particles']:,.0f}", seconds(row["seconds"]),
                              f"{row['modulus'] / 1e9:.3g}" if row["modulus"] else "-",
                              f"{row['plateau_stress'] / 1e6:.3g}", f"{row['work'] / 1e6:.3g}",
                              "-" if own else f"{100 * work_error(row):+.3g} %",
                              "-" if own else percent(curve_error(row)),
                              percent(row["largest_energy_error"]), percent(overlap(row))])
    return table(heads, lines)


def overlap(row):
    """The most that lies upon each other, over the area of the wall."""
    if row.get("overlapped_area") is None:
        return None
    return row["overlapped_area"] / (row["particles"] * row["location_area"])


def at_zero(rows):
    """What the straight line through the work of the last two levels has at h = 0."""
    (h1, w1), (h2, w2) = ((1 / row["cells"], row["work"]) for row in rows[-2:])
    return w2 - h2 * (w1 - w2) / (h1 - h2)


def limit_of(rows):
    """What the work of the last three levels, each of half the spacing, tends to; None where their changes do not
    fall regularly, by half or near it."""
    if len(rows) < 3:
        return None
    first, second, last = (row["work"] for row in rows[-3:])
    falls = (first - second) / (second - last)
    return last - (second - last) / (falls - 1) if 1.5 < falls < 4.5 else None


def meeting():
    """Whether the formulations go to the same answer."""
    heads = ["geometry", "total, finest", "updated, finest", "updated, carried to h = 0",
             "of the updated one's change from its coarsest level, toward the total one",
             "total, carried on along its last three levels", "its last two are above that by"]
    lines = []
    for geometry in geometries():
        updated, total = ladder(geometry, "updated"), ladder(geometry, "total")
        if len(updated) < 2:
            continue
        finest = total[-1]["work"]
        gone = (updated[0]["work"] - updated[-1]["work"]) / (updated[0]["work"] - finest)
        limit = limit_of(total)
        above = [f"{100 * (row['work'] / limit - 1):+.2g}" for row in total[-2:]] if limit else []
        lines.append([NAMES[geometry], f"{finest / 1e6:.3g} ({total[-1]['cells']:.0f} cells)",
                      f"{updated[-1]['work'] / 1e6:.3g} ({updated[-1]['cells']:.0f} cells)",
                      f"{at_zero(updated) / 1e6:.3g}", f"{100 * gone:.0f} %",
                      f"{limit / 1e6:.3g}" if limit else "-", f"{' and '.join(above)} %" if limit else "-"])
    return table(heads, lines)


def time_for(rows, error):
    """Run time of a ladder for this error of the work, and whether it is beyond its levels: along
    the line of the last two levels' logarithms."""
    known = [(abs(work_error(row)), row["seconds"]) for row in rows]
    for (first, start), (second, end) in zip(known, known[1:]):
        if second <= error <= first:
            share = numpy.log(first / error) / numpy.log(first / second)
            return start * (end / start) ** share, False
    (first, start), (second, end) = known[-2:]
    if not 0 < second < first or error > known[0][0]:
        return None, False
    return end * (end / start) ** (numpy.log(second / error) / numpy.log(first / second)), True


def equal_errors():
    """What the updated step takes to have the error that the total one has."""
    heads = ["geometry", "total: cells", "run time", "error of the work",
             "updated: run time for that error", "ratio"]
    lines = []
    for geometry in geometries():
        updated = ladder(geometry, "updated")
        for row in ladder(geometry, "total")[:-1]:
            error = abs(work_error(row))
            if len(updated) < 2 or error < KNOWN:
                continue
            found, beyond = time_for(updated, error)
            line = [NAMES[geometry], f"{row['cells']:.0f}", seconds(row["seconds"]), percent(error)]
            if found is None:
                lines.append([*line, "not to be said", "-"])
                continue
            note = " (extrapolated)" if beyond else ""
            lines.append([*line, seconds(found) + note, f"{found / row['seconds']:.3g}"])
    return table(heads, lines)


def hinges():
    """Work at the two coarsest levels with hinges as they are, cut and filled."""
    lines = []
    for geometry in geometries("hinges.csv"):
        kept = ladder(geometry, "total")[:2]
        cases = {"as they are": kept}
        for how in ("cut", "filled"):
            rows = [row for row in read("hinges.csv") if (row["geometry"], row["hinges"]) == (geometry, how)]
            cases[f"{how}, {rows[0]['changed']:.0f} locations"] = rows
        for how, (first, second) in cases.items():
            lines.append([NAMES[geometry], how, f"{first['work'] / 1e6:.3g}", f"{second['work'] / 1e6:.3g}",
                          f"{100 * (second['work'] / first['work'] - 1):+.3g} %",
                          f"{100 * (second['work'] / kept[1]['work'] - 1):+.3g} %"])
    return table(["geometry", "hinges", "work [MJ/m3], 75 cells", "150 cells", "change",
                  "150 cells, from hinges as they are"], lines)


def anew():
    """Work of pictures that are sampled anew at every level, beside that of one geometry."""
    lines = []
    for geometry in geometries("anew.csv"):
        own = [row for row in read("anew.csv") if row["geometry"] == geometry]
        for words, found in (("of 75 cells", ladder(geometry, "total")[:len(own)]), ("sampled anew", own)):
            works = [row["work"] for row in found]
            steps = [f"{100 * (fine / coarse - 1):+.2g} %" for coarse, fine in zip(works, works[1:])]
            blank = ["-"] * (3 - len(works))
            lines.append([NAMES[geometry], words, *(f"{work / 1e6:.3g}" for work in works), *blank, *steps, *blank])
    return table(["geometry", "picture", "work [MJ/m3], 75 cells", "150 cells", "300 cells", "75 to 150", "150 to 300"],
                 lines)


def stopped():
    found = [f"{NAMES[row['geometry']]}, {METHODS[row['method']]}, {row['cells']:.0f} cells: "
             f"{row['status'].split(': ', 1)[-1].split(',')[0]}"
             for row in read("ladders.csv") if row["status"] != "ok"]
    return "Runs that stopped:\n\n- " + "\n- ".join(found) if found else "No run stopped."


def machine():
    return json.loads((FOLDER / "machine.json").read_text())


def values():
    """What stands in braces in formulations_page.md."""
    here = machine()
    return {"machine": f"{here['cores']} cores of an {here['processor']} processor, "
                       f"{here['memory_gib']:.0f} GiB, {here['compiler']}",
            "version": f"{here['mpm_par']} ({here['git']})",
            "levels": levels(), "stopped": stopped(), "hinges": hinges(), "anew": anew(),
            "meeting": meeting(), "equal_errors": equal_errors()}


def written():
    return finished(TEXT, filled_in(TEXT, values()))


def draw():
    """curves.png: stress over strain of every level; errors.png: error of the work over run time."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    colours = {"updated": pyplot.cm.Blues, "total": pyplot.cm.Oranges}
    shown = geometries()
    for name in ("curves", "errors"):
        rows = -(-len(shown) // 3)
        figure, axes = pyplot.subplots(rows, 3, figsize=(11, 2.9 * rows))
        for axis in axes.flat[len(shown):]:
            axis.axis("off")
        for axis, geometry in zip(axes.flat, shown):
            for method, words in METHODS.items():
                found = ladder(geometry, method)
                if name == "errors":
                    found = [row for row in found if row is not reference(geometry)]
                    axis.loglog([row["seconds"] for row in found],
                                [100 * abs(work_error(row)) for row in found], "o-", markersize=4,
                                color=colours[method](0.7), label=words)
                    continue
                for k, row in enumerate(found):
                    strain, stress = curve(row)
                    axis.plot(100 * strain, stress / 1e6, linewidth=1,
                              color=colours[method](0.35 + 0.6 * (k + 1) / len(found)),
                              label=f"{words}, {row['cells']:.0f} cells")
            axis.set_title(NAMES[geometry], fontsize=9)
            axis.grid(alpha=0.3)
            axis.legend(fontsize=6)
        for axis in axes.flat[:len(shown)]:
            if name == "curves":
                axis.set_xlabel("strain [%]", fontsize=8)
                axis.set_ylabel("stress [MPa]", fontsize=8)
                top = numpy.percentile(numpy.concatenate([line.get_ydata() for line in axis.lines]), 97)
                axis.set_ylim(0, top)
            else:
                axis.set_xlabel("run time on one core [s]", fontsize=8)
                axis.set_ylabel("error of the work [%]", fontsize=8)
        figure.tight_layout()
        figure.savefig(FOLDER / f"{name}.png", dpi=90)
        pyplot.close(figure)


def main():
    if write_or_check(PAGE, written()):
        draw()


if __name__ == "__main__":
    main()
