"""The part of docs/accuracy.md on early contact."""
import analysis
from words import percent, points, seconds
from written_page import table

FLIP = ("linear flip", "gimp flip", "quadratic flip", "cubic flip")


def comma(method):
    return method.replace(" ", ", ")


def gaps():
    return ", ".join(f"{analysis.gap_left(method):.2f} ({comma(method)})" for method in FLIP)


def cells_early(model, method, geometry=None):
    """Slope of the closing strain over h in cells a lumen: what early contact would have to be to
    explain all of it."""
    _, slope, _ = analysis.first_order(model, analysis.ladder(model, method, geometry),
                                       "closing_strain")
    return -slope / analysis.lumens_per_length(model)


def honeycomb():
    methods = analysis.ladder_methods("honeycomb")
    heads = ["cells across (per wall)", *map(comma, methods)]
    ladders = {method: {row["cells"]: row for row in analysis.ladder("honeycomb", method)}
               for method in methods}
    lines = []
    for cells in sorted({cells for rows in ladders.values() for cells in rows}):
        line = [f"{cells:.0f} ({cells * 0.03 / 0.866:.1f})"]
        for method in methods:
            row = ladders[method].get(cells)
            found = row and analysis.closing_strain("honeycomb", row)
            if not found:
                line.append("")
                continue
            at_zero, _, _ = analysis.first_order("honeycomb", list(ladders[method].values()),
                                                 "closing_strain")
            line.append(f"{points(found)} ({points(at_zero - found)}), {seconds(row['seconds'])}")
        lines.append(line)
    last = ["line at h = 0; slope in cells"]
    for method in methods:
        at_zero, _, off = analysis.first_order("honeycomb", list(ladders[method].values()),
                                               "closing_strain")
        last.append(f"{points(at_zero)} (+- {percent(off)}); {cells_early('honeycomb', method):.2f}")
    return table(heads, lines + [last])


def loblolly_pairs():
    """Change of the closing strain between neighbouring levels, measured, and due to early contact."""
    heads = ["method, geometry", "from cells", "to cells", "measured", "g dh n/L", "share"]
    lines = []
    for method in analysis.ladder_methods("loblolly"):
        for geometry in ("fixed", "picture"):
            rows = analysis.ladder("loblolly", method, geometry)
            if geometry == "picture":  # levels far apart, for a change that is worth its name
                rows = [row for row in rows if row["cells"] in (75, 150, 300)]
            for one, two in zip(rows, rows[1:]):
                measured = (analysis.closing_strain("loblolly", two)
                            - analysis.closing_strain("loblolly", one))
                by_gap = early("loblolly", method, one) - early("loblolly", method, two)
                lines.append([f"{comma(method)}, {geometry}", f"{one['cells']:.0f}",
                              f"{two['cells']:.0f}", points(measured), points(by_gap),
                              f"{by_gap / measured:.2f}"])
    return table(heads, lines)


def early(model, method, row):
    """Strain by which contact comes early: g h for each lumen along the way, g from the closing gap."""
    return analysis.gap_left(method) * analysis.spacing(model, row) \
        * analysis.lumens_per_length(model)


def quote():
    """What a resolution costs on loblolly, as a list."""
    rows = [row for row in analysis.ladder("loblolly", "gimp flip", "picture")
            if row["cells"] in (75, 150, 300)]
    at_zero, _, _ = analysis.first_order("loblolly", [row for row in analysis.ladder(
        "loblolly", "gimp flip", "picture") if row["cells"] >= 150], "closing_strain")
    return "; ".join(
        f"{row['cells']:.0f} cells ({seconds(row['seconds'])}): closing strain "
        f"{points(analysis.closing_strain('loblolly', row))}, "
        f"{points(at_zero - analysis.closing_strain('loblolly', row))} below the line's end, of which "
        f"early contact is {points(early('loblolly', 'gimp flip', row))}" for row in rows)
