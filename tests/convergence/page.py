"""Writes docs/verification.md from table.json and the scenes that it names.

    page.py [--check]    --check: only says whether the page is the one that would be written
"""
import json

import measures
from ladders import CELLS, SCENES, TABLE, orders
from written_page import table, write_or_check

PAGE = SCENES.parents[1] / "docs" / "verification.md"
INTRODUCTION = """# Verification

Written by `tests/convergence/page.py` from `tests/convergence/table.json`; the errors there are measured
by `tests/convergence/ladders.py build/mpm_par --write` and held by `sh jobscripts/test.sh -L convergence`:
one that grows by more than a tenth fails. The coarsest grid runs with the other tests.

A scene states its exact solution (`exact_solution` in docs/input_reference.md), in which X and Y are the
place at t = 0; or a scalar of the run, named above its table, is compared with its exact value. Where no
formula gives that, finite elements in `tests/convergence/references` do, which know nothing of `mpm_par`.
Errors of fields are roots of mean squares over all particles, weighted with mass: in metres, or
over the largest size that the exact solution has in the run. Orders are those of neighbouring grids.
Update order MUSL, two particles per cell and direction; the total Lagrangian step has a cell for each. Affine schemes have no stable step with linear
shape functions and are left out there.

What the tables say:

- linear shape functions converge until particles cross cells, and then get worse; beyond full density
  they lose stress that the solid alone would carry;
- gimp and quadratic converge with second order until the quadrature of fixed domains ends it; cubic
  goes on to errors three times smaller, and cpdi, whose domains deform, to five times smaller ones where
  strains are large along the grid's lines; it alone follows a stretch of three;
- gimp and splines end at walls at rest and converge with second order there too; beside a side that
  moves they are whole, and what lies there rings;
- pic loses energy with every step and converges with first order;
- apic and tpic are the most accurate for smooth motion; flip keeps the energy, but not the angular
  momentum, and does not always come to rest under a load that lasts (cantilever);
- moduli of honeycombs are within 1.5 % of those of the plane solid at 32 cells per wall, and within 9 %
  at four; plastic hinges are slower, 2 to 5 % at 32 cells per wall and 12 to 28 % at four;
- the cells of the total Lagrangian step bend a wall of two locations along the grid with 0.6 % of error, a
  cantilever of one, in the plane or in space, with 0.3 %, bear the plastic moment within 1.2 % with one,
  two and four locations across, and close a gap when it is closed; a wall that is clamped between posts bears
  0, 4.1 and 0.9 % more than it can, where two cells across bear 33 % more with gimp; walls across
  the grid have the stairs of their locations, which cells feel more than functions that reach over them:
  moduli of honeycombs come from below, as fast as gimp's from above; plastic collapse is within 2 to 4 % at
  four cells per wall;
- lumens close 0.7 to 2 cells too early, whatever the grid: beyond full density the stress is 30 % too
  high with walls of four cells, and 1.7 % with sixteen (gimp).
"""


def words_of(scene):
    """Title and opening comment."""
    lines = (SCENES / scene).read_text().splitlines()
    comment = [line[1:].strip() for line in lines[:lines.index(next(
        line for line in lines if not line.startswith("#")))]]
    title = next(line for line in lines if line.startswith("title:"))[len("title:"):].strip()
    return title, " ".join(comment)


def looked_at(case):
    """What the numbers of the table are."""
    if "measure" not in case:
        return f"`{case['error']}`" + (" [m]" if case["error"] == "displacement_error" else "")
    words = measures.words(case["measure"])
    if measures.number(case["exact"]) == 0:
        return words
    bound = "its bound from below" if case.get("bound") else "the exact"
    return f"{words}, over {bound} `{case['exact']}`, less one"


def cell(case, error):
    if error is None:
        return "broke down"
    if "measure" in case and measures.number(case["exact"]) != 0:
        return f"{100 * error:+.2g} %" if abs(error) < 0.1 else f"{100 * error:+.0f} %"
    return f"{error:.3g}"


def section(case, before):
    """A heading of its own, unless the case before had the same scene."""
    text = []
    if before is None or before["scene"] != case["scene"]:
        title, comment = words_of(case["scene"])
        text += [f"## {title}", "", comment, ""]
    settings = ", ".join(f"`--set {setting}`" for setting in case["settings"])
    text += [f"`inputs/benchmarks/{case['scene']}`, {settings}: {looked_at(case)}", ""]
    heads = ["shape function, scheme, or formulation", *(f"n = {n}" for n in case["levels"]), "orders"]
    lines = []
    for method, errors in case["errors"].items():
        orderless = None in errors or max(map(abs, errors)) < case.get("floor", 0)
        rates = [] if orderless else orders(case["levels"], errors)
        lines.append([method if method in CELLS else method.replace(" ", ", "),
                      *(cell(case, error) for error in errors),
                      ", ".join(f"{rate:.2f}" for rate in rates)])
    remark = f"\n{case['remark']}\n" if "remark" in case else ""
    return "\n".join([*text, table(heads, lines)]) + remark


def main():
    cases = json.loads(TABLE.read_text())
    page = INTRODUCTION + "".join("\n" + section(case, before)
                                  for before, case in zip([None, *cases], cases))
    write_or_check(PAGE, page)


if __name__ == "__main__":
    main()
