"""Runs stiff and extreme scenes with both formulations, every shape function and scheme, and says
which hold.

    atlas.py MPM_PAR [--case NAME ...] [--method NAME ...] [--quick] [--long] [--csv FILE] [--write]

table.json holds the cases: a scene of `scenes` or `inputs`, what `--set` makes of it, the bounds of
the figures (figures.py) and, for each method that does not hold, its verdict and the cause.

    holds      the run ends and every figure is within its bounds
    degrades   the run ends, a figure is beyond its bounds
    fails      the program stops the run; its message is in the results

A verdict that is worse than the table's is an error, exit status 1; as collapses differ by rounding
between machines, a figure may be beyond its bound by a quarter. --csv writes the results, --write
the verdicts into the table, where causes of new ones are to be filled in.
"""
import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from figures import Scene, failed_at, figures_of

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
import scene_run  # noqa: E402

HERE = Path(__file__).parent
PROJECT = HERE.parents[1]
TABLE = HERE / "table.json"
RESULTS = HERE / "stability.csv"
VERDICTS = ("holds", "degrades", "fails")
SLACK = 0.25
FIGURES = ("gain", "loss", "ratio_low", "ratio_high", "through", "gap", "pieces", "momentum",
           "turned", "growth", "stiffness")
TOTAL = "total lagrangian"  # the method that has neither shape functions nor schemes
COLUMNS = ("case", "scene", "formulation", "shape_function", "scheme", "update_order", "cfl",
           "verdict", "beyond", *FIGURES, "steps", "failed_at", "cause", "message")


def methods_of(table, case):
    return [method for name in case["methods"] for method in table["methods"][name]]


def bounds_of(table, case):
    """Name: [lowest, highest] of a figure; null is none."""
    return {**table["bounds"], **case.get("bounds", {})}


def numerics_of(method):
    """What the scene has under numerics, by key."""
    if method == TOTAL:
        return {"formulation": "total_lagrangian"}
    keys = "formulation", "shape_function", "scheme", "update_order"  # the last: musl if not named
    return dict(zip(keys, ["updated_lagrangian", *method.split(), "musl"]))


def name_of(numerics):
    """A method with all its keys, as numerics_of and rows of the results have them."""
    if numerics["formulation"] == "total_lagrangian":
        return TOTAL
    return " ".join(numerics[key] for key in ("shape_function", "scheme", "update_order"))


def settings_of(table, case, method):
    settings = [*(f"numerics.{key}={value}" for key, value in numerics_of(method).items()),
                "output.fields=[volume_ratio, velocity]", *case.get("settings", [])]
    if "share_of_limit" in case:
        cfl = min(3, case["share_of_limit"] * table["limits"][method])  # a scene takes none above 3
        settings.append(f"numerics.cfl={cfl:.6g}")
    return settings


def broken(bounds, figures, slack=0.0):
    """Names of the figures beyond their bounds by more than a share of them."""
    return [name for name, (low, high) in bounds.items() if name in figures and not (
        (low is None or figures[name] >= low * (1 - slack)) and
        (high is None or figures[name] <= high * (1 + slack)))]


def message_of(output):
    """The program's own words, in one line, without the paths of this run."""
    text = " ".join(output.split())
    start = text.find("error")
    text = text[start:] if start >= 0 else text
    return text.split(" The last sound state")[0].removeprefix("error:").strip()


def run(mpm_par, table, case, method, folder):
    """A row of the results."""
    done = scene_run.ended_or_stopped(mpm_par, HERE / case["scene"], folder,
                                      settings_of(table, case, method))
    row = numerics_of(method)
    row |= {"case": case["name"], "scene": case["scene"], "beyond": "", "message": ""}
    row["cfl"] = float(f"{Scene(folder).cfl:.3g}")
    if done.returncode == 3:
        return row | {"verdict": "fails", "failed_at": failed_at(folder, done.stderr),
                      "message": message_of(done.stderr)}
    bounds = bounds_of(table, case)
    figures = figures_of(folder, bounds)
    beyond = broken(bounds, figures)
    row["steps"] = json.loads((folder / "summary.json").read_text())["steps"]
    verdict = "degrades" if beyond else "holds"
    return row | figures | {"verdict": verdict, "beyond": " ".join(beyond)}


def defect(table, case, method, row):
    """What is worse than the table says, in words; None if nothing."""
    known = case.get("expected", {}).get(method, ["holds", ""])
    row["cause"] = known[1] if row["verdict"] == known[0] else ""
    if VERDICTS.index(row["verdict"]) <= VERDICTS.index(known[0]):
        return None
    if row["verdict"] == "degrades" and not broken(bounds_of(table, case), row, SLACK):
        return None
    why = row["message"] or ", ".join(f"{name} {row[name]}" for name in row["beyond"].split())
    return f"{case['name']}, {method}: {row['verdict']}, was: {known[0]}. {why}"


def learn(case, method, row):
    """The verdict into the table; a cause that still fits stays."""
    expected = case.setdefault("expected", {})
    known = expected.pop(method, ["holds", ""])
    if row["verdict"] != "holds":
        expected[method] = [row["verdict"], known[1] if known[0] == row["verdict"] else ""]


def text_of(table):
    """As JSON: a line for each entry of a map, a block for each case."""
    def mapped(entries, indent):
        lines = [f"{indent}  {json.dumps(key)}: {json.dumps(value)}"
                 for key, value in entries.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    blocks = [f'  "{key}": {mapped(table[key], "  ")}' for key in table if key != "cases"]
    cases = []
    for case in table["cases"]:
        lines = [f'      "{key}": ' + (mapped(value, "      ") if key == "expected"
                                       else json.dumps(value)) for key, value in case.items()]
        cases.append("    {\n" + ",\n".join(lines) + "\n    }")
    return "{\n" + ",\n".join(blocks) + ',\n  "cases": [\n' + ",\n".join(cases) + "\n  ]\n}\n"


def chosen(table, given):
    """Cases and methods to run."""
    for case in table["cases"]:
        if given.case and case["name"] not in given.case:
            continue
        if not given.case and case.get("long", False) != given.long:
            continue
        methods = methods_of(table, case)
        if given.quick:
            methods = [method for method in case.get("quick", []) if method in methods]
        for method in methods:
            if not given.method or method in given.method:
                yield case, method


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--case", nargs="+", help="names; all that are not long unless given")
    arguments.add_argument("--method", nargs="+", help="such as 'gimp flip'; all unless given")
    arguments.add_argument("--quick", action="store_true",
                           help="the methods that a case has for it")
    arguments.add_argument("--long", action="store_true",
                           help="whole micrographs and 10^6 steps, a minute each")
    arguments.add_argument("--csv", type=Path, help="rows of other runs in it stay")
    arguments.add_argument("--write", action="store_true")
    given = arguments.parse_args()
    table = json.loads(TABLE.read_text())
    rows, found = [], []
    with tempfile.TemporaryDirectory() as folder:
        for case, method in chosen(table, given):
            output = Path(folder) / f"{len(rows)}"
            row = run(given.mpm_par.resolve(), table, case, method, output)
            subprocess.run(["rm", "-r", str(output)], check=True)
            if given.write:
                learn(case, method, row)
            worse = defect(table, case, method, row)
            found += [worse] if worse else []
            rows.append(row)
            shown = row["message"] or " ".join(f"{name}={row[name]}" for name in FIGURES
                                               if name in row and not math.isnan(row[name]))
            print(f"{case['name']:<28} {method:<20} {row['verdict']:<9} {row['beyond']} | {shown}",
                  flush=True)
            if given.csv:
                write_csv(given.csv, rows)
    if given.write:
        TABLE.write_text(text_of(table))
    sys.exit("\n".join(found) if found else 0)


def same_run(row):
    return row["case"], name_of(row)


def write_csv(file, rows):
    """New rows in the place of those of the same runs; new runs at the end."""
    kept = {}
    if file.exists():
        with open(file, newline="") as old:
            kept = {same_run(row): row for row in csv.DictReader(old)}
    kept |= {same_run(row): row for row in rows}
    with open(file, "w", newline="") as new:
        writer = csv.DictWriter(new, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept.values())


if __name__ == "__main__":
    main()
