"""Writes docs/stability.md from table.json, stability.csv and critical_cfl.json.

    page.py [--check]    --check: only says whether the page is the one that would be written
"""
import csv
import json

from atlas import FIGURES, HERE, PROJECT, RESULTS, TABLE, TOTAL, name_of, numerics_of
from critical_cfl import FILE as CRITICAL
from written_page import table as markdown, write_or_check

PAGE = PROJECT / "docs" / "stability.md"
INTRODUCTION = (HERE / "introduction.md").read_text()
GROUPS = {"stiff": "Stiff scenes", "extreme": "Extreme scenes", "space": "In space",
          "wood": "Whole wood"}
WORDS = {"gain": "gain", "loss": "loss", "ratio_low": "J", "ratio_high": "J", "through": "through",
         "gap": "gap", "pieces": "pieces", "momentum": "momentum", "turned": "turned",
         "growth": "growth", "stiffness": "stiffness"}
PERCENT = ("gain", "loss", "turned")
ORDERS = ("usf", "usl")


def percent(value):
    return f"{100 * value:.0f} %" if value >= 0.1 else f"{100 * value:.2g} %"


def shown(name, value):
    if name in PERCENT:
        return f"{WORDS[name]} {percent(value)}"
    if name == "pieces":
        return f"{value:.0f} more piece" + ("s" if value > 1 else "")
    return f"{WORDS[name]} {value:.2g}"


def cell(row, letters):
    """Verdict, figure and the letter of the cause."""
    if row is None:
        return ""
    letter = f" ({letters[row['cause']]})" if row["cause"] else ""
    if row["verdict"] == "fails":
        return f"**fails**, {row['failed_at']}{letter}"
    if row["verdict"] == "holds" and row["growth"]:
        return "holds, " + shown("growth", float(row["growth"]))
    if row["verdict"] == "holds":
        return f"holds, {percent(max(float(row['gain']), float(row['loss'])))}"
    told = [shown(name, float(row[name])) for name in row["beyond"].split()]
    if not {"gain", "loss"} & set(row["beyond"].split()):
        told.insert(0, percent(max(float(row["gain"]), float(row["loss"]))))
    return "*degrades*, " + ", ".join(told) + letter


def results():
    with open(RESULTS, newline="") as file:
        return {(row["case"], name_of(row)): row for row in csv.DictReader(file)}


def title_of(method):
    return "total Lagrangian" if method == TOTAL else method.replace(" ", ", ")


def table_of(cases, methods, rows, letters):
    heads = [title_of(method.removesuffix(" musl")) for method in methods]
    lines = [[f"{case['what']} (`{case['name']}`)",
              *(cell(rows.get((case["name"], method)), letters) for method in methods)]
             for case in cases]
    return markdown(["scene", *heads], lines)


def bounds_text(table):
    def one(name, low, high):
        return f"`{name}` " + ", ".join(([f"at least {low:g}"] if low is not None else []) +
                                        ([f"at most {high:g}"] if high is not None else []) or
                                        ["not judged"])
    def all_of(bounds):
        return "; ".join(one(name, *limits) for name, limits in bounds.items())
    lines = [[f"`{case['name']}`", all_of(case["bounds"])] for case in table["cases"]
             if case.get("bounds")]
    return (f"Bounds: {all_of(table['bounds'])}. Where a scene has its own:\n\n"
            + markdown(["scene", "bounds"], lines))


def messages(table, rows):
    """What the user is told, once for each case."""
    text = []
    for case in table["cases"]:
        failed = [(method, row) for (name, method), row in rows.items()
                  if name == case["name"] and row["verdict"] == "fails"]
        if failed:
            method, row = failed[0]
            text.append(f"- `{case['name']}`, {method.removesuffix(' musl')}: \"{row['message']}\"")
    return "\n".join(text) + "\n"


def critical_text(table):
    heads = ["shape function, scheme, update order", "bar", "corner", "corner, ratio 0.49", "drift",
             "crush", "theory", "default"]
    lines = []
    for method, found in json.loads(CRITICAL.read_text()).items():
        measured = [found[name] for name in ("bar", "corner", "corner_nu", "drift", "crush")]
        lines.append([title_of(name_of(numerics_of(method))),
                      *("none" if value == 0 else "3 or more" if value >= 3 else f"{value:g}"
                        for value in measured),
                      f"{table['limits'][method]:g}", f"{found['default']:.2g}"])
    return markdown(heads, lines)


def main():
    table, rows = json.loads(TABLE.read_text()), results()
    found = {row["cause"] for row in rows.values()}
    used = [cause for cause in table["causes"] if cause in found]
    letters = {cause: chr(ord("a") + k) for k, cause in enumerate(used)}
    plain = [name_of(numerics_of(method)) for method in table["methods"]["all"]]
    ordered = [name_of(numerics_of(method)) for method in table["methods"]["orders"]]
    parts = [INTRODUCTION.replace("FIGURES", ", ".join(f"`{name}`" for name in FIGURES)),
             bounds_text(table)]
    for group, title in GROUPS.items():
        cases = [case for case in table["cases"] if case["group"] == group]
        parts += [f"## {title}\n", table_of(cases, plain, rows, letters)]
    cases = [case for case in table["cases"] if "orders" in case["methods"]]
    parts += ["## Other update orders\n", table_of(cases, ordered, rows, letters), "## Causes\n",
              "\n".join(f"- ({letters[cause]}) {table['causes'][cause]}" for cause in used) + "\n",
              "## What the program says\n",
              "The message of the first method that fails in each scene:\n",
              messages(table, rows), (HERE / "critical.md").read_text(), critical_text(table)]
    write_or_check(PAGE, "\n".join(parts))


if __name__ == "__main__":
    main()
