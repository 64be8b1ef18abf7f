"""Ladders, fronts and early contact out of the files in docs/accuracy."""
import functools
import json

import numpy
import yaml

import runs
import convergence
import pareto
import results
from benchmarks import TABLE
from loblolly import VARIANTS

read = functools.cache(runs.read_rows)
WIDTH = {"loblolly": 0.832e-3, "honeycomb": 0.866e-3}  # of the specimen along the piston's way, m
# A stress well above the plateau and below that of the full solid, at which crushed specimens are
# compared: some two and a half times the plateau stress.
CLOSED = {"loblolly": 200e6, "honeycomb": 150e6}
HONEYCOMB_PERIOD = 3 ** 0.5 * 0.1e-3  # of crushed_honeycomb.yaml along the piston's way, m


def case_rows(case):
    return [row for row in read("benchmarks.csv")
            if row["case"] == case and row["error"] is not None]


def settled(row):
    """The largest error of this level and of the finer ones of its method: an error that changes its
    sign passes through 0, and a level where it happens to do so has reached nothing."""
    return max(other["error"] for other in case_rows(row["case"])
               if other["method"] == row["method"] and other["level"] >= row["level"])


def front(case, cost="seconds"):
    """Rows that no other row of the scene beats in cost and settled error both, cheapest first.

    Where the error is as large as the exact answer, nothing was found at any cost."""
    return pareto.front([row for row in case_rows(case) if settled(row) < 1],
                        lambda row: row[cost], settled)


def on_front(case, method):
    """Number of a method's runs on the front of time, and on that of particle-steps."""
    return tuple(sum(row["method"] == method for row in front(case, cost))
                 for cost in ("seconds", "particle_steps"))


def cases():
    return TABLE["cases"]


def methods():
    """Those of the catalogue; variants() are what one of them becomes by another key."""
    return TABLE["methods"]


def variants():
    return TABLE["variants"]


def ladder_methods(model):
    """Methods of a model whose whole ladder was run."""
    return [method for method in dict.fromkeys(row["method"] for row in read(f"{model}.csv"))
            if method not in VARIANTS]


def spacing(model, row):
    """Size of a cell along the piston's way, m."""
    return WIDTH[model] / row["cells"]


def ladder(model, method, geometry=None):
    """Good rows of a method from coarse to fine."""
    found = [row for row in read(f"{model}.csv") if row["method"] == method
             and row["status"] == "ok" and geometry in (None, row.get("geometry"))]
    return sorted(found, key=lambda row: row["cells"])


def curve(model, row):
    """Strains and stresses of a run."""
    column = " ".join(filter(None, (row.get("geometry"), row["method"], f"{row['cells']:.0f}")))
    lines = read(f"{model}_curves.csv")
    return (numpy.array([line["strain"] for line in lines]),
            numpy.array([line[column] for line in lines]))


def closing_strain(model, row):
    """Strain from which on the stress stays above CLOSED; None if it does not get there."""
    strain, stress = curve(model, row)
    level = CLOSED[model]
    last = numpy.nonzero(stress < level)[0][-1]
    if last + 1 == len(strain):
        return None
    part = (level - stress[last]) / (stress[last + 1] - stress[last])
    return float(strain[last] + part * (strain[last + 1] - strain[last]))


FIGURES = {"modulus": "modulus", "plateau_stress": "plateau stress",
           "densification_strain": "onset of densification", "closing_strain": "closing strain",
           "work": "work", "curve": "whole curve"}


def value(model, row, figure):
    if figure == "curve":
        return curve(model, row)[1]
    if figure == "closing_strain":
        return closing_strain(model, row)
    return row[figure]


def for_orders(rows):
    """Levels some one and a half times apart: of nearer ones the differences are those of sampling."""
    cells = {row["cells"] for row in rows}
    for wanted in ((100, 150, 240, 360, 600), (100, 150, 240, 360), (75, 125, 180, 300)):
        if cells.issuperset(wanted):
            return [row for row in rows if row["cells"] in wanted]
    return rows


def limit(model, rows, figure):
    """convergence.Limit of a ladder, of the levels that have the figure; None for fewer than three."""
    known = [(spacing(model, row), value(model, row, figure)) for row in rows]
    known = [pair for pair in known if pair[1] is not None]
    if len(known) < 3:
        return None
    return convergence.limit(*zip(*known))


def change(model, row, other, figure):
    """Relative to the other's figure; of curves in the 2-norm. None where one is missing."""
    one, two = value(model, row, figure), value(model, other, figure)
    if one is None or two is None:
        return None
    return results.relative_error(one, two)


def exponent(rows):
    """Of seconds over the number of cells across, least squares of the logarithms."""
    return pareto.slope([row["cells"] for row in rows], [row["seconds"] for row in rows])


def first_order(model, rows, figure):
    """Straight line through a figure over the size of cells, least squares: value at h = 0 and slope
    in 1/m (of a curve: at every strain), and the largest distance of a level from it, over the value
    at h = 0 (2-norm); of the levels that have the figure."""
    known = [(spacing(model, row), value(model, row, figure)) for row in rows]
    h, f = map(numpy.array, zip(*[pair for pair in known if pair[1] is not None]))
    slope, at_zero = numpy.polyfit(h, f, 1)
    off = max(numpy.linalg.norm(numpy.atleast_1d(at_zero + slope * size - found))
              for size, found in zip(h, f))
    return at_zero, slope, float(off / numpy.linalg.norm(numpy.atleast_1d(at_zero)))


def first_order_error(model, rows, figure, cells):
    """Relative error at so many cells across, after that line."""
    at_zero, slope, _ = first_order(model, rows, figure)
    return float(numpy.linalg.norm(numpy.atleast_1d(slope)) * WIDTH[model] / cells
                 / numpy.linalg.norm(numpy.atleast_1d(at_zero)))


def cells_for(model, rows, figure, error):
    """Cells across at which that line leaves so much of an error."""
    return first_order_error(model, rows, figure, 1) / error


def seconds_at(rows, cells):
    """Run time at so many cells, from the finest level with the exponent of the ladder."""
    return rows[-1]["seconds"] * (cells / rows[-1]["cells"]) ** exponent(rows)


def gap_left(method):
    """Cells between two bodies when they begin to feel each other, on the finest grid of the
    closing gap."""
    finest = max((row for row in case_rows("gap") if row["method"] == method),
                 key=lambda row: row["level"])
    return finest["error"] * finest["level"]


def earlywood():
    """Share of the picture's width and number of lumens across it, of the loblolly model."""
    drawn = yaml.safe_load((runs.PROJECT / "inputs/wood/loblolly.anatomy.yaml").read_text())
    share = drawn["density"]["windows"][0]["to"]
    pitch = drawn["files"]["earlywood"]["radial_pitch"] * 1e-6
    return share, share * WIDTH["loblolly"] / pitch


def lumens_per_length(model):
    """Lumens that close one after another along the piston's way, over the specimen's length, 1/m."""
    if model == "honeycomb":
        return 1 / HONEYCOMB_PERIOD
    return earlywood()[1] / WIDTH["loblolly"]


def machine():
    return json.loads((runs.RESULTS / "machine.json").read_text())

