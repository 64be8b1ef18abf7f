"""The parts of docs/accuracy.md on the loblolly model."""
import analysis
import results
from words import giga, mega, percent, points, seconds
from written_page import table

GEOMETRIES = ("picture", "fixed")
FARTHEST = 0.5  # an extrapolation that moves a figure by more is none
# Figures that lie on straight lines over h. The whole curve and the work do not: they hold the steep
# end of the curve, which the closing strain moves.
QUOTED = ("modulus", "plateau_stress", "closing_strain")


def methods():
    return analysis.ladder_methods("loblolly")


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


def variants(cells):
    """Every other method at one level of the picture, and where the line of the default ends."""
    heads = ["method", "run time", "modulus [GPa]", "plateau [MPa]", "closing strain",
             "work [MJ/m3]", "energy error"]
    lines = []
    for method in [*methods(), *analysis.VARIANTS]:
        row = next((row for row in ladder(method, "picture") if row["cells"] == cells), None)
        if row is None:
            lines.append([method.replace(" ", ", "), "stopped", *[""] * 5])
            continue
        lines.append([method.replace(" ", ", "), seconds(row["seconds"]), giga(row["modulus"]),
                      mega(row["plateau_stress"]), points(analysis.closing_strain("loblolly", row)),
                      mega(row["work"]), percent(row["energy_error"])])
    modulus, plateau, closing = (float(analysis.first_order("loblolly", fine("gimp flip"), figure)[0])
                                 for figure in QUOTED)
    lines.append(["gimp, flip: line at h = 0", "", giga(modulus), mega(plateau), points(closing), "",
                  ""])
    return table(heads, lines)


UNITS = {"modulus": lambda value: giga(value) + " GPa",
         "plateau_stress": lambda value: mega(value) + " MPa",
         "densification_strain": points, "closing_strain": points,
         "work": lambda value: mega(value) + " MJ/m3"}


def last_level(method, geometry, figure):
    return [row for row in ladder(method, geometry)
            if analysis.value("loblolly", row, figure) is not None][-1]


def justified(method, geometry, figure, found):
    """How far the finest level is off Richardson's limit; None where that is not to be trusted."""
    if found.warnings or found.value is None:
        return None
    finest = analysis.value("loblolly", last_level(method, geometry, figure), figure)
    off = results.relative_error(finest, found.value)
    return off if off < FARTHEST else None


def plateau_limits():
    """Every limit of the plateau stress on the picture: Richardson's and the lines' ends."""
    found = []
    for method in methods():
        rows = ladder(method, "picture")
        limit = analysis.limit("loblolly", analysis.for_orders(rows), "plateau_stress")
        if limit and justified(method, "picture", "plateau_stress", limit) is not None:
            found.append(float(limit.value))
        if len(fine(method)) > 2:
            found.append(float(analysis.first_order("loblolly", fine(method), "plateau_stress")[0]))
    return f"{mega(min(found))} to {mega(max(found))} MPa"


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
                known = justified(method, geometry, figure, found)
                if known is None:
                    lines.append([*line, "not justified", ""])
                    continue
                shown = "a curve" if figure == "curve" else UNITS[figure](float(found.value))
                lines.append([*line, shown, percent(known)])
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


def reach(rows, cells):
    """Run time at so many cells; beyond a month nobody waits for it."""
    found = analysis.seconds_at(rows, cells)
    return seconds(found) if found < 30 * 86400 else "beyond a month"


def users(method):
    """What a user's resolution is worth and what 5 % and 1 % would take."""
    rows = fine(method)
    last = rows[-1]["cells"]
    heads = ["figure", "line at h = 0", "levels off the line by", "error at 75 cells", "at 150",
             f"at {last:.0f}", "cells for 5 %", "run time", "cells for 1 %", "run time"]
    lines = []
    for figure in QUOTED:
        words = analysis.FIGURES[figure]
        at_zero, _, off = analysis.first_order("loblolly", rows, figure)
        line = [words, UNITS[figure](float(at_zero)), percent(off)]
        line += [percent(analysis.first_order_error("loblolly", rows, figure, cells))
                 for cells in (75, 150, last)]
        for error in (0.05, 0.01):
            cells = analysis.cells_for("loblolly", rows, figure, error)
            line += [f"{cells:,.0f}", reach(rows, cells)]
        lines.append(line)
    return table(heads, lines)


def foretold(method, known, last):
    """What levels say of a finer one that was run after them, by the straight line through them."""
    held = {row["cells"]: row for row in ladder(method, "picture")}
    if last not in held:
        return f"{last} cells were not run.\n"
    heads = ["figure", f"foretold at {last} cells by {' and '.join(map(str, known))}", "found",
             "difference", f"change from {known[-1]} to {last} cells"]
    lines = []
    for figure in QUOTED:
        at_zero, slope, _ = analysis.first_order("loblolly", [held[cells] for cells in known], figure)
        said = float(at_zero + slope * analysis.spacing("loblolly", held[last]))
        found, before = (analysis.value("loblolly", held[cells], figure)
                         for cells in (last, known[-1]))
        lines.append([analysis.FIGURES[figure], UNITS[figure](said), UNITS[figure](found),
                      f"{100 * (said / found - 1):+.1f} %", f"{100 * (found / before - 1):+.1f} %"])
    return table(heads, lines)


def errors_at(method, cells):
    """Of the three figures that are quoted most, along the line of first order."""
    return ", ".join(
        f"{words} {percent(analysis.first_order_error('loblolly', fine(method), figure, cells))}"
        for figure, words in zip(QUOTED, ("modulus", "plateau", "closing strain")))


def three_users():
    """A sentence for each of three users."""
    method = "gimp flip"
    rows = fine(method)
    held = {row["cells"]: row for row in ladder(method, "picture")}

    def need(figure, error):
        cells = analysis.cells_for("loblolly", rows, figure, error)
        known = "" if cells <= rows[-1]["cells"] else ", extrapolated"
        return f"{cells:,.0f} cells across, {reach(rows, cells)}{known}"

    whole = {figure: analysis.first_order("loblolly", rows, figure)[0] for figure in QUOTED}

    def carried(*cells):
        """Run time of levels, and how far what they give at h = 0 is from the whole line's end."""
        pair = [held[one] for one in cells]
        limits = {figure: analysis.first_order("loblolly", pair, figure)[0] for figure in whole}
        return seconds(sum(row["seconds"] for row in pair)), ", ".join(
            f"{analysis.FIGURES[figure]} {percent(results.relative_error(limits[figure], value))}"
            for figure, value in whole.items())

    coarse_time, coarse = carried(150, 300)
    fine_time, sharp = carried(300, 600)
    return "\n".join([
        f"- **A quick look**: its defaults (gimp, flip) with `cells: [150, 97]`, "
        f"{seconds(held[150]['seconds'])}: where walls fold, and in which order; the figures are too "
        f"stiff and too early, off by {errors_at(method, 150)}. 75 cells take "
        f"{seconds(held[75]['seconds'])} and leave {errors_at(method, 75)}.",
        f"- **5 % on a real micrograph**: no single run that was made has it. Run 150 and 300 cells "
        f"across with them, {coarse_time} together, and carry "
        f"modulus, plateau and closing strain to h = 0 as 2 f300 - f150: what comes out is away from "
        f"the line through all levels from 150 cells on by {coarse}. One run alone, along that line: modulus "
        f"{need('modulus', 0.05)}; closing strain {need('closing_strain', 0.05)}; plateau "
        f"{need('plateau_stress', 0.05)}. Nothing proves 5 % of the plateau: its limits "
        f"range from {plateau_limits()}.",
        f"- **1 %**: not reached by a run. 300 and 600 cells, {fine_time} together, carried in the same way "
        f"are away from that line by {sharp}. One run alone, along the line and with run times that grow as "
        f"the ladder's: modulus {need('modulus', 0.01)}; closing strain {need('closing_strain', 0.01)}; "
        f"plateau {need('plateau_stress', 0.01)}. The picture has to be as good, too."]) + "\n"
