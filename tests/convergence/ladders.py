"""Runs scenes with an exact solution on finer and finer grids, for every shape function and scheme,
and compares errors with those of table.json.

    ladders.py MPM_PAR [--scene NAME ...] [--method NAME ...] [--levels N] [--write]

table.json holds, for each scene: its file, what `--set` makes of a level (`{2*n}`: twice the level),
the levels, and for each method the errors that they have. An error is a key of exact_solution in
summary.json ("error"), or what a function of measures/ ("measure", "options") finds over what is
"exact", less one. "floor" is what that function or that value is uncertain by, "bound" says that the
exact value is one from below; "remark" is for the page. --write puts the measured errors there, for
a change that is meant to alter them.
"""
import argparse
import itertools
import json
import math
import re
import sys
import tempfile
from pathlib import Path

import measures

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
import scene_run  # noqa: E402

TABLE = Path(__file__).with_name("table.json")
SCENES = Path(__file__).parents[2] / "inputs" / "benchmarks"
WORSE = 1.10  # an error may grow by so much, not more
# Methods that have neither shape function nor scheme, and what they set.
CELLS = {"total lagrangian": [], "total lagrangian fitted": ["numerics.surface=fitted"]}


def orders(levels, errors):
    """Of each pair of neighbours; h is 1 / level."""
    return [math.log(abs(a / b)) / math.log(m / n) if a and b else math.nan
            for (n, a), (m, b) in zip(zip(levels, errors), list(zip(levels, errors))[1:])]


def settings_of(case, level):
    """For --set: what stands in braces is worked out."""
    return [re.sub(r"{(.*?)}", lambda found: str(measures.number(found[1], n=level)), setting)
            for setting in case["settings"]]


def numerics_of(method):
    """For --set. Cells take shorter steps than some scenes ask for."""
    if method in CELLS:
        return ["numerics.formulation=total_lagrangian", "numerics.cfl=0.25", *CELLS[method]]
    return [f"numerics.{key}={value}"
            for key, value in zip(("shape_function", "scheme"), method.split())]


def results_of(mpm_par, case, method, level, folder):
    """Where in `folder` the run's results are; None if it broke down. A run is made once."""
    settings = settings_of(case, level)
    settings += numerics_of(method)
    results = folder / re.sub(r"[^\w.,=-]", "_", " ".join([case["scene"], *settings]))
    if not results.exists():
        scene_run.ended_or_stopped(mpm_par, SCENES / case["scene"], results, settings)
    return results if (results / "summary.json").exists() else None


def error_of(case, level, folder):
    """The error of the run whose results are in that folder; None if it broke down."""
    if folder is None:
        return None
    if "measure" in case:
        return measures.error(case, level, folder)
    return json.loads((folder / "summary.json").read_text())["exact_solution"][case["error"]]


def defects(case, method, known, measured):
    """What is wrong with these errors, in words; an empty list if nothing."""
    found = []
    for level, before, now in zip(case["levels"], known, measured):
        where = f"{case['scene']}, {method}, level {level}"
        if (before is None) != (now is None):
            found.append(f"{where}: {'broke down' if now is None else 'ran'}, which it did not before")
        elif now is not None and abs(now) > WORSE * max(abs(before), case.get("floor", 0)):
            found.append(f"{where}: error {now:.3g}, more than {WORSE} times {before:.3g}")
        elif now is not None and now < 0 <= before and case.get("bound"):
            found.append(f"{where}: {now:.3g} below what is a bound")
    return found


def climb(given, case, folder):
    """Runs the levels of a case with every method, prints the errors, and keeps or compares them."""
    found = []
    levels = case["levels"][:given.levels]
    for method, known in case["errors"].items():
        if given.method and method not in given.method:
            continue
        measured = [error_of(case, level, results_of(given.mpm_par, case, method, level, folder))
                    for level in levels]
        sound = [error for error in measured if error is not None]
        rates = orders(levels, sound) if len(sound) == len(levels) else []
        print(f"{Path(case['scene']).stem:<22} {method:<16}",
              " ".join("-" if error is None else f"{error:.3g}" for error in measured),
              " order", " ".join(f"{rate:.2f}" for rate in rates), flush=True)
        if given.write:
            case["errors"][method] = [error and float(f"{error:.4g}") for error in measured]
        else:
            found += defects(case, method, known, measured)
    return found


def text_of(table):
    """As JSON: a line for each method."""
    cases = []
    for case in table:
        lines = [f'  "{key}": {json.dumps(value)}' for key, value in case.items() if key != "errors"]
        errors = [f'    "{method}": {json.dumps(errors)}' for method, errors in case["errors"].items()]
        lines.append('  "errors": {\n' + ",\n".join(errors) + "\n  }")
        cases.append("{\n" + ",\n".join(lines) + "\n}")
    return "[" + ", ".join(cases) + "]\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--scene", nargs="+", help="names without .yaml; all unless given")
    arguments.add_argument("--method", nargs="+", help="such as 'gimp flip'; all unless given")
    arguments.add_argument("--levels", type=int, help="only so many, the coarsest")
    arguments.add_argument("--write", action="store_true")
    given = arguments.parse_args()
    table = json.loads(TABLE.read_text())
    found = []
    for scene, cases in itertools.groupby(table, lambda case: Path(case["scene"]).stem):
        if given.scene and scene not in given.scene:
            continue
        with tempfile.TemporaryDirectory() as folder:
            for case in cases:
                found += climb(given, case, Path(folder))
    if given.write:
        TABLE.write_text(text_of(table))
    sys.exit("\n".join(found) if found else 0)


if __name__ == "__main__":
    main()
