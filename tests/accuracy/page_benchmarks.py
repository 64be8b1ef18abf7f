"""The part of docs/accuracy.md on scenes with a known answer."""
import analysis
from words import percent, seconds
from written_page import table

ABOUT = {
    "vortex": "displacement, root of the mean square over the size of the exact one",
    "ring": "displacement, root of the mean square over the size of the exact one",
    "bar": "displacement, worst over time, over the size of the exact one",
    "hill": "mean growth of the radii (Hill's solution with elastic strains)",
    "honeycomb_modulus": "modulus, against that of the plane solid by finite elements",
    "full_density": "stress of a crushed honeycomb beyond full density, over that of the solid",
    "thin_wall": "stiffness in bending of a wall n cells thick, against Timoshenko's beam",
    "inclined_wall": "the same, the wall inclined to the grid",
    "gap": "width that is left when two blocks feel each other, over their length"}


def comma(method):
    return method.replace(" ", ", ")


def all_methods():
    return analysis.methods() + analysis.variants()


def table_of_fronts():
    heads = ["method"] + [case["name"].replace("_", " ") for case in analysis.cases()]
    lines = []
    for method in all_methods():
        cells = [comma(method)]
        for case in analysis.cases():
            rows = [row for row in analysis.case_rows(case["name"]) if row["method"] == method]
            timed, stepped = analysis.on_front(case["name"], method)
            mark = " **t**" * bool(timed) + " **s**" * bool(stepped)
            finest = max(rows, key=lambda row: row["level"], default=None)
            cells.append("-" if finest is None else percent(finest["error"]) + mark)
        lines.append(cells)
    return table(heads, lines)


def list_of_fronts():
    lines = []
    for case in analysis.cases():
        front = analysis.front(case["name"])
        found = [f"{comma(row['method'])} {row['level']:.0f} ({percent(analysis.settled(row))}, "
                 f"{seconds(row['seconds'])})" for row in front]
        levels = ", ".join(map(str, case["levels"]))
        lines.append(f"- **{case['title']}** (`{case['scene']}`, n = {levels}): {ABOUT[case['name']]}. "
                     + "; ".join(found) + ".")
    return "\n".join(lines) + "\n"


def broken():
    """Runs that stopped."""
    found = [row for row in analysis.read("benchmarks.csv") if row["status"] != "ok"]
    if not found:
        return ""
    text = "; ".join(f"{row['case']}, {comma(row['method'])}, n = {row['level']:.0f}"
                     for row in found)
    return f"Stopped by the watch over the energy, and without a point: {text}.\n"


def front_count():
    """Number of scenes on whose front of run time each method has a run."""
    counts = {method: sum(bool(analysis.on_front(case["name"], method)[0])
                          for case in analysis.cases()) for method in all_methods()}
    ordered = sorted(counts.items(), key=lambda pair: -pair[1])
    return ", ".join(f"{comma(method)} {count}" for method, count in ordered)
