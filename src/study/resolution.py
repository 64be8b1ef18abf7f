"""Keys of a scene that refine its solution, and how fine a value of theirs is."""
import math
import re

from mpm_par.quantities import NUMBER, to_si


def _cells(text):
    counts = [int(word) for word in re.findall(r"\d+", text)]
    if not counts or min(counts) < 1:
        raise ValueError("is no list of numbers of cells")
    return math.prod(counts) ** (-1 / len(counts))


def _quantity(text):
    values = [to_si(word)[1] for word in text.strip("[] ").split(",")]
    if min(values) <= 0:
        raise ValueError("is not above 0")
    return math.prod(values) ** (1 / len(values))


def _inverse(text):
    return 1 / _quantity(text)


# Key: the size that goes to zero as the value is refined, and its unit. Cells that are not square
# count with the geometric mean of their sides.
SIZES = {"grid.cells": _cells, "grid.spacing": _quantity, "grid.particles_per_cell": _inverse,
         "numerics.cfl": _quantity, "loading.speed": _quantity}


def size(key, text):
    """The size that is refined; only ratios of sizes of one key mean anything."""
    return SIZES[key](text)


def coarsened(key, text, factor):
    """grid.cells or grid.spacing for cells `factor` times as large (a fraction: finer)."""
    if key == "grid.cells":
        counts = [max(2, round(int(word) / factor)) for word in re.findall(r"\d+", text)]
        return "[" + ", ".join(map(str, counts)) + "]"
    return re.sub(NUMBER, lambda number: f"{float(number[0]) * factor:.9g}", text)


def short(key, text):
    """A value for tables and legends: `[48, 42]` of cells as `48x42`."""
    if key == "grid.cells":
        return "x".join(re.findall(r"\d+", text))
    return text
