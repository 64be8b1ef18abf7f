"""The parts of docs/accuracy.md on the loblolly model."""
import analysis
import results
from words import giga, mega, percent, points, seconds, table

GEOMETRIES = {"picture": "the picture sampled at every level",
              "fixed": "the geometry of 150 locations across held fixed"}


def methods():
    return list(dict.fromkeys(row["method"] for row in analysis.read("loblolly.csv")))


def ladder(method, geometry):
    return analysis.ladder("loblolly", method, geometry)


def levels(geometry):
    heads = ["method", "cells (particles) across", "particles", "run time", "modulus [GPa]",
             "plateau [MPa]", "onset of densification", "closing strain", "work [MJ/m3]",
             "whole curve, from the finest"]
    lines = []
    for method in methods():
        rows = ladder(method, geometry)
        for row in rows:
            from_finest = analysis.change("loblolly", row, rows[-1], "curve")
            lines.append([method.replace(" ", ", "), f"{row['cells']:.0f} ({2 * row['cells']:.0f})",
                          f"{row['particles']:,.0f}", seconds(row["seconds"]), giga(row["modulus"]),
                          mega(row["plateau_stress"]), points(row["densification_strain"]),
                          points(analysis.closing_strain("loblolly", row)), mega(row["work"]),
                          percent(from_finest) if row is not rows[-1] else "-"])
    return table(heads, lines)


UNITS = {"modulus": lambda value: giga(value) + " GPa",
         "plateau_stress": lambda value: mega(value) + " MPa",
         "densification_strain": points, "closing_strain": points,
         "work": lambda value: mega(value) + " MJ/m3"}


def last_level(method, geometry, figure):
    return [row for row in ladder(method, geometry)
            if analysis.value("loblolly", row, figure) is not None][-1]


def limits():
    """Observed orders and limits, of four levels or more."""
    heads = ["figure", "geometry", "method", "orders of successive triples", "Richardson's limit",
             "finest level is off by"]
    lines = []
    for figure, words in analysis.FIGURES.items():
        for geometry in GEOMETRIES:
            for method in methods():
                rows = ladder(method, geometry)
                found = analysis.limit("loblolly", analysis.for_orders(rows), figure)
                if found is None:
                    continue
                orders = ", ".join("-" if order is None else f"{order:.1f}" for order in found.orders)
                line = [words, geometry, method.replace(" ", ", "), orders]
                if found.warnings or found.value is None:
                    lines.append([*line, "not justified", ""])
                    continue
                finest = analysis.value("loblolly", last_level(method, geometry, figure), figure)
                shown = "a curve" if figure == "curve" else UNITS[figure](float(found.value))
                lines.append([*line, shown, percent(results.relative_error(finest, found.value))])
    return table(heads, lines)


def parts(method):
    """Error of the grid and of the picture at the coarsest level, against the finest level of both."""
    heads = ["figure", "75 cells", "geometry of 75 cells, finest grid", "finest picture",
             "grid", "picture"]
    fixed, picture = ladder(method, "fixed"), ladder(method, "picture")
    cells = max({row["cells"] for row in fixed} & {row["cells"] for row in picture})
    fine_fixed, fine_picture = (next(row for row in rows if row["cells"] == cells)
                                for rows in (fixed, picture))
    lines = []
    for figure, unit in UNITS.items():
        coarse, sharp, whole = (analysis.value("loblolly", row, figure)
                                for row in (fixed[0], fine_fixed, fine_picture))
        lines.append([analysis.FIGURES[figure], unit(coarse), unit(sharp), unit(whole),
                      f"{100 * (coarse - sharp) / whole:+.0f} %",
                      f"{100 * (sharp - whole) / whole:+.0f} %"])
    grid, drawn = (analysis.change("loblolly", *pair, "curve")
                   for pair in ((fixed[0], fine_fixed), (fine_fixed, fine_picture)))
    lines.append(["whole curve", "", "", "", percent(grid), percent(drawn)])
    return cells, table(heads, lines)


def fine(method):
    """Levels of the picture from which first order is carried to h = 0."""
    return [row for row in ladder(method, "picture") if row["cells"] >= 150]


def users(method):
    """What a user's resolution is worth and what 5 % and 1 % would take."""
    rows = fine(method)
    last = rows[-1]["cells"]
    heads = ["figure", "line at h = 0", "levels off the line by", "error at 75 cells", "at 150",
             f"at {last:.0f}", "cells for 5 %", "run time", "cells for 1 %", "run time"]
    lines = []
    for figure, words in analysis.FIGURES.items():
        if figure == "densification_strain":
            continue
        at_zero, _, off = analysis.first_order("loblolly", rows, figure)
        line = [words, "a curve" if figure == "curve" else UNITS[figure](float(at_zero)), percent(off)]
        line += [percent(analysis.first_order_error("loblolly", rows, figure, cells))
                 for cells in (75, 150, last)]
        for error in (0.05, 0.01):
            cells = analysis.cells_for("loblolly", rows, figure, error)
            line += [f"{cells:,.0f}", seconds(analysis.seconds_at(rows, cells))]
        lines.append(line)
    return table(heads, lines)
