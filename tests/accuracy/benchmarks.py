"""Error and cost of every method on scenes with a known answer.

    benchmarks.py MPM_PAR [--quick] [--case NAME ...] [--work DIR] [--write] [--kept]

table.json names scenes, levels and methods; what is measured, and against what, is that of
tests/convergence/table.json for the same scene where the case itself does not say it. --write puts
what is kept in DIR into docs/accuracy/benchmarks.csv, --kept makes no other runs; --quick runs the
coarsest levels ("quick") and writes nothing.
"""
import argparse
import json
from pathlib import Path

import runs
import ladders

TABLE = json.loads(Path(__file__).with_name("table.json").read_text())
METHODS = TABLE["methods"] + TABLE["variants"]


def whole_case(case):
    """The case with what the table of the ladders says of its scene."""
    known = next(one for one in json.loads(ladders.TABLE.read_text())
                 if one["scene"] == case["scene"])
    return {"settings": known["settings"]} | ({} if "error" in case else {
        key: known[key] for key in ("error", "measure", "exact", "options") if key in known}) | case


def error_of(case, level, folder):
    """As a positive fraction; a width that counts in cells becomes one in lengths of the scene."""
    found = abs(ladders.error_of(case, level, folder))
    return found / level if case.get("measure") == "contact.remaining_width" else found


def all_settings(case, method, level):
    return ladders.settings_of(case, level) + runs.method_settings(method)


def row_of(mpm_par, case, method, level, work):
    settings = all_settings(case, method, level)
    folder, cost = runs.run(mpm_par, ladders.SCENES / case["scene"], settings, work)
    row = {"case": case["name"], "method": method, "level": level, **cost}
    if cost["status"] == "ok":
        row["error"] = float(f"{error_of(case, level, folder):.4g}")
    return row


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--quick", action="store_true")
    arguments.add_argument("--case", nargs="+", help="names; all unless given")
    arguments.add_argument("--work", type=Path, default=runs.PROJECT / "results" / "accuracy")
    arguments.add_argument("--write", action="store_true")
    arguments.add_argument("--kept", action="store_true")
    given = arguments.parse_args()
    rows = []
    for case in map(whole_case, TABLE["cases"]):
        if given.case and case["name"] not in given.case:
            continue
        for level in case["levels"][:case["quick"] if given.quick else None]:
            for method in METHODS:
                if given.kept and not runs.kept_cost(
                        given.mpm_par, ladders.SCENES / case["scene"],
                        all_settings(case, method, level), given.work):
                    continue
                rows.append(row_of(given.mpm_par, case, method, level, given.work))
                print(" ".join(f"{key}={value}" for key, value in rows[-1].items()), flush=True)
    if given.write and not given.quick and not given.case:
        runs.write_rows("benchmarks.csv", rows)


if __name__ == "__main__":
    main()
